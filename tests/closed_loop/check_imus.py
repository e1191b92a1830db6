# SPDX-License-Identifier: Apache-2.0
"""IMUs on the links in the place of stroke sensors: the true tip with all errors, dry and in soil, of both excavators;
a profile with its own section [imu]; profiles whose section is wrong."""

import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile

MM = 1e-3
# profile, options, draws, least and most median of the true tip's largest error, most of all
CASES = (
    ("excavator_22t", ("--errors", "none"), 1, 3 * MM, 15 * MM, 15 * MM),
    ("excavator_22t", (), 6, 10 * MM, 30 * MM, 45 * MM),
    ("excavator_22t", ("--soil",), 4, 25 * MM, 65 * MM, 110 * MM),
    ("excavator_12t", (), 4, 10 * MM, 30 * MM, 45 * MM),
    ("excavator_12t", ("--soil",), 4, 20 * MM, 65 * MM, 110 * MM),
)
# Hard ground: an arm that shakes and blows that hit the links are no fault of the IMUs. Task, and whether the soil lets
# it be done at all.
TASKS = (("slope", True), ("truck_by_steps", False))
IMU_FAULTS = ("(fault 1)", "(fault 42)")
SECTION = """
[imu]
protection = "range"
rate_noise = 1.8e-3
rate_bias = 3.5e-3
acceleration_noise = 0.3
angle_error = 2.0e-3
boom = { address = 240, at = [2.0, 0.4], turn = 0.2 }
arm = { address = 241, at = [0.8, 0.3], backwards = true }
bucket = { address = 242, at = [0.2, 0.05], on_rocker = true }
body = { address = 243 }
"""
# what is wrong, what is put in its place, words of the refusal
WRONG = (
    ("address = 241", "address = 240", ["imu.arm.address", "240 is that of imu.boom too"]),
    ("address = 243", "address = 130", ["imu.body.address", "132 .. 253"]),
    ('protection = "range"\n', "", ["imu.protection"]),
    ("turn = 0.2", "turn = 20.0", ["imu.boom.turn", "rad"]),
    ("angle_error = 2.0e-3\n", "", ["imu.angle_error"]),
)


def call(graben, *words, status=0):
    done = subprocess.run([graben, *words], capture_output=True, text=True)
    assert done.returncode == status, f"{words}: status {done.returncode}: {done.stderr}"
    return done.stdout + done.stderr


def bounds(graben, folder):
    wrong = []
    for profile, options, draws, least, most, worst in CASES:
        file = folder / "imus.csv"
        file.unlink(missing_ok=True)
        call(graben, "campaign", "dig", "--profile", profile, "--sensors", "imu", "--draws", str(draws),
             "--summary", str(file), *options)
        with open(file, encoding="ascii") as stream:
            rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
        assert len(rows) == draws and all(row["end"] == "done" for row in rows), rows
        errors = sorted(float(row["max_error_true_m"]) for row in rows)
        median = errors[(len(errors) - 1) // 2]
        print(f"{profile} {' '.join(options)}: {median / MM:.1f} mm median, {errors[-1] / MM:.1f} mm worst of {draws}")
        if not (least <= median <= most and errors[-1] <= worst):
            wrong.append(f"{profile} {options}: median {median}, worst {errors[-1]}")
    assert not wrong, wrong


def in_loam(graben, folder):
    for task, done in TASKS:
        told = subprocess.run([graben, "autodig", "--task", task, "--soil", "loam", "--sensors", "imu", "--out",
                               str(folder / task)], capture_output=True, text=True, check=False)
        said = told.stdout + told.stderr
        print(f"{task} in loam: status {told.returncode}, {told.stderr.strip()}")
        assert told.returncode == 0 or not done, said
        assert not any(fault in said for fault in IMU_FAULTS), said


def own_section(graben, folder, machines):
    for name in ("excavator_22t.toml", "excavator_22t.sim.toml"):
        shutil.copy(machines / name, folder / name)
    profile = folder / "excavator_22t.toml"
    plain = profile.read_text(encoding="utf-8")
    profile.write_text(plain + SECTION, encoding="utf-8")
    said = call(graben, "dig", "--profile", str(profile), "--out", str(folder / "own"))
    assert "true" in said, said
    log = (folder / "own" / "dig.log").read_text(encoding="ascii")
    for there, word in ((True, "0CF02AF0#"), (True, "08F02DF3#"), (False, "0CFF2080#")):
        assert (word in log) == there, f"{word} in the log: {not there}"
    for old, new, words in WRONG:
        assert old in SECTION, old
        profile.write_text(plain + SECTION.replace(old, new), encoding="utf-8")
        said = call(graben, "check", str(profile), status=1)
        for word in words:
            assert word in said, f"{new!r}: {said}"


def main():
    graben, machines = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        own_section(graben, folder, machines)
        bounds(graben, folder)
        in_loam(graben, folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
