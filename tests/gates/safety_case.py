#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: every link of the safety case leads somewhere, and its table is that of README.md.

safety_case.py --root DIR --rows COMMAND [--tests BUILD] [--write]: COMMAND prints the rows of the fault table,
a number a line; BUILD is the folder that ctest knows tests of."""

import argparse
import pathlib
import re
import shlex
import subprocess
import sys
import tomllib

CASE, README, FAULTS = "firmware/safety/case.toml", "firmware/safety/README.md", "firmware/safety/faults.toml"
SEEDS = "tests/faults/seeded.toml"
BEGIN, END = "<!-- case: begin -->", "<!-- case: end -->"
LINKS = ("faults", "rows", "tests", "mutants", "seeds")


def output(command: list[str]) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def mutated_files(root: pathlib.Path) -> set[str]:
    """Files whose mutants are made: those that tests/mutation names, or finds by a pattern."""
    text = (root / "tests/mutation/CMakeLists.txt").read_text(encoding="utf-8")
    named = set(re.findall(r"[\w/]+\.[ch]pp", text))
    patterns = re.findall(r"\$\{PROJECT_SOURCE_DIR\}/([\w/]+\*\.cpp)", text)
    return named | {str(file.relative_to(root)) for pattern in patterns for file in root.glob(pattern)}


def dead_links(requirements: list[dict], known: dict[str, set]) -> list[str]:
    return [f"{CASE}: {requirement['id']}: {kind}: {link!r} is not there"
            for requirement in requirements for kind in LINKS
            for link in requirement.get(kind, []) if link not in known[kind]]


def left_out(requirements: list[dict], known: dict[str, set]) -> list[str]:
    return [f"{CASE}: {kind}: {link!r} stands under no requirement" for kind in ("faults", "rows", "seeds")
            for link in sorted(known[kind] - {link for row in requirements for link in row.get(kind, [])})]


def wrong_rows(case: dict) -> list[str]:
    problems = []
    requirements = case["requirement"]
    ids = [requirement["id"] for requirement in requirements]
    for requirement in requirements:
        if unknown := requirement.keys() - {"id", "text", *LINKS}:
            problems.append(f"{CASE}: {requirement['id']}: unknown key {sorted(unknown)[0]}")
        if requirement["id"][0] not in case["hazard"]:
            problems.append(f"{CASE}: {requirement['id']}: no such hazard")
        if ids.count(requirement["id"]) > 1:
            problems.append(f"{CASE}: {requirement['id']}: is there twice")
        if not requirement.get("rows") and not requirement.get("tests"):
            problems.append(f"{CASE}: {requirement['id']}: nothing shows it")
    problems += [f"{CASE}: hazard {letter}: nothing is required against it" for letter in case["hazard"]
                 if not any(name.startswith(letter) for name in ids)]
    return problems


def table(case: dict) -> str:
    lines = []
    for letter, hazard in case["hazard"].items():
        lines += [f"**{hazard['text']}**", "", "| | required | faults | rows | tests | mutants of | seeded faults |",
                  "|---|---|---|---|---|---|---|"]
        for row in case["requirement"]:
            if row["id"].startswith(letter):
                cells = [", ".join(f"`{pathlib.PurePath(str(link)).name}`" if kind != "rows" else str(link)
                                   for link in row.get(kind, [])) or "-" for kind in LINKS]
                lines.append(f"| {row['id']} | {row['text']} | {' | '.join(cells)} |")
        lines.append("")
    return "\n".join(lines).rstrip("\n")


def written(text: str, part: str) -> str:
    begin, end = text.index(BEGIN) + len(BEGIN), text.index(END)
    return f"{text[:begin]}\n{part}\n{text[end:]}"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--rows", required=True, help="command that prints the rows' numbers")
    parser.add_argument("--tests", type=pathlib.Path, help="build folder; without it tests are not looked up")
    parser.add_argument("--write", action="store_true", help="write the table into README.md")
    options = parser.parse_args()
    root = options.root
    case = tomllib.loads((root / CASE).read_text(encoding="ascii"))
    requirements = case["requirement"]
    known = {"faults": set(tomllib.loads((root / FAULTS).read_text(encoding="ascii"))),
             "rows": {int(line.split()[0]) for line in output(shlex.split(options.rows)).splitlines()},
             "mutants": mutated_files(root),
             "seeds": set(tomllib.loads((root / SEEDS).read_text(encoding="ascii")))}
    if options.tests:
        known["tests"] = set(re.findall(r"Test +#\d+: (\S+)", output(["ctest", "--test-dir", str(options.tests), "-N"])))
    else:
        known["tests"] = {link for row in requirements for link in row.get("tests", [])}
    problems = wrong_rows(case) + dead_links(requirements, known) + left_out(requirements, known)
    readme = root / README
    text = readme.read_text(encoding="utf-8")
    if options.write:
        readme.write_text(written(text, table(case)), encoding="utf-8")
    elif written(text, table(case)) != text:
        problems.append(f"{README}: the table is not that of case.toml: {pathlib.Path(__file__).name} --write")
    print("\n".join([*problems, f"safety case: {len(requirements)} requirements, {len(known['rows'])} rows, "
                     f"{len(known['faults'])} faults, {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
