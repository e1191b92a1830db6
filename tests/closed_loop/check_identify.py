# SPDX-License-Identifier: Apache-2.0
"""`graben identify --csv`: finds a machine that only this file knows, and refuses recordings that are none."""

import csv
import gzip
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

AXES = ("boom", "arm", "bucket", "swing")
STEP_S = 0.05
FINE = 10  # Steps of the machine within one of the recording.
COLUMNS = ["run", "time_s", *(f"{what}_{axis}" for axis in AXES
                              for what in ("command_permille", "angle_rad", "velocity_radps"))]


class Axis:
    """Dead time, pilot lag, an opening per direction, a second-order answer to the flow."""

    def __init__(self, dead_time_s, lag_s, edges, full_radps, sign):
        self.dead_time_s, self.lag_s, self.edges, self.full_radps, self.sign = (
            dead_time_s, lag_s, edges, full_radps, sign)

    def start(self):
        self.pilot = self.velocity = self.push = self.angle = 0.0

    def opening(self):
        edge = self.edges[0] if self.pilot > 0 else self.edges[1]
        open_ratio = max(0.0, (abs(self.pilot) - edge) / (1 - edge)) ** 1.4
        return math.copysign(open_ratio, self.pilot)

    def step(self, command, shared, h):
        self.pilot += (command - self.pilot) * (1 - math.exp(-h / self.lag_s))
        wanted = self.full_radps * self.opening() * shared
        self.push += h * (18 * 18 * (wanted - self.velocity) - 2 * 0.8 * 18 * self.push)
        self.velocity += h * self.push
        self.angle += h * self.sign * self.velocity


MACHINE = dict(boom=Axis(0.14, 0.06, (0.41, 0.50), 0.45, -1), arm=Axis(0.10, 0.09, (0.30, 0.44), 0.7, 1),
               bucket=Axis(0.18, 0.05, (0.52, 0.36), 1.0, -1), swing=Axis(0.06, 0.12, (0.40, 0.40), 0.9, 1))


def recording(seed, runs, standing=(), most=1.0, seconds=25):
    rows = []
    dice = random.Random(seed)
    for run in range(runs):
        commands = {axis: [] for axis in AXES}
        for axis in AXES:
            while len(commands[axis]) < seconds / STEP_S:
                to = 0.0 if axis in standing or dice.random() < 0.3 else dice.uniform(-most, most)
                commands[axis] += [to] * dice.randint(6, 24)
            MACHINE[axis].start()
        for row in range(int(seconds / STEP_S)):
            rows.append([run, f"{row * STEP_S:.3f}"])
            for axis in AXES:
                of = MACHINE[axis]
                rows[-1] += [f"{1000 * commands[axis][row]:.0f}", f"{of.angle:.6f}",
                             f"{of.sign * of.velocity + dice.gauss(0, 0.002):.6f}"]
            for fine in range(FINE):
                h = STEP_S / FINE
                open_all = sum(abs(MACHINE[axis].opening()) for axis in AXES)
                for axis in AXES:
                    of = MACHINE[axis]
                    late = math.floor(row + (fine * h - of.dead_time_s) / STEP_S + 1e-9)
                    others = open_all - abs(of.opening())
                    of.step(commands[axis][late] if late >= 0 else 0.0, 1 / (1 + 0.25 * others), h)
    return rows


