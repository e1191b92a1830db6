# SPDX-License-Identifier: Apache-2.0
"""`graben grade` on a design whose track curves in plan, by an alignment of LandXML or by arcs at a track's
corners: made within the tolerance at both ends of the edge, which keeps to the track; a slow engine's outer track
holds it; what is written is the same design again; what can't be driven is refused with the place."""

import math
import os
import sys
import tempfile

from grading import LEVEL, MM, TILTS, figures_of, made_within_bounds, profile_takes_what_was_written, read, refused, \
    write, written

WAY = ("--alignment", "way", "--datum", "54.3")
# What a run has to keep, two-sided: worst error, mm; time, s; the edge beside its track in plan, mm.
RUNS = (
    ((), (2, 9), (27.5, 29.5), (10, 70)),
    (("--errors", "all", "--seed", "2"), (2, 14), (28, 33), (10, 110)),
    (("--engine-rpm", "1000"), (2, 9), (39.5, 42), (10, 70)),
    (("--dead-time", "0.15", "--pose-latency", "0.05"), (4, 18), (27.5, 29.5), (10, 80)),
)


def passes_come_back_along_it(graben, folder, curved):
    """Backward too it keeps to the track."""
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", curved, *WAY, "--pass-depth", "0.2")
    assert figures["passes"] == 2 and figures["off_track_m"] < 0.15, figures
    assert figures["ground_left_m"] < 12 * MM and figures["over_cut_m"] < 12 * MM, figures


def a_part_of_it(graben, folder, curved):
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", curved, *WAY, "--stations", "0,20")
    assert abs(figures["mean_speed_mps"] * figures["time_s"] - 20.0) < 0.1
    curvatures = written(folder, 3)
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
    assert abs(max(written(folder, 3)) - 0.04) < 1e-6
    refused(graben, "--profile", TILTS, "--design", file, "--track", track, words=("bends by 1.120", "--radius"))
    refused(graben, "--profile", TILTS, "--design", file, "--track", track, "--radius", "60",
            words=("bends by 1.120", "an arc of 60 m takes"))


def what_cannot_be_driven_is_refused(graben, folder, curved):
    refused(graben, "--profile", LEVEL, "--design", curved, *WAY, words=("curves from station 8.00 m", "no tilt"))
    refused(graben, "--profile", TILTS, "--design", curved, "--alignment", "path",
            words=("alignment 'path' is there 0 times", "'way'"))
    refused(graben, "--profile", TILTS, "--design", curved, *WAY, "--track", "0,0,9,9", words=("does not go with --track",))
    refused(graben, "--profile", TILTS, "--design", curved, *WAY, "--stations", "20,60",
            words=("<Alignment name=\"way\">", "allowed: rising, 0.000 .. 45.000 m"))
    text = read(curved)
    for old, new, words in (
            ("<Curve ", "<Spiral ", ("line 13, <Spiral>", "allowed in an alignment: <Line>, <Curve>")),
            ('rot="ccw"', 'rot="up"', ("<Curve>", 'rot="up"', "cw, ccw"))):
        changed = text.replace(old, new, 1)
        if new.startswith("<"):  # Its end as well, where it is another element.
            changed = changed.replace("</Curve>", f"</{new.split()[0].strip('<')}>", 1)
        bad = write(changed, folder, "bad.xml")
        refused(graben, "--profile", TILTS, "--design", bad, *WAY, words=words)
    tight = write("0 0 0 0\n4 0 0 0\n4.1 -0.05 0 0.13\n20 -0.05 0 0.13\n", folder, "tight.txt")
    refused(graben, "--profile", TILTS, "--design", tight, words=("a radius of", "at least 8.90", "askew", "x = "))
    write("0 0 0 0\n4 0 0\n", tight)
    refused(graben, "--profile", TILTS, "--design", tight, words=("line 2", "a curvature in every line or in none"))


def main():
    graben, machines, designs = sys.argv[1:]
    curved = os.path.join(designs, "curved.xml")
    with tempfile.TemporaryDirectory() as folder:
        made_within_bounds(graben, folder, RUNS, "--design", curved, *WAY)
        passes_come_back_along_it(graben, folder, curved)
        a_part_of_it(graben, folder, curved)
        arcs_at_corners(graben, folder)
        profile_takes_what_was_written(graben, folder, machines, ("--design", curved, *WAY), 45.0, 0.36,
                                       ("max_error_true_m", "off_track_m", "time_s"), "curves in plan")
        what_cannot_be_driven_is_refused(graben, folder, curved)


if __name__ == "__main__":
    main()
