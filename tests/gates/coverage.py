#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: the tests go through every line and every branch of the safety code.

Runs COMMAND, which is to run the tests, on counters set to zero. No branch is excused: the code is
compiled without exceptions, so the compiler makes none of its own."""

import argparse
import json
import pathlib
import re
import subprocess
import sys

SOURCES = ("firmware/safety/*.cpp", "firmware/*/safety/*.cpp", "firmware/drives/*.cpp", "hal/link/e2e*.cpp")
# What only controls; its tests are of another kind.
CONTROL = {f"firmware/drives/{name}.cpp" for name in ("blocked", "drive_servo", "spool_parking", "velocity_cap")}

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", required=True, type=pathlib.Path)
parser.add_argument("--objects", required=True, type=pathlib.Path, help="where the counters are")
parser.add_argument("command", nargs=argparse.REMAINDER, help="after --")
arguments = parser.parse_args()
command = arguments.command[1:] if arguments.command[:1] == ["--"] else arguments.command
root = arguments.root.resolve()

for counters in arguments.objects.rglob("*.gcda"):
    counters.unlink()
tests = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
if tests.returncode != 0:
    print(tests.stdout, end="")
    sys.exit("coverage: the tests themselves fail")

judged = sorted(path.relative_to(root).as_posix() for glob in SOURCES for path in root.glob(glob))
judged = [name for name in judged if name not in CONTROL]
filters = [f"--filter={re.escape((root / name).as_posix().rsplit('.', 1)[0])}[.][ch]pp$"
           for name in judged]
report = subprocess.run(
    ["gcovr", "--root", root, *filters, "--json", "-", arguments.objects],
    stdout=subprocess.PIPE, check=True)
counted = {file["file"]: file["lines"] for file in json.loads(report.stdout)["files"]}

problems = [f"{name}: was not counted: the gate is dead" for name in judged if name not in counted]
print(f"{'':40} {'lines':>12} {'branches':>12}")
for name, lines in sorted(counted.items()):
    lines = [line for line in lines if not line["gcovr/noncode"]]
    branches = [(line["line_number"], branch) for line in lines for branch in line["branches"]]
    run = sum(line["count"] > 0 for line in lines)
    taken = sum(branch["count"] > 0 for _, branch in branches)
    print(f"{name:40} {f'{run}/{len(lines)}':>12} {f'{taken}/{len(branches)}':>12}")
    for line in lines:
        not_taken = sum(branch["count"] == 0 for branch in line["branches"])
        if line["count"] == 0:
            problems.append(f"{name}:{line['line_number']}: never executed")
        elif not_taken:
            problems.append(f"{name}:{line['line_number']}: {not_taken} of "
                            f"{len(line['branches'])} branches never taken")
if not judged:
    problems.append("no files to look at: the gate is dead")
for problem in problems:
    print(problem)
print(f"coverage: {len(judged)} files, {len(problems)} problems")
sys.exit(1 if problems else 0)
