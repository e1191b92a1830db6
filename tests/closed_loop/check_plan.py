# SPDX-License-Identifier: Apache-2.0
"""`graben plan` as a user types it: the paper's line, other paces, lines that can't be had."""

import csv
import json
import math
import os
import subprocess
import sys
import tempfile

import report_page

J = (0.0, 6.866, 0.0)
K = (2.244, 3.886, 0.0)


class Planner:
    def __init__(self, graben, folder):
        self._graben = graben
        self._folder = folder

    def run(self, *arguments):
        return subprocess.run([self._graben, "plan", "--out", self._folder, *arguments],
                              capture_output=True, text=True, timeout=1800)

    def plan(self, *arguments):
        """Output, figures and rows of a plan that can be had."""
        done = self.run(*arguments)
        assert done.returncode == 0 and not done.stderr, f"{arguments}: {done.stderr}"
        with open(os.path.join(self._folder, "plan.json"), encoding="utf-8") as stream:
            figures = json.load(stream)
        with open(os.path.join(self._folder, "plan.csv"), encoding="utf-8", newline="") as stream:
            rows = [{key: float(value) for key, value in row.items()}
                    for row in csv.DictReader(stream)]
        return done.stdout, figures, rows

    def refused(self, needles, *arguments, status=1):
        for name in os.listdir(self._folder):
            os.remove(os.path.join(self._folder, name))
        done = self.run(*arguments)
        assert done.returncode == status and not done.stdout, f"{arguments}: {done}"
        assert all(needle in done.stderr for needle in needles), f"{arguments}: {done.stderr}"
        assert not os.listdir(self._folder), f"{arguments}: files of a plan that there is not"


def strokes_to_teeth(graben, row):
    strokes = ",".join(str(row[f"{axis}_m"]) for axis in ("boom", "arm", "bucket"))
    done = subprocess.run([graben, "pose", "--profile", "excavator_12t", f"--strokes={strokes}",
                           f"--swing={row['swing_rad']}"], capture_output=True, text=True,
                          timeout=1800, check=True)
    return json.loads(done.stdout)["position_m"]


def paper_line(graben, planner):
    output, figures, rows = planner.plan("--table")
    assert "boom" in output and output.count("\n") > len(rows), output
    assert figures["duration_s"] == 18.4 and figures["slowed_by"] == "none"
    assert abs(figures["length_m"] - math.dist(J, K)) < 1e-12
    assert rows[0]["time_s"] == 0.0 and rows[-1]["time_s"] == 18.4
    for end, row in ((J, rows[0]), (K, rows[-1])):
        assert math.dist(end, (row["x_m"], row["y_m"], row["z_m"])) < 1e-12, row
    # Strokes and swing of the plan through `graben pose`.
    for row in rows[::60]:
        assert math.dist(strokes_to_teeth(graben, row), (row["x_m"], row["y_m"], row["z_m"])) < 1e-5
    # Velocities against differences, away from the ends of the ramps.
    for before, here, after in zip(rows[60:300], rows[61:300], rows[62:300]):
        slope = (after["arm_m"] - before["arm_m"]) / (after["time_s"] - before["time_s"])
        assert abs(slope - here["arm_mps"]) < 1e-5, here
    with open(os.path.join(planner._folder, "plan.html"), "rb") as stream:
        setup = report_page.setup_of(stream.read())
    run = setup["run"]
    assert setup["source"]["mode"] == "plan" and len(run["pose"]["drives"]) == len(rows), len(rows)
    assert math.dist(run["way"][-1], K) < 1e-3, run["way"][-1]


def other_paces(planner):
    _, timed, _ = planner.plan("--duration", "30")
    assert timed["duration_s"] == 30.0
    _, paced, _ = planner.plan("--speed", str(timed["speed_mps"]))
    assert abs(paced["duration_s"] - 30.0) < 1e-9
    _, hasty, _ = planner.plan("--duration", "0.5")
    assert hasty["duration_s"] > 5.0 and hasty["slowed_by"] == "acceleration of the teeth"
    _, limited, _ = planner.plan("--duration", "1", "--acceleration", "100")
    assert limited["slowed_by"] in [f"{what} of the {drive}" for what in ("speed", "acceleration")
                                    for drive in ("boom", "arm", "bucket", "swing")]
    ratios = [drive[key] for drive in limited["drives"].values()
              for key in ("speed_ratio", "acceleration_ratio")]
    assert abs(max(ratios) - 1.0) < 1e-9, ratios
    _, big, rows = planner.plan("--profile", "excavator_22t", "--step", "0.5")
    assert big["duration_s"] == 18.4 and len(rows) == 38


RAISED = """start = { position = [7.0, 0.0, -0.42], attitude = 2.2 }
[[step]]
do = "dig"
to = { position = [4.8, 0.0, -0.48], attitude = 0.9 }
[[step]]
do = "swing"
to = { position = [0.0, 4.6, 3.4], attitude = 0.3 }
[design]
through = [0.0, 0.0, -0.5]
normal = [0.0, 0.0, 1.0]
clearance = 0.05
"""


