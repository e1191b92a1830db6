#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What ./test cost, judged by its budget: budget.py RECORDS BUILD [--whole REASON] [--write].

Costs are counted in units: processor seconds over those of six reference compiles (reference.cpp), so that a
busy or slow machine turns nothing red. They are made while a stage runs, beside its own work, since a compile
beside another is dearer and a shared machine changes within minutes; each stage is counted by the mean of its
own, a short one by the mean of all. RECORDS has stages.txt and reference.txt, lines of a stage and seconds;
BUILD, the release, has costs.txt (cost.cmake) and Ninja's log. Red a tenth above the budget (budget.toml) and above what the scatter of the
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
TESTS_STAGE = "release tests"  # Whose tests are counted one by one.
KEPT = 1.0  # Units: a test below that is not written down.
GREW = 1.2  # Of what it was.
# Compiles of reference.cpp. Tried: with six the first sight of the commit that wrote the budget down (2ef3bcf4)
# costs the 26 units that it cost there, built anew on another machine: 331 s, a compile beside another 2.1 s.
COMPILES_OF_UNIT = 6
# Compiles without which nothing is judged. One in three was 1.3 times as dear as the others (tried: 9 in a row).
LEAST_COMPILES = 10
LEAST_OF_STAGE = 6  # Of a stage that is counted by its own: two minutes of it. Judged: with fewer the dear ones of three decide.


def rows_of(file: pathlib.Path) -> dict[str, float]:
    """Lines of a name and one or two numbers of seconds, user and system; what is there twice adds up."""
    found: dict[str, float] = {}
    for line in file.read_text(encoding="utf-8").splitlines() if file.exists() else ():
        if match := re.match(r"(.+?) ([\d.]+)(?: ([\d.]+))?(?: [\d.]+)?$", line):
            found[match[1]] = found.get(match[1], 0.0) + float(match[2]) + float(match[3] or 0)
    return found


class Units:
    """Seconds of a unit, by stage, and what part of a cost the scatter of the references leaves unknown: two
    standard errors of the mean."""

    def __init__(self, file: pathlib.Path):
        self.of_stage: dict[str, list[float]] = {}
        for line in file.read_text(encoding="utf-8").splitlines() if file.exists() else ():
            name, user, system = line.rsplit(" ", 2)
            self.of_stage.setdefault(name, []).append(float(user) + float(system))
        self.all = [seconds for row in self.of_stage.values() for seconds in row]
        if len(self.all) < LEAST_COMPILES:
            sys.exit(f"budget: {len(self.all)} reference compiles; {LEAST_COMPILES} are wanted: the gate is dead")

    def row(self, stage: str) -> list[float]:
        own = self.of_stage.get(stage, [])
        return own if len(own) >= LEAST_OF_STAGE else self.all

    def seconds(self, stage: str) -> float:
        return COMPILES_OF_UNIT * statistics.mean(self.row(stage))

    def unknown(self, stage: str) -> float:
        row = self.row(stage)
        return 2.0 * statistics.stdev(row) / math.sqrt(len(row)) / statistics.mean(row)

    def sum(self, stages: dict[str, float]) -> tuple[float, float]:
        """Units of several stages, and what part of it is unknown."""
        units = {name: seconds / self.seconds(name) for name, seconds in stages.items()}
        total = sum(units.values())
        return total, math.hypot(*(units[name] * self.unknown(name) for name in units)) / total if total > 0.0 else 0.0


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


def table(stages: dict, tests: dict, objects: dict, unit: Units) -> str:
    proofs = tomllib.loads((HERE / "proofs.toml").read_text(encoding="utf-8"))
    units, _ = unit.sum(stages)
    lines = [f"One unit is six compiles of `tests/cost/reference.cpp`, {sum(stages.values()) / units:.2f} processor seconds when "
             "this was made.", "", "| | units | seconds |", "|---|---|---|"]

    def row(name: str, seconds: float, stage: str) -> tuple[str, float, float]:
        return name, seconds / unit.seconds(stage), seconds

    named = [row("`./run`, fresh: build and one dig", stages.get("first sight", 0.0), "first sight"),
             ("`./test`, fresh", units, sum(stages.values())),
             *(row(f"stage: {name}", seconds, name) for name, seconds in dearest(stages, 6)),
             *(row(f"test: `{name}`: {proofs.get(name, '')}", seconds, TESTS_STAGE) for name, seconds in dearest(tests, 10)),
             *(row(f"object: {name} (wall clock)", seconds, "release build") for name, seconds in dearest(objects, 5))]
    lines += [f"| {name} | {count:.0f} | {seconds:.0f} |" for name, count, seconds in named]
    return "\n".join(lines) + "\n"


