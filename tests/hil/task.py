# SPDX-License-Identifier: Apache-2.0
"""A task over a real CAN kernel beside the same in memory:
task.py dig|grade|autodig vcan|controllers SECONDS OUT GRABEN GRABEN_ECU"""

import dataclasses
import functools
import json
import pathlib
import subprocess
import sys
import tempfile
from collections.abc import Callable

import bus_log
import resident
import run_programs
import stats_file
from bus_log import ECU_HEALTH, SPOOL_COMMAND, VALVE_STATE
from scenario import ICOUNT_SHIFT

# The error may differ by so much from that of the bus in memory.
SHARE = 0.5


@dataclasses.dataclass
class Task:
    """Named as the tool's command that does it in memory."""
    profile: str
    # Of `graben plant`.
    operator: str
    # Where the summary says for how long the error was judged, and how long is enough.
    judged: str
    enough_s: float
    # Of graben-ecu.
    file: str = ""
    # By how much the error may be more than in memory.
    more: float = SHARE


# A cycle that begins while the machine's frames are on the bus has values of two ages, 10 ms apart. That
# of the strokes is made up for: at the worst phase, the boom's frame now before the cycle and now after
# it, a dig of 5.1 mm became one of 22.4, and is one of 7.8 now.
TASKS = {"dig": Task("excavator_22t.toml", "dig", "on_path_s", 5.0, more=0.60),
         "grade": Task("dozer_9t.toml", "grade", "over_grade_s", 20.0),
         # The line takes no less than 18.4 s.
         "autodig": Task("excavator_12t.toml", "program", "on_lines_s", 18.4, "flatten.toml")}
SCRIPTS = {"vcan": ("task.sh", 0), "controllers": ("controllers.sh", 2)}
# The dozer drives over its whole design before it starts; the guest is slower than a machine.
START_MS = 1500.0
CYCLES = 1000
# Commands that the machine does not take before it trusts their counter.
HANDSHAKE = 2
# Two errors of some millimetres that differ by less are the same.
RESOLUTION_M = 0.0015
# The period of a message, and what the bus and the guest may add.
PERIOD_S, LATE_S = 0.010, 0.0015


def in_memory(graben: pathlib.Path, *command: str | pathlib.Path) -> dict:
    with tempfile.TemporaryDirectory() as folder:
        summary = pathlib.Path(folder) / "summary.json"
        subprocess.run([graben, *command, "--out", folder, "--summary", summary],
                       check=True, stdout=subprocess.DEVNULL)
        return json.loads(summary.read_text())


def check_stats(out: pathlib.Path) -> list[str]:
    stats, problems = stats_file.read(out / "stats")
    print(" ".join(f"{name}={value}" for name, value in stats.items()))
    if float(stats["start_us"]) * 1e-3 > START_MS:
        problems.append(f"took {float(stats['start_us']) * 1e-3:.1f} ms to start")
    if int(stats["cycles"]) < CYCLES:
        problems.append(f"{stats['cycles']} cycles are too few to judge by")
    return [*problems, *resident.check(out / "memory")]


def check_frames(log: list[bus_log.Frame]) -> list[str]:
    # While the machine was there; at its end its process and its socket go.
    end = max(frame.time for frame in log if frame.name == VALVE_STATE)
    commands = [frame.time for frame in log if frame.name == SPOOL_COMMAND and frame.time < end]
    late = [later - earlier for earlier, later in zip(commands, commands[1:])
            if later - earlier > PERIOD_S + LATE_S]
    problems = [f"{len(late)} commands late, up to {max(late):.4f} s apart"] if late else []
    health = [frame for frame in log if frame.name == ECU_HEALTH][-1]
    # Allocations, page faults, overruns; whether real time is on.
    if (said := tuple(health.bits(*at) for at in ((32, 4), (40, 8), (48, 8), (36, 2)))) != (0, 0, 0, 1):
        problems.append(f"EcuHealth says {said}")
    return problems


def check_run(out: pathlib.Path) -> list[str]:
    """What holds whatever the task was: its process, its frames, and that the task was finished."""
    summary = json.loads((out / "summary.json").read_text())
    problems = []
    if not summary.get("finished", True):
        problems.append("the task was not finished")
    for name in ("commands_rejected", "swing_commands_rejected"):
        if summary.get(name, 0) > HANDSHAKE:
            problems.append(f"{name} {summary[name]}")
    for name in ("command_timeouts", "swing_command_timeouts", "frames_dropped", "late_cycles"):
        if summary.get(name, 0):
            problems.append(f"{name} of the machine {summary[name]}")
    log = bus_log.frames(next(out.glob("*can0.log")))
    return [*problems, *check_frames(log), *check_stats(out)]


def check(task: str, graben: pathlib.Path, out: pathlib.Path) -> list[str]:
    judged, enough_s = TASKS[task].judged, TASKS[task].enough_s
    summary = json.loads((out / "summary.json").read_text())
    expected_m = in_memory(graben, task)["max_error_true_m"]
    print(f"{task}: error {summary['max_error_true_m'] * 1e3:.2f} mm, in memory {expected_m * 1e3:.2f} mm, "
          f"over {summary[judged]:.2f} s")
    problems = []
    more_m = summary["max_error_true_m"] - expected_m
    alike = (-max(SHARE * expected_m, RESOLUTION_M) <= more_m
             <= max(TASKS[task].more * expected_m, RESOLUTION_M))
    if summary[judged] < enough_s or not alike:
        problems.append("the error is another one")
    return [*problems, *check_run(out)]


def graben_among(programs: list[str]) -> pathlib.Path:
    return next(pathlib.Path(path) for path in programs if pathlib.Path(path).name == "graben")


def run(kind: str, does: Task, seconds: float, judge: Callable[[pathlib.Path], list[str]], options: str = "",
        extra: dict[str, pathlib.Path] | None = None, icount_shift: int = ICOUNT_SHIFT) -> int:
    """`options`: more of `graben plant`, beside a file."""
    script, controllers = SCRIPTS[kind]
    with tempfile.TemporaryDirectory() as folder:
        told = pathlib.Path(folder) / "task"
        told.write_text(f"{does.operator} {does.profile} {seconds:g} {does.file} {options}\n")
        return run_programs.main(script, judge, timeout_s=seconds + 30.0, controllers=controllers,
                                 extra={"task": told, **(extra or {})}, icount_shift=icount_shift)


def main() -> int:
    task, kind, seconds = sys.argv[1:4]
    del sys.argv[1:4]
    return run(kind, TASKS[task], float(seconds), functools.partial(check, task, graben_among(sys.argv)))


if __name__ == "__main__":
    sys.exit(main())
