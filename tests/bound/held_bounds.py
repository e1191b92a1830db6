#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts of fuzzed cycles against the bound of every function, and the facts of facts.toml against them, in the image itself.

    held_bounds.py --kind excavator --of 12t --counts FILE --host BUILD --tools PREFIX IMAGE EMULATOR...

IMAGE is an image of tests/memory whose board replays traces (board_trace.cpp). The traces are of scripts that
tests/timing/counts/search.py draws, recorded by the host's build; QEMU counts in each call of a step how many
instructions each call of each function executes with all that it calls (function_plugin.c). Red where that is more
than the function's bound, where a fact's functions are called more often than it says, and where next to nothing was
counted. Only of functions that have a bound by themselves; how many, and the nearest to theirs, it prints.
"""

import argparse
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
COUNTS = HERE.parent / "timing" / "counts"
sys.path[:0] = [str(HERE), str(COUNTS)]
sys.dont_write_bytecode = True
import counting  # noqa: E402
import search  # noqa: E402
import bounds as bounds_file  # noqa: E402
from bound import machine_of, part_name, reached, shortened  # noqa: E402
from facts import Facts  # noqa: E402
from listing import Image, Refusal  # noqa: E402
from machine import counts  # noqa: E402
from program import Program  # noqa: E402
from table import Table  # noqa: E402

ROOT = r"BareEcu<.*>::step\("
SETUPS = {"excavator": "12t", "dozer": "dozer"}
AT_A_TIME = 20_000  # cycles that are recorded and counted before the next ones
LONGEST = 600  # cycles of a script
LONGEST_TASK = 4000
LEAST_FUNCTIONS = 100


def scripts(kind, draw):
    """Without end, of the image's own machine: those of the search changed again and again, and whole tasks with less
    in their way, which get further."""
    setup = SETUPS[kind]
    known = [line for line in counting.scripts_of(counting.CASES["cycles"]) if line.split()[:2] == [setup] * 2]
    while True:
        whole = not known or draw.random() < 0.5
        script = f"{setup} {setup} speed=100" if whole else draw.choice(known)
        for _ in range(draw.randrange(2 if whole else 6)):
            mutant = search.mutant_of_cycles(draw, script)
            script = mutant if mutant.split()[1] == setup else script
        head, edits = search.parts_of(script)
        head = search.with_key(head, "cycles", draw.randrange(100, LONGEST_TASK if whole else LONGEST))
        yield search.joined(search.with_key(head, "seed", draw.randrange(1, 100_000)), edits)


def bounds_of(program, root):
    """{entry: bound} of all that has one whatever it is called with; of others the most of what calls them with."""
    graphs = reached(program, root)
    program.table.prepare(program.image, graphs.values())
    whole = program.of(root)
    if whole.open:
        raise Refusal("there is a loop without a count")
    found = {}
    for (entry, known, cut), one in program.summaries.items():
        if not cut and not one.open and entry in graphs:
            found.setdefault(entry, {})[known] = one.bound
    return {entry: ones.get((), max(ones.values())) for entry, ones in found.items()}, graphs


def asked(program, root, graphs):
    """What the plugin is told."""
    image, lines = program.image, [f"function {entry:x}" for entry in sorted(graphs)]
    lines.append(f"root {root:x}")
    for n, row in enumerate(program.facts.rows):
        for role in ("within", "calls"):
            lines += [f"{role} {n} {at:x}" for at in sorted(graphs) if re.search(row[role], image.word(at))]
    return "\n".join(lines) + "\n"


def record(host, chosen, folder):
    listed, traces = folder / "scripts.txt", folder / "traces"
    listed.write_text("".join(f"{script}\n" for script in chosen), encoding="utf-8")
    subprocess.run([host / "record_cycles", listed, traces], stdout=subprocess.DEVNULL, check=True)
    return traces


def counted(options, question, chosen):
    """({entry: (most, calls, most of a step)}, {fact: (times, calls)}, bytes of stack, cycles) of these scripts."""
    with tempfile.TemporaryDirectory(prefix="graben-bounds-") as name:
        folder = pathlib.Path(name)
        traces = record(options.host, chosen, folder)
        told, answer = folder / "asked", folder / "told"
        told.write_text(question, encoding="utf-8")
        plugin = f"{options.host / 'libfunction_plugin.so'},in={told},out={answer}"
        done = subprocess.run([*options.emulator, options.image, traces], stdout=subprocess.PIPE, text=True, check=False,
                              env={**os.environ, "QEMU_PLUGIN": plugin})
        ran = re.search(r"^stack (\d+)\ncycles (\d+)$", done.stdout, re.M)
        if done.returncode != 0 or not ran or not answer.exists():
            raise Refusal(f"{options.image}: status {done.returncode}, {done.stdout!r}")
        functions, facts = {}, {}
        for line in answer.read_text(encoding="utf-8").splitlines():
            what, which, *numbers = line.split()
            if what == "function":
                functions[int(which, 16)] = tuple(map(int, numbers))
            else:
                facts[int(which)] = tuple(map(int, numbers))
    return functions, facts, int(ran[1]), int(ran[2])


def merge(most, more):
    for key, (value, calls, *of_step) in more.items():
        known = most.get(key, (0, 0, 0))
        most[key] = max(known[0], value), known[1] + calls, max(known[2], *of_step, 0)


def judge(image, bounds, rows, functions, facts):
    called = [at for at in bounds if functions.get(at, (0, 0, 0))[1]]
    problems = [f"{shortened(image.word(at))}: {functions[at][0]} instructions, its bound is {bounds[at]}"
                for at in called if functions[at][0] > bounds[at]]
    for n, row in enumerate(rows):
        times, ran, _ = facts.get(n, (0, 0, 0))
        if row["proof"].startswith("held_bounds.py") and not ran:
            problems.append(f"{row['within']}: never ran, nothing was counted of {row['calls']}")
        if times > row["at_most"]:
            problems.append(f"{row['calls']} in {row['within']}: {times} times, and the fact says at most {row['at_most']}")
    if len(called) < LEAST_FUNCTIONS:
        problems.append(f"{len(called)} functions were called: next to nothing was counted")
    return called, problems


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kind", choices=SETUPS, required=True)
    parser.add_argument("--of", required=True, metavar="MACHINE")
    parser.add_argument("--counts", type=pathlib.Path, required=True)
    parser.add_argument("--host", type=lambda word: pathlib.Path(word) / counting.WHERE, required=True)
    parser.add_argument("--tools", default="")
    parser.add_argument("--facts", default=HERE / "facts.toml")
    parser.add_argument("--source", default=HERE.parents[1])
    parser.add_argument("--cycles", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--too-small", metavar="CALLS=N", help="a fact is taken to say only N: has to be red")
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--toml", metavar="TARGET.KIND", help="writes what the step's parts took into bounds.toml")
    parser.add_argument("image")
    parser.add_argument("emulator", nargs=argparse.REMAINDER)
    return parser.parse_args()


def main():
    options = parse()
    image = Image(options.tools, options.image)
    machine = counts(options.counts)[options.of]
    program = Program(image, machine_of(image), HERE.parent / "memory" / "calls.toml",
                      Table(HERE / "loops.toml", options.source, machine), Facts(options.facts, machine))
    if options.too_small:
        calls, _, most = options.too_small.rpartition("=")
        for row in program.facts.rows:
            row["at_most"] = min(row["at_most"], int(most)) if calls in row["calls"] else row["at_most"]
    root = program.entry_of(ROOT)
    bounds, graphs = bounds_of(program, root)
    question = asked(program, root, graphs)
    functions, facts, cycles, stack = {}, {}, 0, 0
    endless = scripts(options.kind, random.Random(options.seed))
    while cycles < options.cycles:
        chosen, due = [], min(AT_A_TIME, options.cycles - cycles)
        while due > 0:
            chosen.append(next(endless))
            due -= int(search.key_of(search.parts_of(chosen[-1])[0], "cycles"))
        of_functions, of_facts, taken, more = counted(options, question, chosen)
        stack = max(stack, taken)
        merge(functions, of_functions)
        merge(facts, of_facts)
        cycles += more
        print(f"{cycles} cycles, {functions[root][0]} instructions at most", file=sys.stderr, flush=True)
    deepest = program.of(root).stack
    called, problems = judge(image, bounds, program.facts.rows, functions, facts)
    print(f"{cycles} cycles: {len(called)} of {len(graphs)} functions called; a step {functions[root][0]} "
          f"of {bounds[root]}; {stack} B of stack, of {deepest} at most")
    if options.show:
        for at in sorted(called, key=lambda at: -functions[at][0] / bounds[at]):
            print(f"{functions[at][0] / bounds[at]:.3f} {functions[at][0]} of {bounds[at]}: {shortened(image.word(at))}")
        for n, row in enumerate(program.facts.rows):
            print(f"{row['calls']} in {row['within']}: {facts.get(n, (0,))[0]} of {row['at_most']}")
    if options.toml:
        of_step = {}
        for at in called:
            name = part_name(image.word(at))
            of_step[name] = max(of_step.get(name, 0), functions[at][2])
        bounds_file.take_over_seen(options.toml, of_step)
    return problems


if __name__ == "__main__":
    try:
        problems_found = main()
    except Refusal as refusal:
        problems_found = [str(refusal)]
    print("".join(f"held_bounds: {problem}\n" for problem in problems_found), end="")
    sys.exit(1 if problems_found else 0)
