# SPDX-License-Identifier: Apache-2.0
"""How soon `graben drift` sees what wears, and how often it sees what does not: hidden machines, a log a day in which one
thing grows from day to day. 2.4 CPU seconds a log. drift_campaign.py GRABEN [--machines 5] [--days 10] [--kinds leak3,healthy] [--judge]

Prints what came of each machine, then a row for each kind: of how many machines its work order was there with the first log in which it had half of its
final size, and work orders of anything else, of so many days. With --judge the status is 1 where a kind is seen by then on fewer than 90 % of the machines, or
more than one order in 1000 days is of something else.
"""

import argparse
import json
import multiprocessing
import pathlib
import subprocess
import sys
import tempfile

DAY_S = 86400.0
BEGIN_S = 1788307200.0  # 2 September 2026, 00:00 UTC.

SEEN = 0.9
FALSE_PER_DAY = 1e-3

# What is told of the machine when a share of it has grown, and the figure that has to show it.
KINDS = {
    "healthy": (lambda share: "", None),
    "leak2": (lambda share: f"piston_leak={1 + share:.4f}", "leakage, closed"),
    "leak3": (lambda share: f"piston_leak={1 + 2 * share:.4f}", "leakage, closed"),
    "leak5": (lambda share: f"piston_leak={1 + 4 * share:.4f}", "leakage, closed"),
    "pump5": (lambda share: f"pump_flow={1 - 0.05 * share:.5f}", "flow, of the profile's"),
    "pump10": (lambda share: f"pump_flow={1 - 0.1 * share:.5f}", "flow, of the profile's"),
    "band2": (lambda share: f"dead_band_more={0.02 * share:.5f}", "dead band's edge"),
    "zero5": (lambda share: f"stroke_zero_more={0.005 * share:.6f}", "stroke's zero"),
}


def dated(file, begin_s):
    """The log's stamps as those of a day."""
    with open(file, encoding="ascii") as stream:
        lines = [f"({float(line[1:line.index(')')]) + begin_s:.6f}{line[line.index(')'):]}" for line in stream]
    file.write_text("".join(lines), encoding="ascii")


def figures_of(job):
    """Per figure its kind and the day from which on it was beyond its noise, or None."""
    graben, kind, machine, days = job
    with tempfile.TemporaryDirectory() as name:
        logs = []
        for day in range(days):
            log = pathlib.Path(name) / f"day{day}.log"
            found = KINDS[kind][0](day / (days - 1))
            subprocess.run([graben, "commission", "--profile", "excavator_22t", "--hidden", str(machine), "--seed",
                            str(1000 * machine + day), *(["--found", found] if found else []), "--log", log],
                           check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            # One that stopped on its way is a log too.
            dated(log, BEGIN_S + day * DAY_S + 8 * 3600)
            logs.append(log)
        summary = pathlib.Path(name) / "drift.json"
        done = subprocess.run([graben, "drift", *logs, "--profile", "excavator_22t", "--summary", summary],
                              capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        said = json.loads(summary.read_text())
    rows = []
    for figure in said["figures"]:
        beyond_s = figure["first_beyond_s"]
        rows.append((figure["figure"], figure["part"], None if beyond_s is None else int((beyond_s - BEGIN_S) // DAY_S)))
    return kind, machine, rows, said


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("graben")
    parser.add_argument("--machines", type=int, default=5)
    parser.add_argument("--first", type=int, default=1, help="Seed of the first machine")
    parser.add_argument("--days", type=int, default=10)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--judge", action="store_true", help="Status 1 where the bounds are missed")
    parser.add_argument("--summary", help="All that drift said, as JSON")
    asked = parser.parse_args()
    half_day = -(-(asked.days - 1) // 2)
    jobs = [(asked.graben, kind, machine, asked.days) for machine in range(asked.first, asked.first + asked.machines)
            for kind in asked.kinds.split(",")]
    results = []
    with multiprocessing.Pool(asked.jobs) as pool:
        for result in pool.imap_unordered(figures_of, jobs):
            results.append(result)
            beyond = [f"{part}: {what}, day {day}" for what, part, day in result[2] if day is not None]
            print(f"  {result[0]}, machine {result[1]}: {'; '.join(beyond) or 'no order'}", flush=True)
    missed = []
    false_orders = 0
    for kind in asked.kinds.split(","):
        mine = [result for result in results if result[0] == kind]
        wanted = KINDS[kind][1]
        firsts = [min((day for what, _, day in rows if what == wanted and day is not None), default=None)
                  for _, _, rows, _ in mine]
        false = [f"{part}: {what} (machine {machine}, day {day})" for _, machine, rows, _ in mine
                 for what, part, day in rows if day is not None and what != wanted]
        seen = sum(first is not None and first <= half_day for first in firsts)
        false_orders += len(false)
        if wanted is not None and seen < SEEN * len(mine):
            missed.append(f"{kind}: seen in time on {seen} of {len(mine)}")
        # What grows grows in all parts alike: of one part alone is what counts for a fault of one.
        parts = [day for _, _, rows, _ in mine for what, _, day in rows if what == wanted]
        of_parts = sum(day is not None and day <= half_day for day in parts)
        text = "" if wanted is None else (f"seen by half of its size on {seen} of {len(mine)} machines, first days {firsts}, "
                                          f"in {of_parts} of {len(parts)} parts; ")
        print(f"{kind:<8} {text}{len(false)} false orders in {len(mine) * asked.days} days {'; '.join(false)}", flush=True)
    if false_orders > FALSE_PER_DAY * len(results) * asked.days:
        missed.append(f"{false_orders} false orders in {len(results) * asked.days} days")
    if asked.summary:
        pathlib.Path(asked.summary).write_text(json.dumps([result[3] | {"kind": result[0], "machine": result[1]}
                                                           for result in results]))
    if missed:
        print(f"missed: {'; '.join(missed)}")
    return 1 if missed and asked.judge else 0


if __name__ == "__main__":
    sys.exit(main())
