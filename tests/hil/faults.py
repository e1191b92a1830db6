# SPDX-License-Identifier: Apache-2.0
"""Faults that only a kernel can show: faults.py OUT PROGRAM... runs faults.sh and judges its log.

Prints a table: row of the fault list, what was seen, how long until neutral."""

import dataclasses
import pathlib
import sys

import bus_log
import run_programs
from bus_log import ACTIVE, ECU_STATUS, MARK, READY, SPOOL_COMMAND, VALVE_STATE, Frame

STROKES = {"0CFF2080": 1260.0, "0CFF2180": 1504.0, "0CFF2280": 1104.0}  # mm, of the 22 t profile
NEUTRAL_S = 0.0305  # a cycle until it is seen, two more at most, and the bus
VALVE_TIMEOUT_S = 0.100
ECHO_S = 0.030  # the valve side's cycle, and that of its frame
SETTLE_S = 0.5
MOVED_SHARE = 0.01


@dataclasses.dataclass
class Expected:
    row: int
    name: str
    # Frame that is the cause, where the log has it; else the mark.
    cause: str = MARK
    # Fault codes of EcuStatus that name it; none: the machine must go on as if nothing were.
    codes: tuple[int, ...] = ()
    # The ECU's frames cease for at least so long.
    silent_s: float = 0.0
    # It starts again: nothing is left of what it was.
    restarts: bool = False


CYCLE_STALLED, BUS_OFF, BUS_PASSIVE, BUS_DOWN, TRANSMIT = 10, 12, 13, 14, 15
MISSING = (1, 3, 5, 20)  # a stroke, a swash, the operator, the spools
ROWS = [
    Expected(26, "bus-off", cause="20000040", codes=(BUS_OFF,)),
    Expected(27, "error-passive", cause="20000004", codes=(BUS_PASSIVE,)),
    Expected(28, "interface down", codes=(BUS_DOWN,), silent_s=0.4),
    # All of the interface is blocked, the machine's frames too: whichever is missed first.
    Expected(29, "transmit queue full", codes=(TRANSMIT, *MISSING), silent_s=0.02),
    Expected(24, "flood, top priority"),
    Expected(25, "flood, low priority"),
    Expected(44, "stopped and continued (30, 31)", codes=(CYCLE_STALLED,), silent_s=0.9),
    Expected(42, "stalled, watchdog", silent_s=0.5, restarts=True),
    Expected(43, "killed", silent_s=0.4, restarts=True),
    Expected(45, "wall clock steps"),
]


def until_ready(part: list[Frame]) -> list[Frame]:
    """The part up to where the controller is Ready again, by which the operator has let go."""
    for place, frame in enumerate(part):
        if frame.name == ECU_STATUS and frame.mode == READY:
            return part[:place]
    return part


def moved(part: list[Frame], since: float) -> float:
    """Largest share of its stroke that a cylinder moved after `since`."""
    worst = 0.0
    for name, stroke_mm in STROKES.items():
        seen = [frame.bits(16, 16) * 0.05 for frame in part if frame.name == name and frame.time >= since]
        if seen:
            worst = max(worst, (max(seen) - min(seen)) / stroke_mm)
    return worst


def judge_silence(expected: Expected, commands: list[Frame], valve: list[Frame]) -> list[str]:
    gaps = [(later.time - earlier.time, earlier.time) for earlier, later in zip(commands, commands[1:])]
    longest, last = max(gaps, default=(0.0, 0.0))
    problems = []
    if longest < expected.silent_s:
        problems.append(f"its frames ceased for {longest:.3f} s only")
    if next(command for command in commands if command.time > last).neutral is False:
        problems.append("the first command after the gap is not neutral")
    # With the interface down nobody hears the valve either.
    if expected.row != 28 and longest > VALVE_TIMEOUT_S:
        closed = [frame.time for frame in valve if frame.time > last and frame.bits(12, 2) == 0]
        late = (closed[0] - last) if closed else float("inf")
        if late > VALVE_TIMEOUT_S + ECHO_S:
            problems.append(f"the valve side closed {late:.3f} s after the last command")
    return problems


