#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Flash, static RAM and the deepest chain of calls of the images of one target, held against what
they were and what an ECU has.

    report.py --target NAME --tools PREFIX --objects FILE KIND=IMAGE...   measures and judges
    report.py ... --toml     writes what it measures into observed.toml
    report.py ... --strict   2 % more or less is red, not 10 %
    report.py ... --chain    prints each chain
    report.py --table        observed.toml as a table (tests/README.md has it)
"""

import argparse
import dataclasses
import pathlib
import re
import sys
import tomllib

from call_graph import CallGraph
from disassembly import Refusal, check_frames, output_of

HERE = pathlib.Path(__file__).parent
OBSERVED = HERE / "observed.toml"
# By target: the ECU that this is for.
MOST = {"arm-none-eabi-cortex-m7": {"flash": 240 * 1024, "ram": 36 * 1024, "stack": 11 * 1024}}
# In ./test only what nobody would have wanted is red; --strict is for a thorough run by hand.
DRIFT, DRIFT_STRICT = 0.10, 0.02
FIGURES = ("flash", "ram", "stack")
ENTRY = r"^main$"


def sizes_of(tools, image):
    """Bytes of flash and of static RAM: what is constant or has a first value, what is written."""
    flash = ram = 0
    for line in output_of(tools + "readelf", "-SW", image).splitlines():
        found = re.match(
            r"\s*\[\s*\d+\]\s+\S+\s+(\w+)\s+[0-9a-f]+\s+[0-9a-f]+\s+([0-9a-f]+)\s+\w+\s+([A-Z]*)", line
        )
        if not found or "A" not in found[3]:
            continue
        size = int(found[2], 16)
        flash += 0 if found[1] == "NOBITS" else size
        ram += size if "W" in found[3] else 0
    if not flash:
        raise Refusal(f"{image}: nothing in flash")
    return flash, ram


def measure(tools, image, calls=HERE / "calls.toml"):
    flash, ram = sizes_of(tools, image)
    graph = CallGraph(tools, image, calls)
    stack, chain = graph.deepest(ENTRY)
    return {"flash": flash, "ram": ram, "stack": stack}, chain


def judge(kind, figures, observed, most, drift):
    """What is wrong with the figures of an image."""
    problems = [
        f"{kind}: {figures[name]} B of {name}, {most[name]} B is the most"
        for name in most
        if figures[name] > most[name]
    ]
    for name in FIGURES:
        was = observed.get(name)
        if was is None:
            problems.append(f"{kind}: observed.toml has no {name} of it (--toml fills it in)")
        elif abs(figures[name] - was) > drift * was:
            problems.append(
                f"{kind}: {figures[name]} B of {name}, it was {was} B (--toml, if it is meant)"
            )
    return problems


def read_observed():
    return tomllib.loads(OBSERVED.read_text("utf-8")) if OBSERVED.exists() else {}


def write_observed(observed):
    lines = ["# What report.py --toml has measured: bytes, by target and image.\n"]
    for target in sorted(observed):
        for kind in sorted(observed[target]):
            lines.append(f"\n[{target}.{kind}]\n")
            lines += [f"{name} = {observed[target][kind][name]}\n" for name in FIGURES]
    OBSERVED.write_text("".join(lines), "utf-8")


def table(observed):
    grouped = "{:,}".format
    rows = [
        "| Target | Image | Flash, B | Static RAM, B | Deepest stack, B |",
        "| --- | --- | ---: | ---: | ---: |",
    ]
    for target in sorted(observed):
        for kind, figures in sorted(observed[target].items()):
            cells = [grouped(figures[name]).replace(",", " ") for name in FIGURES]
            rows.append(f"| {target} | {kind} | " + " | ".join(cells) + " |")
    return rows


def run_target(arguments):
    objects = pathlib.Path(arguments.objects).read_text("utf-8").split()
    compared = check_frames(arguments.tools, objects)
    print(f"{arguments.target}: frames of {compared} functions are what the compiler says")
    observed = read_observed()
    most = MOST.get(arguments.target, {})
    problems = []
    for kind, image in (word.split("=", 1) for word in arguments.images):
        figures, chain = measure(arguments.tools, image, arguments.calls)
        print(
            f"{arguments.target} {kind}: {figures['flash']} B of flash, {figures['ram']} B of RAM, "
            f"{figures['stack']} B of stack"
        )
        if arguments.chain:
            print("".join(f"{size:8} {name}\n" for name, size in chain), end="")
        was = observed.get(arguments.target, {}).get(kind, {})
        if arguments.toml:
            observed.setdefault(arguments.target, {})[kind] = figures
        # A strict run says what it changes; by itself --toml is how a change is taken over.
        compared = figures if arguments.toml and not arguments.strict else was
        problems += judge(kind, figures, compared, most, DRIFT_STRICT if arguments.strict else DRIFT)
    if arguments.toml:
        write_observed(observed)
    return problems


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--target")
    parser.add_argument("--tools", default="", help="what the names of its tools begin with")
    parser.add_argument("--objects", help="a file that lists the core's object files")
    parser.add_argument("--calls", default=HERE / "calls.toml")
    parser.add_argument("--toml", action="store_true")
    parser.add_argument("--chain", action="store_true")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--strict", action="store_true")
    parser.add_argument("images", nargs="*", metavar="KIND=IMAGE")
    return parser.parse_args()


def main():
    arguments = parse()
    if arguments.table:
        print("\n".join(table(read_observed())))
        return []
    return run_target(arguments)


if __name__ == "__main__":
    try:
        found = main()
    except Refusal as refusal:
        found = [str(refusal)]
    print("".join(f"memory: {problem}\n" for problem in found), end="")
    sys.exit(1 if found else 0)
