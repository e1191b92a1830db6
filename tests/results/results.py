#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tables of results in tests/README.md: rows.toml says how each figure is made, results.json has the
figures, a table stands between its markers.

  results.py --check             the tables are what the data say; every row has a figure
  results.py --write             writes the tables
  results.py --make              makes every figure anew, writes data and tables (hours); begun again it
                                 goes on with what is not in build/thorough yet
  results.py --make --only NAME  only the runs of rows.toml whose names match the expression
  results.py --quick             makes the figures that take seconds, and fails if one is another
"""

import argparse
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib

import measured

HERE = pathlib.Path(__file__).resolve().parent
PLACE = re.compile(r"\{([^{}|]+)\|([^{}|]*)\|([^{}|]+)\}")
# Figures are in SI units; what a table shows them in.
UNITS = {"": 1.0, "mm": 1e3, "%": 100.0, "MPa": 1e-6, "deg": 57.29577951308232, "s": 1.0, "us": 1e-3,
         "ms": 1e-6}


def filled(cell: str, figures: dict[str, float]) -> str:
    def shown(match: re.Match) -> str:
        name, unit, form = match.groups()
        if name not in figures:
            raise measured.Failure(f"no figure {name!r}; there are {', '.join(sorted(figures))}")
        value = figures[name] * UNITS[unit]
        return format(round(value) if form.endswith("d") else value, form).replace(",", " ")
    return PLACE.sub(shown, cell)


def shown_command(run: dict) -> str:
    words = run.get("show") or re.sub(r" --(?:out|summary|json) \{folder\}\S*", "", run["command"])
    # In a table a | ends the cell, also within code.
    return (f"`{words}`" if "`" not in words else words).replace("|", "\\|")


class Book:
    def __init__(self, rows: pathlib.Path, results: pathlib.Path, readme: pathlib.Path):
        definition = tomllib.loads(rows.read_text(encoding="utf-8"))
        self.tables, self.runs, self.rows = (definition[key] for key in ("table", "run", "row"))
        self.results_path, self.readme = results, readme
        self.results = json.loads(results.read_text(encoding="utf-8"))

    def problems_of_data(self) -> list[str]:
        names = [row["name"] for row in self.rows]
        problems = [f"{name}: twice in rows.toml" for name in sorted({n for n in names if names.count(n) > 1})]
        problems += [f"{row['name']}: there is no table {row['table']} or no run {row['run']}"
                     for row in self.rows if row["table"] not in self.tables or row["run"] not in self.runs]
        problems += [f"{name}: no figure in results.json" for name in names if name not in self.results]
        problems += [f"{name}: in results.json and not in rows.toml" for name in self.results
                     if name not in names]
        problems += [f"{row['name']}: other cells in results.json" for row in self.rows
                     if len(self.results.get(row["name"], row)["cells"]) != len(row["cells"])]
        used = {row["run"] for row in self.rows}
        return problems + [f"run {name}: no row needs it" for name in self.runs if name not in used]

    def lines_of(self, name: str) -> list[str]:
        table = self.tables[name]
        if "lines" in table:
            done = subprocess.run(shlex.split(table["lines"]), cwd=measured.ROOT, check=True,
                                  stdout=subprocess.PIPE, text=True)
            return done.stdout.splitlines()
        rows = [[*table["columns"], "command", "measured"]]
        rows.append(["---"] * len(rows[0]))
        for row in self.rows:
            if row["table"] == name:
                result = self.results[row["name"]]
                rows.append([*self.cells_of(row), shown_command(self.runs[row["run"]]), result["date"]])
        return ["| " + " | ".join(row) + " |" for row in rows]

    def cells_of(self, row: dict) -> list[str]:
        """Words are those of rows.toml, figures those of results.json."""
        kept = self.results[row["name"]]["cells"]
        return [old if PLACE.search(cell) else cell for cell, old in zip(row["cells"], kept)]

    def parts(self):
        """(name, begin, end) of the lines between each pair of markers."""
        lines = self.readme.read_text(encoding="utf-8").splitlines()
        begin = None
        for number, line in enumerate(lines):
            if match := re.fullmatch(r"<!-- table (\w+)(?: .*)?-->", line):
                name, begin = match[1], number + 1
            elif line == "<!-- end of table -->" and begin is not None:
                yield name, begin, number
                begin = None

    def check(self) -> list[str]:
        if problems := self.problems_of_data():
            return problems
        lines = self.readme.read_text(encoding="utf-8").splitlines()
        there = {name: [line for line in lines[begin:end] if line] for name, begin, end in self.parts()}
        problems = [f"{self.readme.name}: no markers of table {name}" for name in self.tables if name not in there]
        problems += [f"{self.readme.name}: there is no table {name}" for name in there if name not in self.tables]
        return problems + [f"{self.readme.name}: table {name} is not what the data say (--write)"
                           for name in there if name in self.tables and there[name] != self.lines_of(name)]

    def write(self):
        lines = self.readme.read_text(encoding="utf-8").splitlines()
        for name, begin, end in reversed(list(self.parts())):
            lines[begin:end] = ["", *self.lines_of(name), ""]
        self.readme.write_text("\n".join(lines) + "\n", encoding="utf-8")
        ordered = {row["name"]: self.results[row["name"]] for row in self.rows if row["name"] in self.results}
        self.results_path.write_text(json.dumps(ordered, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")

    def wanted(self, only: str, quick: bool = False) -> list[str]:
        """Those that take least come first."""
        names = [name for name, run in self.runs.items()
                 if re.fullmatch(only, name) and (run.get("quick") or not quick)]
        return sorted(names, key=lambda name: self.runs[name].get("minutes", 0.0))

    def cells(self, run: str, figures: dict[str, float]):
        for row in self.rows:
            if row["run"] == run:
                yield row, [filled(cell, figures) for cell in row["cells"]]

    def make(self, options) -> list[str]:
        options.state.mkdir(parents=True, exist_ok=True)
        problems = []
        for name in self.wanted(options.only):
            try:
                state = measured.make(name, self.runs[name], options.state, options.build, options.again)
                for row, cells in self.cells(name, state["figures"]):
                    self.results[row["name"]] = {"cells": cells, "date": state["date"]}
            except measured.Failure as failure:
                problems.append(f"{name}: {failure}")
                print(problems[-1], flush=True)
        self.write()
        return problems

    def quick(self, options) -> list[str]:
        problems = []
        for name in self.wanted(options.only, quick=True):
            with tempfile.TemporaryDirectory() as folder:
                figures = measured.measure(self.runs[name], pathlib.Path(folder), options.build)
            for row, cells in self.cells(name, figures):
                if cells != (said := self.cells_of(row)) and not row.get("volatile"):
                    problems.append(f"{row['name']}: {cells} now, {said} in results.json"
                                    f" (results.py --make --only {name})")
        if not self.wanted(options.only, quick=True):
            problems.append("no run is quick: nothing was compared")
        return problems


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    for action in ("check", "write", "make", "quick"):
        parser.add_argument(f"--{action}", dest="action", action="store_const", const=action, required=False)
    parser.add_argument("--only", default=".*", metavar="NAME")
    parser.add_argument("--again", action="store_true", help="also what is in the state folder already")
    parser.add_argument("--build", type=pathlib.Path, default=measured.ROOT / "build/release")
    parser.add_argument("--state", type=pathlib.Path, default=measured.ROOT / "build/thorough")
    parser.add_argument("--rows", type=pathlib.Path, default=HERE / "rows.toml")
    parser.add_argument("--results", type=pathlib.Path, default=HERE / "results.json")
    parser.add_argument("--readme", type=pathlib.Path, default=HERE.parent / "README.md")
    options = parser.parse_args()
    if not options.action:
        parser.error("one of --check, --write, --make, --quick")
    return options


def main() -> int:
    options = arguments()
    book = Book(options.rows, options.results, options.readme)
    try:
        if options.action == "write":
            book.write()
        problems = {"check": book.check, "write": book.check, "make": lambda: book.make(options),
                    "quick": lambda: book.quick(options)}[options.action]()
    except measured.Failure as failure:
        problems = [str(failure)]
    print("\n".join([*problems, f"results: {len(book.rows)} rows, {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
