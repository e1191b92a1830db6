# SPDX-License-Identifier: Apache-2.0
"""Runs the two measuring programs; what comes back is keyed by (solver, line of the case)."""

import contextlib
import dataclasses
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

PART = re.compile(rb"^desc: Trigger: Client Request: (\S+)/(\d+)$")
SUMMARY = re.compile(rb"^summary: (\d+)$")


@dataclasses.dataclass
class Timing:
    time_ns: float  # the least of the repetitions' means
    spread: float  # their median over that, less 1
    returned: float
    margin: float  # of the plain circuit at the lambda returned
    margin_below: float  # the same 1e-6 below
    margin_above: float


def fail(what: str):
    sys.exit(f"./run bench: {what}")


def run(command: list) -> subprocess.Popen:
    try:
        return subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    except OSError as error:
        fail(f"can't start {command[0]}: {error.strerror}")


def wait(process: subprocess.Popen, what: str):
    _, errors = process.communicate()
    if process.returncode != 0:
        fail(f"{what} failed with status {process.returncode}\n{errors.rstrip()}")


def times(programs: pathlib.Path, cases: pathlib.Path, repetitions: int, seconds: float):
    """(timings, Google Benchmark's context). The repetitions of all pairs are shuffled, so that
    what disturbs the machine for a while disturbs every solver alike."""
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder, "times.json")
        wait(run([programs / "time_solvers", cases, f"--benchmark_repetitions={repetitions}",
                  f"--benchmark_min_time={seconds}",
                  "--benchmark_enable_random_interleaving=true",
                  f"--benchmark_out={output}", "--benchmark_out_format=json"]), "time_solvers")
        report = json.loads(output.read_text())
    runs = {}
    for entry in report["benchmarks"]:
        if entry["run_type"] == "iteration":
            solver, line = entry["run_name"].split("/")
            runs.setdefault((solver, int(line)), []).append(entry)
    found = {}
    for pair, entries in runs.items():
        each = [entry["real_time"] for entry in entries]
        first = entries[0]
        found[pair] = Timing(min(each), statistics.median(each) / min(each) - 1.0,
                             first["lambda"], first["margin"], first["margin_below"],
                             first["margin_above"])
    return found, report["context"]


def parts(profile: pathlib.Path) -> dict[tuple[str, int], int]:
    counts, pair = {}, None
    with profile.open("rb") as stream:
        for line in stream:
            if part := PART.match(line):
                pair = (part[1].decode(), int(part[2]))
            elif pair and (summary := SUMMARY.match(line)):
                counts[pair], pair = int(summary[1]), None
    return counts


def instructions(programs: pathlib.Path, cases: pathlib.Path, strides: dict[str, int]):
    """Instructions of one solve, for every stride-th case of each solver; 0: for none. Solvers of
    different strides are counted at the same time: a count does not depend on what else runs."""
    counts = {}
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:
        started = []
        for stride in sorted(set(strides.values()) - {0}):
            profile = pathlib.Path(folder, f"callgrind.{stride}")
            solvers = [solver for solver, own in strides.items() if own == stride]
            process = run(["valgrind", "--tool=callgrind", "--collect-atstart=no",
                           "--combine-dumps=yes", f"--callgrind-out-file={profile}",
                           programs / "count_instructions", cases, stride, *solvers])
            stack.callback(process.kill)
            started.append((process, profile))
        for process, profile in started:
            wait(process, "valgrind")
            counts.update(parts(profile))
    return counts
