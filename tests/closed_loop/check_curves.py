# SPDX-License-Identifier: Apache-2.0
"""`graben grade` on a design whose track curves in plan, by an alignment of LandXML or by arcs at a track's
corners: made within the tolerance at both ends of the edge, which keeps to the track; a slow engine's outer track
holds it; what is written is the same design again; what can't be driven is refused with the place."""

import json
import math
import os
import re
import sys
import tempfile

from grading import figures_of, refused, run

MM = 1e-3
TILTS, LEVEL = "dozer_9t_tilt", "dozer_9t"
WAY = ("--alignment", "way", "--datum", "54.3")
# What a run has to keep, two-sided: worst error, the edge beside its track in plan, mm; time, s.
RUNS = (
    ((), (2, 9), (10, 70), (27.5, 29.5)),
    (("--errors", "all", "--seed", "2"), (2, 14), (10, 110), (28, 33)),
    (("--engine-rpm", "1000"), (2, 9), (10, 70), (39.5, 42)),
    (("--dead-time", "0.15", "--pose-latency", "0.05"), (4, 18), (10, 80), (27.5, 29.5)),
)


def made_along_the_alignment(graben, folder, curved):
    for options, error_mm, aside_mm, time_s in RUNS:
        figures = figures_of(graben, folder, "--profile", TILTS, "--design", curved, *WAY, *options)
        worst = max(figures[key] for key in ("max_error_true_m", "over_cut_m", "ground_left_m"))
        print(f"{' '.join(options) or 'as it is'}: {worst / MM:.1f} mm, {figures['off_track_m'] / MM:.0f} mm beside "
              f"the track, {figures['time_s']:.2f} s")
        assert error_mm[0] * MM < worst < error_mm[1] * MM, (options, worst)
        assert aside_mm[0] * MM < figures["off_track_m"] < aside_mm[1] * MM, (options, figures["off_track_m"])
        assert time_s[0] < figures["time_s"] < time_s[1], (options, figures["time_s"])
        assert figures["passes"] == 1


def passes_come_back_along_it(graben, folder, curved):
    """Backward too it keeps to the track."""
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", curved, *WAY, "--pass-depth", "0.2")
    assert figures["passes"] == 2 and figures["off_track_m"] < 0.15, figures
    assert figures["ground_left_m"] < 12 * MM and figures["over_cut_m"] < 12 * MM, figures


def written_curvatures(folder):
    with open(os.path.join(folder, "design.txt"), encoding="utf-8") as stream:
        return [float(line.split()[3]) for line in stream if not line.startswith("#")]


def a_part_of_it(graben, folder, curved):
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", curved, *WAY, "--stations", "0,20")
    assert abs(figures["mean_speed_mps"] * figures["time_s"] - 20.0) < 0.1
    curvatures = written_curvatures(folder)
    assert max(curvatures) == 0.05 and min(curvatures) == 0.0, (max(curvatures), min(curvatures))


def banked_ring(file):
    """A quarter of a circle of 25 m about (0, 25), 0.1 m deep, with the inside 4 % down; level ways before it
    and after it."""
    with open(file, "w", encoding="utf-8") as stream:
        for i in range(-20, 61):
            along = 0.5 * i
            for across in (-2.0, -1.0, 0.0, 1.0, 2.0):
                deep = -0.1 * min(1.0, max(0.0, (along + 8.0) / 3.0))
                bank = 0.04 * min(1.0, max(0.0, (along + 4.0) / 4.0))
                turned = max(0.0, along) / 25.0
                x = min(0.0, along) + 25.0 * math.sin(turned) - across * math.sin(turned)
                y = 25.0 - 25.0 * math.cos(turned) + across * math.cos(turned)
                stream.write(f"{x:.5f} {y:.5f} {deep - bank * across:.5f}\n")


def arcs_at_corners(graben, folder):
    """The same way by a track's corners: the tangents of its arc."""
    file = os.path.join(folder, "ring.xyz")
    banked_ring(file)
    turned = 28.0 / 25.0
    side = 25.0 * math.tan(0.5 * turned)
    track = (f"-10,0,{side:.6f},0,{side + side * math.cos(turned):.6f},{side * math.sin(turned):.6f}")
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", file, "--track", track, "--radius", "25")
    print(f"a ring: {figures['max_error_true_m'] / MM:.1f} mm, {figures['off_track_m'] / MM:.0f} mm beside the track")
    assert 0.5 * MM < figures["max_error_true_m"] < 8 * MM and figures["off_track_m"] < 0.07, figures
    assert abs(max(written_curvatures(folder)) - 0.04) < 1e-6
    refused(graben, "--profile", TILTS, "--design", file, "--track", track, words=("bends by 1.120", "--radius"))
    refused(graben, "--profile", TILTS, "--design", file, "--track", track, "--radius", "60",
            words=("bends by 1.120", "an arc of 60 m takes"))


