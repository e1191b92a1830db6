#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""That budget.py is red where it has to be: a tenth above the budget with the names of what grew, too few
reference compiles, nothing counted, a dear test without its proof; and green on a machine that is ten times
slower in all, or in one stage, or so unsteady that a tenth says nothing."""

import pathlib
import subprocess
import sys
import tempfile

BUDGET = pathlib.Path(__file__).resolve().parent / "budget.py"
LOG = "# ninja log v5\n0\t4000\t0\tapp/CMakeFiles/a.dir/a.cpp.o\tx\n"
ROWS = '[budget_units]\nfirst_sight = 20\ntest = 100\n\n[stages]\n"release tests" = 30.0\n\n[tests]\nclosed_loop_dig = 5.0\n'


def judged(folder: pathlib.Path, *options: str, slower: float = 1.0, release_s: float = 180.0, dig_s: float = 10.0,
           references: int = 10, unsteady: float = 0.0, more: str = "", tests: bool = True, first: float = 1.0,
           own: int = 10) -> tuple[int, str]:
    (folder / "budget.toml").write_text(ROWS)
    (folder / "reference.txt").write_text("".join(
        f"{stage} {(1.8 + (unsteady if k % 2 else -unsteady)) * slower * of_stage / 6.0} {0.2 * slower * of_stage / 6.0}\n"
        for stage, count, of_stage in (("first sight", own if first != 1.0 else 0, first), ("release tests", references, 1.0))
        for k in range(count)))
    (folder / "stages.txt").write_text(f"first sight {40 * slower * first}\nrelease tests {(release_s - 40) * slower}\n")
    (folder / "costs.txt").write_text(f"closed_loop_dig {dig_s * slower} 0.0 9\n{more}" if tests else "")
    (folder / ".ninja_log").write_text(LOG)
    done = subprocess.run([sys.executable, "-B", str(BUDGET), str(folder), str(folder), "--budget",
                           str(folder / "budget.toml"), *options], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


with tempfile.TemporaryDirectory() as name:
    here = pathlib.Path(name)
    for what, status, needle, call in (
            ("within", 0, "cost: test 90 units", {}),
            ("slower in all", 0, "cost: test 90 units (1800 s, 20.00 each, to 0 %)", {"slower": 10.0}),
            ("less than a tenth above", 0, "", {"release_s": 218.0}),
            ("a tenth above", 1, "cost: test took 111 units, a tenth above its budget of 100", {"release_s": 222.0}),
            ("what grew", 1, "cost: closed_loop_dig grew by 35 units, from 5", {"release_s": 300.0, "dig_s": 80.0}),
            ("nine references", 1, "9 reference compiles; 10 are wanted", {"references": 9}),
            ("slower in its first stage", 0, "cost: first_sight 20 units (80 s, 4.00 each", {"first": 2.0}),
            ("a short stage", 1, "cost: first_sight took 30 units", {"first": 2.0, "own": 5}),
            ("unsteady", 0, "cost: test 111 units (222 s, 2.00 each, to 28 %)", {"release_s": 222.0, "unsteady": 1.0}),
            ("far above though unsteady", 1, "cost: test took 150 units", {"release_s": 300.0, "unsteady": 1.0}),
            ("nothing counted", 1, "no stages or no tests were counted: the gate is dead", {"tests": False}),
            ("no proof", 1, "unit_new costs 5.0 units, and tests/cost/proofs.toml does not say", {"more": "unit_new 9 1 9\n"})):
        code, said = judged(here, **call)
        assert code == status and needle in said, f"{what}: {code}\n{said}"
    code, said = judged(here, "--whole", "no whole run is known", release_s=300.0)
    assert code == 0 and "NOT judged: no whole run is known" in said, said
print("budget.py: 13 cases as wanted")
