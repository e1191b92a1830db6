# SPDX-License-Identifier: Apache-2.0
"""Looks for what costs more: changes the scripts of cases/ at random and keeps what beats them.

  search.py BUILD --seconds 600 [--only GROUP]

Counts are those of BUILD's target, the host's by choice. What is kept replaces the cheapest of its
group, cut off behind its dearest cycle. The same seed, cases and code find the same.
"""

import argparse
import dataclasses
import functools
import pathlib
import random
import re
import sys
import time

import counting
import enumeration

KEEP = 6  # scripts of each group
MUTANTS = 6  # of each group at a time
LONGEST = 400  # cycles of what is made here; what is committed may be longer
# Frames beside the machine's own that a bus of 500 kbit/s still brings in 10 ms.
MOST_BESIDE = 60
OPERATIONS = ("raw", "raw", "raw", "raw", "mute", "wrong", "as", "good", "flood", "late", "speed",
              "hold", "refuse", "port")


def parts_of(script: str) -> tuple[list[str], list[str]]:
    head, *edits = [part.strip() for part in script.split("|")]
    return head.split(), edits


def joined(head: list[str], edits: list[str]) -> str:
    return " | ".join([" ".join(head), *edits])


def with_key(head: list[str], key: str, value) -> list[str]:
    return [*[word for word in head if not word.startswith(f"{key}=")], f"{key}={value}"]


def key_of(head: list[str], key: str) -> str | None:
    return next((word[len(key) + 1:] for word in head if word.startswith(f"{key}=")), None)


def beside(edits: list[str]) -> dict[int, int]:
    """Frames that each cycle brings more."""
    more: dict[int, int] = {}
    for edit in edits:
        found = re.match(r"@(\d+)(?:\+(\d+))? (?:flood|good) \S+ (\d+)", edit)
        if found:
            at, cycles, frames = (int(number or 1) for number in found.groups())
            for cycle in range(at, at + cycles):
                more[cycle] = more.get(cycle, 0) + frames
    return more


@functools.lru_cache
def messages(setup: str) -> dict:
    return enumeration.messages(setup)


def new_edit(draw: random.Random, setup: str, group: str, cycles: int) -> str:
    at = draw.randrange(min(25, cycles - 1), cycles)
    when = f"@{at}+{draw.choice((1, 1, 2, 3, 8, 30))}"
    what = draw.choice(OPERATIONS)
    known = messages(setup)
    message = draw.choice(list(known))
    most = enumeration.QUEUE if group.endswith("-queue") else MOST_BESIDE
    if what == "raw":
        field = draw.choice(list(known[message]) or [""])
        if not field:
            return f"{when} mute {message}"
        raws = known[message][field]
        raw = draw.choice(raws) if draw.random() < 0.4 else draw.randrange(raws[0], max(raws) + 1)
        return f"{when} raw {message}.{field} {raw}"
    if what == "as":
        return f"{when} as {message} {draw.choice(list(known))}"
    if what == "good":
        return f"@{at} good {message} {draw.randrange(1, most + 1)}"
    if what == "flood":
        target = draw.choice([*known, "foreign", "error"])
        return f"@{at} flood {target} {draw.randrange(1, most + 1)} {draw.getrandbits(64):#x}"
    numbers = {"late": (5, 40), "speed": (0, 101), "hold": (0, 3), "port": (0, 5)}
    if what in numbers:
        return f"{when} {what} {draw.randrange(*numbers[what])}"
    return f"{when} {what}" + ("" if what == "refuse" else f" {message}")


