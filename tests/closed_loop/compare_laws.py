# SPDX-License-Identifier: Apache-2.0
"""The feedback laws side by side: compare_laws.py GRABEN [--draws 200] [--jobs N] [--markdown]
runs campaigns of servo, oil and kim in each case and prints their figures at their own and at equal loop
time, and below them swash on demand against constant swash for law oil.

At equal loop time the quicker ones are slowed by the operator's override until their median is within 2 %
of the slowest one's. Figures are of the draws that ended as done; the last column counts how all ended.
Status 2 if a campaign could not be made."""

import argparse
import collections
import csv
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

# Key -> name in the tables, options, speed override.
CASES = {
    "dry": ("no soil", (), 1.0),
    "soil_stiff": ("soil, stiff oil", ("--soil", "--stiff-oil"), 1.0),
    "soil": ("soil", ("--soil",), 1.0),
    "air": ("air", ("--air",), 1.0),
    "rock": ("rock", ("--obstacle",), 1.0),
    "dead_time": ("dead time 0.15 s, half speed", ("--dead-time", "0.15"), 0.5),
}
ERRORS = ("kim", "all")
LAWS = {law: ("--law", law) for law in ("servo", "oil", "kim")}
SWASH_CASES = ("dry", "soil", "air")
SWASHES = {"on demand": ("--law", "oil"), "constant 0.643": ("--law", "oil", "--swash", "0.643")}

LEAST_SPEED = 0.05  # that graben takes
TOLERANCE = 0.02    # of the slowest loop time
TRIALS, TRIAL_DRAWS = 3, 6  # that find the speed on few draws
RUNS = 5                    # at most, of all draws
JOULES_PER_KWH = 3.6e6

HEAD = ("case", "errors", "law", "loop time", "speed", "tip, max: median / p95 / max, mm", "ringing, max, mm",
        "loop, s", "kWh a loop", "lambda's variation, /s", "reversals boom, /s", "arm, /s",
        "after rock: median / p95 / max, mm", "draws")
SWASH_HEAD = ("case", "errors", "swash", "loop time", "speed", "tip, max: median / p95 / max, mm", "loop, s",
              "of constant's time", "kWh a loop", "of constant's energy", "draws")


def ranked(values, share):
    """Nearest rank, as `graben campaign` has it."""
    return sorted(values)[max(math.ceil(share * len(values)), 1) - 1]


class Figures:
    """Of the rows of one campaign, by seed."""

    def __init__(self, rows):
        self.done = [row for row in rows if row["end"] == "done"]
        self.ends = collections.Counter(row["end"] for row in rows)

    def values(self, key):
        return [float(row[key]) for row in self.done if row[key]]

    def median(self, key):
        return ranked(self.values(key), 0.5) if self.values(key) else None

    def text(self, key, shares=(0.5,), scale=1.0, digits=1):
        values = self.values(key)
        return " / ".join(f"{scale * ranked(values, share):.{digits}f}" for share in shares) if values else "-"

    def tip(self):
        return self.text("max_error_true_m", (0.5, 0.95, 1.0), 1e3)

    def energy(self):
        return self.text("energy_per_loop_j", scale=1.0 / JOULES_PER_KWH, digits=3)

    def ended(self):
        return ", ".join(f"{count} {end}" for end, count in sorted(self.ends.items()))


class Campaigns:
    """Runs campaigns, each in a file of its own; draws that are in it are not made again."""

    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def figures(self, arguments, speed, draws):
        given = ["--profile", self.options.profile, "--seed", str(self.options.seed), *arguments,
                 "--speed", f"{speed:.5g}"]
        file = self.folder / (re.sub(r"\W+", "_", " ".join(given)).strip("_") + ".csv")
        done = subprocess.run([self.options.graben, "campaign", "dig", *given, "--draws", str(draws), "--jobs",
                               str(self.options.jobs), "--summary", str(file)], capture_output=True, text=True,
                              check=False)
        if done.returncode != 0 and "did not come to their end" not in done.stderr:
            raise RuntimeError(f"{' '.join(given)}: status {done.returncode}: {done.stderr.strip()}")
        with open(file, encoding="utf-8") as stream:
            rows = {int(row["seed"]): row for row in csv.DictReader(line for line in stream if line[0] != "#")}
        seeds = range(self.options.seed, self.options.seed + draws)
        if missing := [seed for seed in seeds if seed not in rows]:
            raise RuntimeError(f"{file}: seed {missing[0]} is missing")
        return Figures([rows[seed] for seed in seeds])


