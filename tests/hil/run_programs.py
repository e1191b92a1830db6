# SPDX-License-Identifier: Apache-2.0
"""Runs a scenario with the project's programs and judges what it leaves: for faults.py and others.

Command line: OUT PROGRAM..."""

import pathlib
import shutil
import sys
from collections.abc import Callable

import guest
from scenario import ICOUNT_SHIFT, Broken, Nowhere, Scenario, tail

HERE = pathlib.Path(__file__).resolve().parent
PROFILES = HERE.parents[1] / "app" / "machines"


def run(script: str, out: pathlib.Path, programs: list[pathlib.Path],
        check: Callable[[pathlib.Path], list[str]], timeout_s: float, controllers: int = 0,
        extra: dict[str, pathlib.Path] | None = None, modules: tuple[str, ...] = (),
        icount_shift: int = ICOUNT_SHIFT, tools: tuple[str, ...] = ()) -> int:
    programs = [*programs, *(pathlib.Path(shutil.which(tool) or f"/usr/bin/{tool}") for tool in tools)]
    # Behind graben, what the guests' scripts call: plant, operate, commission; and the scope where it is tried.
    for graben in [program for program in programs if program.name == "graben"]:
        behind = ("graben-bus", "graben-scope") if script in ("scope.sh", "first_metre.sh") else ("graben-bus",)
        programs = [*programs, *(graben.with_name(name) for name in behind)]
    scenario = Scenario(script=HERE / script, programs=programs, controllers=controllers, modules=modules,
                        timeout_s=timeout_s, icount_shift=icount_shift, patience_s=max(1200.0, 8.0 * timeout_s),
                        files={"ecu.sh": HERE / "ecu.sh", **(extra or {}),
                               **{file.name: file for pattern in ("*.toml", "tasks/*.toml")
                                  for file in PROFILES.glob(pattern)}})
    try:
        # The guest's clock counts instructions: times do not hang on how busy this host is.
        result = guest.run(scenario, out, where="vm")
    except Nowhere as reason:
        return guest.give_up(script, reason)
    except Broken as problem:
        print(f"hil: {problem}")
        return 1
    if result.status != 0:
        print(tail(result.console), f"\nhil: {script} ended with status {result.status}")
        return 1
    problems = check(out)
    print("\n".join([*problems, f"hil: {script}: {len(problems)} problems, {result.wall_s:.1f} s"]))
    return 1 if problems else 0


def main(script: str, check: Callable[[pathlib.Path], list[str]], timeout_s: float,
         controllers: int = 0, extra: dict[str, pathlib.Path] | None = None,
         modules: tuple[str, ...] = (), icount_shift: int = ICOUNT_SHIFT, tools: tuple[str, ...] = ()) -> int:
    out, *programs = map(pathlib.Path, sys.argv[1:])
    return run(script, out, programs, check, timeout_s, controllers, extra, modules, icount_shift, tools)
