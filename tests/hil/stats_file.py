# SPDX-License-Identifier: Apache-2.0
"""What graben-ecu --stats leaves: counters, and histograms as cyclictest -h prints them."""

import pathlib
import re

COUNTER = re.compile(r"^# (\w+) (.+)$", re.MULTILINE)
TOTALS = re.compile(r"^# ((?:\w+ )*\w+):((?: \d+)+)$", re.MULTILINE)
# Threads, as cyclictest would call them.
WAKE_UP, CYCLE = 0, 1
# None of these may ever count while nothing is broken on purpose.
NEVER = ("overruns", "skipped_periods", "allocations", "page_faults", "frames_rejected",
         "frames_dropped", "receive_overflow", "error_frames", "reopened")


def counters(text: str) -> dict[str, str]:
    """The `# name value` lines."""
    return dict(COUNTER.findall(text.partition("# Columns:")[0]))


def rows(text: str) -> list[list[int]]:
    """What is left for a plot once the comments are gone: microseconds, counts."""
    return [[int(word) for word in line.split()] for line in text.splitlines()
            if line and not line.startswith("#")]


def check_form(text: str) -> list[str]:
    """Whether the histograms say the same as their totals and as the counters."""
    table, stats = rows(text), counters(text)
    totals = {name: [int(word) for word in words.split()] for name, words in TOTALS.findall(text)}
    problems = []
    if [row[0] for row in table] != list(range(len(table))) or {len(row) for row in table} != {3}:
        return ["its rows are not microseconds from 0 on with a count for each of two threads"]
    for thread, name in ((WAKE_UP, "wake_up_latency"), (CYCLE, "cycle_time")):
        counts = [row[1 + thread] for row in table]
        if sum(counts) != totals["Total"][thread]:
            problems.append(f"{name}: {sum(counts)} in its rows, {totals['Total'][thread]} in all")
        for line, figure in (("Min", "min"), ("Avg", "mean"), ("Max", "max")):
            if totals[f"{line} Latencies"][thread] != int(stats[f"{name}_{figure}_ns"]) // 1000:
                problems.append(f"{name}: {line} Latencies is not {figure}_ns")
        seen_us = [us for us, count in enumerate(counts) if count]
        if totals["Histogram Overflows"][thread] == 0 and totals["Max Latencies"][thread] != seen_us[-1]:
            problems.append(f"{name}: its last row is not its maximum")
        if totals["Min Latencies"][thread] != seen_us[0]:
            problems.append(f"{name}: its first row is not its minimum")
    return problems


def check_counters(stats: dict[str, str], babbled_to: bool) -> list[str]:
    """A controller that is babbled to refuses what is more than a few frames of a message a cycle."""
    never = [name for name in NEVER if not (babbled_to and name == "frames_rejected")]
    problems = [f"{name} {stats[name]}, expected 0" for name in never if stats[name] != "0"]
    if babbled_to and stats["frames_rejected"] == "0":
        problems.append("frames_rejected 0, expected what is too many of them")
    return problems if stats["real_time"] == "1" else [*problems, "not real time"]


def durations(stats: dict[str, str]) -> str:
    """min / mean / max of both, in microseconds."""
    return "   ".join(
        " / ".join(f"{int(stats[f'{name}_{figure}_ns']) * 1e-3:6.1f}" for figure in ("min", "mean", "max"))
        for name in ("wake_up_latency", "cycle_time"))


def read(path: pathlib.Path, babbled_to: bool = False) -> tuple[dict[str, str], list[str]]:
    """Its counters, and what is wrong with it."""
    text = path.read_text()
    stats = counters(text)
    return stats, [*check_counters(stats, babbled_to), *check_form(text)]
