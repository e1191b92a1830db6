# SPDX-License-Identifier: Apache-2.0
"""How long a cycle takes, kernel included, and how late it begins, by the load of the bus:
timing.py OUT PROGRAM... boots once for all runs of the table, then again for the first of them, which
has to give the same histograms. The emulator's clock counts instructions, but when its devices are
served is up to the host. One boot that went another way was seen (2026-11-22), and one first boot that
none of the next three was as (2026-11-25), so up to three more are tried, until two of all are the same.
What is printed is an observed maximum, no bound."""

import dataclasses
import json
import pathlib
import shutil
import sys
import tempfile

import run_programs
import stats_file
from machine import NS_PER_INSTRUCTION

HERE = pathlib.Path(__file__).resolve().parent


@dataclasses.dataclass(frozen=True)
class Run:
    name: str
    # Of the bus in all; 0: what the controller and its machine send.
    percent: int
    profile: str
    operator: str
    seconds: float
    # Largest seen of all lengths and orders of the runs, ns; 2026-11-24, GCC 12.2, kernel 6.1.192. Runs
    # whose load the filters keep away do the same work: they have one figure, the largest of them. The
    # dozer's is of 2026-11-26: its preview now moves the body over the ground ahead.
    wake_up_ns: int
    cycle_ns: int
    # Of the frames that fill the bus, if the controller is to hear them.
    identifier: str = ""

    def line(self) -> str:
        return (f"{self.name} {self.percent} {self.profile} {self.operator} {self.seconds:g} "
                f"{self.identifier}\n")


EXCAVATOR, DOZER = ("excavator_22t.toml", "dig", 4.4), ("dozer_9t.toml", "grade", 3.2)
# EEC1: no counter, no checksum, so that a copy of the last one is as good as that.
EEC1 = "0CF00400"
RUNS = [
    Run("full", 100, *EXCAVATOR, wake_up_ns=27_000, cycle_ns=491_000),
    Run("own", 0, *EXCAVATOR, wake_up_ns=27_000, cycle_ns=491_000),
    Run("half", 50, *EXCAVATOR, wake_up_ns=27_000, cycle_ns=491_000),
    Run("heard", 100, *EXCAVATOR, wake_up_ns=27_000, cycle_ns=613_000, identifier=EEC1),
    Run("dozer", 100, *DOZER, wake_up_ns=27_000, cycle_ns=564_000),
]
# The same programs on the same kernel give the same nanoseconds. Another compiler or kernel does not,
# nor does another moment of the kernel's tick: by that alone, in four orders and lengths of the runs and
# on four machines, the largest wake-up differed by 5 us and the largest cycle of one run by 15 %; on a
# host with other work a wake-up of 42 us was seen once (2026-11-25).
WAKE_UP_MARGIN_NS, CYCLE_MARGIN = 20_000, 0.20
SLOT_S = 320e-6
SHARE_MARGIN = 0.03
OWN_SHARE = (0.30, 0.45)
ENABLED_S = 1.0
AGAIN_MOST = 3


def bus_share(out: pathlib.Path, run: Run) -> float:
    """Frames by the interface's own count, over as many as a full bus carries."""
    begin, end = ([float(word) for word in line.split()]
                  for line in (out / f"{run.name}.frames").read_text().splitlines())
    return (end[0] - begin[0]) * SLOT_S / (end[1] - begin[1])


def check_load(out: pathlib.Path, run: Run, received: int) -> list[str]:
    share = bus_share(out, run)
    if not run.percent:
        return [] if OWN_SHARE[0] < share < OWN_SHARE[1] else [f"own frames fill {share:.1%} of the bus"]
    wanted = run.percent / 100
    problems = [] if abs(share - wanted) < SHARE_MARGIN * wanted else [
        f"the bus was filled to {share:.1%} instead of {wanted:.0%}"]
    words = (out / f"{run.name}.generator").read_text().split()
    heard, sent = int(words[3]), int(words[5])
    # The load begins before the controller and ends after it.
    if run.identifier and received < 0.9 * sent:
        problems.append(f"{sent} frames to hear, {received} heard")
    if not run.identifier and received > heard:
        problems.append(f"{received} frames heard of {heard}: the filters let the load through")
    return problems


def check_run(out: pathlib.Path, run: Run) -> list[str]:
    stats, problems = stats_file.read(out / f"{run.name}.stats", babbled_to=bool(run.identifier))
    for figure, most in (("wake_up_latency", run.wake_up_ns + WAKE_UP_MARGIN_NS),
                         ("cycle_time", round(run.cycle_ns * (1 + CYCLE_MARGIN)))):
        if (seen := int(stats[f"{figure}_max_ns"])) > most:
            problems.append(f"{figure} up to {seen} ns, {most} ns is the most")
    summary = json.loads((out / f"{run.name}.json").read_text())
    if summary["enabled_s"] < ENABLED_S:
        problems.append(f"at work for {summary['enabled_s']:.2f} s only")
    problems += [f"{name} of the machine {summary[name]}"
                 for name in ("command_timeouts", "frames_dropped", "late_cycles") if summary[name]]
    problems += check_load(out, run, int(stats["frames_received"]))
    print(f"{run.name:6} {run.profile:19} {bus_share(out, run):6.1%}   {stats_file.durations(stats)}   "
          f"{stats['cycles']:>5} {stats['overruns']:>3} {stats['page_faults']:>3}")
    return [f"{run.name}: {problem}" for problem in problems]


def check(out: pathlib.Path) -> list[str]:
    print(f"us of the guest's clock, {NS_PER_INSTRUCTION} ns an instruction; min / mean / max\n"
          f"{'':27}bus       wake-up latency              cycle time        cycles, overruns, page faults")
    return [problem for run in RUNS for problem in check_run(out, run)]


def boots_of(out: pathlib.Path) -> list[pathlib.Path]:
    return [out / "first", *sorted(out.glob("again_*"))]


def check_again(boots: list[pathlib.Path]) -> list[str]:
    """The last of the boots against those before it."""
    name = f"{RUNS[0].name}.stats"
    *before, last = [(boot / name).read_bytes() for boot in boots]
    same = last in before
    print(f"booted again: {name} is {'the same, byte for byte' if same else 'ANOTHER one'}")
    return [] if same else [f"booted again, {name} is another one"]


def loads(last: int) -> str:
    """The runs, of which all after `last` are behind the end. As many bytes for any: up to there
    one guest is as the other, instruction for instruction."""
    lines = [run.line() for run in RUNS]
    return "".join([*lines[:last], "end\n", *lines[last:]])


def boot(out: pathlib.Path, programs: list[pathlib.Path], last: int, judge) -> int:
    with tempfile.TemporaryDirectory() as folder:
        told = pathlib.Path(folder) / "loads"
        told.write_text(loads(last))
        return run_programs.run("timing.sh", out, programs, judge, timeout_s=120.0,
                                extra={"loads": told})


def main() -> int:
    out, *programs = map(pathlib.Path, sys.argv[1:])
    first = out / "first"
    for left in boots_of(out)[1:]:
        shutil.rmtree(left)
    if (status := boot(first, programs, len(RUNS), check)) or not (first / "console.txt").exists():
        return status
    for again in range(AGAIN_MOST):
        status = boot(out / f"again_{again}", programs, 1, lambda _: check_again(boots_of(out)))
        if not status:
            break
    return status


if __name__ == "__main__":
    sys.exit(main())
