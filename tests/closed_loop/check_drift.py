# SPDX-License-Identifier: Apache-2.0
"""`graben drift`: a leakage that grows becomes a work order with its day, five days without change none, and what is no
trend is refused. check_drift.py GRABEN"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

from drift_campaign import BEGIN_S, DAY_S, dated

DAYS = 5


def call(graben, *arguments):
    return subprocess.run([graben, "drift", *map(str, arguments)], capture_output=True, text=True, check=False)


def drive(graben, folder, name, day, found="", profile="excavator_22t"):
    """A short commissioning of the arm."""
    log = folder / f"{name}{day}.log"
    subprocess.run([graben, "commission", "--profile", profile, "--hidden", "3", "--seed", str(100 + day), "--only", "arm",
                    "--no-bursts", "--no-touch", "arm-extended,arm-retracted", *(["--found", found] if found else []),
                    "--log", log], check=True, stdout=subprocess.DEVNULL)
    return log


def main(graben):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        undated = drive(graben, folder, "undated", 0)
        healthy = [drive(graben, folder, "healthy", day) for day in range(DAYS)]
        leaking = [drive(graben, folder, "leaking", day, f"piston_leak={1 + 3 * day}") for day in range(1, DAYS)]
        for day, log in [*enumerate(healthy), *enumerate(leaking, 1)]:
            dated(log, BEGIN_S + day * DAY_S)
        summary = folder / "drift.json"
        done = call(graben, *healthy, "--profile", "excavator_22t", "--summary", summary)
        assert done.returncode == 0 and re.search(r"no work order: none of [1-9]\d* figures has changed", done.stdout), done.stdout + done.stderr
        said = json.loads(summary.read_text())
        assert said["work_orders"] == [] and len(said["logs"]) == DAYS, said
        # In any order. The boom stands under its load while the arm is driven.
        done = call(graben, *reversed(leaking), healthy[0], "--profile", "excavator_22t", "--summary", summary)
        said = json.loads(summary.read_text())
        orders = [order for order in said["work_orders"] if order.startswith("boom: leakage (it creeps while closed) ")]
        assert done.returncode == 0 and len(orders) == 1 and f"work order: {orders[0]}\n" in done.stdout, done.stdout
        assert "that of 2 September 2026; beyond its noise from 6 September 2026 on: look at the piston's seal" in orders[0]
        for needle, *arguments in (
                ("4 logs of use: a trend needs 5", *leaking), ("is the same log as another", *healthy, healthy[0]),
                ("its stamps are no clock's", *healthy, undated), ("none.log", *healthy, folder / "none.log")):
            done = call(graben, *arguments, "--profile", "excavator_22t")
            assert done.returncode == 1 and needle in done.stderr and not done.stdout, f"{needle}: {done}"
        done = call(graben, *healthy, "--profile", "excavator_12t")
        assert done.returncode == 1 and done.stderr.count("\n") <= 2, done


main(*sys.argv[1:])
