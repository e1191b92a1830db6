# SPDX-License-Identifier: Apache-2.0
"""The table of lies of living sensors (firmware/safety/README.md), tried anew.

Each row of lies.toml is tried by lie_cases at three speeds of the operator, with `--seeds` draws of machine,
sensors' errors and time for each of its faults. Prints the table; --write puts it into the README, with --only
the rows that were tried in the place of those that are there.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tomllib

SPEEDS = (1.0, 0.3, 0.1)
BEGIN = "<!-- lies.py: from here -->\n"
END = "<!-- lies.py: to here -->\n"
ROWS = "tests/lies/lies.toml"
README = "firmware/safety/README.md"


def tried(binary: pathlib.Path, row: dict, fault: str, speed: float, seeds: int) -> dict:
    command = [binary, "--machine", row["machine"], "--speed", str(speed), "--seeds", str(seeds)]
    for name in fault.split("+"):
        command += ["--fault", name]
    command += ["--soil"] if row.get("soil") else []
    command += ["--from-start"] if row.get("from_start") else []
    command += ["--second"] if row.get("second") else []
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def together(of_faults: list[dict]) -> dict:
    """Of all faults of a row: counts, the middle of the medians, the worst."""
    medians = sorted(one["seen_s"][0] for one in of_faults if one["seen"])
    offs = sorted(one["off"][0] for one in of_faults if one["worked"])
    return {"tried": sum(one["tried"] for one in of_faults), "seen": sum(one["seen"] for one in of_faults),
            "worked": sum(one["worked"] for one in of_faults),
            "median_s": medians[len(medians) // 2] if medians else None,
            "worst_s": max((one["seen_s"][1] for one in of_faults if one["seen"]), default=None),
            "median_off": offs[len(offs) // 2], "worst_off": max(one["off"][1] for one in of_faults)}


def cell(of: dict) -> str:
    share = f"{of['seen']} of {of['worked']}" if of["seen"] < of["worked"] else "all"
    if of["worked"] < of["tried"]:
        share += f" ({of['tried'] - of['worked']} stopped before it)"
    times = "" if of["median_s"] is None else f", {of['median_s']:.1f} / {of['worst_s']:.1f} s"
    return f"{share}{times}; {of['median_off']:.2f} / {of['worst_off']:.2f}"


def table(rows: list[dict], results: dict) -> str:
    lines = ["| lie | wanted | " + " | ".join(f"speed {speed:g}" for speed in SPEEDS) + " |",
             "|---|---|" + "---|" * len(SPEEDS)]
    for number, row in enumerate(rows):
        cells = [cell(results[number, speed]) for speed in SPEEDS]
        lines.append(f"| {row['name']} | {row['most']:g} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def name_of(line: str) -> str:
    return line.split("|")[1].strip()


def merged(before: str, found: str, names: list[str]) -> str:
    """The table before with the rows of the other in the place of its own, in the order of the names."""
    lines = {name_of(line): line for text in (before, found) for line in text.splitlines()[2:]}
    return "\n".join(found.splitlines()[:2] + [lines[name] for name in names if name in lines]) + "\n"


def rows_of(file: pathlib.Path) -> list[dict]:
    rows = tomllib.loads(file.read_text())["lie"]
    names = [row["name"] for row in rows]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise SystemExit(f"{file}: two rows are named '{twice[0]}': one would stand in the other's place")
    return rows


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--build", type=pathlib.Path, default=pathlib.Path("build/release"))
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--only", default="", help="rows whose name has this")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    rows = rows_of(options.root / ROWS)
    names = [row["name"] for row in rows]
    rows = [row for row in rows if options.only in row["name"]]
    if not rows:
        parser.error(f"--only {options.only}: no row of lies.toml has this in its name")
    binary = options.build / "tests/lies/lie_cases"
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = {(number, speed): [pool.submit(tried, binary, row, fault, speed, options.seeds) for fault in row["any"]]
                 for number, row in enumerate(rows) for speed in SPEEDS}
        results = {key: together([one.result() for one in ones]) for key, ones in found.items()}
    text = table(rows, results)
    print(text, end="")
    if options.write:
        readme = options.root / README
        before, rest = readme.read_text().split(BEGIN)
        old, after = rest.split(END)
        readme.write_text(before + BEGIN + merged(old, text, names) + END + after)
    return 0


if __name__ == "__main__":
    sys.exit(main())