def next_speed(points, target_s, most):
    """From (1 / speed, loop time), which is nearly linear: the line through the two points next to the target, on
    either side of it if there are such; in proportion if there is one point."""
    points = sorted(points, key=lambda point: point[1])
    above = next((at for at, point in enumerate(points) if point[1] > target_s), len(points) - 1)
    (first, first_s), (inverse, loop_s) = points[max(above - 1, 0)], points[above]
    if above > 0 and inverse > first and loop_s > first_s:
        following = inverse + (target_s - loop_s) * (inverse - first) / (loop_s - first_s)
    else:
        following = inverse * target_s / loop_s
    return min(max(1.0 / following, LEAST_SPEED), most)


def slowed(campaigns, arguments, most, own, target_s):
    """Speed and figures at which the median loop takes target_s: trials on few draws, then on all."""
    draws = campaigns.options.draws
    few = min(draws, TRIAL_DRAWS)
    own_s = own.median("loop_s")
    few_own_s = campaigns.figures(arguments, most, few).median("loop_s")
    speed = next_speed([(1.0 / most, own_s)], target_s, most)
    if few < draws and few_own_s:
        # The few are as much quicker or slower than all as they were at their own speed.
        few_target_s = target_s * few_own_s / own_s
        points = [(1.0 / most, few_own_s)]
        for _ in range(TRIALS):
            loop_s = campaigns.figures(arguments, speed, few).median("loop_s")
            if not loop_s:
                break
            points.append((1.0 / speed, loop_s))
            if abs(loop_s / few_target_s - 1.0) <= TOLERANCE / 4.0:
                break
            speed = next_speed(points, few_target_s, most)
    points, found = [(1.0 / most, own_s)], []
    for _ in range(RUNS):
        figures = campaigns.figures(arguments, speed, draws)
        loop_s = figures.median("loop_s")
        found.append((abs(loop_s / target_s - 1.0) if loop_s else math.inf, speed, figures))
        if not loop_s or found[-1][0] <= TOLERANCE:
            break
        points.append((1.0 / speed, loop_s))
        speed = next_speed(points, target_s, most)
    return min(found, key=lambda one: one[0])[1:]


def compare(campaigns, case, errors, ways):
    """(way, 'own' or 'equal', speed, figures, slowest median loop) of each way, first all at their own loop time."""
    _, arguments, most = CASES[case]
    given = {way: (*arguments, "--errors", errors, *extra) for way, extra in ways.items()}
    own = {way: campaigns.figures(given[way], most, campaigns.options.draws) for way in ways}
    loops = {way: figures.median("loop_s") for way, figures in own.items()}
    slowest_s = max((loop_s for loop_s in loops.values() if loop_s), default=None)
    results = [(way, "own", most, own[way], slowest_s) for way in ways]
    for way in ways:
        speed, figures = most, own[way]
        if loops[way] and loops[way] < (1.0 - TOLERANCE) * slowest_s:
            speed, figures = slowed(campaigns, given[way], most, figures, slowest_s)
        results.append((way, "equal", speed, figures, slowest_s))
    return results


def loop_text(at, figures, slowest_s):
    """An equal loop time that is not within the tolerance is told."""
    loop_s = figures.median("loop_s")
    missed = at == "equal" and loop_s and abs(loop_s / slowest_s - 1.0) > TOLERANCE
    return figures.text("loop_s", digits=2) + (f" ({loop_s / slowest_s - 1.0:+.1%})" if missed else "")


