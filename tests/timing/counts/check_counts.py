# SPDX-License-Identifier: Apache-2.0
"""How many instructions a controller's cycle and a solve cost at most, against observed.json.

  check_counts.py BUILD             fails where a maximum is more than 10 % above what is committed
  check_counts.py BUILD --thorough  tries more, and fails from 2 % on (--strict: that alone)
  check_counts.py BUILD --update    writes what it found into observed.json
  check_counts.py --table           prints observed.json as a table (tests/README.md has it)

BUILD is a build of any target; the traces that it replays are recorded by the host's release build.
The scripts are those of cases/: what has cost most, group by group (search.py). An observed
maximum, not a WCET bound: caches, contention and a kernel's work are outside.
"""

import argparse
import json
import pathlib
import sys
import time

import counting
import enumeration

# Another compiler moves a count by some percent, and what a change costs is not to be known before it is
# done: in ./test only what nobody would have wanted is red.
ALLOWED, ALLOWED_STRICT = 0.10, 0.02
# Cycles that end in another mode than on the host: another C library's last bit may decide.
OTHER_MODE = 0.01
GROUPS = ("22t", "22t-queue", "12t", "12t-queue", "dozer", "dozer-queue", "solve", "solve-any")
TITLES = ("22 t", "22 t, full queue", "12 t", "12 t, full queue", "dozer", "dozer, full queue",
          "solve", "solve, any valve")


def observed(path: pathlib.Path) -> dict:
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def table(known: dict) -> str:
    rows = [["target", *TITLES], ["---", *["---:"] * len(TITLES)]]
    for target in sorted(known):
        rows.append([target, *[f"{known[target][group]['count']:,}".replace(",", " ")
                               if group in known[target] else "-" for group in GROUPS]])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def count_all(bench: counting.Bench, options) -> list[counting.Counted]:
    found = []
    for kind, path in counting.CASES.items():
        scripts = counting.scripts_of(path)
        if options.thorough:
            scripts += enumeration.scripts(kind)
        scripts = [line for line in scripts if options.only in (None, line.split()[0])]
        if scripts:
            found += bench.count(kind, scripts, options.twice)
    if not found:
        counting.fail(f"no case belongs to {options.only}")
    return found


def judge(target: str, most: dict[str, counting.Counted], known: dict, allowed: float) -> list[str]:
    problems = []
    for group, counted in sorted(most.items()):
        committed = known.get(target, {}).get(group)
        if committed is None:
            problems.append(f"{target} {group}: nothing is committed (--update)")
            continue
        more = counted.most / committed["count"] - 1.0
        verdict = ("" if abs(more) <= ALLOWED_STRICT else "  less: --update" if more < 0.0 else
                   "  TOO MUCH" if more > allowed else "  more: --update, if it is meant")
        print(f"{target} {group}: {counted.most}, {100.0 * more:+.2f} %, {counted.place}{verdict}")
        if more > allowed:
            problems.append(f"{target} {group}: {counted.most} instructions, {100.0 * more:.2f} % "
                            f"above the committed {committed['count']}")
    return problems


def replays(found: list[counting.Counted], target: str) -> list[str]:
    """What says that the traces still are what they were recorded for."""
    cycles = sum(len(counted.counts) for counted in found)
    other = sum(counted.other_mode for counted in found)
    print(f"{target}: {cycles} sections of {len(found)} scripts, {other} in another mode")
    problems = [f"{target}: '{counted.script}' replays nothing"
                for counted in found if not counted.counts]
    if other > OTHER_MODE * cycles:
        problems.append(f"{target}: {other} of {cycles} cycles end in another mode than on the host")
    return problems


def update(path: pathlib.Path, target: str, most: dict[str, counting.Counted]):
    known = observed(path)
    known.setdefault(target, {}).update(
        {group: {"count": counted.most, "case": counted.place} for group, counted in most.items()})
    path.write_text(json.dumps(known, indent=2, sort_keys=True) + "\n", encoding="utf-8")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=pathlib.Path)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--twice", action="store_true", help="counts have to be the same again")
    parser.add_argument("--thorough", action="store_true",
                        help="strict; also all boundaries, all fault rows, whole tasks (enumeration.py)")
    parser.add_argument("--strict", action="store_true", help="what is more than 2 %% above is red")
    parser.add_argument("--only", metavar="GROUP")
    parser.add_argument("--burn", type=int, default=0, metavar="N",
                        help="so many wasted instructions in each section")
    parser.add_argument("--observed", type=pathlib.Path, default=counting.OBSERVED)
    parser.add_argument("--table", action="store_true")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    if options.table:
        print(table(observed(options.observed)))
        return 0
    if options.build is None:
        counting.fail("BUILD is missing")
    began = time.monotonic()
    bench = counting.Bench(options.build, options.burn)
    found = count_all(bench, options)
    most = counting.maxima(found)
    problems = replays(found, bench.target)
    before = observed(options.observed)
    options.strict = options.strict or options.thorough
    if options.update:
        update(options.observed, bench.target, most)
    # A thorough run says what it changes; by itself --update is how a change is taken over.
    problems += judge(bench.target, most, before if options.thorough else observed(options.observed),
                      ALLOWED_STRICT if options.strict else ALLOWED)
    committed = set(observed(options.observed).get(bench.target, {}))
    if options.only is None:
        problems += [f"{bench.target} {group}: committed, and no case of it is left"
                     for group in sorted(committed - set(most))]
    print("\n".join([*problems,
                     f"counts: {len(problems)} problems, {time.monotonic() - began:.1f} s"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
