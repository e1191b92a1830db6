#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Passes that give way beside passes that don't: fixed_passes.py GRABEN [--deeper 0.06] [--draws 12] [--soil loam]
digs the pit of fixed_passes.toml in passes of one depth and with `truck_loading`, in the same draws, and prints how many
of each came to their end, and the soil an hour of the one over the other's where both did. Status 2 if a campaign could
not be made."""

import argparse
import csv
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

TASK = pathlib.Path(__file__).with_suffix(".toml")


def dug(graben: str, task: str, soil: str, draws: int, folder: pathlib.Path) -> dict[str, float | None]:
    """Soil an hour by seed; None where it did not come to its end."""
    table = folder / f"{pathlib.Path(task).stem}.csv"
    done = subprocess.run([graben, "campaign", "autodig", "--profile", "excavator_12t", "--task", task, "--soil", soil,
                           "--errors", "all", "--draws", str(draws), "--summary", str(table)],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if not table.exists():
        print(done.stdout, file=sys.stderr)
        raise SystemExit(2)
    rows = csv.DictReader(line for line in table.read_text().splitlines() if not line.startswith("#"))
    by_seed = {row["seed"]: float(row["cut_m3ph"]) if row["end"] == "done" else None for row in rows}
    if len(by_seed) != draws:
        print(f"{table.name}: {len(by_seed)} of {draws} draws", file=sys.stderr)
        raise SystemExit(2)
    return by_seed


def at_depth(deeper_m: float, folder: pathlib.Path) -> str:
    text, count = re.subn(r"deeper = [0-9.]+", f"deeper = {deeper_m}", TASK.read_text(encoding="utf-8"))
    if count != 1:
        raise RuntimeError(f"{TASK.name}: 'deeper' is there {count} times")
    path = folder / "fixed.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("graben")
    parser.add_argument("--deeper", type=float, default=0.06, help="each pass than the last one, m")
    parser.add_argument("--draws", type=int, default=12)
    parser.add_argument("--soil", default="loam")
    asked = parser.parse_args()
    if not 0.01 <= asked.deeper <= 0.3 or asked.draws < 1:
        parser.error("wanted: --deeper of 0.01 to 0.3 m, at least one draw")
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        fixed = dug(asked.graben, at_depth(asked.deeper, folder), asked.soil, asked.draws, folder)
        gives = dug(asked.graben, "truck_loading", asked.soil, asked.draws, folder)
    both = [seed for seed in fixed if fixed[seed] and gives[seed]]
    print(f"fixed passes: {sum(m3ph is not None for m3ph in fixed.values())} of {asked.draws} draws done")
    print(f"passes that give way: {sum(m3ph is not None for m3ph in gives.values())} of {asked.draws} draws done")
    if both:
        print(f"soil an hour: {statistics.median(gives[seed] / fixed[seed] for seed in both):.2f} times, "
              f"{statistics.median(fixed[seed] for seed in both):.1f} to "
              f"{statistics.median(gives[seed] for seed in both):.1f} m3")
    else:
        print("soil an hour: no draw in which both came to their end")
    return 0


if __name__ == "__main__":
    sys.exit(main())
