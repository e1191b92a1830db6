# SPDX-License-Identifier: Apache-2.0
"""What a machine can do without: the figures of tests/README.md in the table of `graben check` and in the one of
app/machines/README.md.

  check_capabilities.py --check   both are what that has
  check_capabilities.py --write   writes both
"""

import pathlib
import re
import sys

import results as tables

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SOURCE = ROOT / "app/reports/check/capability_table.cpp"
README = ROOT / "app/machines/README.md"
BEGIN, END = "<!-- capabilities (tests/results/check_capabilities.py) -->", "<!-- end of capabilities -->"
# In the order of the source's rows.
KEYS = ("none", "imu", "slopes", "spool", "swash", "pressure", "zx200", "ls", "nfc")
PLACES = (("22t", "dry"), ("22t", "soil"), ("12t", "dry"), ("12t", "soil"))
# Runs that other tables have.
ELSEWHERE = {"without_none_22t_dry": "draws_found", "without_none_22t_soil": "draws_soil_found",
             "without_slopes_12t_dry": "parts_slopes_12t"}
COLUMNS = ("without", "stands in", "not seen any more", "22 t, dry", "22 t, soil", "12 t, dry", "12 t, soil")
ROW = re.compile(r'^    \{((?:\s*"[^"]*",?)+)\s*\[\]', re.MULTILINE)
FIGURES = re.compile(r'"[^"]*; [^"]*; [^"]*; [^"]*"(?=,\s*\[\])|"@\w+@"(?=,\s*\[\])')


def figure(results, key, place):
    """Median / 95th percentile, mm."""
    name = f"without_{key}_{place[0]}_{place[1]}"
    cells = results.get(ELSEWHERE.get(name, name))
    return " / ".join(cells[1].split(" / ")[:2]) if cells else "-"


def texts_of(row):
    """Lost, stand-in, unseen, costs: C++ joins words that follow each other without a comma."""
    return [re.sub(r'"\s*"', "", part).strip().strip('"')
            for part in re.split(r'(?<="),', re.sub(r'"\s+"', "", row).strip().rstrip(","))]


def wanted(results, source):
    """The source with the figures, and the lines of the README's table."""
    costs = ["; ".join(figure(results, key, place) for place in PLACES) for key in KEYS]
    found = iter(costs)
    source = FIGURES.sub(lambda _: f'"{next(found)}"', source)
    rows = [texts_of(match[1]) for match in ROW.finditer(source)]
    assert len(rows) == len(KEYS) and not list(found), f"{SOURCE.name}: {len(rows)} rows, not {len(KEYS)}"
    lines = [COLUMNS, ["---"] * len(COLUMNS), *([*row[:3], *row[3].split("; ")] for row in rows)]
    return source, ["| " + " | ".join(line) + " |" for line in lines]


def main():
    book = tables.Book(HERE / "rows.toml", ROOT / "tests/README.md")
    results = {row.name: book.cells_of(row) for row in book.results}
    source, readme = SOURCE.read_text(encoding="utf-8"), README.read_text(encoding="utf-8")
    new_source, table = wanted(results, source)
    before, rest = readme.split(BEGIN)
    new_readme = before + BEGIN + "\n\n" + "\n".join(table) + "\n\n" + END + rest.split(END)[1]
    if sys.argv[1:] == ["--write"]:
        SOURCE.write_text(new_source, encoding="utf-8")
        README.write_text(new_readme, encoding="utf-8")
        return 0
    if sys.argv[1:] != ["--check"]:
        print(__doc__, file=sys.stderr)
        return 2
    stale = [path.name for path, old, new in ((SOURCE, source, new_source), (README, readme, new_readme)) if old != new]
    for name in stale:
        print(f"{name}: not what the tables have (check_capabilities.py --write)")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