def law_row(case, errors, result):
    law, at, speed, figures, slowest_s = result
    return (CASES[case][0], errors, law, at, f"{speed:.3g}", figures.tip(),
            figures.text("ringing_rms_m", (1.0,), 1e3), loop_text(at, figures, slowest_s), figures.energy(),
            figures.text("lambda_variation_ps", digits=2), figures.text("spool_reversals_boom_ps", digits=2),
            figures.text("spool_reversals_arm_ps", digits=2),
            figures.text("recovery_error_max_m", (0.5, 0.95, 1.0), 1e3), figures.ended())


def swash_rows(case, errors, results):
    constant = {at: figures for way, at, _, figures, _ in results if way != "on demand"}
    rows = []
    for way, at, speed, figures, slowest_s in results:
        ratios = ["-" if way != "on demand" or None in (pair := (figures.median(key), constant[at].median(key)))
                  else f"{pair[0] / pair[1]:.2f}" for key in ("loop_s", "energy_per_loop_j")]
        rows.append((CASES[case][0], errors, way, at, f"{speed:.3g}", figures.tip(),
                     loop_text(at, figures, slowest_s), ratios[0], figures.energy(), ratios[1], figures.ended()))
    return rows


def print_table(head, rows, markdown):
    if markdown:
        for row in (head, ("---",) * len(head), *rows):
            print(f"| {' | '.join(row)} |")
        return
    widths = [max(len(row[column]) for row in (head, *rows)) for column in range(len(head))]
    for row in (head, *rows):
        print("  ".join(text.ljust(width) for text, width in zip(row, widths)).rstrip())


def print_tables(campaigns):
    options = campaigns.options
    laws = [law_row(case, errors, result) for case in options.cases for errors in options.errors
            for result in compare(campaigns, case, errors, LAWS)]
    swashes = [row for case in options.cases if case in SWASH_CASES for errors in options.errors
               for row in swash_rows(case, errors, compare(campaigns, case, errors, SWASHES))]
    print(f"{options.profile}: {options.draws} draws, seeds {options.seed} to {options.seed + options.draws - 1}; "
          "medians unless said otherwise\n")
    print_table(HEAD, laws, options.markdown)
    if swashes:
        print("\nSwash on demand against constant swash, law oil\n")
        print_table(SWASH_HEAD, swashes, options.markdown)
    if "air" in options.cases:
        print("\nair: the time is that of the manoeuvre, the energy is scaled to a whole loop's length")


def whole(least):
    def number(text):
        if not re.fullmatch(r"\d+", text) or int(text) < least:
            raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from {least} on")
        return int(text)
    return number


def some_of(known):
    def names(text):
        chosen = text.split(",")
        if unknown := [name for name in chosen if name not in known]:
            raise argparse.ArgumentTypeError(f"'{unknown[0]}' is none of {', '.join(known)}")
        return [name for name in known if name in chosen]
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("graben")
    parser.add_argument("--profile", default="excavator_22t")
    parser.add_argument("--draws", type=whole(1), default=200)
    parser.add_argument("--seed", type=whole(0), default=1, help="of the first draw")
    parser.add_argument("--jobs", type=whole(1), default=os.cpu_count())
    parser.add_argument("--cases", type=some_of(tuple(CASES)), default=list(CASES), metavar="CASE[,CASE]",
                        help=f"of {', '.join(CASES)}")
    parser.add_argument("--errors", type=some_of(ERRORS), default=list(ERRORS), metavar="ERRORS[,ERRORS]",
                        help=f"of {', '.join(ERRORS)}")
    parser.add_argument("--out", type=pathlib.Path, metavar="FOLDER",
                        help="keeps the campaigns' files here, and goes on with those that are there")
    parser.add_argument("--markdown", action="store_true")
    options = parser.parse_args()
    if shutil.which(options.graben) is None:
        parser.error(f"{options.graben}: no such program")
    try:
        with tempfile.TemporaryDirectory() as temporary:
            folder = options.out or pathlib.Path(temporary)
            folder.mkdir(parents=True, exist_ok=True)
            print_tables(Campaigns(options, folder))
    except (OSError, RuntimeError) as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
