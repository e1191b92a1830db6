# SPDX-License-Identifier: Apache-2.0
"""Machines that the controller is not told: cells.py GRABEN [--fine | --map | --cell OIL EXPONENT DEAD_BAND]
[--profile MACHINE] [--speed S]
[--law LAW] [--dead-time S] [--later S] [--jobs N]
digs the dry path, without any other error, on simulated machines whose oil, opening exponent and dead band
are each cell's, and prints a row a cell: how it ended, largest distance of the true tip from the path,
ringing (rms above 1 Hz), and how far the learnt ends of the dead bands are from the true ones.

Status 1 if a cell is beyond --most-error or --most-ringing (mm), is not done, or its edges are learnt
farther off than --most-edge (% of the travel); --may-miss cells of all may. Status 2 if a run could not be
made."""

import argparse
import concurrent.futures
import itertools
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

# Oil in GPa, exponent of the opening, dead band as a share of the travel.
COARSE = ((0.7, 1.0, 1.4, 2.0), (1.4, 1.6, 1.8), (0.17, 0.20, 0.23))
FINE = ((0.6, 0.8, 1.0, 1.4, 2.0), (1.2, 1.4, 1.6, 1.8, 2.0), (0.15, 0.175, 0.20, 0.225, 0.25))
MAP = ((0.6, 0.7, 1.0, 1.4, 2.0), (1.3, 1.5, 1.6, 1.8), (0.16, 0.19, 0.22, 0.24))
PROFILE_DEAD_BAND = 0.20
EDGES = re.compile(r" 18FF3982#([0-9A-F]{12})")


def edges_percent(log):
    """Of the last frame; of those that are known."""
    last = EDGES.findall(log.read_text(encoding="ascii"))[-1]
    return [0.1 * raw - 12.5 for raw in bytes.fromhex(last) if raw <= 250]


def found(cell):
    return f"oil={cell[0]},exponent={cell[1]},dead_band={cell[2]}"


def share_of_speed(text):
    share = float(text)
    if not 0.05 <= share <= 1.0:
        raise argparse.ArgumentTypeError("a share of the full speed, 0.05 .. 1")
    return share


def run(graben, cell, how, also, folder):
    name = folder / "_".join(map(str, cell))
    summary = pathlib.Path(f"{name}.json")
    done = subprocess.run([graben, "dig", *how, "--found", found(cell) + also, "--out", str(name), "--summary", str(summary)],
                          capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1) or not summary.exists():
        raise RuntimeError(f"{found(cell)}: status {done.returncode}: {done.stderr.strip()[-300:]}")
    figures = json.loads(summary.read_text(encoding="utf-8"))
    truth = 100 * (cell[2] - PROFILE_DEAD_BAND)
    off = max((abs(edge - truth) for edge in edges_percent(name / "dig.log")), default=0.0)
    # A run that never came to its path has neither.
    error, ringing = (math.inf if figures[key] is None else 1e3 * figures[key]
                      for key in ("max_error_true_m", "ringing_rms_m"))
    return (done.returncode == 0, error, ringing, off, done.stderr.strip())


def worst(rows, column):
    """Of the runs that have such a figure."""
    return max((row[column] for row in rows if math.isfinite(row[column])), default=0.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("graben")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--fine", action="store_true", help="125 cells instead of 36")
    which.add_argument("--map", action="store_true", help="80 cells instead of 36, of softer oil and other edges")
    which.add_argument("--cell", nargs=3, type=float, action="append", metavar=("GPA", "EXPONENT", "DEAD_BAND"),
                       help="this one alone, or with others like it")
    parser.add_argument("--speed", type=share_of_speed, default=1.0, metavar="S", help="of the full one, 0.05 .. 1")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--law", help="the profile's unless told")
    parser.add_argument("--profile", default="excavator_22t", help="of an excavator (excavator_22t)")
    parser.add_argument("--dead-time", type=float, metavar="S", help="of every spool, told; the profile's unless told")
    parser.add_argument("--later", type=float, metavar="S", help="by so much it is longer than told")
    parser.add_argument("--most-error", type=float, default=50.0, metavar="MM")
    parser.add_argument("--most-ringing", type=float, default=3.0, metavar="MM")
    parser.add_argument("--most-edge", type=float, default=3.0, metavar="PERCENT")
    parser.add_argument("--may-miss", type=int, default=0, metavar="CELLS")
    options = parser.parse_args()
    how = ["--profile", options.profile, "--speed", str(options.speed)]
    how += ["--law", options.law] if options.law else []
    how += ["--dead-time", str(options.dead_time)] if options.dead_time is not None else []
    also = "" if options.later is None else f",dead_time={options.later}"
    every = FINE if options.fine else MAP if options.map else COARSE
    cells = [tuple(cell) for cell in options.cell] if options.cell else list(itertools.product(*every))
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        try:
            rows = list(pool.map(lambda cell: run(options.graben, cell, how, also, pathlib.Path(folder)), cells))
        except RuntimeError as error:
            print(f"cells.py: {error}", file=sys.stderr)
            sys.exit(2)
    print("oil, GPa  exponent  dead band  tip, max, mm  ringing, mm  edges off, %")
    missed = 0
    for cell, (done, error, ringing, off, why) in zip(cells, rows):
        miss = not (done and error <= options.most_error and ringing <= options.most_ringing
                    and off <= options.most_edge)
        missed += miss
        print(f"{cell[0]:8}  {cell[1]:8}  {cell[2]:9}  {error:12.1f}  {ringing:11.2f}  {off:12.1f}"
              f"{'  missed ' if miss else ''}{why}")
    print(f"cells: {len(cells)}  done: {sum(row[0] for row in rows)}  worst tip: {worst(rows, 1):.1f} mm  "
          f"worst ringing: {worst(rows, 2):.2f} mm  "
          f"ringing over {options.most_ringing:g} mm: {sum(row[2] > options.most_ringing for row in rows)}  "
          f"worst edge: {worst(rows, 3):.1f} %  missed: {missed}")
    sys.exit(1 if missed > options.may_miss else 0)


if __name__ == "__main__":
    main()