def changed_head(draw: random.Random, head: list[str]) -> list[str]:
    setup = head[1]
    roll = draw.randrange(5)
    if roll == 0:
        return with_key(head, "seed", draw.randrange(1, 1000))
    if roll == 1 and setup in ("22t", "12t"):
        shares = ",".join(f"{draw.uniform(0.02, 0.98):.3f}" for _ in range(3))
        return with_key(head, "start", shares)
    if roll == 2:
        return with_key(head, "speed", draw.choice((10, 30, 60, 100)))
    if roll == 3 and setup == "12t":
        return with_key(head, "task", draw.randrange(2))
    if roll == 3 and setup == "22t":
        bare = [word for word in head if word != "soil"]
        return bare if "soil" in head else [*bare, "soil"]
    if roll == 3:
        return [head[0], "bumps" if setup == "dozer" else "dozer", *head[2:]]
    return with_key(head, "cycles", draw.randrange(70, LONGEST))


def shifted(draw: random.Random, edit: str) -> str:
    by = draw.choice((-8, -2, -1, 1, 2, 8))
    return re.sub(r"^@(\d+)", lambda found: f"@{max(1, int(found[1]) + by)}", edit)


def altered_number(draw: random.Random, edit: str) -> str:
    """Another raw value or other bytes in the same place."""
    words = edit.split()
    if words[1] == "raw":
        words[-1] = str(max(0, int(words[-1]) + draw.choice((-3000, -300, -30, 30, 300, 3000))))
    elif words[1] == "flood" and len(words) > 4:
        words[-1] = f"{int(words[-1], 0) ^ (1 << draw.randrange(64)):#x}"
    return " ".join(words)


def mutant_of_cycles(draw: random.Random, script: str) -> str:
    head, edits = parts_of(script)
    if key_of(head, "row"):
        head = with_key(head, "seed", 2 * draw.randrange(1, 50))
        if draw.random() < 0.5:
            head = with_key(head, "row", draw.choice(enumeration.FAULT_ROWS[head[1]]))
        return joined(with_key(head, "cycles", 4000), [])
    for _ in range(draw.choice((1, 1, 2, 3))):
        cycles = int(key_of(head, "cycles") or 100)
        roll = draw.random()
        if roll < 0.3:
            head = changed_head(draw, head)
        elif roll < 0.65 or not edits:
            edits = [*edits, new_edit(draw, head[1], head[0], cycles)]
        else:
            at = draw.randrange(len(edits))
            change = draw.choice(("drop", "shift", "number"))
            if change == "drop":
                edits = edits[:at] + edits[at + 1:]
            else:
                edit = (shifted if change == "shift" else altered_number)(draw, edits[at])
                edits = [*edits[:at], edit, *edits[at + 1:]]
    most = enumeration.QUEUE if head[0].endswith("-queue") else MOST_BESIDE
    while max(beside(edits).values(), default=0) > most:
        edits = edits[:-1]
    return joined(head, edits)


def mutant_of_solves(draw: random.Random, script: str) -> str:
    words = script.split()
    if words[1] in ("vector", "random"):
        return f"{words[0]} random {draw.randrange(10_000_000)}"
    numbers = {word.split("=")[0]: [float(number) for number in word.split("=")[1].split(",")]
               for word in words[2:]}
    largest = {"v": 0.8, "cap": 6.4e7, "rod": 6.4e7, "flow": 6e-3, "last": 1.0}
    for _ in range(draw.choice((1, 1, 2, 4))):
        key = draw.choice(("v", "v", "cap", "cap", "rod", "rod", "flow", "last"))
        at = draw.randrange(len(numbers[key]))
        sign = draw.choice((-1.0, 1.0)) if key == "v" else 1.0
        value = numbers[key][at]
        value = draw.choice((value * draw.uniform(0.5, 2.0), value * draw.uniform(0.97, 1.03),
                             sign * largest[key] * draw.random(), sign * value))
        numbers[key][at] = min(max(value, -0.8 if key == "v" else 0.0), largest[key])
    return enumeration.solve_line(words[1], *[numbers[key] for key in ("v", "cap", "rod", "flow")],
                                  numbers["last"][0])


