# SPDX-License-Identifier: Apache-2.0
"""Proves that the judges of timing and memory can say no: canary_timing.py OUT takes what hil_timing
left, as it is, then with one figure of it changed."""

import pathlib
import re
import sys
from collections.abc import Callable

import resident
import timing
from canary_judge import prove

RUN = timing.RUNS[0]
HEARD = next(run for run in timing.RUNS if run.identifier)


def edit(path: pathlib.Path, pattern: str, becomes: Callable[[re.Match], str]):
    before = path.read_text()
    path.write_text(re.sub(pattern, becomes, before, count=1, flags=re.MULTILINE))
    assert path.read_text() != before, f"{path.name} is another one: the seed has no effect"


def in_stats(counter: str, change: Callable[[int], int]):
    return lambda out: edit(out / "first" / f"{RUN.name}.stats", rf"^# {counter} (\d+)$",
                            lambda found: f"# {counter} {change(int(found[1]))}")


def unloaded(out: pathlib.Path):
    """One frame in ten was not sent."""
    begin = float((out / "first" / f"{RUN.name}.frames").read_text().split()[0])
    edit(out / "first" / f"{RUN.name}.frames", r"\n(\d+) ",
         lambda found: f"\n{round(begin + 0.9 * (float(found[1]) - begin))} ")


def lost_row(out: pathlib.Path):
    edit(out / "first" / f"{RUN.name}.stats", r"^(\d{6} \d{6})\t0*[1-9]\d*$",
         lambda found: f"{found[1]}\t000000")


def unheard(out: pathlib.Path):
    edit(out / "first" / f"{HEARD.name}.stats", r"^# frames_received \d+$",
         lambda _: "# frames_received 4000")


def none_refused(out: pathlib.Path):
    edit(out / "first" / f"{HEARD.name}.stats", r"^# frames_rejected \d+$",
         lambda _: "# frames_rejected 0")


def another(out: pathlib.Path):
    edit(timing.boots_of(out)[-1] / f"{RUN.name}.stats", r"_mean_ns (\d+)$",
         lambda found: f"_mean_ns {int(found[1]) + 1}")


def in_memory(name: str, size_kb: int):
    return lambda out: edit(out / "first" / "memory", rf"^{name}:\s+\d+ kB$",
                            lambda _: f"{name}: {size_kb} kB")


def judge(out: pathlib.Path) -> list[str]:
    return [*timing.check(out / "first"), *timing.check_again(timing.boots_of(out)),
            *resident.check(out / "first" / "memory")]


CASES = {
    "an overrun": (in_stats("overruns", lambda _: 1), "full: overruns 1, expected 0"),
    "a page fault": (in_stats("page_faults", lambda _: 1), "full: page_faults 1, expected 0"),
    "a refused frame": (in_stats("frames_rejected", lambda _: 1), "full: frames_rejected 1, expected 0"),
    "all of a babble": (none_refused, "heard: frames_rejected 0, expected what is too many"),
    "slow": (in_stats("cycle_time_max_ns", lambda ns: 2 * ns), "cycle_time up to"),
    "woken late": (in_stats("wake_up_latency_max_ns", lambda ns: 3 * ns), "wake_up_latency up to"),
    "little load": (unloaded, r"the bus was filled to (89|9\d)\.\d% instead of 100%"),
    "a load that is not heard": (unheard, "frames to hear, 4000 heard"),
    "a lost row": (lost_row, r"cycle_time: \d+ in its rows, \d+ in all"),
    "another time": (another, "booted again, full.stats is another one"),
    "resident": (in_memory("Rss", 6145), "6145 kB resident, .* 6144 kB is the most"),
    "locked": (in_memory("VmLck", 6145), "6145 kB locked, 6144 kB is the most"),
    "not locked": (in_memory("VmLck", 0), "^0 kB locked of"),
}


def main() -> int:
    left = pathlib.Path(sys.argv[1])
    return prove("timing", left, timing.boots_of(left)[-1] / "console.txt", judge, CASES)


if __name__ == "__main__":
    sys.exit(main())
