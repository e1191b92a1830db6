#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What ./test cost, judged by its budget: budget.py RECORDS BUILD [--whole REASON] [--write].

Costs are counted in units: processor seconds over those of six reference compiles (reference.cpp), so that a
busy or slow machine turns nothing red. They are made before each stage, as many at once as there are
processors, since a compile beside another is dearer and a shared machine changes within minutes; the mean
counts. RECORDS has stages.txt and reference.txt, lines of a name and seconds; BUILD, the release, has costs.txt
(cost.cmake) and Ninja's log. Red a tenth above the budget (budget.toml) and above what the scatter of the
references leaves unknown, with the names of what grew; red where a test costs more than two units and
proofs.toml does not say what only it proves. --write: this run's costs become those that a later one is
compared with, here and in tests/README.md.
"""

import argparse
import math
import pathlib
import re
import statistics
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
TABLE = re.compile(r"(<!-- table cost \(tests/cost\) -->\n).*?(<!-- end of table -->)", re.DOTALL)
KEPT = 1.0  # Units: a test below that is not written down.
GREW = 1.2  # Of what it was.
# Compiles of reference.cpp. Tried: with six the first sight of the commit that wrote the budget down (2ef3bcf4)
# costs the 26 units that it cost there, built anew on another machine: 331 s, a compile beside another 2.1 s.
COMPILES_OF_UNIT = 6
# Compiles without which nothing is judged. One in three was 1.3 times as dear as the others (tried: 9 in a row).
LEAST_COMPILES = 10


def rows_of(file: pathlib.Path) -> dict[str, float]:
    """Lines of a name and one or two numbers of seconds, user and system; what is there twice adds up."""
    found: dict[str, float] = {}
    for line in file.read_text(encoding="utf-8").splitlines() if file.exists() else ():
        if match := re.match(r"(.+?) ([\d.]+)(?: ([\d.]+))?(?: [\d.]+)?$", line):
            found[match[1]] = found.get(match[1], 0.0) + float(match[2]) + float(match[3] or 0)
    return found


def unit_of(file: pathlib.Path) -> tuple[float, float]:
    """Seconds of a unit, and what part of it its own scatter leaves unknown: two standard errors of the mean."""
    seconds = [sum(map(float, line.split())) for line in file.read_text(encoding="utf-8").splitlines()]
    if len(seconds) < LEAST_COMPILES:
        sys.exit(f"budget: {len(seconds)} reference compiles; {LEAST_COMPILES} are wanted: the gate is dead")
    mean = statistics.mean(seconds)
    return COMPILES_OF_UNIT * mean, 2.0 * statistics.stdev(seconds) / math.sqrt(len(seconds)) / mean


def units_of_build(log: pathlib.Path) -> dict[str, float]:
    """Seconds that each object took, by Ninja's clock."""
    found = {}
    for line in log.read_text(encoding="utf-8").splitlines()[1:]:
        begin, end, _, output, _ = line.split("\t")
        if output.endswith((".o", ".gch")):
            found[re.sub(r"CMakeFiles/|[.]dir(?=/)|[.]o$", "", output)] = (int(end) - int(begin)) / 1000.0
    return found


def dearest(rows: dict[str, float], count: int) -> list[tuple[str, float]]:
    return sorted(rows.items(), key=lambda row: -row[1])[:count]


def table(stages: dict, tests: dict, objects: dict, unit_s: float) -> str:
    proofs = tomllib.loads((HERE / "proofs.toml").read_text(encoding="utf-8"))
    lines = [f"One unit is six compiles of `tests/cost/reference.cpp`, {unit_s:.2f} processor seconds when this was made.", "",
             "| | units | seconds |", "|---|---|---|"]
    named = [("`./run`, fresh: build and one dig", stages.get("first sight", 0.0)), ("`./test`, fresh", sum(stages.values())),
             *((f"stage: {name}", seconds) for name, seconds in dearest(stages, 6)),
             *((f"test: `{name}`: {proofs.get(name, '')}", seconds) for name, seconds in dearest(tests, 10)),
             *((f"object: {name} (wall clock)", seconds) for name, seconds in dearest(objects, 5))]
    lines += [f"| {name} | {seconds / unit_s:.0f} | {seconds:.0f} |" for name, seconds in named]
    return "\n".join(lines) + "\n"


