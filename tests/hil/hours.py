# SPDX-License-Identifier: Apache-2.0
"""The real process for hours on a real CAN kernel: hours.py OUT SECONDS GRABEN_ECU GRABEN. At the end memory, threads,
open files and store are as 20 s after the start, no cycle has allocated, faulted a page in or come late, and the machine
has dug all the time."""

import json
import pathlib
import re
import sys

import resident
import run_programs
import stats_file

# Pages of the kernel's own that a process has on its account.
MOST_GROWTH_KB = 16
LOOP_S = 25.0


def figures(path: pathlib.Path) -> dict[str, int]:
    text = path.read_text()
    return {"Rss": resident.kb(text, "Rss"),
            **{name: int(re.search(rf"^{name}:\s+(\d+)$", text, re.MULTILINE)[1])
               for name in ("Threads", "OpenFiles", "StoreFiles")}}


def check(seconds: float, out: pathlib.Path) -> list[str]:
    stats, problems = stats_file.read(out / "stats")
    first, last = figures(out / "first"), figures(out / "last")
    summary = json.loads((out / "summary.json").read_text())
    print(f"hours: {int(stats['cycles'])} cycles, {summary['loops']:.0f} loops, first {first}, last {last}")
    print(f"hours: wake-up and cycle, us: {stats_file.durations(stats)}")
    if last["Rss"] > first["Rss"] + MOST_GROWTH_KB or any(last[name] != first[name] for name in ("Threads", "OpenFiles")):
        problems.append(f"it has grown: {first}, {last}")
    if int(stats["cycles"]) < 100 * seconds or summary["loops"] < seconds / LOOP_S - 2:
        problems.append(f"{stats['cycles']} cycles, {summary['loops']} loops")
    if stats["address_lost"] != "0" or int(stats["claims_defended"]) < seconds / 10 or stats["store_dropped"] != "0":
        problems.append(f"claims kept off {stats['claims_defended']}, lost {stats['address_lost']}, store {stats['store_dropped']}")
    return [*problems, *resident.check(out / "memory")]


def main() -> int:
    out, seconds = pathlib.Path(sys.argv[1]), float(sys.argv.pop(2))
    told = out.with_suffix(".seconds")
    told.parent.mkdir(parents=True, exist_ok=True)
    told.write_text(f"{seconds:g}\n")
    return run_programs.main("hours.sh", lambda at: check(seconds, at), timeout_s=seconds + 120.0, extra={"seconds": told})


if __name__ == "__main__":
    sys.exit(main())