def judge_stop(expected: Expected, part: list[Frame]) -> tuple[str, list[str]]:
    """It ends in neutral and stays there until the operator has let go."""
    problems: list[str] = []
    commands = [frame for frame in part if frame.name == SPOOL_COMMAND]
    valve = [frame for frame in part if frame.name == VALVE_STATE]
    cause = next((frame.time for frame in part if frame.name == expected.cause), None)
    first = next((frame for frame in commands if cause is not None and frame.time > cause
                  and frame.neutral), None)
    if cause is None or first is None:
        return "never neutral", ["never neutral"]
    if expected.silent_s:
        problems += judge_silence(expected, commands, valve)
    elif first.time - cause > NEUTRAL_S:
        problems.append(f"neutral after {(first.time - cause) * 1e3:.1f} ms")
    latched = until_ready([frame for frame in part if frame.time >= first.time])
    if any(frame.name == SPOOL_COMMAND and not frame.neutral for frame in latched):
        problems.append("left neutral before the operator let go")
    codes = {frame.fault for frame in latched if frame.name == ECU_STATUS}
    if expected.codes and not codes & set(expected.codes):
        problems.append(f"fault codes {sorted(codes)}, expected {expected.codes}")
    if (share := moved(latched, first.time + SETTLE_S)) > MOVED_SHARE:
        problems.append(f"a cylinder moved by {share:.1%} of its stroke afterwards")
    seen = "restarted neutral" if expected.restarts else f"neutral, latched, fault {min(codes & set(expected.codes), default='-')}"
    return f"{seen:32} {(first.time - cause) * 1e3:7.1f} ms", problems


def steps_of(commands: list[Frame]) -> list[tuple[int, float]]:
    """(how far the counter went on, how long it took) from command to command. A recorder that was
    flooded leaves frames out; their counters tell of them."""
    return [((later.bits(8, 4) - earlier.bits(8, 4)) % 15, later.time - earlier.time)
            for earlier, later in zip(commands, commands[1:])]


def judge_unaffected(part: list[Frame]) -> tuple[str, list[str]]:
    begin = part[0].time
    wall_steps = any(abs(later.time - earlier.time) > 60 for earlier, later in zip(part, part[1:]))
    part = part if wall_steps else [frame for frame in part if frame.time <= begin + 1.0]
    commands = [frame for frame in part if frame.name == SPOOL_COMMAND]
    steps = steps_of(commands)
    problems = []
    if sum(count for count, _ in steps) < 95 or any(frame.neutral for frame in commands):
        problems.append(f"{sum(frame.neutral for frame in commands)} of {len(commands)} commands neutral")
    if late := [took for count, took in steps if took < 60 and took > count * 0.010 + 0.0015]:
        problems.append(f"commands up to {max(late):.4f} s apart")
    if any(frame.mode != ACTIVE or frame.fault for frame in part if frame.name == ECU_STATUS):
        problems.append("not active all the time")
    return f"{'unaffected':32} {'-':>10}", problems


def parts_of(log: list[Frame]) -> dict[int, list[Frame]]:
    """From each mark to the next."""
    places = [place for place, frame in enumerate(log) if frame.name == MARK]
    return {int(log[here].data.hex()) if log[here].data != b"\xff" else -1: log[here:there]
            for here, there in zip(places, [*places[1:], len(log)])}


def check(out: pathlib.Path) -> list[str]:
    parts = parts_of(bus_log.frames(out / "vcan0.log"))
    problems = []
    for expected in ROWS:
        part = parts.get(expected.row, [])
        if not part:
            problems.append(f"row {expected.row}: not tried")
            continue
        stops = bool(expected.codes or expected.silent_s)
        seen, found = judge_stop(expected, part) if stops else judge_unaffected(part)
        print(f"{expected.row:3}  {expected.name:32} {seen}  {'ok' if not found else '; '.join(found)}")
        problems += [f"row {expected.row}: {problem}" for problem in found]
    story = (out / "supervise.log").read_text().split("\n")
    starts = sum(line.startswith("started") for line in story)
    if starts != 3 or sum(line.startswith("watchdog") for line in story) != 1:
        problems.append(f"the supervisor saw {starts} starts, expected 3, one of them by its watchdog: {story}")
    return problems


if __name__ == "__main__":
    sys.exit(run_programs.main("faults.sh", check, timeout_s=240))
