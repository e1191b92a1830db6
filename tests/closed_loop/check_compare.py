# SPDX-License-Identifier: Apache-2.0
"""`graben compare`: figures of two logs are those of their runs, a run is like itself, and the page has
both.

check_compare.py GRABEN
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

from report_page import setup_of


def call(graben, folder, *arguments, status=0):
    done = subprocess.run([graben, *arguments], cwd=folder, capture_output=True, text=True, timeout=1800)
    assert done.returncode == status, f"{arguments}: {done.returncode}: {done.stderr}"
    return done.stderr if status else done.stdout


def rows_of(table):
    """Words -> first, second, difference."""
    found = {}
    for line in table.splitlines()[1:]:
        match = re.match(r"(.{34}) *(\S+) +(\S+) +(\S+)", line)
        if match:
            found[match[1].strip()] = [math.nan if cell == "-" else float(cell) for cell in match.groups()[1:]]
    return found


def near(found, wanted, within):
    assert abs(found - wanted) <= within, (found, wanted, within)


def figures_are_the_runs(rows, first, second):
    """The controller's own error is that of the measured tip, at 50 Hz instead of 100 Hz."""
    for column, summary in ((0, first), (1, second)):
        figures = json.loads(summary.read_text(encoding="utf-8"))
        near(rows["path error, largest"][column], 1e3 * figures["max_error_measured_m"], 1.5)
        near(rows["lambda, mean once on the path"][column], figures["lambda_mean"], 0.02)
        near(rows["lambda, least once on the path"][column], figures["lambda_min"], 0.05)
        for name, share in figures["limit_share"].items():
            near(rows["held by " + ("nothing" if name == "none" else name)][column], 100.0 * share, 0.051)
    for name, (a, b, difference) in rows.items():
        if not math.isnan(difference):
            near(difference, b - a, 0.11 if abs(a) > 1 else 0.002 if "lambda," in name else 0.11)


def page_has_both(page):
    setup = setup_of(page.read_bytes())
    lines = {(line["plot"], line["label"]): line["values"] for line in setup["run"]["truth"]["lines"]}
    times = setup["run"]["truth"]["time_s"]
    assert setup["run"]["log"] and len(times) > 800
    for plot, label in (("lambda", "lambda, second"), ("error", "Path error, second"), ("spools", "Arm, second"),
                        ("strokes", "Boom, first"), ("strokes", "Boom, second"), ("difference_strokes", "Boom")):
        assert len(lines[plot, label]) == len(times), (plot, label)
    both = zip(lines["strokes", "Boom, first"], lines["strokes", "Boom, second"], lines["difference_strokes", "Boom"])
    seen = [(a, b, off) for a, b, off in both if None not in (a, b, off)]
    assert len(seen) > 0.8 * len(times) and max(abs(off) for _, _, off in seen) > 1.0
    assert max(abs(b - a - off) for a, b, off in seen) < 0.11
    assert any("difference" in figure["note"] for figure in setup["run"]["summary"])


def is_no_log(graben, folder):
    assert "a: is a folder" in call(graben, folder, "compare", "a", "b/dig.log", status=1)
    assert "none.log: there is no such file" in call(graben, folder, "compare", "none.log", "b/dig.log", status=1)
    # One that was being written ends inside a line.
    text = (folder / "a/dig.log").read_text(encoding="ascii")
    (folder / "cut.log").write_text(text[:-8], encoding="ascii")
    said = call(graben, folder, "compare", "cut.log", "b/dig.log", "--out", ".")
    assert "path error" in said and "cut.log: its last line is cut, and left out" in said, said
    (folder / "cut.log").write_text(text[:40] + "\n" + text, encoding="ascii")
    said = call(graben, folder, "compare", "cut.log", "b/dig.log", "--out", ".")
    assert "path error" in said and "1 line is none of candump's, left out; the first is line 1" in said, said


def other_runs(graben, folder):
    """What is not of the same machine or task, or hardly a run, is said in the terminal and on the page."""
    same = call(graben, folder, "compare", "a/dig.log", "b/dig.log", "--out", ".")
    assert "note:" not in same, same
    call(graben, folder, "autodig", "--task", "flatten", "--out", "d")
    # Both are 'program' to the bus.
    call(graben, folder, "autodig", "--task", "slope", "--out", "e")
    lines = (folder / "a/dig.log").read_text(encoding="ascii").splitlines(keepends=True)
    assert "note:" not in call(graben, folder, "compare", "d/autodig.log", "d/autodig.log", "--out", ".")
    call(graben, folder, "dig", "--bus", "zx200", "--out", "f")
    (folder / "short.log").write_text("".join(lines[:400]), encoding="ascii")
    for files, wanted in ((("a/dig.log", "d/autodig.log"), ("two profiles: excavator_22t and excavator_12t",
                                                            "two tasks: dig and program")),
                          (("d/autodig.log", "e/autodig.log"), ("two tasks",)),
                          (("f/dig.log", "a/dig.log"), ("two profiles: excavator_22t on bus zx200 and excavator_22t",)),
                          (("a/dig.log", "short.log"), ("short.log: the controller was active for ",))):
        said = call(graben, folder, "compare", *files, "--out", ".")
        page = setup_of((folder / "compare.html").read_bytes())["run"]["subtitle"]
        for words in wanted:
            assert f"note: {words}" in said and words in page, (words, said, page)


def main():
    graben = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        call(graben, folder, "dig", "--out", "a", "--summary", "a.json")
        call(graben, folder, "dig", "--out", "b", "--soil", "--errors", "kim", "--seed", "3", "--summary", "b.json")
        table = call(graben, folder, "compare", "a/dig.log", "b/dig.log", "--out", ".")
        rows = rows_of(table)
        figures_are_the_runs(rows, folder / "a.json", folder / "b.json")
        assert rows["path error, largest"][1] > 2 * rows["path error, largest"][0], rows
        assert all(len(line) <= 80 for line in table.splitlines()), table
        held = [row for words, row in rows.items() if words.startswith("held by")]
        for column in (0, 1):
            near(sum(row[column] for row in held), 100.0, 0.5)
        page_has_both(folder / "compare.html")
        same = rows_of(call(graben, folder, "compare", "a/dig.log", "a/dig.log", "--out", "."))
        assert all(math.isnan(row[2]) or row[2] == 0.0 for row in same.values()), same

        call(graben, folder, "grade", "--out", "c")
        assert "nothing to compare" in call(graben, folder, "compare", "a/dig.log", "c/grade.log", status=1)
        assert "none.log" in call(graben, folder, "compare", "a/dig.log", "none.log", status=1)
        (folder / "other.log").write_text("(0000000000.100000) vcan0 123#00\n", encoding="ascii")
        assert "no word of a controller" in call(graben, folder, "compare", "other.log", "a/dig.log", status=1)
        subprocess.run(["gzip", "-k", "a/dig.log"], cwd=folder, check=True)
        assert rows_of(call(graben, folder, "compare", "a/dig.log.gz", "b/dig.log", "--out", ".")) == rows
        page_has_both(folder / "compare.html")
        is_no_log(graben, folder)
        other_runs(graben, folder)
        again = rows_of(call(graben, folder, "compare", "b/dig.log", "a/dig.log.gz", "--out", "."))
        assert again["path error, largest"][1] == rows["path error, largest"][0]
        print(f"two runs: {rows['path error, largest']} mm; a run is like itself")


if __name__ == "__main__":
    main()
