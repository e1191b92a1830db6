# SPDX-License-Identifier: Apache-2.0
"""Measure-up of IMUs from touches, whole: a simulated machine as found whose IMUs are turned on their links by what
nobody knows touches two pegs; from the log of its bus `graben measure-up` makes a profile; the digging path is dug with
the old profile, with the new one, and with IMUs that were never turned. Prints each draw and, of all, median / 95th
percentile / max of the true tip's error. Exit status 1 where the new profile does not hold the bounds."""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

MM = 1e-3
SECTION = """like = "{machine}"

[imu]
protection = "range"
rate_noise = 1.8e-3
rate_bias = 3.5e-3
acceleration_noise = 0.3
angle_error = 2.0e-3
boom = {{ address = 226, at = [2.0, 0.3], turn = 0.1 }}
arm = {{ address = 227, at = [1.0, 0.2], backwards = true }}
bucket = {{ address = 228, {bucket} }}
"""
BUCKETS = {"excavator_22t": "at = [0.7, 0.0]", "excavator_12t": "at = [0.2, 0.0], on_rocker = true"}
# What the fences allow for a stroke that IMUs give.
FENCE = "\n[fence]\nstroke_error = 5.6e-3\n"
BOUNDS = {"median": 30 * MM, "p95": 45 * MM}


def call(graben, folder, *words):
    done = subprocess.run([graben, *words], capture_output=True, text=True, cwd=folder, check=False)
    assert done.returncode == 0, f"{words}: status {done.returncode}: {done.stderr}"
    return done.stdout


def machine_in(machines, folder, name):
    """mine.toml, like the shipped one but with IMUs, and its simulated machine."""
    for file in (f"{name}.toml", f"{name}.sim.toml"):
        (folder / file).write_text((machines / file).read_text(encoding="utf-8"), encoding="utf-8")
    (folder / "mine.toml").write_text(SECTION.format(machine=name, bucket=BUCKETS[name]) + FENCE, encoding="utf-8")
    (folder / "mine.sim.toml").write_text(f'like = "{name}"\n', encoding="utf-8")


def touched(graben, folder, *options):
    """Options for measure-up of the log that the simulated machine has made."""
    said = call(graben, folder, "measure-up", "--record", "touch.log", "--profile", "mine.toml", "--force", *options)
    return re.search(r"^next: graben measure-up (.*) --out", said, re.MULTILINE).group(1).split()


def error_m(graben, folder, profile, *options):
    """NaN where it does not come round."""
    done = subprocess.run([graben, "dig", "--profile", profile, "--simulated", "mine.sim.toml", "--out", "out", *options],
                          capture_output=True, text=True, cwd=folder, check=False)
    found = re.search(r"^path error of the true tip, max +([0-9.]+) mm", done.stdout, re.MULTILINE)
    return float(found.group(1)) * MM if done.returncode == 0 else float("nan")


def measured_up(graben, folder, *options):
    """What is left at the pegs, with found.toml made; NaN where the log was refused, or nobody came to a peg."""
    try:
        said = call(graben, folder, "measure-up", *touched(graben, folder, *options), "--out", "found.toml", "--force")
    except AssertionError as refusal:
        print(refusal, flush=True)
        return float("nan")
    return float(re.search(r"^left +([0-9.]+) mm RMS", said, re.MULTILINE).group(1)) * MM


def draw(graben, folder, seed, degrees):
    mounting = ("--imu-mounting", str(degrees * 0.01745329))
    errors = ("--errors", "all", "--seed", str(seed))
    left = measured_up(graben, folder, *mounting, *errors)
    after = error_m(graben, folder, "found.toml", *mounting, *errors) if left == left else float("nan")
    return (error_m(graben, folder, "mine.toml", *mounting, *errors), after, error_m(graben, folder, "mine.toml", *errors), left)


def of(values):
    """Median, 95th percentile, max; where a run did not come round, beyond all others."""
    ranked = sorted(value if value == value else float("inf") for value in values)
    return [ranked[max(0, -(-len(ranked) * share // 100) - 1)] for share in (50, 95, 100)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("graben", type=lambda text: str(pathlib.Path(text).resolve()))
    parser.add_argument("machines", type=pathlib.Path)
    parser.add_argument("--profile", choices=sorted(BUCKETS), default="excavator_22t")
    parser.add_argument("--draws", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--degrees", type=float, default=2.0)
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        machine_in(options.machines, folder, options.profile)
        for seed in range(options.seed, options.seed + options.draws):
            rows.append(draw(options.graben, folder, seed, options.degrees))
            print(f"seed {seed}: before {rows[-1][0] / MM:.1f}, after {rows[-1][1] / MM:.1f}, never turned {rows[-1][2] / MM:.1f}, "
                  f"left at the pegs {rows[-1][3] / MM:.1f} mm", flush=True)
    for word, column in (("before", 0), ("after", 1), ("never turned", 2), ("left", 3)):
        print(f"{word}: " + " / ".join(f"{value / MM:.1f}" for value in of([row[column] for row in rows])) + " mm")
    print(f"measured up: {sum(row[3] == row[3] for row in rows)} of {len(rows)}")
    median, p95, _ = of([row[1] for row in rows])
    assert of([row[0] for row in rows])[0] > 1.5 * BOUNDS["p95"], "the IMUs were not turned"
    assert median <= BOUNDS["median"] and p95 <= BOUNDS["p95"], f"after: {median / MM:.1f} / {p95 / MM:.1f} mm"
    return 0


if __name__ == "__main__":
    sys.exit(main())
