# SPDX-License-Identifier: Apache-2.0
"""Commissioning over a bus of the kernel: commission.py OUT GRABEN_ECU GRABEN HIL_GAMEPAD. What the hand
does (commission.pad) beside what is on the bus, in the station's own log and in its progress file."""

import json
import pathlib
import sys

import bus_log
import run_programs

HERE = pathlib.Path(__file__).resolve().parent
OPERATOR_COMMAND, BUCKET_STROKE, COMMISSION_DUTY = "0CFF2781", "0CFF2280", "0CFF2D81"
COMMISSION = 6
# One cycle from the hand to the bus, and what the guest adds.
RELEASE_S = 0.022
WINDOW_M = (0.10, 0.95)  # As commission.toml has it.
LEAST_MOTION_M = 0.01
STEPS = ["bucket, extending: ramp to its edge", "bucket, retracting: ramp to its edge"]
# What each refusal has to say.
REFUSALS = {"no_controller": "no controller is heard", "no_windows": "nobody can confirm windows",
            "nothing_begun": "drive.log.progress.json: there is no such file", "log_is_there": "there is a log already"}


def enabled(frames, begin_s: float, end_s: float) -> list[bool]:
    return [frame.bits(12, 2) == 1 for frame in frames
            if frame.name == OPERATOR_COMMAND and begin_s <= frame.time < end_s]


def check_hand(frames, marks) -> list[str]:
    problems = []
    if any(enabled(frames, marks[1] + RELEASE_S, marks[2])):
        problems.append("let go, and enable is still given")
    if not all(enabled(frames, marks[1] - 1.0, marks[1])):
        problems.append("held, and enable is not given")
    if True not in enabled(frames, marks[2], marks[2] + 0.5):
        problems.append("pressed again, it does not count")
    if enabled(frames, marks[3] + 0.1, marks[3] + 0.4)[-1:] not in ([False], []):
        problems.append("told to end, its last words give enable")
    tasks = {frame.bits(24, 8) for frame in frames if frame.name == OPERATOR_COMMAND}
    if tasks != {0, COMMISSION}:
        problems.append(f"tasks {tasks} were asked for")
    neutral = [all(frame.bits(start, 16) == bus_log.NEUTRAL_RAW for start in (16, 32, 48))
               for frame in frames if frame.name == COMMISSION_DUTY
               and marks[1] + RELEASE_S <= frame.time < marks[2]]
    if not neutral or not all(neutral):
        problems.append("let go, and duties are still tried")
    return problems


def check_log(out: pathlib.Path, frames, marks) -> list[str]:
    """The station's own log has what the recorder has, on a clock that never goes back."""
    own = bus_log.frames(out / "drive.log")
    problems = []
    times = [frame.time for frame in own]
    if times != sorted(times):
        problems.append("the station's log goes back in time")
    for name in (OPERATOR_COMMAND, COMMISSION_DUTY, BUCKET_STROKE, bus_log.SPOOL_COMMAND):
        mine = sum(frame.name == name for frame in own)
        offset = times[0] - frames[0].time
        if not mine:
            problems.append(f"{name} is not in the station's log")
        print(f"commission: {name}: {mine} frames in the station's log ({offset:.1f} s apart)")
    strokes = [frame.bits(16, 16) * 5e-5 for frame in own if frame.name == BUCKET_STROKE]
    print(f"commission: the bucket's stroke is between {min(strokes):.3f} and {max(strokes):.3f} m")
    if min(strokes) < WINDOW_M[0] - 0.05 or max(strokes) > WINDOW_M[1] + 0.05:
        problems.append("the window was left")
    if max(strokes) - min(strokes) < LEAST_MOTION_M:
        problems.append("the bucket does not move")
    return problems


def check(out: pathlib.Path) -> list[str]:
    frames = bus_log.frames(out / "vcan0.log")
    marks = {frame.data[0]: frame.time for frame in frames if frame.name == bus_log.MARK}
    if missing := [mark for mark in range(1, 5) if mark not in marks]:
        return [f"no mark {missing}"]
    problems = check_hand(frames, marks) + check_log(out, frames, marks)
    for name, words in REFUSALS.items():
        if words not in (said := (out / name).read_text()):
            problems.append(f"{name}: says {said.strip()!r}")
    progress = json.loads((out / "drive.log.progress.json").read_text())
    for step in progress["steps"]:
        print(f"commission: {step}")
    if [step["step"] for step in progress["steps"]] != STEPS:
        problems.append("not every step is done")
    if any(frame.fault for frame in frames if frame.name == bus_log.ECU_STATUS
           and marks[1] - 1.0 <= frame.time < marks[3]):
        problems.append("the controller has a fault")
    first, second = ((out / name).read_text() for name in ("said_first", "said_second"))
    problems += [f"it never said '{words}'" for words, said in (
        ("--resume", first), ("BucketStroke", first), ("bucket stroke:", first),
        ("next: graben identify", second), ("2 of 2 steps done", second)) if words not in said]
    return problems


if __name__ == "__main__":
    sys.exit(run_programs.main("commission.sh", check, timeout_s=200.0,
                               extra={name: HERE / name for name in ("commission.pad",
                                                                     "commission.toml")},
                               modules=("evdev", "uinput")))
