#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many instructions a step costs at most, from a linked image and the counts of loops.toml.

    bound.py --tools PREFIX --root REGEX IMAGE    refuses what has no bound, else prints it
    bound.py ... --loops                          prints every loop with its count and why
    bound.py ... --judge TARGET.KIND              2 % more or less than bounds.toml has is red
    bound.py ... --judge TARGET.KIND --toml       writes what it finds into bounds.toml
    bound.py --table                              bounds.toml as a table, beside what was observed
    bound.py ... --path                           prints the dearest path
    bound.py ... --counts FILE [--of MACHINE]     what any machine of its kind may have, and some have
"""

import argparse
import pathlib
import re
import sys

import bounds
from aarch64 import AArch64
from arm import Arm
from facts import Facts
from listing import Image, Refusal
from machine import counts
from program import Program
from table import Table

HERE = pathlib.Path(__file__).parent
MACHINES = {40: Arm, 183: AArch64}


def machine_of(image):
    if image.machine not in MACHINES:
        raise Refusal(f"{image.file}: nobody has said how to read machine {image.machine}")
    return MACHINES[image.machine](image)


def reached(program, start):
    """The graphs of all that may be called from there."""
    graphs, todo = {}, [start]
    while todo:
        entry = todo.pop()
        if entry in graphs:
            continue
        graphs[entry] = program.graph(entry)
        for block in graphs[entry].blocks.values():
            for where, target in block.calls:
                todo += program.targets(entry, target, where)
    return graphs


def counted(program, table, graphs):
    """How many loops have their count of what."""
    proven = rows = never = 0
    for entry, graph in graphs.items():
        for header, loop in graph.loops.items():
            ways = {(found.how, found.count is None) for (at, _, _), one in program.summaries.items() if at == entry
                    for found in one.loops if found.header == header}
            if not ways:
                never += 1
            elif ("a row", False) in ways:
                rows += 1
            else:
                proven += 1
    return f"loops: {proven} proven from registers, {rows} by {len(table.used)} rows, {never} of functions left out"


def stages(image, summary):
    """What of the bound is each part of the step's: by name, those that its controller calls."""
    found = {}
    for times, one in summary.calls:
        inside = one.calls if "Controller::step(" in image.word(one.entry) else [(1, one)]
        for more, part in inside:
            name = part_name(image.word(part.entry))
            found[name] = found.get(name, 0) + times * more * part.bound
    return found


def part_name(word):
    """As bounds.toml has it."""
    return shortened(word).replace("graben::", "")


def shortened(word):
    """A name without its arguments and what it is a template of."""
    return re.sub(r"^.* (?=[\w:~<>]+\()", "", re.sub(r"\((?!anonymous).*$", "(", word)).rstrip("(")


def print_path(image, summary, times=1, depth=0):
    """The dearest path in words: whom it calls how often, down to a hundredth of the whole."""
    whole = print_path.whole = summary.bound if not depth else print_path.whole
    print(f"{times * summary.bound:12} {'  ' * depth}{times} x {shortened(image.word(summary.entry))}: "
          f"{summary.own} of its own")
    merged = {}
    for count, one in summary.calls:
        merged.setdefault(id(one), [0, one])[0] += count
    for count, one in sorted(merged.values(), key=lambda pair: -pair[0] * pair[1].bound):
        if times * count * one.bound * 100 >= whole and depth < 12:
            print_path(image, one, times * count, depth + 1)


def parse(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tools", default="")
    parser.add_argument("--calls", default=HERE.parent / "memory" / "calls.toml")
    parser.add_argument("--rows", dest="table", default=HERE / "loops.toml", type=pathlib.Path)
    parser.add_argument("--facts", default=HERE / "facts.toml", type=pathlib.Path)
    parser.add_argument("--source", default=HERE.parents[1])
    parser.add_argument("--root", default=r"BareEcu<.*>::step\(")
    parser.add_argument("--counts", type=pathlib.Path)
    parser.add_argument("--of", metavar="MACHINE", help="of those in --counts only this one")
    parser.add_argument("--loops", action="store_true")
    parser.add_argument("--path", action="store_true")
    parser.add_argument("--judge", metavar="TARGET.KIND")
    parser.add_argument("--toml", action="store_true")
    parser.add_argument("--table-of-bounds", "--table", dest="show", action="store_true")
    parser.add_argument("image", nargs="?")
    return parser.parse_args(words)


def main():
    options = parse()
    if options.show:
        print("\n".join([*bounds.table(bounds.known()), "", *bounds.parts_table(bounds.known())]))
        return []
    image = Image(options.tools, options.image)
    machine = machine_of(image)
    known = counts(options.counts) if options.counts else {"any": None}
    problems, found, before = [], {}, None
    for whose in [options.of] if options.of else known:
        table = Table(options.table if options.table.exists() else None, options.source, known[whose])
        facts = Facts(options.facts if options.facts.exists() else None, known[whose])
        program = Program(image, machine, options.calls, table, facts, before)
        before = program
        print(f"{whose}:" if whose != "any" else "any machine:")
        problems += look_at(options, program, found, whose)
    if options.judge and not problems:
        problems += bounds.judge(options.judge, found, options.toml)
    return problems


def look_at(options, program, found, whose):
    root = program.entry_of(options.root)
    graphs = reached(program, root)
    program.table.prepare(program.image, graphs.values())
    summary = program.of(root)
    print(f"{len(graphs)} functions, {sum(len(g.back_edges()) for g in graphs.values())} back edges, "
          f"{sum(len(g.loops) for g in graphs.values())} loops")
    if options.loops:
        print_loops(program)
    if summary.open:
        return [f"{program.table.place(program.graphs[entry], program.graphs[entry].loops[header])}: "
                "a loop without a count" for entry, header in sorted(summary.open)]
    if options.path:
        print_path(program.image, summary)
    print(f"{summary.bound} instructions, {summary.stack} B of stack; {program.facts.assumed()} facts assumed")
    print(counted(program, program.table, graphs))
    found[whose] = (summary, stages(program.image, summary))
    return []


def print_loops(program):
    for (entry, known, _), summary in sorted(program.summaries.items()):
        for loop in summary.loops:
            graph = program.graphs[entry]
            place = program.table.place(graph, graph.loops[loop.header])
            print(f"{loop.count} {loop.how}: {place} {known or ''}")


if __name__ == "__main__":
    try:
        problems_found = main()
    except Refusal as refusal:
        problems_found = [str(refusal)]
    print("".join(f"bound: {problem}\n" for problem in problems_found), end="")
    sys.exit(1 if problems_found else 0)
