#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The package as a service: check_service.py PACKAGE GRABEN OUT boots a Debian with systemd in a
virtual machine, runs service.sh in it, and judges what that leaves."""

import pathlib
import re
import sys
import tarfile

import debian_root
from debian_root import HERE, Nowhere

import bus_log
import guest
import initramfs
from bus_log import ECU_HEALTH, MARK, SPOOL_COMMAND, Frame
from scenario import Broken, Scenario, tail

PROFILE = HERE.parents[1] / "app" / "machines" / "excavator_22t.toml"
SIMULATION = PROFILE.with_suffix(".sim.toml")  # of graben plant
LOG, SENT_LOG = "can1.log", "can0.log"
INSTALLED, STALLED, KILLED, DIGGING, STOPPED, RUNNING, REMOVED, LAST = range(8)
PERIOD_S, LATE_S = 0.010, 0.0015
# The watchdog's 200 ms, from when it was fed last; half a second of rest; and the start, which costs
# systemd 0.3e9 instructions for the confinement alone: more than a second of the guest's; and 0.25 s of the claim.
STALL_S, KILL_S = (0.85, 2.65), (0.75, 2.45)
# What each note of service.sh has to say, beside loaded.
RUNS = {"ActiveState": "active", "SubState": "running", "Result": "success", "UnitFileState": "enabled"}
NOTES = {
    "installed": {"ActiveState": "inactive", "UnitFileState": "disabled"},
    "preset": {"ActiveState": "inactive", "UnitFileState": "disabled"},
    "no_profile": {"ActiveState": "failed", "Result": "exit-code", "ExecMainStatus": "2", "NRestarts": "0"},
    "no_interface": {"ActiveState": "activating"},
    "came": RUNS,
    "running": {**RUNS, "NRestarts": "0"},
    "reloaded": {**RUNS, "NRestarts": "0"},
    "stalled": {**RUNS, "NRestarts": "1"},
    "killed": {**RUNS, "NRestarts": "2"},
    "upgraded": {"ActiveState": "inactive", "Result": "success", "UnitFileState": "enabled"},
    "stopped": {"ActiveState": "inactive", "Result": "success", "ExecMainStatus": "0"},
    "removed": {"ActiveState": "inactive", "LoadState": "not-found"},
}
# What service.sh brings about, told as an error; and what only an emulated machine lacks.
TOLD = ["graben-ecu: profile 'nothing': there is no such file, nor one of that name in /etc/graben, /usr/share/graben; "
        "wanted: a file or one of dozer_9t, excavator_12t, excavator_22t",
        "graben-ecu: can0: the interface is down (ip -details link show can0)"]
EXPECTED_WARNINGS = re.compile(
    r"graben-ecu.service: (Failed with result|Main process exited|Watchdog timeout)"
    r"|Failed to start graben-ecu.service|Failed to find module 'autofs4'"
    r"|Automount Point unsupported")


def pairs(path: pathlib.Path) -> dict[str, str]:
    return dict(line.split("=", 1) for line in path.read_text().splitlines())


def check_notes(out: pathlib.Path) -> list[str]:
    problems = []
    for name, wanted in NOTES.items():
        found = pairs(out / name)
        problems += [f"{name}: {key} is {found.get(key)} instead of {value}"
                     for key, value in wanted.items() if found.get(key) != value]
    return problems


def check_process(out: pathlib.Path) -> list[str]:
    status = dict(line.split(":", 1) for line in (out / "process").read_text().splitlines())
    status = {key: value.strip() for key, value in status.items()}
    said = (out / "scheduler").read_text()
    print(f"uid {status['Uid'].split()[0]}, {status['VmLck']} locked of {status['VmSize']}, capabilities "
          f"{status['CapEff']}, seccomp {status['Seccomp']}; {' '.join(said.split())}")
    wanted = [("SCHED_FIFO" in said and "priority: 80" in said, "no SCHED_FIFO 80"),
              (status["Uid"].split()[0] != "0", "it runs as root"),
              (not status["VmLck"].startswith("0 "), "its memory is not locked"),
              # IPC_LOCK (14) and SYS_NICE (23).
              (int(status["CapEff"], 16) == int(status["CapBnd"], 16) == 1 << 14 | 1 << 23,
               "it has other capabilities than two"),
              (status["NoNewPrivs"] == "1" and status["Seccomp"] == "2", "it is not confined"),
              ("bitrate 500000" in (out / "link").read_text(), "can0 has not 500 kbit/s"),
              ("graben" not in (out / "left").read_text(), "removed, it has left something")]
    return [what for good, what in wanted if not good]


def between(log: list[Frame], first: int, then: int) -> list[Frame]:
    begin, end = (next(place for place, frame in enumerate(log)
                       if frame.name == MARK and frame.data == bytes([number])) for number in (first, then))
    return log[begin:end]


def commands(part: list[Frame]) -> list[Frame]:
    return [frame for frame in part if frame.name == SPOOL_COMMAND]


def check_gap(log: list[Frame], first: int, then: int, name: str, limits: tuple[float, float]) -> list[str]:
    """Silent for so long, and neutral afterwards."""
    part = between(log, first, then)
    sent = commands(part)
    times = [part[0].time, *(frame.time for frame in sent)]
    gap, place = max((later - earlier, place)
                     for place, (earlier, later) in enumerate(zip(times, times[1:])))
    print(f"{name}: silent for {gap:.3f} s")
    good = limits[0] <= gap <= limits[1] and all(frame.neutral for frame in sent[place:place + 20])
    return [] if good else [f"{name}: silent for {gap:.3f} s instead of {limits}, or then not neutral"]


def check_stop(log: list[Frame], first: int, then: int, name: str, digs: bool) -> list[str]:
    """Neutral, several times, then nothing; in time until the end."""
    problems = []
    part = between(log, first, then)
    sent = commands(part)
    moving = [frame for frame in sent if not frame.neutral]
    calm = sent[len(moving):]
    print(f"{name}: {len(moving)} commands on, then {len(calm)} neutral, then none")
    if bool(moving) != digs or len(calm) < 5 or not all(frame.neutral for frame in calm):
        problems.append(f"{name}: {len(moving)} commands, {len(calm)} neutral")
    late = [later.time - earlier.time for earlier, later in zip(sent, sent[1:])
            if later.time - earlier.time > PERIOD_S + LATE_S]
    if late:
        problems.append(f"{name}: {len(late)} commands late on the way, up to {max(late):.4f} s apart")
    return problems


def check_frames(log: list[Frame], sent: list[Frame]) -> list[str]:
    before = commands(log[:log.index(between(log, STALLED, KILLED)[0])])
    digging = commands(between(log, KILLED, DIGGING))
    healths = [frame for frame in between(sent, KILLED, DIGGING) if frame.name == ECU_HEALTH]
    if not healths:
        return ["no EcuHealth while it digs"]
    health = healths[-1]
    problems = [] if before and all(frame.neutral for frame in before) else ["not neutral without a machine"]
    if all(frame.neutral for frame in digging[-50:]):
        problems.append("it does not dig: nothing is known of how it stops")
    # Allocations, page faults, overruns; whether real time is on.
    if (said := tuple(health.bits(*at) for at in ((32, 4), (40, 8), (48, 8), (36, 2)))) != (0, 0, 0, 1):
        problems.append(f"EcuHealth says {said}")
    silent = commands(between(log, STOPPED, RUNNING)[:1] + between(log, REMOVED, LAST))
    if silent:
        problems.append("it sends although it is removed")
    return [*problems, *check_gap(log, STALLED, KILLED, "stall", STALL_S),
            *check_gap(log, KILLED, DIGGING, "kill", KILL_S),
            *check_stop(log, DIGGING, STOPPED, "stop", digs=True),
            *check_stop(log, RUNNING, REMOVED, "remove", digs=False)]


def check_journal(out: pathlib.Path) -> list[str]:
    said = list(filter(str.strip, (out / "warnings").read_text().splitlines()))
    return [*(f"the journal does not tell: {line}" for line in TOLD if line not in said),
            *(f"the journal warns: {line}" for line in dict.fromkeys(said)
              if line not in TOLD and not EXPECTED_WARNINGS.search(line))]


def libraries_beyond(root_tar: pathlib.Path, program: pathlib.Path) -> dict[str, pathlib.Path]:
    """Those of the program that the root has not got."""
    with tarfile.open(root_tar) as tar:
        there = {pathlib.PurePosixPath(name).name for name in tar.getnames()}
    return {f"lib/{path.name}": path for path in map(pathlib.Path, initramfs.libraries_of(program))
            if path.name not in there}


def main() -> int:
    package, graben, out = map(pathlib.Path, sys.argv[1:])
    graben = graben.with_name("graben-bus")  # It has the command plant.
    try:
        roots = debian_root.fetch()
        scenario = Scenario(
            script=HERE / "service.sh", controllers=2, root=roots / "service.cpio", timeout_s=120.0,
            patience_s=1200.0,
            files={"graben-ecu.deb": package, "graben-bus": graben, PROFILE.name: PROFILE, SIMULATION.name: SIMULATION,
                   **libraries_beyond(roots / "service.tar", graben)})
        result = guest.run(scenario, out, where="vm")
    except Nowhere as reason:
        return guest.give_up("service", reason, "package")
    except Broken as problem:
        print(f"package: {problem}")
        return 1
    if result.status != 0:
        print(tail(result.console), f"\npackage: service.sh ended with status {result.status}")
        return 1
    problems = [*check_notes(out), *check_process(out), *check_frames(bus_log.frames(out / LOG), bus_log.frames(out / SENT_LOG)),
                *check_journal(out)]
    print("\n".join([*problems, f"package: service: {len(problems)} problems, {result.wall_s:.1f} s"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
