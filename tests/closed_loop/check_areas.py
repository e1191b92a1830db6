# SPDX-License-Identifier: Apache-2.0
"""Areas of `graben autodig`: dug to their design, in soils and on machines of both sizes as found; as
built told in figures, map and report; areas that can't be had."""

import argparse
import json
import tempfile

import report_page
from check_autodig import MM, Digger

OVER_CUT_MM, BUILT = 25.0, 0.95


def as_built(digger, dug, what):
    """The map's places give the figures, and the report has the same places."""
    places = dug["built_map"]
    off_m = sorted(place["off_m"] for place in places)
    for share, name in ((0.05, "built_low_m"), (0.5, "built_median_m"), (0.95, "built_high_m")):
        least, most = (off_m[min(len(off_m) - 1, max(0, int(share * len(off_m)) + n))] for n in (-1, 1))
        assert least - 1e-6 <= dug[name] <= most + 1e-6, f"{what}: {name} {dug[name]}, {least} .. {most}"
    within = sum(abs(off) <= 30 * MM for off in off_m) / len(off_m)
    assert abs(within - dug["built_within_ratio"]) < 1e-3, f"{what}: {within}"
    # A wall that falls in leaves loose soil on what is firm.
    assert all(place["firm_m"] <= place["off_m"] + 0.1 for place in places), what
    built = report_page.setup_of(digger.content("autodig.html"))["run"]["built"]
    for key, name, per_m in (("x_m", "x_m", 1.0), ("y_m", "y_m", 1.0), ("off_mm", "off_m", 1e3),
                             ("firm_mm", "firm_m", 1e3)):
        assert len(built[key]) == len(places), f"{what}: {key}"
        worst = max(abs(told - per_m * place[name]) for told, place in zip(built[key], places))
        assert worst < 0.06, f"{what}: {key} is {worst} off"


# Machine, task, soil, seed; a run takes ten seconds. The second part: with --every.
AREAS = (("12t", "truck_loading", "loam", 1),)
MORE_AREAS = (("12t", "level", "loam", 3), ("22t", "trench", "sand", 10), ("12t", "trench", "loam", 1), ("12t", "trench", "sand", 5), ("12t", "slope", "clay", 2),
              ("12t", "slope", "loam", 2), ("22t", "trench", "loam", 4), ("22t", "slope", "loam", 2))


def areas(digger, cells):
    """Dug to their design in soil that nobody has told of, on a machine as found; never through it."""
    for machine, task, soil, seed in cells:
        dug = digger.figures("--profile", f"excavator_{machine}", "--task", task, "--soil", soil, "--errors", "all",
                             "--seed", str(seed))
        what = f"{task} in {soil}, {machine}"
        assert 0.0 <= dug["over_cut_max_m"] <= OVER_CUT_MM * MM, f"{what}: {dug['over_cut_max_m']}"
        assert dug["built_within_ratio"] >= BUILT, f"{what}: {dug['built_within_ratio']}"
        assert dug["max_error_true_m"] is None, dug["max_error_true_m"]
        # The teeth feel some soil over what the plan allows, never a multiple of what the machine has.
        assert 0.0 < dug["cut_force_over_n"] < dug["cut_force_over_max_n"] < 200e3, f"{what}: {dug['cut_force_over_max_n']}"
        as_built(digger, dug, what)
        rounds = 1 + max(step["round"] for step in dug["steps"])
        assert 3 <= rounds <= 40, f"{what}: {rounds} rounds"
    shallow = digger.task('area = { kind = "trench", far = 6.6, near = 4.4, depth = 0.8, ground = -0.5 }\n')
    air = digger.figures(*shallow)
    assert air["built_map"] == [] and air["built_median_m"] is None, air["built_map"]
    assert "built" not in report_page.setup_of(digger.content("autodig.html"))["run"]
    assert air["cut_force_over_n"] is None and air["cut_m3"] is None and air["over_cut_max_m"] < 10 * MM, air["over_cut_max_m"]
    for line, needle in (
            ('kind = "moat", far = 6.6, near = 4.4, depth = 0.8', "area.kind"),
            ('kind = "pit", far = 6.6, near = 4.4, depth = 0.8', "area.width"),
            ('kind = "trench", far = 4.4, near = 6.6, depth = 0.8', "area.near (line 1): 6.6 m; allowed: less"),
            ('kind = "trench", far = 6.6, near = 4.4, depth = 9.0', "area.depth"),
            ('kind = "trench", far = 6.6, near = 4.4, depth = 0.8, width = 1.0', "area.width"),
            ('kind = "slope", far = 6.6, near = 4.4, depth = 0.8', "area.depth_near"),
            ('kind = "trench", far = 12.0, near = 4.4, depth = 0.8', "out of the reach"),
            ('kind = "level", far = 6.6, near = 4.4, depth = 0.2, turn = 2.9', "swing")):
        digger.refused([needle], *digger.task(f"area = {{ {line} }}\n"))


def what_is_left_is_said(digger):
    said = []
    for soil, seed in (("stones", 11), ("stones", 12), ("loam", 1)):
        done = digger.call("autodig", "--task", "trench", "--soil", soil, "--errors", "all", "--seed", str(seed),
                           "--summary", digger.path("left.json"))
        with open(digger.path("left.json"), encoding="utf-8") as stream:
            left = json.load(stream)["built_within_ratio"] < BUILT
        said.append("ground was left: " in done.stdout)
        assert said[-1] == left and done.returncode == 0, f"{soil}, seed {seed}: {done.stdout}"
    assert set(said) == {True, False}, said


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("graben")
    parser.add_argument("--every", action="store_true", help="more areas")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        digger = Digger(arguments.graben, folder)
        areas(digger, AREAS + (MORE_AREAS if arguments.every else ()))
        what_is_left_is_said(digger)


if __name__ == "__main__":
    main()
