# SPDX-License-Identifier: Apache-2.0
"""The operator's station with a gamepad of uinput's: operate.py OUT GRABEN_ECU GRABEN HIL_GAMEPAD
[--arms-only]. What the hand does (operate.pad) beside what is on the bus."""

import pathlib
import sys

import bus_log
import run_programs

HERE = pathlib.Path(__file__).resolve().parent
OPERATOR_COMMAND, OPERATOR_AXES, BOOM_STROKE = "0CFF2781", "0CFF2C81", "0CFF2080"
NO_TASK, JOG = 0, 4
PERIOD_S = 0.020
# One cycle from the hand to the bus, and what the guest adds.
RELEASE_S = PERIOD_S + 0.002
UNPLUGGED_S = 0.040
# The controller misses a station after 50 ms.
LOST_S = 0.045
SILENT_S = 2.0  # As operate.sh has it.
LEAST_RISE_M = 0.02
# What each refusal has to say.
REFUSALS = {"no_interface": "vcan7: ", "no_gamepad": "no gamepad among ",
            "no_device": "/dev/null: no input device", "no_terminal": "no terminal",
            "two_gamepads": "Second Pad", "second_station": "another station sends OperatorCommand "
            "(source address 129)", "other_station": "(source address 66)"}


class Bus:
    """The log, with questions."""

    def __init__(self, out: pathlib.Path):
        frames = bus_log.frames(out / "vcan0.log")
        self.commands = [frame for frame in frames if frame.name == OPERATOR_COMMAND]
        self.axes = [frame for frame in frames if frame.name == OPERATOR_AXES]
        self.status = [frame for frame in frames if frame.name == bus_log.ECU_STATUS]
        self.strokes = [(frame.time, frame.bits(16, 16) * 5e-5) for frame in frames
                        if frame.name == BOOM_STROKE]
        self.marks = {frame.data[0]: frame.time for frame in frames if frame.name == bus_log.MARK}

    def between(self, frames, begin_s: float, end_s: float):
        return [frame for frame in frames if begin_s <= frame.time < end_s]

    def enabled(self, begin_s: float, end_s: float) -> list[bool]:
        return [frame.bits(12, 2) == 1 for frame in self.between(self.commands, begin_s, end_s)]

    def off_after(self, begin_s: float) -> float:
        """How long after this time the first frame without enable comes, after which none has it
        for a while."""
        later = [frame for frame in self.commands if begin_s <= frame.time < begin_s + 8.0]
        for frame in later:
            if frame.bits(12, 2) != 1:
                return frame.time - begin_s
        return float("inf")

    def stroke_at(self, time_s: float) -> float:
        return next(stroke for time, stroke in self.strokes if time >= time_s)


def check_frames(bus: Bus) -> list[str]:
    problems = []
    begin, end = bus.marks[1], bus.marks[9]
    for name, frames in (("OperatorCommand", bus.commands), ("OperatorAxes", bus.axes)):
        times = [frame.time for frame in frames if begin <= frame.time <= end]
        gaps = [later - earlier for earlier, later in zip(times, times[1:])]
        # A device that is gone is closed, and opened again, in about a cycle: that one's frames come late, and
        # the next ones, which keep to the clock, soon after.
        unplugged = [gap for gap, time in zip(gaps, times) if time >= bus.marks[8]]
        held = gaps[:len(gaps) - len(unplugged)]
        print(f"operate: {name} every {1e3 * min(held):.1f} to {1e3 * max(held):.1f} ms, "
              f"up to {1e3 * max(unplugged):.1f} ms without the gamepad")
        if max(held) > 1.5 * PERIOD_S or min(held) < 0.5 * PERIOD_S or max(unplugged) > LOST_S:
            problems.append(f"{name} comes too seldom or too often")
        counters = [frame.bits(8, 4) for frame in frames if begin <= frame.time <= end]
        if any((earlier + 1) % 15 != later for earlier, later in zip(counters, counters[1:])):
            problems.append(f"{name}: a counter is left out")
    if bus.between(bus.commands, bus.marks[2], end)[-1].bits(48, 16) == 0:
        problems.append("no stamp is answered")
    return problems


