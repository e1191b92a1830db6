# SPDX-License-Identifier: Apache-2.0
"""`graben grade` as tests run it: its figures, and what it refuses."""

import json
import pathlib
import re
import subprocess

MM = 1e-3
TILTS, LEVEL = "dozer_9t_tilt", "dozer_9t"


def read(*path):
    return pathlib.Path(*path).read_text(encoding="utf-8")


def write(text, *path):
    """Where it was written."""
    pathlib.Path(*path).write_text(text, encoding="utf-8")
    return str(pathlib.Path(*path))


def run(graben, *options):
    return subprocess.run([graben, "grade", *options], capture_output=True, text=True, timeout=1800)


def figures_of(graben, folder, *options):
    """Of its summary; its files go into the folder."""
    summary = pathlib.Path(folder, "summary.json")
    done = run(graben, "--out", folder, "--summary", summary, *options)
    # Each test has bounds of its own, some wider than the profile's tolerance.
    assert done.returncode == 0 or "out of tolerance" in done.stderr, f"{options}: {done.stdout}{done.stderr}"
    return json.loads(read(summary))


def refused(graben, *options, words):
    done = run(graben, *options)
    assert done.returncode != 0, f"{options} was taken"
    for word in words:
        assert word in done.stderr, f"{options}: '{word}' is not in: {done.stderr}"


def written(folder, column):
    """Of the design that a run wrote, point by point: 2 the slopes across, 3 the curvatures."""
    return [float(line.split()[column]) for line in read(folder, "design.txt").splitlines() if not line.startswith("#")]


def made_within_bounds(graben, folder, runs, *design):
    """Each run's options with bounds of its worst error, mm, of its time, s, and of the edge beside its track, mm."""
    for options, error_mm, time_s, aside_mm in runs:
        figures = figures_of(graben, folder, "--profile", TILTS, *design, *options)
        worst = max(figures[key] for key in ("max_error_true_m", "over_cut_m", "ground_left_m"))
        print(f"{' '.join(options) or 'as it is'}: {worst / MM:.1f} mm, {figures['off_track_m'] / MM:.0f} mm beside "
              f"the track, {figures['time_s']:.2f} s")
        assert error_mm[0] * MM < worst < error_mm[1] * MM, (options, worst)
        assert aside_mm[0] * MM < figures["off_track_m"] < aside_mm[1] * MM, (options, figures["off_track_m"])
        assert time_s[0] < figures["time_s"] < time_s[1], (options, figures["time_s"])
        assert figures["passes"] == 1


def profile_takes_what_was_written(graben, folder, machines, design, length, depth_max, compared, refusal):
    """A profile of its own drives the design that a run wrote as that run did; without its tilt it is refused."""
    figures = figures_of(graben, folder, "--profile", TILTS, *design)
    for ending in (".toml", ".sim.toml"):
        text = read(machines, LEVEL + ending) + "[tilt]" + read(machines, TILTS + ending).partition("[tilt]")[2]
        text = re.sub(r"(?m)^profile = \[\[0\.0.*$", 'design = "design.txt"', text)
        text = re.sub(r"(?m)^length = 27\.0", f"length = {length}", text)
        write(re.sub(r"(?m)^depth_max = .*$", f"depth_max = {depth_max}", text), folder, "own" + ending)
    own = str(pathlib.Path(folder, "own.toml"))
    again = figures_of(graben, folder, "--profile", own)
    # But for six decimals of each number.
    for key in compared:
        assert abs(again[key] - figures[key]) < 1e-3 * max(1.0, figures[key]), (key, again[key], figures[key])
    write(read(own).partition("[tilt]")[0], own)
    refused(graben, "--profile", own, words=("grade.design", refusal, "no [tilt]"))
