# SPDX-License-Identifier: Apache-2.0
"""Faults that look healthy frame by frame, and signals, on a real kernel's bus:
plausible.py OUT PROGRAM... [--every] [--only TEXT] runs the deployed process beside the simulated machine, once
for each row of the fault table that only a kernel can show, or with --every once for each machine that can have it
and each signal, and prints how long after the fault it was named, with which fault of EcuStatus, and how long after
that all commands on the bus were neutral."""

import pathlib
import re
import sys
import tempfile

import plausible_judge
import run_programs
from plausible_cases import CASES, EVERY, MADE, TRACK, TRACK_FILE, Case, lanes

LANES = 3


def ms(value: float | None) -> str:
    return f"{value:7.0f}" if value is not None else f"{'-':>7}"


def check(cases: list[Case], out: pathlib.Path) -> list[str]:
    problems = []
    print(f"row  {'machine':14}  {'fault':48} seen ms   {'named':32} neutral ms")
    for place, case in enumerate(cases):
        seen = plausible_judge.judge(case, out, f"v{place}")
        print(f"{case.row:3}  {case.machine[0]:14}  {case.text:48.48} {ms(seen.detected)}   {seen.named:32} "
              f"{ms(seen.neutral)}     {'; '.join(seen.problems) or 'ok'}")
        problems += [f"row {case.row}, {case.machine[0]}, {case.text}: {problem}" for problem in seen.problems]
    up, idle = (out / "uptime").read_text().split()
    print(f"the guest was up for {up} s, idle for {idle} s")
    return problems


def made_profiles(folder: pathlib.Path) -> dict[str, pathlib.Path]:
    for name, (source, changes) in MADE.items():
        text = (run_programs.PROFILES / source).read_text(encoding="utf-8")
        for pattern, instead in changes:
            text, count = re.subn(pattern, instead, text)
            if count != 1:
                raise RuntimeError(f"{source}: '{pattern}' is there {count} times")
        (folder / name).write_text(text, encoding="utf-8")
    track = "".join(" ".join(map(str, corner)) + "\n" for corner in TRACK)
    (folder / TRACK_FILE).write_text(track, encoding="ascii")
    return {name: folder / name for name in (*MADE, TRACK_FILE)}


def main() -> int:
    only = ""
    if "--only" in sys.argv:
        place = sys.argv.index("--only")
        only = sys.argv[place + 1]
        del sys.argv[place:place + 2]
    every = "--every" in sys.argv
    if every:
        sys.argv.remove("--every")
    cases = [case for case in (EVERY if every or only else CASES) if re.search(only, f"{case.row} {case.machine[0]} {case.text}")]
    lane_of = lanes(cases, LANES)
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        told = folder / "cases"
        told.write_text("".join(case.line(lane_of[place], f"v{place}") for place, case in enumerate(cases)),
                        encoding="ascii")
        return run_programs.main("plausible.sh", lambda out: check(cases, out), timeout_s=210.0 if every else 100.0,
                                 extra={"cases": told, **made_profiles(folder)})


if __name__ == "__main__":
    sys.exit(main())
