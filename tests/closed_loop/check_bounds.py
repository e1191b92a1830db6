# SPDX-License-Identifier: Apache-2.0
"""Golden bounds of the closed loop on a few draws of each experiment, two-sided: worse is a
regression, and far better than a machine with lag, compliance and wrong sensors allows is a bug of
the simulation or of the figures."""

import csv
import os
import subprocess
import sys
import tempfile

MM = 1e-3

# name, options (with --errors kim unless they say), draws, {figure: (least median, most median, most of all)}
EXPERIMENTS = (
    ("exact, no soil", ("--errors", "none"), 1,
     {"max_error_true_m": (3 * MM, 10 * MM, 10 * MM)}),
    ("no soil", (), 8,
     {"max_error_true_m": (8 * MM, 22 * MM, 35 * MM),
      "rmse_error_measured_m": (1 * MM, 5 * MM, 10 * MM),
      "lambda_below_1": (0.1, 0.9, 1.0)}),
    ("soil, stiff oil", ("--soil", "--stiff-oil"), 6,
     {"max_error_true_m": (10 * MM, 33 * MM, 60 * MM),
      "rmse_error_measured_m": (1 * MM, 10 * MM, 15 * MM),
      "lambda_below_1": (0.1, 1.0, 1.0)}),
    ("soil", ("--soil",), 6,
     {"max_error_true_m": (20 * MM, 50 * MM, 75 * MM),
      "rmse_error_measured_m": (5 * MM, 15 * MM, 20 * MM),
      "lambda_variation_ps": (0.05, 0.5, 0.8),
      "loop_s": (17.0, 21.0, 24.0),
      "lambda_below_1": (0.1, 1.0, 1.0)}),
    ("obstacle, stiff oil", ("--obstacle", "--stiff-oil"), 4,
     {"lambda_held": (0.0, 0.1, 0.1),
      "max_error_true_m": (10 * MM, 35 * MM, 45 * MM),
      "recovery_error_max_m": (2 * MM, 25 * MM, 30 * MM)}),
    ("obstacle", ("--obstacle",), 4,
     {"lambda_held": (0.0, 0.1, 0.1),
      "max_error_true_m": (10 * MM, 40 * MM, 50 * MM),
      "recovery_error_max_m": (5 * MM, 35 * MM, 45 * MM)}),
    ("as found, no soil", ("--errors", "all"), 6,
     {"max_error_true_m": (10 * MM, 40 * MM, 70 * MM),
      "ringing_rms_m": (0.1 * MM, 4 * MM, 8 * MM)}),
    ("no soil, the servo, constant swash", ("--law", "servo", "--swash", "0.643"), 4,
     {"max_error_true_m": (8 * MM, 25 * MM, 40 * MM),
      "lambda_below_1": (0.33, 0.9, 1.0)}),
    ("the oil as a state, softer oil and a steeper valve than assumed: the servo is 180 mm off",
     ("--errors", "none", "--found", "oil=0.7,exponent=1.5,dead_band=0.20"), 1,
     {"max_error_true_m": (4 * MM, 30 * MM, 30 * MM)}),
    ("in the air", ("--air",), 4,
     {"max_error_true_m": (10 * MM, 70 * MM, 100 * MM),
      "regeneration": (0.2, 0.95, 1.0)}),
    ("dead time", ("--dead-time", "0.15", "--speed", "0.5"), 4,
     {"max_error_measured_m": (3 * MM, 25 * MM, 46 * MM),
      "rmse_error_measured_m": (0.5 * MM, 5 * MM, 10 * MM)}),
)
PORT_RELIEF_PA = 38.0e6


def rows(graben, folder, options, draws):
    file = os.path.join(folder, "bounds.csv")
    if os.path.exists(file):
        os.remove(file)
    errors = () if "--errors" in options else ("--errors", "kim")
    done = subprocess.run([graben, "campaign", "dig", "--draws", str(draws), "--summary", file,
                           *errors, *options], capture_output=True, text=True)
    assert done.returncode == 0, f"{options}: {done.stderr}"
    with open(file, encoding="ascii") as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


def figures(table, name):
    return sorted(float(row[name]) for row in table)


def median(values):
    return values[(len(values) - 1) // 2]


def check(name, table, bounds):
    wrong = [f"{name}, seed {row['seed']}: {row['end']}" for row in table if row["end"] != "done"]
    peak = figures(table, "peak_chamber_pressure_pa")[-1]
    if not peak <= 1.1 * PORT_RELIEF_PA:
        wrong.append(f"{name}: a chamber had {peak / 1e6:.1f} MPa")
    for figure, (least, most, most_of_all) in bounds.items():
        values = figures(table, figure)
        print(f"{name}: {figure} median {median(values):.4g}, max {values[-1]:.4g}")
        if not (least <= median(values) <= most and values[-1] <= most_of_all):
            wrong.append(f"{name}: {figure} has median {median(values):.4g} and max "
                         f"{values[-1]:.4g}; allowed: median {least:.4g} .. {most:.4g}, max "
                         f"{most_of_all:.4g}")
    return wrong


def main():
    graben = sys.argv[1]
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for name, options, draws, bounds in EXPERIMENTS:
            wrong += check(name, rows(graben, folder, options, draws), bounds)
        # What the optimisation is for: without it the tip is five times as far off.
        solved = median(figures(rows(graben, folder, (), 4), "max_error_true_m"))
        fixed_rows = rows(graben, folder, ("--fixed-lambda",), 4)
        fixed = median(figures(fixed_rows, "max_error_true_m"))
        print(f"lambda fixed at 1: {fixed:.3f} m, {fixed / solved:.0f} times as much")
        if not 5.0 * solved <= fixed <= 1.0:
            wrong.append(f"lambda fixed at 1: {fixed:.3f} m for {solved:.3f} m")
    print("\n".join(wrong) or "every figure within its bounds")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