def cut(counted: counting.Counted) -> counting.Counted:
    """Without what comes after the dearest cycle."""
    if len(counted.counts) == 1:
        return counted
    dearest = counted.counts.index(counted.most)
    head, edits = parts_of(counted.script)
    edits = [edit for edit in edits if int(re.match(r"@(\d+)", edit)[1]) <= dearest]
    script = joined(with_key(head, "cycles", dearest + 1), edits)
    return dataclasses.replace(counted, script=script, counts=counted.counts[:dearest + 1])


def family(script: str) -> str:
    """One of each is kept: the same edits with other messages and numbers are no other case."""
    head, edits = parts_of(script)
    words = script.split()
    if len(words) > 2 and words[2].startswith("v="):
        return re.sub(r"-?[\d.]+(e[-+]?\d+)?", "#", " ".join(words[:3]))
    return " ".join([*head[:2], "row" if key_of(head, "row") else "",
                     *sorted({edit.split()[1] for edit in edits})])


def best(known: list[counting.Counted]) -> list[counting.Counted]:
    kept: dict[str, list[counting.Counted]] = {}
    seen = set()
    for counted in sorted(map(cut, known), key=lambda one: -one.most):
        mark = (counted.group, family(counted.script))
        if mark not in seen and len(kept.setdefault(counted.group, [])) < KEEP:
            seen.add(mark)
            kept[counted.group].append(counted)
    return [counted for group in sorted(kept) for counted in kept[group]]


def write(path: pathlib.Path, known: list[counting.Counted]):
    remarks = [line for line in path.read_text(encoding="utf-8").splitlines()
               if line.startswith("#")]
    lines = [*remarks, *[counted.script for counted in known]]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def refused(bench: counting.Bench, kind: str, scripts: list[str]) -> list[counting.Counted]:
    """What of these can be counted: a mutant may be one that nothing can be made of."""
    try:
        return bench.count(kind, scripts)
    except SystemExit as problem:
        if len(scripts) == 1:
            print(f"left out: {scripts[0]}\n{problem}", file=sys.stderr)
            return []
        half = len(scripts) // 2
        return refused(bench, kind, scripts[:half]) + refused(bench, kind, scripts[half:])


def search(bench: counting.Bench, kind: str, options):
    path = counting.CASES[kind]
    draw = random.Random(options.seed)
    mutate = mutant_of_cycles if kind == "cycles" else mutant_of_solves
    scripts = counting.scripts_of(path)
    if options.start_thorough:
        scripts += enumeration.scripts(kind)
    known = best(bench.count(kind, scripts))
    write(path, known)
    tried, until = 0, time.monotonic() + options.seconds
    while time.monotonic() < until:
        mutants = []
        for group in sorted({counted.group for counted in known}):
            own = [counted for counted in known if counted.group == group]
            # A long one costs as much as many short ones.
            own = [one.script for one in own if len(one.counts) <= LONGEST] or [own[0].script]
            if options.only in (None, group):
                count = MUTANTS * (20 if kind == "solves" else 1)
                mutants += [mutate(draw, draw.choice(own)) for _ in range(count)]
        if not mutants:
            return
        tried += len(mutants)
        before = {group: one.most for group, one in counting.maxima(known).items()}
        known = best(known + refused(bench, kind, mutants))
        for group, one in counting.maxima(known).items():
            if one.most > before[group]:
                print(f"{tried} {group}: {one.most}, {one.place}", flush=True)
        write(path, known)
    print(f"{kind}: {tried} tried")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=300.0, help="of either kind")
    parser.add_argument("--kind", choices=list(counting.CASES), help="one of them only")
    parser.add_argument("--only", metavar="GROUP")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--start-thorough", action="store_true",
                        help="with all scripts of enumeration.py to begin with")
    options = parser.parse_args()
    bench = counting.Bench(options.build)
    for kind in [options.kind] if options.kind else counting.CASES:
        search(bench, kind, options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
