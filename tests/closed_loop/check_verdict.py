# SPDX-License-Identifier: Apache-2.0
"""`graben verdict`: a right answer or a clear word for each of 30 logs: own, foreign, cut, empty, wrong DBC, saturated,
two machines. One simulated motion is written in many ways. check_verdict.py GRABEN CAN_DBC"""

import gzip
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

AXES = ("boom", "arm", "bucket", "swing")
STEP_S = 0.02
DEAD_S = dict(boom=0.14, arm=0.10, bucket=0.18, swing=0.06)
LAG_S = dict(boom=0.08, arm=0.10, bucket=0.06, swing=0.15)
FULL_RADPS = dict(boom=0.4, arm=0.6, bucket=0.9, swing=0.7)
EDGE = 0.25


def motion(seed=1, seconds=45, sign=1, commands=lambda dice: 0.0 if dice.random() < 0.2 else max(-1.0, min(1.0, dice.uniform(-1.1, 1.1))),
           asked=lambda command: command):
    """{axis: (commands as recorded, angles)}, a row each STEP_S; `asked`: what is recorded of a command."""
    dice = random.Random(seed)
    rows = int(seconds / STEP_S)
    result = {}
    for axis in AXES:
        real = []
        left = 0
        speed = angle = 0.0
        angles = []
        for row in range(rows):
            if left == 0:
                command = commands(dice)
                # Away from the ends of its travel.
                real.append(-math.copysign(command, angle * sign) if abs(angle) > 0.25 else command)
                left = dice.randint(15, 60)
            else:
                real.append(real[-1])
            left -= 1
            late = row - 1 - round(DEAD_S[axis] / STEP_S)  # What is held from that row on moves until this one.
            command = real[late] if late >= 0 else 0.0
            wanted = sign * math.copysign(max(0.0, abs(command) - EDGE) / (1 - EDGE), command) * FULL_RADPS[axis]
            before = speed
            speed += (wanted - speed) * (1 - math.exp(-STEP_S / LAG_S[axis]))
            angle += STEP_S * (before + speed) / 2
            angles.append(angle + dice.gauss(0, 1e-4))
        result[axis] = ([asked(command) for command in real[:rows]], angles)
    return result


def table(moves, header, cells, time=lambda row: f"{row * STEP_S:.3f}", between=",", rows=None, every=1):
    text = between.join(header) + "\n"
    count = len(next(iter(moves.values()))[0])
    for row in range(0, count, every):
        if rows is None or rows(row):
            text += between.join([time(row), *cells(row)]) + "\n"
    return text


def plain(moves, axes=AXES, command=lambda c: f"{1000 * c:.0f}", angle=lambda a: f"{a:.5f}",
          names=("command_permille_{}", "angle_rad_{}"), clock="time_s", **more):
    header = [clock, *(name.format(axis) for axis in axes for name in names)]
    return table(moves, header, lambda row: [text for axis in axes for text in
                                            (command(moves[axis][0][row]), angle(moves[axis][1][row]))], **more)


def protected(identity, data):
    crc = 0
    for byte in ((identity >> 8) & 0xFF, (identity >> 16) & 0xFF, *data[1:]):
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x1D) & 0xFF if crc & 0x80 else crc << 1
    return bytes([crc, *data[1:]])


def words(*values):
    return b"".join(int(round(value)).to_bytes(2, "little") for value in values)