def judged(budget: dict, stages: dict, tests: dict, unit_s: float, unknown: float) -> list[str]:
    """What is above its budget, and what grew."""
    problems = []
    print(f"cost: a unit is {unit_s:.2f} processor seconds, to {100.0 * unknown:.0f} %")
    for name, seconds in (("first_sight", stages.get("first sight", 0.0)), ("test", sum(stages.values()))):
        units, most = seconds / unit_s, budget["budget_units"][name]
        print(f"cost: {name} {units:.0f} units ({seconds:.0f} s); the budget is {most}")
        if units > (1.1 + unknown) * most:
            problems.append(f"cost: {name} took {units:.0f} units, a tenth above its budget of {most}")
    before = budget.get("tests", {}) | {f"stage {name}": units for name, units in budget.get("stages", {}).items()}
    now = tests | {f"stage {name}": seconds for name, seconds in stages.items()}
    grown = sorted(((seconds / unit_s - before.get(name, 0.0), name) for name, seconds in now.items()
                    if seconds / unit_s > max(KEPT, GREW * before.get(name, 0.0))), reverse=True)
    proofs = tomllib.loads((HERE / "proofs.toml").read_text(encoding="utf-8"))
    unproven = [f"cost: {name} costs {seconds / unit_s:.1f} units, and tests/cost/proofs.toml does not say what only it proves"
                for name, seconds in tests.items() if seconds / unit_s > 2.0 * KEPT and name not in proofs]
    if problems:
        problems += [f"cost: {name} grew by {more:.0f} units, from {before.get(name, 0.0):.0f}" for more, name in grown[:20]]
    return problems + unproven


def write(budget: dict, stages: dict, tests: dict, objects: dict, unit_s: float) -> None:
    text = "# Units that ./test may cost, and what it cost when they were last written (budget.py --write).\n"
    text += "# A higher budget is a commit of its own, with its reason.\n\n[budget_units]\n"
    text += "".join(f"{name} = {most}\n" for name, most in budget["budget_units"].items())
    for name, rows in (("stages", stages), ("tests", tests)):
        text += f"\n[{name}]\n" + "".join(
            f'"{row}" = {seconds / unit_s:.1f}\n' for row, seconds in dearest(rows, len(rows)) if seconds / unit_s >= KEPT)
    (HERE / "budget.toml").write_text(text, encoding="utf-8")
    readme = HERE.parent / "README.md"
    old = readme.read_text(encoding="utf-8")
    new, count = TABLE.subn(lambda match: match[1] + "\n" + table(stages, tests, objects, unit_s) + "\n" + match[2], old)
    if count != 1:
        sys.exit("budget: tests/README.md has no place for the table")
    readme.write_text(new, encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("records", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--budget", type=pathlib.Path, default=HERE / "budget.toml")
    parser.add_argument("--whole", help="why more was run than on each day: the cost is said and not judged")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    budget = tomllib.loads(options.budget.read_text(encoding="utf-8"))
    unit_s, unknown = unit_of(options.records / "reference.txt")
    stages, tests = rows_of(options.records / "stages.txt"), rows_of(options.build / "costs.txt")
    objects = units_of_build(options.build / ".ninja_log")
    if not stages or not tests:
        sys.exit("budget: no stages or no tests were counted: the gate is dead")
    problems = judged(budget, stages, tests, unit_s, unknown)
    print("dearest tests: " + ", ".join(f"{name} {seconds:.0f} s" for name, seconds in dearest(tests, 10)))
    if options.write:
        write(budget, stages, tests, objects, unit_s)
    if options.whole and problems:
        print(f"cost: NOT judged: {options.whole}")
        return 0
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
