#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The optimiser's cost and accuracy beside general solvers, on every reference case."""

import argparse
import datetime
import json
import pathlib
import statistics
import subprocess
import sys

import measure
import table
import verdict

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "build/release/tests/timing"

# How many repetitions of how many seconds at least, and of which cases instructions are counted (0:
# of none): under Callgrind Ipopt takes a second for a case, a hundred times what the others do.
FULL = {"repetitions": 10, "seconds": 5e-4, "stride": 1, "stride_slow": 6}
QUICK = {"repetitions": 3, "seconds": 3e-4, "stride": 10, "stride_slow": 0}
SLOW = "ipopt"


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="./run bench", description=__doc__,
        epilog="Exit status: 0; 1 if one of our own policies is wrong on any case, or a "
               "measurement fails; 2 for wrong usage.")
    parser.add_argument("--quick", action="store_true",
                        help="three short repetitions; instructions of every tenth case only, and "
                             "Ipopt's not at all")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE",
                        help="write every figure, and every case's, to FILE")
    parser.add_argument("--cases", type=pathlib.Path, metavar="FILE",
                        default=ROOT / "tests/vectors/mcv.jsonl",
                        help="cases with what is expected (default: tests/vectors/mcv.jsonl)")
    options = parser.parse_args()
    if options.json and not options.json.resolve().parent.is_dir():
        parser.error(f"argument --json: no folder {options.json.parent}")
    try:
        options.expects = expectations(options.cases)
    except (OSError, ValueError) as error:
        parser.error(f"argument --cases: {error}")
    return options


def expectations(path: pathlib.Path) -> dict[int, dict]:
    """By line, from 1."""
    expects = {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        try:
            expect = json.loads(line)["expect"]
            expects[number] = {key: float(expect[key]) for key in verdict.OWN.values()}
        except (KeyError, TypeError, ValueError) as error:
            raise ValueError(f"{path}:{number}: no case with expectations: {error!r}") from error
    if not expects:
        raise ValueError(f"{path}: no cases")
    return expects


def say(what: str):
    print(f"graben: {what}", file=sys.stderr, flush=True)


def cpu_model() -> str:
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return "unknown processor"


def revision() -> str:
    try:
        done = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty"],
                              capture_output=True, text=True, check=False)
    except OSError:
        return "unknown"
    return done.stdout.strip() or "unknown"


def measured(options: argparse.Namespace) -> dict:
    plan = QUICK if options.quick else FULL
    say("timing (nothing else should run now)")
    timings, context = measure.times(PROGRAMS, options.cases, plan["repetitions"],
                                     plan["seconds"])
    solvers = list(dict.fromkeys(solver for solver, _ in sorted_pairs(timings)))
    strides = {s: plan["stride_slow" if s == SLOW else "stride"] for s in solvers}
    say("counting instructions")
    counts = measure.instructions(PROGRAMS, options.cases, strides)
    rows = [table.row_of(s, {n: t for (own, n), t in timings.items() if own == s},
                         {n: c for (own, n), c in counts.items() if own == s}, options.expects)
            for s in solvers]
    table.compare(rows)
    return {
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "revision": revision(),
        "processor": cpu_model(),
        "compiler": context["compiler"],
        "cases": len(options.expects),
        "cases_held": sum(map(table.is_held, options.expects.values())),
        "repetitions": plan["repetitions"],
        "spread_median": statistics.median(t.spread for t in timings.values()),
        "instructions_of_every": strides,
        "own_faults": [f"{s}, line {n}: {fault}" for (s, n), t in sorted(timings.items())
                       if (fault := verdict.own_fault(s, t, options.expects[n]))],
        "solvers": rows,
    }


def sorted_pairs(timings: dict) -> list:
    """Ours first, the others as they come; the slowest last."""
    total = {}
    for (solver, _), timing in timings.items():
        total[solver] = total.get(solver, 0.0) + timing.time_ns
    own = list(verdict.OWN)
    return sorted(timings, key=lambda pair: (own.index(pair[0]) if pair[0] in own else len(own),
                                             total[pair[0]]))


def ordinal(stride: int) -> str:
    return {0: "not counted", 1: "every case"}.get(stride, f"every {stride}th case")


def report(result: dict) -> str:
    strides = result["instructions_of_every"]
    usual = strides["global"]
    others = "".join(f", {s}: {ordinal(n)}" for s, n in strides.items() if n != usual)
    return "\n".join([
        f"{result['cases']} cases, {result['date']}, revision {result['revision']}",
        f"{result['processor']}, {result['compiler']}",
        "",
        *table.lines_of(result["solvers"]),
        "",
        "One solve, from machine and input to lambda. Median, 99th percentile and maximum over the "
        "cases;",
        f"held: median over the {result['cases_held']} in which something holds lambda below 1.",
        f"time: of each case the least of {result['repetitions']} repetitions, all solvers' "
        f"shuffled; warm caches; the usual repetition takes {100 * result['spread_median']:.0f} % "
        "more.",
        f"instructions: by Callgrind, {ordinal(usual)}{others}.",
        "error of lambda: distance from the largest feasible lambda, worst case; right: of those "
        "within 1e-6.",
        "missed: ended at a smaller local maximum; wrong: at neither; infeasible: returned what "
        "the circuit can't do.",
    ])


def main() -> int:
    options = arguments()
    result = measured(options)
    print(report(result))
    if options.json:
        try:
            options.json.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
        except OSError as error:
            measure.fail(f"can't write {options.json}: {error.strerror}")
    for fault in result["own_faults"]:
        say(f"WRONG: {fault}")
    return 1 if result["own_faults"] else 0


if __name__ == "__main__":
    sys.exit(main())