def own_frames(moves, enable=1):
    """Strokes as angles of a lever of 0.5 m; swing as it is."""
    frames = []
    for row in range(len(moves["boom"][0])):
        at = row * STEP_S
        counter = row % 15
        duty = [32000 + 20000 * moves[axis][0][row] for axis in AXES]
        head = bytes([0, counter | enable << 4])
        frames.append((at, 0x0CFF3082, protected(0x0CFF3082, head + words(*duty[:3]))))
        frames.append((at, 0x0CFF3782, protected(0x0CFF3782, head + words(duty[3]) + bytes(4))))
        for axis, identity in zip(AXES, (0x0CFF2080, 0x0CFF2180, 0x0CFF2280)):
            stroke = 20000 * (0.9 + 0.5 * moves[axis][1][row])
            frames.append((at + 0.001, identity, protected(identity, head + words(stroke) + bytes(4))))
        swing = (moves["swing"][1][row] * 1000 + 3200) / 0.1
        frames.append((at + 0.001, 0x0CFF2A80, protected(0x0CFF2A80, head + words(swing, 1000, 1000))))
    return frames


def zx200_frames(moves, angles_from=0xE8):
    frames = []
    for row in range(len(moves["boom"][0])):
        at = row * STEP_S
        command = []
        for axis in AXES:
            value = moves[axis][0][row]
            command += [max(0, value) * 250, max(0, -value) * 250]
        frames.append((at, 0x18FF640A, bytes(round(each) for each in command)))
        raw = [(10 - moves[axis][1][row]) / 0.0004 for axis in AXES[:3]]
        frames.append((at + 0.002, 0x18FF7D00 | angles_from, words(*raw, 0)))
    return frames


FOREIGN_DBC = """VERSION ""
BU_: A B
BO_ 256 Levers: 8 A
 SG_ BoomCmd : 0|16@1- (0.1,0) [-100|100] "%" B
 SG_ StickCmd : 16|16@1- (0.1,0) [-100|100] "%" B
 SG_ BucketCmd : 32|16@1- (0.1,0) [-100|100] "%" B
 SG_ SlewCmd : 48|16@1- (0.1,0) [-100|100] "%" B
BO_ 257 Angles: 8 B
 SG_ BoomAngle : 7|16@0- (0.01,0) [-180|180] "deg" A
 SG_ StickAngle : 23|16@0- (0.01,0) [-180|180] "deg" A
 SG_ BucketAngle : 39|16@0- (0.01,0) [-180|180] "deg" A
 SG_ SlewAngle : 55|16@0- (0.01,0) [-180|180] "deg" A
"""


def foreign_frames(moves):
    frames = []
    for row in range(len(moves["boom"][0])):
        at = row * STEP_S
        frames.append((at, 0x100, b"".join(round(1000 * moves[axis][0][row]).to_bytes(2, "little", signed=True) for axis in AXES)))
        frames.append((at, 0x101, b"".join(round(math.degrees(moves[axis][1][row]) * 100).to_bytes(2, "big", signed=True)
                                          for axis in AXES)))
    return frames


def candump(frames, begin=1700000000.0):
    return "".join(f"({begin + at:.6f}) can0 {f'{identity:03X}' if identity < 0x800 else f'{identity:08X}'}#{data.hex().upper()}\n"
                   for at, identity, data in sorted(frames, key=lambda frame: frame[0]))


def asc(frames):
    text = "date Tue Mar 3 10:00:00 2026\nbase hex  timestamps absolute\nno internal events logged\n"
    for at, identity, data in sorted(frames, key=lambda frame: frame[0]):
        name = f"{identity:X}" + ("x" if identity >= 0x800 else "")
        text += f"{at:.6f} 1  {name}             Rx   d {len(data)} {' '.join(f'{byte:02X}' for byte in data)}\n"
    return text


