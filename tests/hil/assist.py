# SPDX-License-Identifier: Apache-2.0
"""Task Assist by the operator's station: assist.py OUT GRABEN_ECU GRABEN HIL_GAMEPAD. What the hand does
(assist.pad) beside what the controller says and where the teeth are, by the strokes on the bus."""

import json
import pathlib
import subprocess
import sys

import bus_log
import run_programs

HERE = pathlib.Path(__file__).resolve().parent
OPERATOR_COMMAND, ECU_MOTION = "0CFF2781", "18FF3282"
STROKES = ("0CFF2080", "0CFF2180", "0CFF2280")
ASSIST, NEAR, HOLDS, LET_GO = 7, 2, 3, 4
FOOT_UP_M, DESIGN_UP_M = 1.75, 2.55  # boom_foot of excavator_22t, and assist.toml.
OFF_M = 0.025                        # The largest.
STOP_S, STOPPED_M = 0.3, 0.015       # The longest stop of the controller's, and the way that is left then.
LEAST_WAY_M, LEAST_BACK_M = 0.5, 0.2
LEAST_LIFT_M = 0.03


class Bus:
    """The log, with questions."""

    def __init__(self, out: pathlib.Path, graben: pathlib.Path):
        self.frames = bus_log.frames(out / "vcan0.log")
        self.graben = graben
        self.marks = {frame.data[0]: frame.time for frame in self.frames if frame.name == bus_log.MARK}

    def of(self, name: str, begin_s: float, end_s: float):
        return [frame for frame in self.frames if frame.name == name and begin_s <= frame.time < end_s]

    def assist(self, begin_s: float, end_s: float) -> set[int]:
        return {frame.bits(48, 4) for frame in self.of(ECU_MOTION, begin_s, end_s)}

    def teeth_m(self, time_s: float) -> tuple[float, float]:
        """Outwards from the boom's foot, and over the ground, by the strokes of this moment."""
        strokes = [next(frame.bits(16, 16) * 5e-5 for frame in self.frames
                        if frame.name == name and frame.time >= time_s) for name in STROKES]
        told = subprocess.run([self.graben, "pose", "--profile", "excavator_22t", "--strokes",
                               ",".join(f"{stroke:.5f}" for stroke in strokes)],
                              check=True, capture_output=True, text=True)
        x_m, y_m = (json.loads(told.stdout)[key] for key in ("x_m", "y_m"))
        return x_m, y_m + FOOT_UP_M


def check_states(bus: Bus) -> list[str]:
    marks, problems = bus.marks, []

    def expect(what: str, holds: bool):
        if not holds:
            problems.append(what)

    tasks = {frame.bits(24, 8) for frame in bus.of(OPERATOR_COMMAND, marks[2], marks[3])}
    expect(f"tasks {tasks} are asked for, not Assist", ASSIST in tasks)
    near = bus.assist(marks[3] - 0.3, marks[3])
    expect(f"before a lever moves it says {near}, not Near", near == {NEAR})
    for mark, what in ((3, "out"), (5, "in")):
        holds = bus.assist(marks[mark] + 0.2, marks[mark + 1])
        expect(f"on the way {what} it says {holds}, not Holds", holds == {HOLDS})
    expect("let go it does not say Near", bus.assist(marks[4] + STOP_S + 0.1, marks[5]) == {NEAR})
    raised = bus.assist(marks[6] + 0.1, marks[7] - 0.5)
    expect(f"with the boom raised it says {raised}, not LetGo", raised == {LET_GO})
    faults = {frame.fault for frame in bus.of(bus_log.ECU_STATUS, marks[2], marks[7])}
    expect(f"faults {faults}", faults == {0})
    return problems


def check_edge(bus: Bus) -> list[str]:
    marks, problems = bus.marks, []
    off_m = 0.0
    for begin, end in ((marks[3], marks[5]), (marks[5], marks[6])):
        for n in range(20):
            off_m = max(off_m, abs(bus.teeth_m(begin + (end - begin) * n / 20)[1] - DESIGN_UP_M))
    start, let_go, stopped, rest = (bus.teeth_m(time) for time in
                                    (marks[3], marks[4], marks[4] + STOP_S, marks[5]))
    way_m = rest[0] - start[0]
    back_m = rest[0] - bus.teeth_m(marks[6])[0]
    left_m = abs(stopped[0] - rest[0])
    before, after = bus.teeth_m(marks[6]), bus.teeth_m(marks[7])
    print(f"assist: {way_m:.2f} m out, {back_m:.2f} m in, {1e3 * off_m:.1f} mm off; {1e3 * (rest[0] - let_go[0]):.0f} mm on "
          f"once let go, {1e3 * left_m:.1f} mm of them after {STOP_S} s; the boom lifts by "
          f"{after[1] - before[1]:.2f} m")
    if way_m < LEAST_WAY_M or back_m < LEAST_BACK_M:
        problems.append(f"the edge goes {way_m:.2f} m out and {back_m:.2f} m in")
    if not 1e-4 < off_m < OFF_M:
        problems.append(f"the edge is {1e3 * off_m:.1f} mm off its design")
    if left_m > STOPPED_M:
        problems.append(f"let go, it goes on by {1e3 * left_m:.1f} mm after {STOP_S} s")
    if after[1] - before[1] < LEAST_LIFT_M:
        problems.append("boom up does not lift the edge")
    return problems


def check(out: pathlib.Path, graben: pathlib.Path) -> list[str]:
    bus = Bus(out, graben)
    if missing := [mark for mark in range(1, 8) if mark not in bus.marks]:
        return [f"no mark {missing}"]
    return check_states(bus) + check_edge(bus)


if __name__ == "__main__":
    sys.exit(run_programs.main("assist.sh", lambda out: check(out, pathlib.Path(sys.argv[3])), timeout_s=60.0,
                               extra={name: HERE / name for name in ("assist.pad", "assist.toml")},
                               modules=("evdev", "uinput")))
