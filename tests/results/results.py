#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tables of results in tests/README.md, which are the only place of the figures: rows.toml says how each
is made. A sum at the end of a table tells that nobody wrote in it by hand.

  results.py --check             the tables are of the rows; every row has a figure
  results.py --write             writes order, printed tables and sums anew, by the figures that are there
  results.py --make              makes every figure anew and writes the tables (hours); begun again it goes on
                                 with what is not in build/thorough yet
  results.py --make --only NAME  only the runs of rows.toml whose names match the expression
  results.py --make --part P/N   of those, sorted by what they take, every Nth, beginning with the Pth
  results.py --quick             makes the figures that take seconds, and fails if one is another
"""

import argparse
import hashlib
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
SPREAD = re.compile(r"\{([^{}|]+)\.spread\|([^{}|]*)\|([^{}|]+)\}")
END = re.compile(r"<!-- end of table (\w+) -->")
# Figures are in SI units; what a table shows them in.
UNITS = {"": 1.0, "mm": 1e3, "%": 100.0, "MPa": 1e-6, "deg": 57.29577951308232, "s": 1.0, "us": 1e-3,
         "ms": 1e-6}


def written_out(cell: str) -> str:
    return SPREAD.sub(r"{\1.median|\2|\3} / {\1.p95|\2|\3} / {\1.max|\2|\3}", cell)


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


def line_of(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def sum_of(lines: list[str]) -> str:
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:8]


class Row:
    def __init__(self, name: str, run: dict, cells: list[str]):
        self.name, self.run, self.cells = name, run, [written_out(cell) for cell in cells]
        # With any figures and any date.
        words = ["[^|]+" if PLACE.search(cell) else re.escape(cell) for cell in self.cells]
        self.line = re.compile(re.escape("| ") + re.escape(" | ").join([*words, re.escape(shown_command(run)), "[^|]+"])
                               + re.escape(" |"))

    def made(self, figures: dict[str, float], date: str) -> str:
        return line_of([*(filled(cell, figures) for cell in self.cells), shown_command(self.run), date])


class Book:
    def __init__(self, rows: pathlib.Path, readme: pathlib.Path):
        definition = tomllib.loads(rows.read_text(encoding="utf-8"))
        self.tables, self.runs = definition["table"], definition["run"]
        self.rows = [Row(name, run, cells) for name, run in self.runs.items() for cells in run["rows"]]
        self.readme = readme
        self.there, self.sums = {}, {}
        lines = readme.read_text(encoding="utf-8").splitlines()
        for name, begin, end in self.parts():
            self.there[name] = [line for line in lines[begin:end] if line]
            self.sums[name] = END.fullmatch(lines[end])[1]
        # Rows that differ in their figures alone stand in their order.
        left = {name: list(lines) for name, lines in self.there.items()}
        self.results = {}
        for row in self.rows:
            lines = left.get(row.run["table"], [])
            if line := next(filter(row.line.fullmatch, lines), None):
                lines.remove(line)
                self.results[row] = line

    def problems_of_data(self) -> list[str]:
        problems = [f"{name}: there is no table {run['table']}" for name, run in self.runs.items()
                    if run["table"] not in self.tables]
        return problems + [f"{row.name}: no figure in {self.readme.name} for '{row.cells[0]}'"
                           for row in self.rows if row not in self.results]

    def lines_of(self, name: str) -> list[str]:
        table = self.tables[name]
        if "lines" in table:
            done = subprocess.run(shlex.split(table["lines"]), cwd=measured.ROOT, check=True,
                                  stdout=subprocess.PIPE, text=True)
            return done.stdout.splitlines()
        head = [*table["columns"], "command", "measured"]
        return [line_of(head), line_of(["---"] * len(head)),
                *(line for row, line in self.results.items() if row.run["table"] == name)]

    def cells_of(self, row: Row) -> list[str]:
        """As the table has them."""
        return self.results[row][2:].split(" | ")[:len(row.cells)]

    def parts(self):
        """(name, begin, end) of the lines between each pair of markers."""
        lines = self.readme.read_text(encoding="utf-8").splitlines()
        begin = None
        for number, line in enumerate(lines):
            if match := re.fullmatch(r"<!-- table (\w+)(?: .*)?-->", line):
                name, begin = match[1], number + 1
            elif END.fullmatch(line) and begin is not None:
                yield name, begin, number
                begin = None

    def check(self) -> list[str]:
        problems = [f"{self.readme.name}: no markers of table {name}" for name in self.tables if name not in self.there]
        problems += [f"{self.readme.name}: there is no table {name}" for name in self.there if name not in self.tables]
        problems += self.problems_of_data()
        return problems + [f"{self.readme.name}: table {name} is not what was made (--make, or --write if words alone changed)"
                           for name, lines in self.there.items() if name in self.tables
                           and (lines != self.lines_of(name) or self.sums[name] != sum_of(lines))]

    def write(self):
        lines = self.readme.read_text(encoding="utf-8").splitlines()
        for name, begin, end in reversed(list(self.parts())):
            made = self.lines_of(name)
            lines[begin:end + 1] = ["", *made, "", f"<!-- end of table {sum_of(made)} -->"]
            self.there[name], self.sums[name] = made, sum_of(made)
        self.readme.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def wanted(self, only: str, quick: bool = False) -> list[str]:
        """Those that take least come first."""
        names = [name for name, run in self.runs.items()
                 if re.fullmatch(only, name) and (run.get("quick") or not quick)]
        return sorted(names, key=lambda name: self.runs[name].get("minutes", 0.0))

    def make(self, options) -> list[str]:
        options.state.mkdir(parents=True, exist_ok=True)
        problems = []
        part, parts = map(int, options.part.split("/"))
        for name in self.wanted(options.only)[part - 1::parts]:
            try:
                state = measured.make(name, self.runs[name], options.state, options.build, options.again)
                self.results |= {row: row.made(state["figures"], state["date"]) for row in self.rows if row.name == name}
            except measured.Failure as failure:
                problems.append(f"{name}: {failure}")
                print(problems[-1], flush=True)
        # In the order of the rows.
        self.results = {row: self.results[row] for row in self.rows if row in self.results}
        self.write()
        return problems

    def quick(self, options) -> list[str]:
        problems = []
        for name in self.wanted(options.only, quick=True):
            with tempfile.TemporaryDirectory() as folder:
                figures = measured.measure(self.runs[name], pathlib.Path(folder), options.build)
            for row in self.rows:
                if row.name != name or row.run.get("volatile"):
                    continue
                cells, said = [filled(cell, figures) for cell in row.cells], self.cells_of(row)
                if cells != said:
                    problems.append(f"{name}: {cells} now, {said} in {self.readme.name}"
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
    parser.add_argument("--part", default="1/1", metavar="P/N")
    parser.add_argument("--again", action="store_true", help="also what is in the state folder already")
    parser.add_argument("--build", type=pathlib.Path, default=measured.ROOT / "build/release")
    parser.add_argument("--state", type=pathlib.Path, default=measured.ROOT / "build/thorough")
    parser.add_argument("--rows", type=pathlib.Path, default=HERE / "rows.toml")
    parser.add_argument("--readme", type=pathlib.Path, default=HERE.parent / "README.md")
    options = parser.parse_args()
    if not options.action:
        parser.error("one of --check, --write, --make, --quick")
    return options


def main() -> int:
    options = arguments()
    book = Book(options.rows, options.readme)
    try:
        # Never over a figure whose row has other words: that would lose it.
        if options.action == "write" and not book.problems_of_data():
            book.write()
        problems = {"check": book.check, "write": book.check, "make": lambda: book.make(options),
                    "quick": lambda: book.quick(options)}[options.action]()
    except measured.Failure as failure:
        problems = [str(failure)]
    print("\n".join([*problems, f"results: {len(book.rows)} rows, {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