def tasks(planner):
    """Step by step, with what the design has raised and where."""
    output, figures, rows = planner.plan("--task", "truck_by_steps", "--step", "0.1")
    assert [step["kind"] for step in figures["steps"]] == ["dig", "lift", "swing", "dump", "return"], figures
    whole = sum(step["duration_s"] for step in figures["steps"])
    assert abs(rows[-1]["time_s"] - whole) < 1e-4, (rows[-1], whole)
    assert all(b["time_s"] >= a["time_s"] and b["way_m"] >= a["way_m"] for a, b in zip(rows, rows[1:]))
    # The teeth are where the last step has them, and their speed is the way's.
    assert math.dist((rows[-1]["x_m"], rows[-1]["y_m"], rows[-1]["z_m"]), (7.0, 0.0, -0.45)) < 1e-5, rows[-1]
    swing = [row for row in rows if 20.0 < row["time_s"] < 22.0]
    for a, b in zip(swing, swing[1:]):
        assert abs((b["way_m"] - a["way_m"]) / (b["time_s"] - a["time_s"])
                   - 0.5 * (a["speed_mps"] + b["speed_mps"])) < 5e-3, (a, b)
    assert "raises" not in output and output.count("\n") == 8, output
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(RAISED)
        file.flush()
        output, figures, _ = planner.plan("--task", file.name)
        told = ("the design raises step 0 (dig): its beginning by 0 mm to teeth x 7.000 m, y 0.000 m, z -0.420 m, "
                "its end by 30 mm to teeth x 4.800 m, y 0.000 m, z -0.450 m\n")
        assert told in output, output
        assert [(step["raised_from_m"], step["raised_to_m"]) for step in figures["steps"]] == [(0.0, 0.03), (0.03, 0.0)]
        with open(os.path.join(planner._folder, "plan.html"), "rb") as stream:
            setup = report_page.setup_of(stream.read())
        assert setup["machines"][0]["tasks"][0]["steps"][0]["raised_to_m"] == 0.03, setup["machines"][0]["tasks"]
        done = subprocess.run([planner._graben, "autodig", "--task", file.name, "--out", planner._folder],
                              capture_output=True, text=True, timeout=1800)
        assert done.returncode == 0 and told in done.stdout, done


def as_autodig(planner):
    """What autodig refuses plan refuses with the same status and words; a line says line for step."""
    line = """start = {{ position = [{}], attitude = {} }}
[[step]]
do = "dig"
to = {{ position = [{}], attitude = {} }}
speed = 0.3
"""
    for profile, begins, ends in (
            ("excavator_12t", "-6,3,0.5,2.0", "-6,-3,0.5,2.0"), ("excavator_22t", "0,8,0,2.2", "2.6,4.6,0,1.2"),
            ("excavator_12t", "7,0,0,2.2", "9.5,0,0,1.2"), ("excavator_12t", "7,0,0,2.2", "7,0,0,2.2"),
            ("excavator_12t", "19,0,0,1.2", "7,0,0,2.2")):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(line.format(*begins.rsplit(",", 1), *ends.rsplit(",", 1)))
            file.flush()
            planned, tasked, dug = (subprocess.run(
                [planner._graben, *arguments, "--profile", profile, "--out", planner._folder],
                capture_output=True, text=True, timeout=1800)
                for arguments in (("plan", f"--from={begins}", f"--to={ends}", "--speed", "0.3"),
                                  ("plan", "--task", file.name), ("autodig", "--task", file.name)))
        assert (planned.returncode, tasked.returncode, dug.returncode) == (1, 1, 1), (planned, tasked, dug)
        assert tasked.stderr.replace("graben plan", "graben autodig") == dug.stderr, (tasked, dug)
        words = planned.stderr.split("graben plan: ", 1)[1].strip()
        assert words.replace(" of the line", " of the step") in dug.stderr, (planned.stderr, dug.stderr)


def impossible(planner):
    where = ["% of the line", "teeth x", "attitude"]
    planner.refused(["the arm cylinder", *where], "--to", "9.5,0,0,1.2")
    planner.refused(["the boom cylinder", *where], "--to", "1,2,5,1.2")
    planner.refused(["the bucket cylinder", *where], "--to", "2.244,3.886,0,-1.0")
    planner.refused(["out of the reach", "0.00 % of the line"], "--from", "19,0,0,1.2")
    # Behind the machine the swing's range ends; a task is refused with the same words.
    planner.refused(["the swing would leave its range, -3 .. 3 rad; at 35.", *where],
                    "--from=-6,3,0.5,2.0", "--to=-6,-3,0.5,2.0", "--speed", "0.3")
    planner.refused(["it ends where it begins"], "--from", "5,0,0,1.2", "--to", "5,0,0,1.2")
    planner.refused(["there is no such file"], "--profile", "no_such_machine")
    planner.refused(["must be excavator"], "--profile", "dozer_9t")
    for usage in (["--to", "1,2,3"], ["--duration", "0"], ["--speed", "nan"],
                  ["--duration", "10", "--speed", "1"], ["--step", "-1"], ["--speed", "3.5"],
                  ["--task", "flatten", "--speed", "1"]):
        planner.refused([""], *usage, status=2)


def main():
    graben = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        planner = Planner(graben, folder)
        paper_line(graben, planner)
        other_paces(planner)
        tasks(planner)
        as_autodig(planner)
        impossible(planner)
    print("lines are planned or told why not")


if __name__ == "__main__":
    main()