class Check:
    def __init__(self, graben, folder):
        self.graben, self.folder, self.count = graben, folder, 0

    def call(self, name, content, *options):
        file = self.folder / name
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        summary = self.folder / "summary.json"
        summary.unlink(missing_ok=True)
        done = subprocess.run([self.graben, "verdict", file, "--summary", summary, *map(str, options)],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.count += 1
        said = json.loads(summary.read_text()) if summary.exists() else None
        return done, said

    def good(self, name, content, *options, drives=AXES, says=(), dead_s=0.015):
        done, said = self.call(name, content, *options)
        assert done.returncode == 0 and not done.stderr, f"{name}: {done.stderr}"
        for drive in drives:
            of = said["drives"][drive]
            assert of["useful"] and of["r2"] > 0.9, f"{name}, {drive}: {of}"
            assert abs(of["dead_time_s"] - DEAD_S[drive]) < dead_s, f"{name}, {drive}: {of['dead_time_s']}"
        for words_ in says:
            assert words_ in done.stdout, f"{name}: {words_!r} is not in:\n{done.stdout}"
        return said

    def refused(self, name, content, needle, *options):
        done, said = self.call(name, content, *options)
        assert done.returncode == 1 and said is None and not done.stdout, f"{name}: {done.returncode} {done.stdout}"
        assert needle in done.stderr, f"{name}: {needle!r} is not in: {done.stderr}"
        assert done.stderr.count("\n") == 1, done.stderr


def tables(check, moves):
    said = check.good("plain.csv", plain(moves), "--html", check.folder / "page.html")
    page = (check.folder / "page.html").read_text()
    assert page.startswith("<!DOCTYPE html>") and "http" not in page and page.count("<svg") == 8
    assert said["drives"]["boom"]["negative"]["driven"] and 0.2 < said["drives"]["boom"]["positive"]["edge_ratio"] < 0.32
    assert 0.001 < said["tip_error_m"]["rms"] < 0.2 and said["tip_error_m"]["low"] < said["tip_error_m"]["rms"]
    said = check.good("two.csv", plain(moves, axes=("boom", "arm")), drives=("boom", "arm"))
    assert list(said["drives"]) == ["boom", "arm"] and all(row["value"] for row in said["draft"])
    check.good("ratios.csv.gz", gzip.compress(plain(moves, command=lambda c: f"{c:.3f}").encode()),
               says=("ratio, though it says per mille",))
    check.good("degrees.csv", plain(moves, angle=lambda a: f"{math.degrees(a):.3f}"), says=("degrees, though it says rad",))
    check.good("ms.csv", plain(moves, time=lambda row: f"{20 * row}"), says=("but its steps of 20 are ms",))
    check.good("comma.csv", plain(moves, names=("{} lever [%]", "{} angle [deg]"), clock="Zeit [s]", between=";",
                                  command=lambda c: f"{100 * c:.1f}".replace(".", ","),
                                  angle=lambda a: f"{math.degrees(a):.3f}".replace(".", ","),
                                  time=lambda row: f"{row * STEP_S:.3f}".replace(".", ",")), says=("decimal comma",))
    check.good("joystick.csv", plain(moves, names=("{}_joystick", "{}_theta"), clock="t", command=lambda c: f"{1500 + 500 * c:.0f}"),
               says=("about 1500",))
    check.good("clock.csv", plain(moves, clock="timestamp", time=lambda row: "2026-03-01T10:%02d:%06.3f" % divmod(row * STEP_S, 60)))
    check.good("gaps.csv", plain(moves, rows=lambda row: row % 1000 < 950), says=("gaps",))
    check.good("cut.csv", plain(moves)[:-20], says=("cut off",))
    check.good("cut.csv.gz", gzip.compress(plain(moves).encode())[:-3000], says=("is cut off or damaged",))
    said = check.good("no_command.csv", plain(moves).replace("command_permille_arm", "note"), drives=("boom", "bucket"))
    assert not said["drives"]["arm"]["has_command"] and any("no command" in text for text in said["drives"]["arm"]["known"])
    check.refused("empty.csv", "", "is empty: there is nothing in it")
    check.refused("header.csv", "time_s,boom_cmd,boom_angle\n", "no rows")
    check.refused("nothing.csv", "time_s,temperature\n" + "".join(f"{row},20\n" for row in range(100)), "no drive is in it")
    check.refused("numbers.csv", "1,2,3\n4,5,6\n", "has no header")
    check.refused("stands.csv", plain({axis: ([0.0] * 2000, [0.3] * 2000) for axis in AXES}), "no drive moves")


def strange_tables(check, moves):
    """As strangers' recorders write them: what was lost or taken otherwise is said, or nothing is."""
    def with_angle(of):
        """The boom's angle in row `n` as of(n, text)."""
        head, *rows = plain(moves).rstrip().split("\n")
        cells = [row.split(",") for row in rows]
        return "\n".join([head, *(",".join([*row[:2], of(n, row[2]), *row[3:]]) for n, row in enumerate(cells))]) + "\n"

    check.good("wraps.csv", plain(moves, angle=lambda a: f"{(360 * 3 + math.degrees(4 * a)) % 360:.3f}"), dead_s=0.02,
               says=("at a full turn, 360: counted on",))
    check.good("no_value.csv", with_angle(lambda n, text: "-999" if n % 100 < 3 else text), says=("are -999, far off",))
    said = check.good("holes.csv", with_angle(lambda n, text: "" if n // 300 % 2 else text), says=("are no number",))
    assert 0.3 < said["drives"]["boom"]["blind_share"] < 0.6, said["drives"]["boom"]
    check.good("minutes.csv", plain(moves, clock="time_min", time=lambda row: f"{row * STEP_S / 60:.7f}"))
    check.good("european.csv", plain(moves, clock="time", between=";", time=lambda row: (
        "1.3.2026 10:%02d:%06.3f" % divmod(row * STEP_S, 60)).replace(".", ",").replace(",", ".", 2)))
    check.good("asked_speed.csv", plain(moves, names=("{}_velocity_command", "angle_rad_{}"), command=lambda c: f"{c / 2:.4f}"))
    said = check.good("input.csv", plain(moves, names=("{}_cmd_in_percent", "angle_rad_{}"), command=lambda c: f"{100 * c:.2f}"))
    assert "turns against" not in str(said["draft"]), said["draft"]
    check.good("two_columns.csv", "\n".join(f"{row},{row.split(',')[2] if n == 0 else 0.5}" for n, row in enumerate(
        plain(moves).rstrip().split("\n"))), says=("one counts; not used: angle_rad_boom",))
    check.good("half_german.csv", plain(moves).replace("angle_rad_arm", "Stiel_Winkel"), drives=("boom", "bucket"),
               says=("not used: Stiel_Winkel",))
    said = check.call("a_second.csv", plain(moves, every=50))[1]["drives"]["boom"]
    assert not said["useful"] and "a value each 1000 ms: slower" in str(said["known"]), said
    said = check.call("5_hz.csv", plain(motion(seconds=200), every=10))[1]["drives"]["boom"]
    assert abs(said["dead_time_s"] - DEAD_S["boom"]) < 1.96 * said["dead_time_deviation_s"], said
    swapped = plain(moves).replace("command_permille_boom", "x").replace("command_permille_arm", "command_permille_boom")
    done, said = check.call("swapped.csv", swapped.replace(",x,", ",command_permille_arm,"))
    assert done.returncode == 0 and "columns of two drives changed about?" in str(said["drives"]["boom"]["known"]), done.stdout
    coarse = "have the time of the row before"
    check.refused("whole_seconds.csv", plain(moves, time=lambda row: f"{int(row * STEP_S)}"), coarse)
    twice = [[f"{n},{row}" for row in plain(motion(seed=n)).rstrip().split("\n")] for n in (1, 5)]
    check.refused("machines.csv", "\n".join(row for both in [("machine" + twice[0][0][1:],), *list(zip(*twice))[1:]]
                                            for row in both), coarse)
    check.refused("commas.csv", plain(moves, angle=lambda a: f"{a:.5f}".replace(".", ",")), "decimal commas between")
    check.refused("old_mac.csv", plain(moves).replace("\n", "\r"), "end in CR alone")


def limits(check):
    full = motion(seed=2, commands=lambda dice: dice.choice((0, 1, -1)))
    said = check.good("saturated.csv", plain(full))
    assert "saturated" in " ".join(said["drives"]["boom"]["known"]), said["drives"]["boom"]
    half = motion(seed=3, asked=lambda command: max(0.0, command))
    done, said = check.call("cut_off.csv", plain(half))
    assert done.returncode == 0 and said["drives"]["boom"]["way_without_command_share"] > 0.1
    assert "% of its way it went with no command" in done.stdout and "negative commands: none was driven" in done.stdout
    other = motion(seed=4)
    done, said = check.call("others.csv", plain({axis: (full[axis][0], other[axis][1]) for axis in AXES}))
    assert done.returncode == 0 and not any(of["useful"] for of in said["drives"].values()), done.stdout
    assert "does not explain its motion" in done.stdout and said["tip_error_m"] is None


def buses(check, moves, can_dbc):
    own = own_frames(moves)
    says = ("our excavator bus",)
    check.good("own.log", candump(own), says=says)
    check.good("own.asc", asc(own), says=says)
    check.good("own_cut.log", candump(own)[:-30], says=says)
    check.refused("own_empty.log", "", "is empty")
    two = [(at + 0.004, identifier, data) for at, identifier, data in own_frames(motion(seed=5))]
    check.refused("two_own.log", candump(own + two), "two machines in one log")
    check.good("zx200.log", candump(zx200_frames(moves)), "--dbc", "zx200", drives=AXES[:3], says=("zx200.toml",))
    check.good("zx200_dbc.log", candump(zx200_frames(moves)), "--dbc", can_dbc / "zx200.dbc", drives=AXES[:3])
    both = zx200_frames(moves) + zx200_frames(motion(seed=6), angles_from=0xE9)
    check.refused("two_zx200.log", candump(both), "from 0xE8 and 0xE9; --source", "--dbc", "zx200")
    check.good("one_of_two.log", candump(both[:len(both) // 2] + [frame for frame in both[len(both) // 2:] if frame[1] & 0xFF == 0xE9]),
               "--dbc", "zx200", "--source", "0xE8", drives=AXES[:3])
    dbc = check.folder / "machine.dbc"
    dbc.write_text(FOREIGN_DBC)
    foreign = candump(foreign_frames(moves))
    check.good("foreign.log", foreign, "--dbc", dbc)
    check.refused("foreign_no_dbc.log", foreign, "--dbc FILE says how")
    check.refused("wrong_dbc.log", foreign, "another machine", "--dbc", can_dbc / "zx200.dbc")
    dbc.write_text(FOREIGN_DBC.replace("@0-", "@1+").replace("(0.01,0)", "(0.5,0)"))
    check.refused("wrong_layout.log", foreign, "read by the DBC of another", "--dbc", dbc)
    check.good("own.csv", candump(own), says=says)
    check.refused("no_source.log", candump(own), "allowed: 0x80, 0x82", "--source", "0x55")
    broken = [(at, identity, bytes([data[0] ^ 255, *data[1:]])) for at, identity, data in own]
    check.refused("broken.log", candump(broken), "every one of them a wrong checksum")
    dbc.write_text(FOREIGN_DBC + 'SIG_VALTYPE_ 257 SlewAngle : 1;\n')
    check.good("float.log", foreign, "--dbc", dbc, drives=AXES[:3], says=("can't be read: Angles.SlewAngle",))
    dbc.write_text("hello\n")
    check.refused("no_dbc.log", foreign, "is it a DBC?", "--dbc", dbc)
    check.refused("no_log.log", "hello\nworld\nthere\n", "is not a line of candump")


def main(graben, can_dbc):
    moves = motion()
    with tempfile.TemporaryDirectory() as name:
        check = Check(graben, pathlib.Path(name))
        tables(check, moves)
        strange_tables(check, moves)
        limits(check)
        buses(check, moves, pathlib.Path(can_dbc))
        print(f"{check.count} logs: a right answer or a clear word each")
        assert check.count >= 30


main(*sys.argv[1:])
