# SPDX-License-Identifier: Apache-2.0
"""Canary of compare_laws.py: check_compare_laws.py GRABEN.

The table has figures of all three laws and equal loop times. Then figures and ends in the campaigns' files are
changed, which the next table must have in that law's row and nowhere else. What can't be run ends with status 2."""

import csv
import pathlib
import subprocess
import sys
import tempfile

graben = sys.argv[1]
compare = pathlib.Path(__file__).with_name("compare_laws.py")
LAWS = ("servo", "oil", "kim")
TIP, RINGING, LOOP, ENERGY, DRAWS = 5, 6, 7, 8, -1


def run(*arguments, status=0):
    done = subprocess.run([sys.executable, "-B", compare, *arguments], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    assert done.returncode == status, f"{arguments}: status {done.returncode}, not {status}:\n{done.stdout}"
    assert "Traceback" not in done.stdout, done.stdout
    return done.stdout


def table(folder):
    """Columns of each row, by law and 'own' or 'equal'; and the rows of swash."""
    out = run(graben, "--draws", "2", "--jobs", "2", "--cases", "dry", "--errors", "kim", "--markdown", "--out",
              folder)
    rows = [[column.strip() for column in line.strip("|").split("|")]
            for line in out.splitlines() if line.startswith("| no soil")]
    laws = {(row[2], row[3]): row for row in rows if row[2] in LAWS}
    assert len(laws) == 2 * len(LAWS) and len(rows) == len(laws) + 4, out
    return laws, rows[len(laws):]


def change(folder, law, **figures):
    """In the first draw of a law's own campaign; rows that did not end have no figures."""
    file, = folder.glob(f"*_law_{law}_speed_1.csv")
    trial, *lines = file.read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(lines))
    rows[0].update(figures)
    if rows[0]["end"] != "done":
        rows[0] = {key: rows[0][key] if key in ("seed", "end") else "" for key in rows[0]}
    file.write_text("\n".join([trial, lines[0], *(",".join(row.values()) for row in rows)]) + "\n", encoding="utf-8")


with tempfile.TemporaryDirectory() as temporary:
    files = pathlib.Path(temporary)
    before, swash = table(files)
    for (law, at), row in before.items():
        assert len([float(number) for number in row[TIP].split("/")]) == 3, row
        assert float(row[TIP].split("/")[2]) > 5.0 and float(row[RINGING]) < 5.0 and row[DRAWS] == "2 done", row
        assert 10.0 < float(row[LOOP]) < 40.0 and 0.1 < float(row[ENERGY]) < 1.0, row
    slowest = max(float(before[law, "own"][LOOP]) for law in LAWS)
    assert all(abs(float(before[law, "equal"][LOOP]) / slowest - 1.0) < 0.021 for law in LAWS), before
    assert abs(float(swash[2][6]) / float(swash[3][6]) - 1.0) < 0.021 and float(swash[2][4]) < 1.0, swash

    change(files, "kim", max_error_true_m="0.123456", ringing_rms_m="0.0111")
    after, _ = table(files)
    assert after["kim", "own"][TIP].endswith("/ 123.5") and after["kim", "own"][RINGING] == "11.1", after
    assert all(after[key] == before[key] for key in before if key[0] != "kim"), after

    change(files, "servo", loop_s="40", energy_per_loop_j="360000")
    change(files, "kim", end="fault")
    after, _ = table(files)
    assert after["kim", "own"][DRAWS] == "1 done, 1 fault" and after["servo", "own"][ENERGY] == "0.100", after
    assert "123.5" not in after["kim", "own"][TIP], after

    run(graben, "--draws", "2", "--cases", "dry", "--profile", "no_such_machine", status=2)

for wrong in (("--draws", "0"), ("--draws", "few"), ("--jobs", "0"), ("--seed", "-1"), ("--cases", "dry,sea"),
              ("--errors", "none"), ("--law", "oil")):
    assert wrong[0] in (said := run(graben, *wrong, status=2)) and "error: " in said, said
assert "no such program" in run("no_such_graben", status=2)
run(status=2)
print("figures of three laws; changed figures and ends are found in their row")
