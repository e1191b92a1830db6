# SPDX-License-Identifier: Apache-2.0
"""`graben grade` on a design with a slope across the track: a dozer whose blade tilts makes it within the
tolerance, both ends of its edge judged; one without refuses it with the place and the figure, as one that
tilts does a crown and a slope that is out of its range. Its profile takes the design that was written. Ground
that resists it is cut in passes."""

import os
import re
import sys
import tempfile

from grading import figures_of, refused

MM = 1e-3
TILTS, LEVEL = "dozer_9t_tilt", "dozer_9t"
TRACK = ("--track", "100,200,131,200", "--datum", "54.3")
# Of the blade that is led over it: what a run has to keep, two-sided.
RUNS = (
    ((), (1, 8), (19, 21)),
    (("--errors", "all", "--seed", "1"), (1, 12), (19, 21)),
    (("--engine-rpm", "1000"), (1, 8), (25, 28)),
    (("--dead-time", "0.15", "--pose-latency", "0.05"), (1.5, 12), (19, 22)),
)


def made_within_the_tolerance(graben, folder, banked):
    for options, error_mm, time_s in RUNS:
        figures = figures_of(graben, folder, "--profile", TILTS, "--design", banked, *TRACK, *options)
        worst = max(figures[key] for key in ("max_error_true_m", "over_cut_m", "ground_left_m"))
        print(f"{' '.join(options) or 'as it is'}: {worst / MM:.1f} mm in {figures['time_s']:.2f} s")
        assert error_mm[0] * MM < worst < error_mm[1] * MM, (options, worst)
        assert time_s[0] < figures["time_s"] < time_s[1], (options, figures["time_s"])
        assert figures["passes"] == 1


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
    with open(banked, encoding="utf-8") as stream:
        points = points_of(stream.read())
    file = os.path.join(folder, "banked.xyz")
    with open(file, "w", encoding="utf-8") as stream:
        stream.writelines(f"{x} {y} {z}\n" for x, y, z in points)
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", file, *TRACK)
    assert 1 * MM < figures["max_error_true_m"] < 8 * MM, figures["max_error_true_m"]
    # The other way round the other side is high.
    back = ("--track", "131,200,100,200", "--datum", "54.3")
    figures_of(graben, folder, "--profile", TILTS, "--design", file, *back)
    with open(os.path.join(folder, "design.txt"), encoding="utf-8") as stream:
        slopes = [float(line.split()[2]) for line in stream if not line.startswith("#")]
    assert abs(max(slopes) - 0.08) < 0.002 and abs(min(slopes) + 0.08) < 0.002, (max(slopes), min(slopes))


def profile_takes_what_was_written(graben, folder, machines, banked):
    figures = figures_of(graben, folder, "--profile", TILTS, "--design", banked, *TRACK)
    for ending in (".toml", ".sim.toml"):
        with open(os.path.join(machines, LEVEL + ending), encoding="utf-8") as stream:
            text = stream.read()
        with open(os.path.join(machines, TILTS + ending), encoding="utf-8") as stream:
            text += "[tilt]" + stream.read().partition("[tilt]")[2]
        text = re.sub(r"(?m)^profile = \[\[0\.0.*$", 'design = "design.txt"', text)
        text = re.sub(r"(?m)^length = 27\.0", "length = 31.0", text)
        text = re.sub(r"(?m)^depth_max = .*$", "depth_max = 0.18", text)
        with open(os.path.join(folder, "own" + ending), "w", encoding="utf-8") as stream:
            stream.write(text)
    again = figures_of(graben, folder, "--profile", os.path.join(folder, "own.toml"))
    for key in ("max_error_true_m", "time_s"):
        assert abs(again[key] - figures[key]) < 1e-3 * max(1.0, figures[key]), key
    # Without its tilt the same profile can't be driven.
    own = os.path.join(folder, "own.toml")
    with open(own, encoding="utf-8") as stream:
        text = stream.read()
    with open(own, "w", encoding="utf-8") as stream:
        stream.write(text.partition("[tilt]")[0])
    refused(graben, "--profile", own, words=("grade.design", "slope across", "no [tilt]"))


def what_cannot_be_made_is_refused(graben, folder, banked):
    refused(graben, "--profile", LEVEL, "--design", banked, *TRACK,
            words=("0.102 m higher", "x = 8.00 m", "1.27 m left", "-0.02 .. 0.02 m", "no tilt"))
    for name, text, words in (
            ("twists.txt", "0 0 0\n5 -0.15 0\n8 -0.15 0.08\n20 -0.15 0.08\n", ("two corners", "-0.048 .. 0.048", "x =")),
            ("beyond.txt", "0 0 0\n5 0 0.4\n", ("line 2", "-0.3 .. 0.3"))):
        file = os.path.join(folder, name)
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(text)
        refused(graben, "--profile", TILTS, "--design", file, words=words)
    crown = os.path.join(folder, "crown.xyz")
    with open(crown, "w", encoding="utf-8") as stream:
        stream.writelines(f"{x} {y} {-0.05 * abs(y)}\n" for x in range(0, 11) for y in (-2, -1, 0, 1, 2))
    refused(graben, "--profile", TILTS, "--design", crown, words=("higher than straight", "edge is straight"))


def main():
    graben, machines, designs = sys.argv[1:]
    banked = os.path.join(designs, "banked.xml")
    with tempfile.TemporaryDirectory() as folder:
        made_within_the_tolerance(graben, folder, banked)
        ground_that_resists_is_cut_in_passes(graben, folder, banked)
        points_are_the_same_design(graben, folder, banked)
        profile_takes_what_was_written(graben, folder, machines, banked)
        what_cannot_be_made_is_refused(graben, folder, banked)


if __name__ == "__main__":
    main()
