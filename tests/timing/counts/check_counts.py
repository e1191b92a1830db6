"""How many instructions a controller's cycle and a solve cost at most, against observed.json.

  check_counts.py BUILD            fails where a maximum is more than 2 % above what is committed
  check_counts.py BUILD --update   writes what it found into observed.json
  check_counts.py --table          prints observed.json as the README's table
  check_counts.py --readme FILE    fails unless FILE has that table; with --update writes it there

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

ALLOWED = 0.02
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


def check_readme(path: pathlib.Path, known: dict, renew: bool) -> list[str]:
    """The table's lines follow each other, the head first."""
    lines, wanted = path.read_text(encoding="utf-8").splitlines(), table(known).splitlines()
    if wanted[0] not in lines:
        return [f"{path.name}: no table begins with '{wanted[0]}'"]
    begin = end = lines.index(wanted[0])
    while end < len(lines) and lines[end].startswith("|"):
        end += 1
    if renew:
        path.write_text("\n".join([*lines[:begin], *wanted, *lines[end:]]) + "\n", encoding="utf-8")
        return []
    return [f"{path.name}: '{line}' is not in its table"
            for line in wanted if line not in lines[begin:end]] + [
                f"{path.name}: '{line}' is not committed in {counting.OBSERVED.name}"
                for line in lines[begin:end] if line not in wanted]


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


def judge(target: str, most: dict[str, counting.Counted], known: dict) -> list[str]:
    problems = []
    for group, counted in sorted(most.items()):
        committed = known.get(target, {}).get(group)
        if committed is None:
            problems.append(f"{target} {group}: nothing is committed (--update)")
            continue
        more = counted.most / committed["count"] - 1.0
        verdict = "" if abs(more) <= ALLOWED else "  less: --update" if more < 0.0 else "  TOO MUCH"
        print(f"{target} {group}: {counted.most}, {100.0 * more:+.2f} %, {counted.place}{verdict}")
        if more > ALLOWED:
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
                        help="also all boundaries, all fault rows, whole tasks (enumeration.py)")
    parser.add_argument("--only", metavar="GROUP")
    parser.add_argument("--burn", type=int, default=0, metavar="N",
                        help="so many wasted instructions in each section")
    parser.add_argument("--observed", type=pathlib.Path, default=counting.OBSERVED)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--readme", type=pathlib.Path, metavar="FILE")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    if options.table:
        print(table(observed(options.observed)))
        return 0
    if options.readme:
        problems = check_readme(options.readme, observed(options.observed), options.update)
        print("\n".join([*problems, f"counts: {len(problems)} problems"]))
        return 1 if problems else 0
    if options.build is None:
        counting.fail("BUILD is missing")
    began = time.monotonic()
    bench = counting.Bench(options.build, options.burn)
    found = count_all(bench, options)
    most = counting.maxima(found)
    problems = replays(found, bench.target)
    if options.update:
        update(options.observed, bench.target, most)
    problems += judge(bench.target, most, observed(options.observed))
    committed = set(observed(options.observed).get(bench.target, {}))
    if options.only is None:
        problems += [f"{bench.target} {group}: committed, and no case of it is left"
                     for group in sorted(committed - set(most))]
    print("\n".join([*problems,
                     f"counts: {len(problems)} problems, {time.monotonic() - began:.1f} s"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
