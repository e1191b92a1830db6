# SPDX-License-Identifier: Apache-2.0
"""Holds the table of lies (firmware/safety/README.md) to what is tried.

Each row of the rows' file has its line in the table and the table has no other. A row with `held` is tried with two
draws of each of its faults at full speed: all must be seen, and until then the tool at most `held` off.
"""

from __future__ import annotations

import argparse
import pathlib
import sys

import lies

SEEDS = 2


def wrong_names(root: pathlib.Path, names: list[str]) -> list[str]:
    table = (root / lies.README).read_text().split(lies.BEGIN)[1].split(lies.END)[0]
    there = [lies.name_of(line) for line in table.splitlines()[2:]]
    return ([f"no line in {lies.README}: {name}" for name in names if name not in there]
            + [f"no row in the file: {name}" for name in there if name not in names])


def missed(binary: pathlib.Path, row: dict) -> list[str]:
    found = []
    for fault in row["any"]:
        done = lies.tried(binary, row, fault, 1.0, SEEDS)
        if done["worked"] < SEEDS or done["seen"] < SEEDS or done["off"][1] > row["held"]:
            found.append(f"{row['name']}: {fault}: {done['seen']} of {done['tried']} seen, {done['off'][1]} off; "
                         f"all and {row['held']} at most")
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="lie_cases")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--rows", type=pathlib.Path, help="another file of rows, which is not held against the table")
    options = parser.parse_args()
    rows = lies.rows_of(options.rows or options.root / lies.ROWS)
    held = [row for row in rows if "held" in row]
    wrong = [] if options.rows else wrong_names(options.root, [row["name"] for row in rows])
    wrong += [line for row in held for line in missed(options.binary, row)]
    for line in wrong:
        print(f"lies: {line}", file=sys.stderr)
    print(f"lies: {len(rows)} rows, {len(held)} of them tried, {len(wrong)} wrong")
    return 1 if wrong or not held else 0


if __name__ == "__main__":
    sys.exit(main())
