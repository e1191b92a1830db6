# SPDX-License-Identifier: Apache-2.0
"""What learning at work (`control.learns`) is worth: every kind of campaign with it and without, on the same draws.
learning.py GRABEN [--draws 12] [--seed 1] [--only "dig, soil+grade"] [--jobs N]

Prints a row for each campaign: draws that came to their end, the median, the 95th percentile and the largest of its error, on and off;
then how many are worse with learning, by more than 2 % and 0.5 mm of the 95th percentile, or by draws that did not end. Status 1 if any is."""

import argparse
import csv
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

# Name, campaign and its options, machine, figure.
CAMPAIGNS = (
    ("dig, full speed", ("dig",), "excavator_22t", "max_error_true_m"),
    ("dig, .3", ("dig", "--speed", "0.3"), "excavator_22t", "max_error_true_m"),
    ("dig, .1", ("dig", "--speed", "0.1"), "excavator_22t", "max_error_true_m"),
    ("dig, soil", ("dig", "--soil"), "excavator_22t", "max_error_true_m"),
    ("dig, load sensing", ("dig",), "excavator_22t_ls", "max_error_true_m"),
    ("dig, negative flow", ("dig",), "excavator_22t_nfc", "max_error_true_m"),
    ("assist", ("assist",), "excavator_22t", "rmse_m"),
    ("identify", ("identify",), "excavator_22t", "max_error_identified_m"),
    ("autodig, flatten, 12 t", ("autodig", "--task", "flatten"), "excavator_12t", "max_error_true_m"),
    ("autodig, trench in loam, 12 t", ("autodig", "--task", "trench", "--soil", "loam"), "excavator_12t", "over_cut_max_m"),
    ("fences, 12 t", ("fences",), "excavator_12t", "beyond_m"),
    ("grade, 9 t", ("grade",), "dozer_9t", "max_error_true_m"),
    ("grade, 9 t with tilt", ("grade",), "dozer_9t_tilt", "max_error_true_m"),
    ("designs, 9 t", ("designs",), "dozer_9t", "max_error_true_m"),
    ("ground, 9 t", ("ground",), "dozer_9t", "max_error_true_m"),
    ("identify, 9 t", ("identify",), "dozer_9t", "max_error_identified_m"),
)
# Ends of a draw that is as it should be.
GOOD = ("done", "refused", "no-way")
WORSE, WORSE_M = 1.02, 5e-4


MACHINES = pathlib.Path(__file__).resolve().parents[2] / "app" / "machines"


def machine_without(folder, profile):
    """The machine's file, with a controller that learns nothing; its simulated machine beside it."""
    told = folder / f"{profile}_told.toml"
    text = (MACHINES / f"{profile}.toml").read_text(encoding="utf-8")
    # A file that is like another may have no such section.
    told_text, found = re.subn(r"^(\[control\].*\n)", r"\1learns = false\n", text, count=1, flags=re.MULTILINE)
    told.write_text(told_text if found else f"{text}\n[control]\nlearns = false\n", encoding="utf-8")
    told.with_suffix(".sim.toml").write_text((MACHINES / f"{profile}.sim.toml").read_text(encoding="utf-8"), encoding="utf-8")
    return told


def run(graben, options, profile, asked, folder):
    file = folder / "draws.csv"
    file.unlink(missing_ok=True)
    done = subprocess.run([graben, "campaign", *options, "--profile", str(profile), "--draws", str(asked.draws),
                           "--seed", str(asked.seed), "--summary", str(file),
                           *(("--jobs", str(asked.jobs)) if asked.jobs else ())], capture_output=True, text=True, check=False)
    # Status 1 as well where a draw did not come to its end, which the table says.
    assert done.returncode in (0, 1) and file.exists(), f"{options}: {done.stdout}{done.stderr}"
    with open(file, encoding="ascii") as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


def p95(values):
    """As the campaign's table has it: the least that 95 % do not pass."""
    return sorted(values)[max(0, -(-95 * len(values) // 100) - 1)]


def figures(rows, column):
    good = [row for row in rows if row["end"] in GOOD]
    values = [float(row[column]) for row in good if row[column]] or [0.0]
    return len(good), statistics.median(values), p95(values), max(values)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("graben")
    parser.add_argument("--draws", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="Campaigns whose names begin so, with + between")
    parser.add_argument("--jobs", type=int)
    asked = parser.parse_args()
    chosen = [each for each in CAMPAIGNS
              if not asked.only or any(each[0].startswith(name) for name in asked.only.split("+"))]
    worse = []
    print(f"{'campaign':<31} {'ended':>8}  {'median':>13}  {'p95':>13}  {'largest':>13}   on / off, mm")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for title, options, profile, column in chosen:
            on, off = (figures(run(asked.graben, options, machine, asked, folder), column)
                       for machine in (profile, machine_without(folder, profile)))
            cells = "  ".join(f"{1e3 * on[at]:>6.1f}/{1e3 * off[at]:>6.1f}" for at in (1, 2, 3))
            is_worse = on[0] < off[0] or on[2] > max(WORSE * off[2], off[2] + WORSE_M)
            print(f"{title:<31} {on[0]:>3}/{off[0]:>3}   {cells}{'   worse with learning' if is_worse else ''}", flush=True)
            if is_worse:
                worse.append(title)
    print(f"{len(worse)} of {len(chosen)} are worse with learning{': ' + ', '.join(worse) if worse else ''}")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
