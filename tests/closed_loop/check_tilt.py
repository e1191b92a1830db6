# SPDX-License-Identifier: Apache-2.0
"""`graben grade` on a design with a slope across the track: a dozer whose blade tilts makes it within the
tolerance, both ends of its edge judged; one without refuses it with the place and the figure, as one that
tilts does a crown and a slope that is out of its range. Its profile takes the design that was written. Ground
that resists it is cut in passes."""

import math
import os
import re
import sys
import tempfile

from grading import LEVEL, MM, TILTS, figures_of, made_within_bounds, profile_takes_what_was_written, read, refused, \
    write, written

TRACK = ("--track", "100,200,131,200", "--datum", "54.3")
ANY = (-math.inf, math.inf)
# Of the blade that is led over it: what a run has to keep, two-sided.
RUNS = (
    ((), (1, 8), (19, 21), ANY),
    (("--errors", "all", "--seed", "1"), (1, 12), (19, 21), ANY),
    (("--engine-rpm", "1000"), (1, 8), (25, 28), ANY),
    (("--dead-time", "0.15", "--pose-latency", "0.05"), (1.5, 12), (19, 22), ANY),
)


def ground_that_resists_is_cut_in_passes(graben, folder, banked):
    """Both ends judged: nothing much below the design, and no more above it than is gone back for."""
    for soil, left_mm, passes in (("loam", 25, 2), ("stones", 25, 3)):
        figures = figures_of(graben, folder, "--profile", TILTS, "--design", banked, *TRACK, "--soil", soil,
                             "--errors", "all", "--seed", "2")
        cut, left = figures["over_cut_m"], figures["ground_left_m"]
        print(f"{soil}: {cut / MM:.1f} mm below, {left / MM:.1f} mm above in {figures['passes']} passes")
        assert 0.1 * MM < cut < 10 * MM, (soil, cut)
        assert 1 * MM < left < left_mm * MM, (soil, left)
        assert 2 <= figures["passes"] <= passes, (soil, figures["passes"])
        assert figures["halt_s"] < 0.5


def points_of(text):
    """The banked surface's, as x, y, z."""
    return [(float(x), float(y), float(z)) for y, x, z in re.findall(r"<P id=\"\d+\">(\S+) (\S+) (\S+)</P>", text)]


def points_are_the_same_design(graben, folder, banked):
    file = write("".join(f"{x} {y} {z}\n" for x, y, z in points_of(read(banked))), folder, "banked.xyz")
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", file, *TRACK)
    assert 1 * MM < figures["max_error_true_m"] < 8 * MM, figures["max_error_true_m"]
    # The other way round the other side is high.
    back = ("--track", "131,200,100,200", "--datum", "54.3")
    figures_of(graben, folder, "--profile", TILTS, "--design", file, *back)
    slopes = written(folder, 2)
    assert abs(max(slopes) - 0.08) < 0.002 and abs(min(slopes) + 0.08) < 0.002, (max(slopes), min(slopes))


def what_cannot_be_made_is_refused(graben, folder, banked):
    refused(graben, "--profile", LEVEL, "--design", banked, *TRACK,
            words=("0.102 m higher", "x = 8.00 m", "1.27 m left", "-0.02 .. 0.02 m", "no tilt"))
    for name, text, words in (
            ("twists.txt", "0 0 0\n5 -0.15 0\n8 -0.15 0.08\n20 -0.15 0.08\n", ("two corners", "-0.048 .. 0.048", "x =")),
            ("beyond.txt", "0 0 0\n5 0 0.4\n", ("line 2", "-0.3 .. 0.3"))):
        refused(graben, "--profile", TILTS, "--design", write(text, folder, name), words=words)
    crown = write("".join(f"{x} {y} {-0.05 * abs(y)}\n" for x in range(0, 11) for y in (-2, -1, 0, 1, 2)),
                  folder, "crown.xyz")
    refused(graben, "--profile", TILTS, "--design", crown, words=("higher than straight", "edge is straight"))


def main():
    graben, machines, designs = sys.argv[1:]
    banked = os.path.join(designs, "banked.xml")
    with tempfile.TemporaryDirectory() as folder:
        made_within_bounds(graben, folder, RUNS, "--design", banked, *TRACK)
        ground_that_resists_is_cut_in_passes(graben, folder, banked)
        points_are_the_same_design(graben, folder, banked)
        profile_takes_what_was_written(graben, folder, machines, ("--design", banked, *TRACK), 31.0, 0.18,
                                       ("max_error_true_m", "time_s"), "slope across")
        what_cannot_be_made_is_refused(graben, folder, banked)


if __name__ == "__main__":
    main()