def write(path, rows, columns=None):
    opened = gzip.open if path.suffix == ".gz" else open
    with opened(path, "wt", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(columns or COLUMNS)
        writer.writerows(rows)
    return path


def call(graben, *arguments):
    return subprocess.run([graben, "identify", *map(str, arguments)], capture_output=True, text=True)


def refused(graben, needle, *arguments, status=1):
    done = call(graben, *arguments)
    assert done.returncode == status, f"{arguments}: status {done.returncode}, {done.stderr}"
    assert needle in done.stderr, f"{arguments}: {needle!r} is not in: {done.stderr}"
    assert not done.stdout, done.stdout


def edge_of(curve):
    """Command at which a curve reaches 5 % of its highest velocity, as MACHINE's own is judged below."""
    wanted = 0.05 * curve[-1]["velocity_radps"]
    for low, high in zip(curve, curve[1:]):
        if high["velocity_radps"] >= wanted:
            rise = high["velocity_radps"] - low["velocity_radps"]
            return low["command_ratio"] + (high["command_ratio"] - low["command_ratio"]) * (
                wanted - low["velocity_radps"]) / rise
    raise AssertionError(curve)


def finds(graben, folder):
    train = write(folder / "train.csv.gz", recording(1, 12))
    judge = write(folder / "judge.csv", recording(2, 4))
    summary = folder / "summary.json"
    done = call(graben, "--csv", train, "--judge", judge, "--summary", summary)
    assert done.returncode == 0 and not done.stderr, done.stderr
    said = json.loads(summary.read_text())
    assert (said["trained_runs"], said["judged_runs"]) == (12, 4)
    for axis, of in MACHINE.items():
        found = said["axes"][axis]
        print(f"{axis}: R2 {found['velocity_r2']:.4f}, {1e3 * found['angle_1s_rms_rad']:.1f} mrad a second ahead, "
              f"dead time {1e3 * found['dead_time_s']:.0f} of {1e3 * of.dead_time_s:.0f} ms, "
              f"lag {1e3 * found['lag_opening_s']:.0f} of {1e3 * of.lag_s:.0f} ms")
        assert found["velocity_r2"] > 0.995 and found["angle_1s_rms_rad"] < 0.015, found
        # Pilot, pump and dead time stand in for each other: their sum is what the motion says.
        assert abs(found["dead_time_s"] - of.dead_time_s) < 0.025, found["dead_time_s"]
        assert found["positive_command_turns"] == of.sign
        for direction, edge in zip(("positive", "negative"), of.edges):
            wanted = edge + (1 - edge) * 0.05 ** (1 / 1.4)
            assert abs(edge_of(found[direction]) - wanted) < 0.03, (axis, direction, edge_of(found[direction]), wanted)
            speeds = [point["velocity_radps"] for point in found[direction]]
            assert speeds == sorted(speeds)
    return train, judge


def says_what_is_not_known(graben, folder):
    part = write(folder / "part.csv", recording(3, 3, standing=("swing",), most=0.7))
    summary = folder / "part.json"
    done = call(graben, "--csv", part, "--summary", summary)
    assert done.returncode == 0, done.stderr
    assert "swing: stood throughout" in done.stdout, done.stdout
    assert "boom, positive commands: nothing beyond " in done.stdout, done.stdout
    said = json.loads(summary.read_text())
    assert said["axes"]["swing"]["velocity_r2"] is None and said["judged_runs"] == 1


def differenced(rows):
    """Velocities as most recordings have them: differences of angles with 0.5 mrad of noise."""
    dice = random.Random(7)
    noisy = [[float(row[3 * axis + 3]) + dice.gauss(0, 5e-4) for axis in range(4)] for row in rows]
    result = []
    for at, row in enumerate(rows):
        new = list(row)
        for axis in range(4):
            near = [n for n in (at - 1, at + 1) if 0 <= n < len(rows) and rows[n][0] == row[0]]
            apart = STEP_S * (max(near[-1], at) - min(near[0], at))
            new[3 * axis + 3] = f"{noisy[at][axis]:.6f}"
            new[3 * axis + 4] = f"{(noisy[max(near[-1], at)][axis] - noisy[min(near[0], at)][axis]) / apart:.6f}"
        result.append(new)
    return result


def by_angles(graben, folder):
    """Ratios, degrees, and no sensor of velocity: dead times come out all the same, and all is said."""
    rows = differenced(recording(1, 10))
    for row in rows:
        for axis in range(4):
            row[3 * axis + 2] = f"{float(row[3 * axis + 2]) / 1000:.4f}"
            row[3 * axis + 3] = f"{math.degrees(float(row[3 * axis + 3])):.5f}"
    summary = folder / "angles.json"
    done = call(graben, "--csv", write(folder / "angles.csv", rows), "--summary", summary)
    assert done.returncode == 0, done.stderr
    for needle in ("they are ratios", "angle_rad_boom is in degrees", "velocity_radps_boom is a difference of the angles"):
        assert needle in done.stdout, done.stdout
    for axis, of in MACHINE.items():
        found = json.loads(summary.read_text())["axes"][axis]
        error_s = found["dead_time_s"] - of.dead_time_s
        print(f"{axis} by its angles: dead time off by {1e3 * error_s:.1f} ms")
        assert abs(error_s) < 0.025 and abs(error_s) < 4 * found["dead_time_deviation_s"], error_s
        assert found["delay_positive"]["to_50_s"] > found["dead_time_s"] and found["model"] == "physical"
        assert found["physical_r2"] > max(found["curve_r2"], found["ridge_r2"]) - 0.02
        assert len(found["fitted"]["load_positive_by_pose"]["value"]) == 7


def other_numbers(graben, folder):
    """Per cent, one ratio among per mille, a swing that wraps, and an arm that moves uncommanded: said, and right."""
    rows = recording(6, 4, seconds=15)
    for row in rows:
        row[COLUMNS.index("angle_rad_swing")] = f"{(float(row[COLUMNS.index('angle_rad_swing')]) + 3 + math.pi) % (2 * math.pi) - math.pi:.6f}"
        row[COLUMNS.index("command_permille_boom")] = f"{float(row[COLUMNS.index('command_permille_boom')]) / 1000:.3f}"
        row[COLUMNS.index("command_permille_arm")] = "0"
    summary = folder / "other.json"
    done = call(graben, "--csv", write(folder / "other.csv", rows), "--summary", summary)
    assert done.returncode == 0, done.stderr
    assert ": it is a ratio, not per mille" in done.stdout, done.stdout
    assert "angle_rad_swing wraps" in done.stdout and "inf" not in done.stdout, done.stdout
    said = json.loads(summary.read_text())["axes"]
    assert said["arm"]["driven"] is False and "dead_time_s" not in said["arm"], said["arm"]
    assert said["boom"]["velocity_r2"] > 0.9 and said["swing"]["velocity_r2"] > 0.9, said
    short = [[*row[:2], *(f"{float(cell) / 10:.1f}" if COLUMNS[at].startswith("command") else cell for at, cell in enumerate(row) if at > 1)]
             for row in recording(6, 4, seconds=4, standing=AXES[1:])]
    done = call(graben, "--csv", write(folder / "percent.csv", short), "--summary", summary)
    assert "they are per cent, not per mille" in done.stdout and "beyond 9 %" not in done.stdout, done.stdout + done.stderr


def useless(graben, folder):
    """Commands of another day."""
    rows, other = recording(8, 3), recording(9, 3)
    mixed = [[*row[:2], *(cell for axis in range(4) for cell in (other[at][3 * axis + 2], *row[3 * axis + 3:3 * axis + 5]))]
             for at, row in enumerate(rows)]
    done = call(graben, "--csv", write(folder / "mixed.csv", mixed), "--summary", folder / "mixed.json")
    assert done.returncode == 1 and "no axis follows its command" in done.stderr, done.stdout + done.stderr


def changed(rows, row, column, value):
    new = [list(line) for line in rows]
    new[row][COLUMNS.index(column)] = value
    return new


def bad_files(graben, folder, train, judge):
    out = folder / "none.json"
    rows = recording(4, 3, seconds=10)

    def bad(needle, text_or_rows, columns=None, name="bad.csv"):
        file = folder / name
        if isinstance(text_or_rows, bytes):
            file.write_bytes(text_or_rows)
        else:
            write(file, text_or_rows, columns)
        refused(graben, needle, "--csv", file, "--summary", out)

    bad("is empty", b"")
    bad("has a header and no rows", [])
    bad("bad.csv:9: velocity_radps_arm is \"nan\"", changed(rows, 7, "velocity_radps_arm", "nan"))
    bad("bad.csv:9: command_permille_boom is \"\"", changed(rows, 7, "command_permille_boom", ""))
    bad("bad.csv:9: angle_rad_boom is \"1e999\"", changed(rows, 7, "angle_rad_boom", "1e999"))
    bad("command_permille_swing is 1001; -1000 .. 1000", changed(rows, 7, "command_permille_swing", "1001"))
    bad("velocity_radps_swing is 50", changed(rows, 7, "velocity_radps_swing", "50"))
    bad("time_s goes on by 100", changed(rows, 7, "time_s", "100.3"))
    bad("time_s goes on by -", changed(rows, 7, "time_s", "0.1"))
    bad("bad.csv:9: angle_rad_boom jumps by -", changed(rows, 7, "angle_rad_boom", "-99"))
    bad("has no column command_permille_swing", [[*row[:11], *row[12:]] for row in rows], [*COLUMNS[:11], *COLUMNS[12:]])
    bad("has the column run twice", rows, ["run", "run", *COLUMNS[2:]])
    bad("is the file cut off", [*rows, rows[-1][:5]])
    bad("lasts 0.95 s", rows[:20])
    bad("two recordings in one file", [*rows[:150], *rows[200:400], *rows[150:200]])
    bad("angle_rad_boom does not go where velocity_radps_boom leads",
        [[*row[:3], -float(row[3]), *row[4:]] for row in rows])
    bad("angle_rad_arm does not go where velocity_radps_arm leads",
        [[*row[:6], 3 * float(row[6]), *row[7:]] for row in rows])
    bad("no joint moves", recording(5, 3, standing=AXES, seconds=5))
    bad("1 runs: at least 3 are needed to leave one out", recording(5, 1, seconds=5))
    bad("is cut off or damaged", train.read_bytes()[:-2000], name="bad.csv.gz")
    bad("has no column run", b"(1.0) can0 123#00\n(1.1) can0 123#00\n")
    refused(graben, "there is no such file", "--csv", folder / "gone.csv", "--summary", out)
    refused(graben, "can't be judged by what it was made of", "--csv", train, "--judge", train, "--summary", out)
    refused(graben, "can't be judged", "--csv", judge, judge, "--summary", out)
    refused(graben, "can't be written", "--csv", judge, "--summary", judge / "folder.json")
    refused(graben, "--csv, or --log of a machine's log", "--summary", out, status=2)
    refused(graben, "--summary is required", "--csv", train, status=2)
    assert not out.exists()


def main(graben):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        train, judge = finds(graben, folder)
        says_what_is_not_known(graben, folder)
        by_angles(graben, folder)
        other_numbers(graben, folder)
        useless(graben, folder)
        bad_files(graben, folder, train, judge)


main(*sys.argv[1:])
