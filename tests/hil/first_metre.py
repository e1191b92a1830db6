# SPDX-License-Identifier: Apache-2.0
"""A new operator's walk, from power on to the first metre on grade: first_metre.py OUT GRABEN_ECU GRABEN HIL_GAMEPAD.
The commands are those of app/operate/README.md; what the hand does (first_metre.pad) beside what the controller says
and where the teeth are, by the strokes on the bus."""

import json
import pathlib
import subprocess
import sys
import tempfile

import bus_log
import run_programs
import walk

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "app" / "operate" / "README.md"
COMMANDS = {"walk_bus.sh": "sudo modprobe", "walk_design.sh": "cat > out/first_metre.toml",
            "walk_power_on.sh": "./run plant", "walk_levers.sh": "./run operate"}
OPERATOR_COMMAND, ECU_MOTION = "0CFF2781", "18FF3282"
STROKES = ("0CFF2080", "0CFF2180", "0CFF2280")
ASSIST, AWAY, NEAR, HOLDS, LET_GO = 7, 1, 2, 3, 4
FOOT_UP_M, DESIGN_UP_M = 1.75, -0.4  # boom_foot of excavator_22t, and the page's design.
OFF_M = 0.025                        # The largest that assist may be off a plane.
STOP_S, STOPPED_M = 0.3, 0.015       # The longest stop of the controller's, and the way that is left then.
LEAST_WAY_M, LEAST_BACK_M = 1.0, 0.2
LEAST_LIFT_M = 0.03
MOST_S = 300.0                       # What the page promises.


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
    above = bus.assist(marks[3] - 0.3, marks[3])
    expect(f"high over the design it says {above}, not Away", above == {AWAY})
    near = bus.assist(marks[4] - 0.5, marks[4])
    expect(f"on the ground, before the arm's lever moves, it says {near}, not Near", near == {NEAR})
    for mark, what in ((4, "in"), (6, "out")):
        holds = bus.assist(marks[mark] + 0.2, marks[mark + 1])
        expect(f"on the way {what} it says {holds}, not Holds", holds == {HOLDS})
    expect("let go it does not say Near", bus.assist(marks[5] + STOP_S + 0.1, marks[6]) == {NEAR})
    raised = bus.assist(marks[7] + 0.1, marks[8] - 0.5)
    expect(f"with the boom raised it says {raised}, not LetGo", raised == {LET_GO})
    faults = {frame.fault for frame in bus.of(bus_log.ECU_STATUS, marks[2], marks[8])}
    expect(f"faults {faults}", faults == {0})
    return problems


def check_edge(bus: Bus) -> list[str]:
    marks, problems = bus.marks, []
    off_m = 0.0
    for begin, end in ((marks[4], marks[6]), (marks[6], marks[7])):
        for n in range(20):
            off_m = max(off_m, abs(bus.teeth_m(begin + (end - begin) * n / 20)[1] - DESIGN_UP_M))
    high, start, let_go, stopped, rest = (bus.teeth_m(time) for time in
                                          (marks[3], marks[4], marks[5], marks[5] + STOP_S, marks[6]))
    way_m = start[0] - rest[0]
    back_m = bus.teeth_m(marks[7])[0] - rest[0]
    left_m = abs(stopped[0] - rest[0])
    before, after = bus.teeth_m(marks[7]), bus.teeth_m(marks[8])
    took_s = marks[5] - bus.frames[0].time
    print(f"first metre: {took_s:.0f} s after power on; {high[1] - start[1]:.2f} m down to {1e3 * (start[1] - DESIGN_UP_M):.1f} mm over the "
          f"design, {way_m:.2f} m in, {back_m:.2f} m out, {1e3 * off_m:.1f} mm off; {1e3 * (let_go[0] - rest[0]):.0f} mm on "
          f"once let go, {1e3 * left_m:.1f} mm of them after {STOP_S} s; the boom lifts by {after[1] - before[1]:.2f} m")
    if way_m < LEAST_WAY_M or back_m < LEAST_BACK_M:
        problems.append(f"the edge goes {way_m:.2f} m in and {back_m:.2f} m out")
    if not 1e-4 < off_m < OFF_M:
        problems.append(f"the edge is {1e3 * off_m:.1f} mm off its design")
    if left_m > STOPPED_M:
        problems.append(f"let go, it goes on by {1e3 * left_m:.1f} mm after {STOP_S} s")
    if after[1] - before[1] < LEAST_LIFT_M:
        problems.append("boom up does not lift the edge")
    if took_s > MOST_S:
        problems.append(f"the metre takes {took_s:.0f} s")
    return problems


def check(out: pathlib.Path, graben: pathlib.Path) -> list[str]:
    bus = Bus(out, graben)
    if missing := [mark for mark in range(1, 9) if mark not in bus.marks]:
        return [f"no mark {missing}"]
    return check_states(bus) + check_edge(bus)


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        try:
            blocks = walk.write(PAGE, pathlib.Path(folder), COMMANDS)
        except ValueError as problem:
            print(f"{PAGE}: {problem}")
            return 1
        return run_programs.main("first_metre.sh", lambda out: check(out, pathlib.Path(sys.argv[3])), timeout_s=90.0,
                                 extra={"first_metre.pad": HERE / "first_metre.pad", **blocks},
                                 modules=("evdev", "uinput"))


if __name__ == "__main__":
    sys.exit(main())
