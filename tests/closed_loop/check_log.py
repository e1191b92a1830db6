# SPDX-License-Identifier: Apache-2.0
"""The log of a dig by the DBC alone: check_log.py GRABEN DBC PROFILE.

Reads the DBC and the kinematics with its own code, not the project's: every frame of the log must be
defined, in range, protected as the DBC says, and the tip that the decoded strokes give must show the
error that the summary names."""

import cmath
import json
import math
import os
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter

from dbc_log import check_counts, frames, read_dbc


def rotated(x, angle):
    return x * cmath.exp(1j * angle)


def triangle(a, b, length):
    return math.acos((abs(a) ** 2 + abs(b) ** 2 - length ** 2) / (2 * abs(a) * abs(b)))


def circles_meet(a, radius_a, b, radius_b):
    """The point on the left of a -> b."""
    gap = abs(b - a)
    along = (radius_a ** 2 - radius_b ** 2 + gap ** 2) / (2 * gap)
    return a + (along + 1j * math.sqrt(radius_a ** 2 - along ** 2)) * (b - a) / gap


def tip(profile, strokes):
    pin = lambda pair: complex(*pair)
    boom, arm, bucket = (profile[axis] for axis in ("boom", "arm", "bucket"))
    lengths = [axis["cylinder"]["closed_length"] + stroke
               for axis, stroke in zip((boom, arm, bucket), strokes)]
    base, eye = pin(boom["cylinder"]["base"]), pin(boom["cylinder"]["eye"])
    boom_angle = triangle(base, eye, lengths[0]) - cmath.phase(eye) + cmath.phase(base)
    base, eye = pin(arm["cylinder"]["base"]) - boom["length"], pin(arm["cylinder"]["eye"])
    arm_angle = -triangle(base, eye, lengths[1]) - cmath.phase(eye) + cmath.phase(base)
    link = bucket["linkage"]
    pivot, lug, foot = pin(link["rocker_pivot"]), pin(link["lug"]), complex(arm["length"])
    end = circles_meet(pin(bucket["cylinder"]["base"]), lengths[2], pivot, link["rocker"])
    lug_at = circles_meet(end, link["coupler"], foot, abs(lug))
    bucket_angle = cmath.phase(lug_at - foot) - cmath.phase(lug)
    return (rotated(boom["length"], boom_angle) + rotated(arm["length"], boom_angle + arm_angle)
            + rotated(bucket["length"], boom_angle + arm_angle + bucket_angle))


def distance_to_path(path, point):
    """From the rounded rectangle: the inner rectangle's offset, by its signed distance."""
    radius = path["corner_radius"]
    half = complex(path["x"][1] - path["x"][0], path["y"][1] - path["y"][0]) / 2
    centre = complex(sum(path["x"]), sum(path["y"])) / 2
    x = abs((point - centre).real) - half.real + radius
    y = abs((point - centre).imag) - half.imag + radius
    outside = abs(complex(max(x, 0.0), max(y, 0.0)))
    return abs(outside + min(max(x, y), 0.0) - radius)


def read_log(path, messages):
    counts, strokes, moments = Counter(), {}, []
    for time, name, values in frames(path, messages):
        counts[name] += 1
        for axis in ("Boom", "Arm", "Bucket"):
            if name == f"{axis}Stroke":
                strokes[axis] = values[name] * 1e-3
        if name == "BucketStroke":
            moments.append((time, strokes["Boom"], strokes["Arm"], strokes["Bucket"]))
    return counts, moments


# Of a machine with a swing drive alone; the 12 t machine's task has them all.
SWING = ("SwingState", "SwingValveState", "SwingCommand")


# Of an operator's station whose hands move the machine, and of who limits it from outside: no run of a task has them.
HANDS = ("ExternalLimit", "TouchedPoint", "OperatorAxes", "CommissionDuty", "CommissionWindow")

# Of second sensors, which a shipped machine has only where it is told so.
SECOND = ("SecondStrokes", "SecondSwing")


def without_hands(messages):
    return {number: m for number, m in messages.items() if m["name"] not in HANDS + SECOND}


def without_swing(messages):
    return {number: m for number, m in without_hands(messages).items() if m["name"] not in SWING}


def check_swing(graben, messages):
    """A task's log has every message of the DBC, as often as it should."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([graben, "autodig", "--out", folder], check=True, capture_output=True,
                       timeout=1800)
        counts, last_s = Counter(), 0.0
        for time_s, name, _ in frames(os.path.join(folder, "autodig.log"), messages):
            counts[name] += 1
            last_s = time_s
    check_counts(counts, without_hands(messages), last_s)


def main():
    graben, dbc, profile_path = sys.argv[1:]
    with open(profile_path, "rb") as stream:
        profile = tomllib.load(stream)
    messages = read_dbc(dbc)
    with tempfile.TemporaryDirectory() as folder:
        summary_path = os.path.join(folder, "summary.json")
        subprocess.run([graben, "dig", "--out", folder, "--summary", summary_path], check=True,
                       capture_output=True, timeout=1800)
        with open(summary_path, encoding="utf-8") as stream:
            summary = json.load(stream)
        counts, moments = read_log(os.path.join(folder, "dig.log"), messages)
    check_counts(counts, without_swing(messages), moments[-1][0])
    begin = summary["approach_s"]
    errors = [distance_to_path(profile["task"]["path"], tip(profile, strokes))
              for time, *strokes in moments
              if begin - 1e-6 <= time <= begin + summary["loop_s"] + 1e-6]
    rmse = math.sqrt(sum(e * e for e in errors) / len(errors))
    print(f"{sum(counts.values())} frames, max error {max(errors) * 1e3:.2f} mm, RMSE {rmse * 1e3:.2f} mm")
    assert abs(max(errors) - summary["max_error_measured_m"]) < 1e-6
    assert abs(rmse - summary["rmse_error_measured_m"]) < 1e-6
    check_swing(graben, messages)


if __name__ == "__main__":
    main()