def judged(budget: dict, stages: dict, tests: dict, unit: Units) -> list[str]:
    """What is above its budget, and what grew."""
    problems = []
    first = {name: seconds for name, seconds in stages.items() if name == "first sight"}
    for name, rows in (("first_sight", first), ("test", stages)):
        (units, unknown), most = unit.sum(rows), budget["budget_units"][name]
        mean_s = sum(rows.values()) / units if units > 0.0 else 0.0
        print(f"cost: {name} {units:.0f} units ({sum(rows.values()):.0f} s, {mean_s:.2f} each, to {100.0 * unknown:.0f} %); "
              f"the budget is {most}")
        if units > (1.1 + unknown) * most:
            problems.append(f"cost: {name} took {units:.0f} units, a tenth above its budget of {most}")
    before = budget.get("tests", {}) | {f"stage {name}": units for name, units in budget.get("stages", {}).items()}
    in_tests = {name: seconds / unit.seconds(TESTS_STAGE) for name, seconds in tests.items()}
    now = in_tests | {f"stage {name}": seconds / unit.seconds(name) for name, seconds in stages.items()}
    grown = sorted(((units - before.get(name, 0.0), name) for name, units in now.items()
                    if units > max(KEPT, GREW * before.get(name, 0.0))), reverse=True)
    proofs = tomllib.loads((HERE / "proofs.toml").read_text(encoding="utf-8"))
    unproven = [f"cost: {name} costs {units:.1f} units, and tests/cost/proofs.toml does not say what only it proves"
                for name, units in in_tests.items() if units > 2.0 * KEPT and name not in proofs]
    if problems:
        problems += [f"cost: {name} grew by {more:.0f} units, from {before.get(name, 0.0):.0f}" for more, name in grown[:20]]
    return problems + unproven


def write(budget: dict, stages: dict, tests: dict, objects: dict, unit: Units) -> None:
    text = "# Units that ./test may cost, and what it cost when they were last written (budget.py --write).\n"
    text += "# A higher budget is a commit of its own, with its reason.\n\n[budget_units]\n"
    text += "".join(f"{name} = {most}\n" for name, most in budget["budget_units"].items())
    for name, rows in (("stages", {row: seconds / unit.seconds(row) for row, seconds in stages.items()}),
                       ("tests", {row: seconds / unit.seconds(TESTS_STAGE) for row, seconds in tests.items()})):
        text += f"\n[{name}]\n" + "".join(f'"{row}" = {units:.1f}\n' for row, units in dearest(rows, len(rows)) if units >= KEPT)
    (HERE / "budget.toml").write_text(text, encoding="utf-8")
    readme = HERE.parent / "README.md"
    old = readme.read_text(encoding="utf-8")
    new, count = TABLE.subn(lambda match: match[1] + "\n" + table(stages, tests, objects, unit) + "\n" + match[2], old)
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
    unit = Units(options.records / "reference.txt")
    stages, tests = rows_of(options.records / "stages.txt"), rows_of(options.build / "costs.txt")
    objects = units_of_build(options.build / ".ninja_log")
    if not stages or not tests:
        sys.exit("budget: no stages or no tests were counted: the gate is dead")
    problems = judged(budget, stages, tests, unit)
    print("dearest tests: " + ", ".join(f"{name} {seconds:.0f} s" for name, seconds in dearest(tests, 10)))
    if options.write:
        write(budget, stages, tests, objects, unit)
    if options.whole and problems:
        print(f"cost: NOT judged: {options.whole}")
        return 0
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