def profile_takes_what_was_written(graben, folder, machines, curved):
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", curved, *WAY)
    for ending in (".toml", ".sim.toml"):
        with open(os.path.join(machines, LEVEL + ending), encoding="utf-8") as stream:
            text = stream.read()
        with open(os.path.join(machines, TILTS + ending), encoding="utf-8") as stream:
            text += "[tilt]" + stream.read().partition("[tilt]")[2]
        text = re.sub(r"(?m)^profile = \[\[0\.0.*$", 'design = "design.txt"', text)
        text = re.sub(r"(?m)^length = 27\.0", "length = 45.0", text)
        text = re.sub(r"(?m)^depth_max = .*$", "depth_max = 0.36", text)
        with open(os.path.join(folder, "own" + ending), "w", encoding="utf-8") as stream:
            stream.write(text)
    summary = os.path.join(folder, "again.json")
    own = os.path.join(folder, "own.toml")
    done = run(graben, "--out", folder, "--summary", summary, "--profile", own)
    assert done.returncode == 0, done.stderr
    with open(summary, encoding="utf-8") as stream:
        again = json.load(stream)
    # But for six decimals of each number.
    for key in ("max_error_true_m", "off_track_m", "time_s"):
        assert abs(again[key] - figures[key]) < 1e-3 * max(1.0, figures[key]), (key, again[key], figures[key])
    # Without its tilt the same profile can't be driven.
    with open(own, encoding="utf-8") as stream:
        text = stream.read()
    with open(own, "w", encoding="utf-8") as stream:
        stream.write(text.partition("[tilt]")[0])
    refused(graben, "--profile", own, words=("grade.design", "curves in plan", "no [tilt]"))


def what_cannot_be_driven_is_refused(graben, folder, curved):
    refused(graben, "--profile", LEVEL, "--design", curved, *WAY, words=("curves from station 8.00 m", "no tilt"))
    refused(graben, "--profile", TILTS, "--design", curved, "--alignment", "path",
            words=("alignment 'path' is there 0 times", "'way'"))
    refused(graben, "--profile", TILTS, "--design", curved, *WAY, "--track", "0,0,9,9", words=("does not go with --track",))
    refused(graben, "--profile", TILTS, "--design", curved, *WAY, "--stations", "20,60",
            words=("<Alignment name=\"way\">", "allowed: rising, 0.000 .. 45.000 m"))
    with open(curved, encoding="utf-8") as stream:
        text = stream.read()
    bad = os.path.join(folder, "bad.xml")
    for old, new, words in (
            ("<Curve ", "<Spiral ", ("line 13, <Spiral>", "allowed in an alignment: <Line>, <Curve>")),
            ('rot="ccw"', 'rot="up"', ("<Curve>", 'rot="up"', "cw, ccw"))):
        with open(bad, "w", encoding="utf-8") as stream:
            # Its end as well, where it is another element.
            stream.write(text.replace(old, new, 1).replace("</Curve>", f"</{new.split()[0].strip('<')}>", 1)
                         if new.startswith("<") else text.replace(old, new, 1))
        refused(graben, "--profile", TILTS, "--design", bad, *WAY, words=words)
    tight = os.path.join(folder, "tight.txt")
    with open(tight, "w", encoding="utf-8") as stream:
        stream.write("0 0 0 0\n4 0 0 0\n4.1 -0.05 0 0.13\n20 -0.05 0 0.13\n")
    refused(graben, "--profile", TILTS, "--design", tight, words=("a radius of", "at least 8.90", "askew", "x = "))
    with open(tight, "w", encoding="utf-8") as stream:
        stream.write("0 0 0 0\n4 0 0\n")
    refused(graben, "--profile", TILTS, "--design", tight, words=("line 2", "a curvature in every line or in none"))


def main():
    graben, machines, designs = sys.argv[1:]
    curved = os.path.join(designs, "curved.xml")
    with tempfile.TemporaryDirectory() as folder:
        made_along_the_alignment(graben, folder, curved)
        passes_come_back_along_it(graben, folder, curved)
        a_part_of_it(graben, folder, curved)
        arcs_at_corners(graben, folder)
        profile_takes_what_was_written(graben, folder, machines, curved)
        what_cannot_be_driven_is_refused(graben, folder, curved)


if __name__ == "__main__":
    main()
