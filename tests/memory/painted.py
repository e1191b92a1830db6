#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the deepest chain of calls, as report.py works it out, against the stack that a replayed run
takes of painted memory: painted.py --tools PREFIX --frames COUNT PROGRAM EMULATOR..."""

import argparse
import re
import subprocess
import sys

from call_graph import CallGraph
from disassembly import Refusal
from report import HERE

ENTRY = r"^graben::memory::run_image\("
# Not every run takes the deepest chain, but one that takes less than this share of it says nothing.
LEAST_SHARE = 0.5


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    found = re.search(r"stack (\d+)\nframes (\d+) differing (\d+)\n", done.stdout)
    if done.returncode != 0 or not found:
        raise Refusal(f"{' '.join(command)}: status {done.returncode}, {done.stdout!r}")
    return [int(number) for number in found.groups()]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tools", default="")
    parser.add_argument("--calls", default=HERE / "calls.toml")
    parser.add_argument("--least-frames", type=int, required=True)
    parser.add_argument("program")
    parser.add_argument("emulator", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    deepest, _ = CallGraph(arguments.tools, arguments.program, arguments.calls).deepest(ENTRY)
    taken, sent, differing = run([*arguments.emulator, arguments.program])
    print(f"{taken} B of stack taken, {deepest} B at most; {differing} of {sent} frames differ")
    problems = []
    if not LEAST_SHARE * deepest < taken <= deepest:
        problems.append(f"{taken} B of stack taken where {deepest} B is the deepest chain")
    if sent < arguments.least_frames or differing:
        problems.append(f"{differing} of {sent} frames are not what they were in the simulation")
    return problems


if __name__ == "__main__":
    try:
        found = main()
    except Refusal as refusal:
        found = [str(refusal)]
    print("".join(f"memory: {problem}\n" for problem in found), end="")
    sys.exit(1 if found else 0)
