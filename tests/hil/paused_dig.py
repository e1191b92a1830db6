# SPDX-License-Identifier: Apache-2.0
"""An area whose operator lets go within a cut, over vcan: the dig goes on where it was, as the bus tells.
paused_dig.py OUT GRABEN_ECU GRABEN"""

import functools
import itertools
import json
import pathlib
import sys

import bus_log
import task
from bus_log import ACTIVE, ECU_STATUS, NEUTRAL_RAW, SPOOL_COMMAND, SWING_COMMAND
from scenario import ICOUNT_SHIFT

HERE = pathlib.Path(__file__).resolve().parent
AREA = HERE / "paused_dig.toml"
TASK_STATUS = "18FF3882"
NONE, APPROACH, DIG, SWING, DUMP, RETURN, DONE = 0, 1, 2, 4, 5, 6, 7
SOIL = "loam"
# In the second cut of two; the unpaused run takes 77 s.
LETS_GO_S, SECONDS = 55.0, 120.0
# Of the pause, and what the frames may take of it.
PAUSE_S, FRAMES_S = 1.0, 0.05
# Share of the step when the operator lets go: the teeth are in, and it is not over.
IN_CUT = (0.2, 0.9)
# As closed_loop/check_areas.py has them.
BUILT, OVER_CUT_M = 0.95, 0.025


def runs(values: list[int]) -> list[int]:
    """Each value once that comes several times on end."""
    return [value for value, _ in itertools.groupby(values)]


def active_spells(log: list[bus_log.Frame]) -> list[tuple[float, float]]:
    modes = [frame for frame in log if frame.name == ECU_STATUS]
    spells = [list(spell) for mode, spell in itertools.groupby(modes, lambda frame: frame.mode) if mode == ACTIVE]
    return [(spell[0].time, spell[-1].time) for spell in spells]


def check_pause(log: list[bus_log.Frame], begin_s: float, end_s: float) -> list[str]:
    """Nothing is commanded in it."""
    moves = [frame for frame in log if begin_s + FRAMES_S < frame.time < end_s - FRAMES_S
             and (frame.name == SPOOL_COMMAND and any(frame.bits(start, 16) != NEUTRAL_RAW for start in (16, 32, 48))
                  or frame.name == SWING_COMMAND and frame.bits(16, 16) != NEUTRAL_RAW)]
    problems = [f"{len(moves)} commands of the pause are not neutral"] if moves else []
    if end_s - begin_s < PAUSE_S:
        problems.append(f"the pause is {end_s - begin_s:.2f} s")
    return problems


def check_goes_on(before: list[bus_log.Frame], after: list[bus_log.Frame], digs: int) -> list[str]:
    """`digs` has the unpaused run, the one that finds the ground among them."""
    share = before[-1].bits(24, 16) * 2e-5
    kinds = [runs([frame.bits(16, 4) for frame in part]) for part in (before, after)]
    print(f"paused_dig: lets go at {share:.0%} of step {kinds[0]}; then {kinds[1]}")
    problems = []
    if kinds[0][-1] != DIG or not IN_CUT[0] < share < IN_CUT[1]:
        problems.append(f"let go in a step of kind {kinds[0][-1]}, at {share:.0%}: not in a cut")
    # Lifted out and emptied, from where it was.
    if kinds[1][:5] != [DIG, SWING, DUMP, RETURN, DIG]:
        problems.append(f"after the pause the steps are of kinds {kinds[1][:5]}")
    if (DIG, RETURN) in itertools.pairwise(kinds[1]):
        problems.append("the ground is looked for again")
    seen = sum(kind.count(DIG) for kind in kinds)
    # The cut that was left is in two parts, and what it left is cut once more.
    if seen > digs + 2:
        problems.append(f"{seen} digs, {digs} without a pause")
    if DONE not in kinds[1]:
        problems.append("the dig does not end")
    return problems


def check_built(what: str, figures: dict) -> list[str]:
    within, low_m = figures["built_within_ratio"], figures["built_low_m"]
    print(f"paused_dig: {what}: {within:.1%} within 30 mm of the design, 95 % no lower than {low_m * 1e3:.1f} mm")
    return [] if within >= BUILT and low_m >= -OVER_CUT_M else [f"{what}: not dug to its design"]


def check(digs: int, out: pathlib.Path) -> list[str]:
    log = bus_log.frames(out / "vcan0.log")
    spells = active_spells(log)
    if len(spells) != 2:
        return [f"active {len(spells)} times: {spells}"]
    (begin_s, left_s), (again_s, _) = spells
    # At the ends of a spell it may say none yet, or already.
    told = [frame for frame in log if frame.name == TASK_STATUS and frame.bits(16, 4) != NONE]
    return [*check_pause(log, left_s, again_s),
            *check_goes_on([frame for frame in told if begin_s <= frame.time <= left_s],
                           [frame for frame in told if again_s <= frame.time], digs),
            *check_built("paused", json.loads((out / "summary.json").read_text())), *task.check_run(out)]


def main() -> int:
    unpaused = task.in_memory(task.graben_among(sys.argv), "autodig", "--task", AREA, "--soil", SOIL)
    if problems := check_built("in memory", unpaused):
        sys.exit(problems[0])
    digs = sum(step["kind"] == "dig" for step in unpaused["steps"])
    does = task.Task("excavator_12t.toml", "program", "", 0.0, AREA.name)
    return task.run("vcan", does, SECONDS, functools.partial(check, digs),
                    f"--soil {SOIL} --lets-go {LETS_GO_S:g}", {AREA.name: AREA}, ICOUNT_SHIFT - 1)


if __name__ == "__main__":
    sys.exit(main())
