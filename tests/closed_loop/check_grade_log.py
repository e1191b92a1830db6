# SPDX-License-Identifier: Apache-2.0
"""The log of a grade by the DBC alone: check_grade_log.py GRABEN DBC PROFILE.

Reads the DBC, the kinematics and the design with its own code, not the project's: the cutting edge
that the decoded pose and stroke give must show the error that the summary names."""

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


class Blade:
    """The triangle of pivot, cylinder base and rod eye, in the complex plane of the body frame."""

    def __init__(self, blade):
        pin = lambda pair: complex(*pair)
        self.pivot, arm = pin(blade["pivot"]), pin(blade["arm"])
        base = pin(blade["cylinder"]["base"]) - self.pivot
        self.home = blade["cylinder"]["length_home"]
        # Where the circle about the base meets the arm's line.
        along = (base * (arm / abs(arm)).conjugate()).real
        self.l11 = abs(base)
        self.l12 = along + math.sqrt(along ** 2 - self.l11 ** 2 + self.home ** 2)
        # The edge at the ground line.
        self.edge = complex(math.sqrt(blade["cutting_edge"] ** 2 - self.pivot.imag ** 2),
                            -self.pivot.imag)
        raised = math.asin((blade["range"][1] - self.pivot.imag) / abs(self.edge))
        self.shortest = self.length(raised - cmath.phase(self.edge))

    def enclosed(self, length):
        return math.acos((self.l11 ** 2 + self.l12 ** 2 - length ** 2) / (2 * self.l11 * self.l12))

    def length(self, angle):
        between = self.enclosed(self.home) - angle
        return math.sqrt(self.l11 ** 2 + self.l12 ** 2 - 2 * self.l11 * self.l12 * math.cos(between))

    def edge_in_body(self, stroke):
        angle = self.enclosed(self.home) - self.enclosed(self.shortest + stroke)
        return self.pivot + self.edge * cmath.exp(1j * angle)


class Design:
    """A corner's parabola is the mean of both lines over the rounding to either side."""

    def __init__(self, grade):
        self.points, self.rounding = grade["profile"], grade["rounding"]
        self.plane = grade

    def line(self, x):
        points = self.points
        if x <= points[0][0]:
            return points[0][1]
        for (x0, z0), (x1, z1) in zip(points, points[1:]):
            if x <= x1:
                return z0 + (z1 - z0) * (x - x0) / (x1 - x0)
        return points[-1][1]

    def height(self, x):
        low, high = x - self.rounding, x + self.rounding
        # The ends are not rounded.
        if low < self.points[0][0] or high > self.points[-1][0]:
            mean = self.line(x)
        else:
            cuts = [low, *(p[0] for p in self.points if low < p[0] < high), high]
            mean = sum((b - a) * (self.line(a) + self.line(b)) / 2
                       for a, b in zip(cuts, cuts[1:])) / (high - low)
        return mean + self.plane["plane_height"] + self.plane["plane_slope"] * x


def read_log(path, messages):
    counts, last, moments = Counter(), {}, []
    for time, name, values in frames(path, messages):
        counts[name] += 1
        last[name] = values
        if name == "BodyVelocity":  # after stroke and pose
            moments.append((time, last["BladeStroke"]["BladeStroke"] * 1e-3,
                            complex(last["BodyPosition"]["Position"],
                                    last["BodyPosition"]["Height"]) * 1e-3,
                            last["BodyPitch"]["Pitch"] * 1e-3))
    return counts, moments


def main():
    graben, dbc, profile_path = sys.argv[1:]
    with open(profile_path, "rb") as stream:
        profile = tomllib.load(stream)
    with open(profile_path.replace(".toml", ".sim.toml"), "rb") as stream:
        length = tomllib.load(stream)["experiment"]["length"]
    # Its blade does not tilt, its track does not curve, no mark is touched, nobody limits it.
    messages = {number: m for number, m in read_dbc(dbc).items()
                if m["name"] not in ("TiltState", "BodyCourse", "TouchedPoint", "ExternalLimit")}
    with tempfile.TemporaryDirectory() as folder:
        summary_path = os.path.join(folder, "summary.json")
        subprocess.run([graben, "grade", "--out", folder, "--summary", summary_path], check=True,
                       capture_output=True, timeout=1800)
        with open(summary_path, encoding="utf-8") as stream:
            summary = json.load(stream)
        counts, moments = read_log(os.path.join(folder, "grade.log"), messages)
    # What task Commission reads is sent by nobody here.
    tried = ("DozerTry", "DozerWindow")
    check_counts(counts, {number: m for number, m in messages.items() if m["name"] not in tried}, moments[-1][0])
    blade, design = Blade(profile["blade"]), Design(profile["grade"])
    errors, times = [], []
    for time, stroke, body, pitch in moments:
        edge = body + blade.edge_in_body(stroke) * cmath.exp(1j * pitch)
        if 0.0 <= edge.real <= length:
            errors.append(edge.imag - design.height(edge.real))
            times.append(time)
    rmse = math.sqrt(sum(e * e for e in errors) / len(errors))
    print(f"{sum(counts.values())} frames, max error {max(map(abs, errors)) * 1e3:.2f} mm, RMSE "
          f"{rmse * 1e3:.2f} mm, {times[-1] - times[0]:.2f} s")
    assert abs(max(map(abs, errors)) - summary["max_error_measured_m"]) < 1e-6
    # A cycle more or less at the ends, where the edge was measured and was not.
    assert abs(rmse - summary["rmse_error_measured_m"]) < 1e-5
    assert abs(times[-1] - times[0] - summary["time_s"]) < 0.1


if __name__ == "__main__":
    main()
