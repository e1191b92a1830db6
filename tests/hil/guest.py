#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a shell script with CAN interfaces: on this host, if its kernel has vcan, or else in a
virtual machine with a PREEMPT_RT kernel, which may also have CAN controllers.

The exit status is the script's; 124 if it took too long, 125 if the machine failed. Where neither
is possible the test is skipped, loudly and with status 0, or with status 1 if CI=true.
"""

import argparse
import os
import pathlib
import shutil
import sys

import host
import machine
from scenario import TIMED_OUT, Broken, Nowhere, Result, Scenario, tail

ROOT = pathlib.Path(__file__).resolve().parents[2]
CACHE = ROOT / "build" / "hil"
PLACES = ("auto", "host", "vm", "none")
BROKEN = 125


def empty(out: pathlib.Path):
    """No result of an earlier run may pass for one of this, and no stranger's files be lost."""
    if out.exists() and any(out.iterdir()):
        if not (out / "console.txt").exists():
            raise Broken(f"{out} has files in it that are not an earlier run's results")
        shutil.rmtree(out)
    out.mkdir(parents=True, exist_ok=True)


def choose(scenario: Scenario, where: str, cache: pathlib.Path):
    """The function that runs the scenario; Nowhere, with the reason for each place, if there is none.
    The controllers exist in the virtual machine only. GRABEN_HIL says where by default; what has
    nothing by GRABEN_HIL=none has nothing by any option either."""
    told = os.environ.get("GRABEN_HIL") or "auto"
    where = told if told == "none" else where or told
    if where not in PLACES:
        raise Broken(f"GRABEN_HIL={where} is none of {', '.join(PLACES)}")
    if where == "none":
        raise Nowhere("told to take this host for one without anything")
    reasons = []
    if where in ("auto", "host"):
        try:
            if scenario.controllers:
                raise Nowhere("it has not the controllers that this test needs")
            if scenario.modules:
                raise Nowhere("this test loads modules of its own")
            if scenario.root:
                raise Nowhere("a Debian of its own needs a virtual machine")
            host.prepare()
            return lambda out: host.run(scenario, out)
        except Nowhere as reason:
            reasons.append(f"not on this host: {reason}")
    if where in ("auto", "vm"):
        try:
            kernel = machine.prepare(cache)
            return lambda out: machine.run(kernel, scenario, out)
        except Nowhere as reason:
            reasons.append(f"not in a virtual machine: {reason}")
    raise Nowhere("; ".join(reasons))


def run(scenario: Scenario, out: pathlib.Path, where: str = "", cache: pathlib.Path = CACHE) -> Result:
    """Runs it on one of PLACES; its results are then in `out`, beside console.txt. Raises Nowhere or
    Broken."""
    run_there = choose(scenario, where, cache)
    empty(out)
    return run_there(out)


def give_up(what: str, reason: Nowhere, suite: str = "hil") -> int:
    """Says that nothing was tested, and why; the exit status. CI may not pass over it."""
    if os.environ.get("CI", "").lower() in ("true", "1"):
        print(f"FAILED {suite}: {what}, and CI=true: {reason}", flush=True)
        return 1
    print(f"SKIPPED {suite}: {what}: {reason}", flush=True)
    return 0


def named_file(text: str) -> tuple[str, pathlib.Path]:
    path, _, name = text.partition("=")
    return name or pathlib.Path(path).name, pathlib.Path(path)


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--script", type=pathlib.Path, help="POSIX sh; see hil.sh")
    parser.add_argument("--out", type=pathlib.Path, help="folder for what the script leaves in $OUT")
    parser.add_argument("--binary", type=pathlib.Path, nargs="+", action="extend", default=[],
                        help="programs, which come with their libraries")
    parser.add_argument("--file", type=named_file, nargs="+", action="extend", default=[],
                        metavar="PATH[=NAME]", help="files for the script's folder")
    parser.add_argument("--controllers", choices=["none", "kvaser"], default="none",
                        help="kvaser: can0 and can1, two SJA1000 on one bus")
    parser.add_argument("--timeout", type=float, default=60, help="seconds of the script's clock")
    parser.add_argument("--patience", type=float, default=600, help="seconds of this host's clock")
    parser.add_argument("--where", choices=PLACES, default="", help="instead of GRABEN_HIL, or auto")
    parser.add_argument("--cache", type=pathlib.Path, default=CACHE)
    parser.add_argument("--prepare", action="store_true", help="fetch the kernel, run nothing")
    options = parser.parse_args()
    if not options.prepare and not (options.script and options.out):
        parser.error("--script and --out, or --prepare")
    return options


def main() -> int:
    options = parse()
    scenario = Scenario(script=options.script, programs=options.binary, files=dict(options.file),
                        controllers=2 if options.controllers == "kvaser" else 0,
                        timeout_s=options.timeout, patience_s=options.patience)
    try:
        if options.prepare:
            choose(scenario, options.where, options.cache)
            return 0
        result = run(scenario, options.out, options.where, options.cache)
    except Nowhere as reason:
        return give_up("nothing tested" if options.prepare else str(options.script), reason)
    except Broken as problem:
        console = options.out / "console.txt" if options.out else None
        if console and console.exists():
            print(tail(console.read_text(encoding="utf-8", errors="replace")))
        print(f"hil: {problem}")
        return BROKEN
    print(tail(result.console, 400))
    print(f"hil: {'timed out, ' if result.status == TIMED_OUT else ''}status {result.status} "
          f"({result.where}, {result.wall_s:.1f} s)")
    return result.status


if __name__ == "__main__":
    sys.exit(main())
