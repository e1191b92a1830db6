#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the reader of LandXML to 25 documents of each of five exporters: every height within 1 mm of the plane that
was written, neither more nor less ground, or refused with the element that makes it so.

    check_exporters.py READ_DESIGNS [--keep FOLDER]
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

from documents import document
from habits import documents

MOST_M = 1e-3
AREA = 1e-3  # Share of it: sides of 0.5 m, in digits of 0.1 mm.


def wrong_of(habit, ground, lines):
    """What is wrong with the answer; none where nothing is."""
    said = lines[0] if lines and lines[0].startswith("refused") else ""
    if habit.refused:
        return "" if habit.refused in said and "line " in said else f"not refused by {habit.refused}: {said or 'read'}"
    if said:
        return said
    area = 0.0
    for line in lines:
        x = list(map(float, line.split()))
        corners = [x[0:3], x[3:6], x[6:9]]
        for east, north, height in corners:
            off = abs(height - ground.height_at(east, north))
            inside = (-MOST_M <= east - ground.east <= (ground.nx - 1) * ground.step + MOST_M
                      and -MOST_M <= north - ground.north <= (ground.ny - 1) * ground.step + MOST_M)
            if not off <= MOST_M or not inside:
                return f"{east} {north} {height}: {1e3 * off:.3f} mm off, {'inside' if inside else 'outside'}"
        (ax, ay, _), (bx, by, _), (cx, cy, _) = corners
        area += 0.5 * abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay))
    right = ground.area()
    return "" if abs(area - right) <= AREA * right else f"area {area:.6f} m2, right is {right:.6f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("reader")
    parser.add_argument("--keep", type=pathlib.Path)
    told = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = told.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        cases, asked = list(documents()), ""
        for name, habit, ground in cases:
            path = folder / f"{name}.xml"
            path.write_bytes(document(habit, ground))
            asked += f"{path}\t{habit.choose}\n"
        run = subprocess.run([told.reader], input=asked, capture_output=True, text=True, check=True)
    answers = run.stdout.split("\n\n")
    failures, refused = [], 0
    for (name, habit, ground), answer in zip(cases, answers):
        refused += bool(habit.refused)
        wrong = wrong_of(habit, ground, answer.strip().splitlines())
        if wrong:
            failures.append(f"{name}: {wrong}")
    print("\n".join(failures) or f"{len(cases)} documents: {len(cases) - refused} read, {refused} refused, as is right")
    return 1 if failures or len(answers) < len(cases) else 0


if __name__ == "__main__":
    sys.exit(main())