def check_hand(bus: Bus) -> list[str]:
    """What the hand does, mark by mark."""
    marks, problems = bus.marks, []

    def expect(what: str, holds: bool):
        if not holds:
            problems.append(what)

    expect("in Manual the controller arms",
           all(frame.mode < bus_log.ARMED for frame in bus.between(bus.status, marks[1], marks[2])))
    expect("held, enable is not given", all(bus.enabled(marks[2] + RELEASE_S, marks[4])))
    expect("the controller does not arm", any(
        frame.mode == bus_log.ARMED for frame in bus.between(bus.status, marks[2], marks[3])))
    tasks = [frame.bits(24, 8) for frame in bus.between(bus.commands, marks[2], marks[3])]
    expect("Jog is asked for before it is armed, or never", tasks[0] == NO_TASK and JOG in tasks)
    speeds = {frame.bits(32, 8) / 2 for frame in bus.between(bus.commands, marks[2], marks[3])}
    expect(f"speeds of {speeds} %, not 60", speeds == {60.0})
    pulled = [frame.bits(16, 8) for frame in bus.between(bus.axes, marks[3] + RELEASE_S, marks[4])]
    expect("the stick at its end is not the axis at its end", set(pulled) == {250})
    for mark, what, limit_s in ((4, "released", RELEASE_S), (6, "events lost", RELEASE_S),
                                (8, "unplugged", UNPLUGGED_S)):
        off_s = bus.off_after(marks[mark])
        print(f"operate: {what}: enable is off after {1e3 * off_s:.1f} ms")
        expect(f"{what}: enable is off after {off_s:.4f} s", off_s <= limit_s)
        expect(f"{what}: enable comes back by itself",
               not any(bus.enabled(marks[mark] + limit_s, marks[mark] + 0.3)))
    expect("pressed with a lever off its middle it counts",
           not any(bus.enabled(marks[5], marks[5] + 0.6)))
    silent_s = bus.off_after(marks[7] + RELEASE_S) + RELEASE_S
    print(f"operate: silent: enable is off after {silent_s:.2f} s")
    expect(f"silent for {silent_s:.3f} s, enable goes then",
           SILENT_S - PERIOD_S <= silent_s <= SILENT_S + 2 * PERIOD_S)
    expect("plugged in again, a new press does not count", any(bus.enabled(marks[9], marks[9] + 0.4)))
    expect("the bus comes back and enable with it",
           not any(bus.enabled(marks[10] - 1.0, marks[10] + 0.5)))
    expect("after the bus a new press does not count",
           any(bus.enabled(marks[11] - 0.1, marks[12])))
    expect("told to end, its last words give enable",
           bus.enabled(marks[12], marks[12] + 0.15)[-1:] == [False])
    return problems


def check_motion(bus: Bus) -> list[str]:
    marks = bus.marks
    rise_m = bus.stroke_at(marks[4]) - bus.stroke_at(marks[3])
    after_m = bus.stroke_at(marks[5] + 0.5) - bus.stroke_at(marks[4] + 0.25)
    print(f"operate: the boom's cylinder extends by {rise_m:.3f} m, and by {after_m:.4f} m once let go")
    problems = [] if rise_m >= LEAST_RISE_M else [f"the boom's cylinder extends by {rise_m:.4f} m"]
    off = bus.between(bus.status, marks[4] + RELEASE_S + 0.05, marks[5])
    if any(frame.mode == bus_log.ACTIVE for frame in off):
        problems.append("let go, and the controller is active")
    return problems


def check(out: pathlib.Path, arms_only: bool) -> list[str]:
    bus = Bus(out)
    if missing := [mark for mark in range(1, 14) if mark not in bus.marks]:
        return [f"no mark {missing}"]
    problems = check_frames(bus) + check_hand(bus) + ([] if arms_only else check_motion(bus))
    for name, words in REFUSALS.items():
        said = (out / name).read_text()
        if words not in said:
            problems.append(f"{name}: says {said.strip()!r}")
    if bus.between(bus.commands, bus.marks[13] + 2 * PERIOD_S, bus.marks[13] + 0.4):
        problems.append("it sends on beside another station")
    said = (out / "said_all").read_text()
    problems += [f"the station never said '{words}'" for words in (
        # Armed or Active: the screen looks eight times a second, and Armed may be over by then.
        "controller A", "the gamepad is gone", "events of the gamepad were lost", "silent for too long",
        "a lever was off its middle", "HELD") if words not in said]
    if "frames are version 7" not in (out / "said_other_version").read_text():
        problems.append("it does not see another version")
    return problems


if __name__ == "__main__":
    only = "--arms-only" in sys.argv
    sys.argv = [argument for argument in sys.argv if argument != "--arms-only"]
    sys.exit(run_programs.main("operate.sh", lambda out: check(out, only), timeout_s=90.0,
                               extra={"operate.pad": HERE / "operate.pad"},
                               modules=("evdev", "uinput")))
