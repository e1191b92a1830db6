#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many instructions a step costs at most, by proof, from a linked image.

    bound.py --tools PREFIX --root REGEX IMAGE    refuses what has no bound, else prints it
    bound.py ... --loops                          prints every loop with its count and why
"""

import argparse
import pathlib
import sys

from aarch64 import AArch64
from arm import Arm
from facts import Facts
from listing import Image, Refusal
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


def parse(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tools", default="")
    parser.add_argument("--calls", default=HERE.parent / "memory" / "calls.toml")
    parser.add_argument("--table", default=HERE / "loops.toml", type=pathlib.Path)
    parser.add_argument("--facts", default=HERE / "facts.toml", type=pathlib.Path)
    parser.add_argument("--source", default=HERE.parents[1])
    parser.add_argument("--root", default=r"BareEcu<.*>::step\(")
    parser.add_argument("--loops", action="store_true")
    parser.add_argument("image")
    return parser.parse_args(words)


def main():
    options = parse()
    image = Image(options.tools, options.image)
    machine = machine_of(image)
    table = Table(options.table if options.table.exists() else None, options.source)
    facts = Facts(options.facts if options.facts.exists() else None)
    program = Program(image, machine, options.calls, table, facts)
    root = program.entry_of(options.root)
    graphs = reached(program, root)
    table.prepare(image, graphs.values())
    found = program.of(root)
    print(f"{len(graphs)} functions, {sum(len(g.back_edges()) for g in graphs.values())} back edges, "
          f"{sum(len(g.loops) for g in graphs.values())} loops")
    if options.loops:
        for (entry, known, _), summary in sorted(program.summaries.items()):
            for loop in summary.loops:
                graph = program.graphs[entry]
                place = table.place(graph, graph.loops[loop.header])
                print(f"{loop.count} {loop.how}: {place} {known or ''}")
    problems = [f"{table.place(program.graphs[entry], program.graphs[entry].loops[header])}: "
                "a loop without a count" for entry, header in sorted(found.open)]
    if not problems:
        print(f"{found.bound} instructions, {found.stack} B of stack")
    return problems


if __name__ == "__main__":
    try:
        problems_found = main()
    except Refusal as refusal:
        problems_found = [str(refusal)]
    print("".join(f"bound: {problem}\n" for problem in problems_found), end="")
    sys.exit(1 if problems_found else 0)
