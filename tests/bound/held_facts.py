#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Facts of facts.toml against what fuzzed cycles do: how often a fact's functions are called in one call of `within`,
counted in a build with GRABEN_COUNT_CALLS (call_counts.cpp). Red where one is called more often than its fact says, where
a fact's `within` never ran, and where none of its functions was called though some may be: nothing was counted of it.

    held_facts.py [--facts FILE] [--show] PROGRAM [ARGUMENT...] [-- PROGRAM ...]
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from facts import Facts  # noqa: E402
from listing import Refusal  # noqa: E402


def functions(program):
    """[(address, name)] of a program that is not moved when it is loaded."""
    lines = subprocess.run(["nm", "-C", "--defined-only", program], capture_output=True, text=True, check=True).stdout
    for line in lines.splitlines():
        address, kind, name = line.split(" ", 2)
        if kind in "tTwW":
            yield address, name


def roles(program, facts):
    named = list(functions(program))
    for number, row in enumerate(facts.rows):
        for role in ("within", "calls"):
            for address, name in named:
                if re.search(row[role], name):
                    yield f"{number} {role} {address}"


def counted(command, facts):
    """{fact's number: (times, calls of `within`)} of one program's run."""
    with tempfile.TemporaryDirectory() as folder:
        asked, told = pathlib.Path(folder, "facts"), pathlib.Path(folder, "counts")
        asked.write_text("\n".join(roles(command[0], facts)) + "\n")
        environment = {**os.environ, "GRABEN_FACTS": str(asked), "GRABEN_FACT_COUNTS": str(told)}
        subprocess.run(command, env=environment, stdout=sys.stderr, check=True)
        if not told.exists():
            raise Refusal(f"{command[0]}: counts no calls; built with GRABEN_COUNT_CALLS?")
        rows = [list(map(int, line.split())) for line in told.read_text().splitlines()]
    return {number: (times, calls) for number, times, calls in rows}


def commands_of(words):
    command = []
    for word in [*words, "--"]:
        if word != "--":
            command.append(word)
        elif command:
            yield command
            command = []


def main():
    parser = argparse.ArgumentParser(description="Facts of facts.toml against what fuzzed cycles do.")
    parser.add_argument("--facts", default=pathlib.Path(__file__).with_name("facts.toml"))
    parser.add_argument("--show", action="store_true")
    parser.add_argument("program", nargs=argparse.REMAINDER)
    given = parser.parse_args()
    facts = Facts(given.facts)
    elsewhere = [row for row in facts.rows if not row["proof"].startswith("held_facts.py")]
    facts.rows = [row for row in facts.rows if row not in elsewhere]
    if elsewhere:
        print(f"facts.toml: {len(elsewhere)} of single machines, or assumed, not looked at here")
    most = {number: (0, 0) for number in range(len(facts.rows))}
    for command in commands_of(given.program):
        for number, (times, calls) in counted(command, facts).items():
            most[number] = (max(most[number][0], times), most[number][1] + calls)
    wrong = []
    for number, row in enumerate(facts.rows):
        times, calls = most[number]
        what = f"{row['calls']} in {row['within']}"
        if given.show:
            print(f"{what}: {times} of {row['at_most']}, in {calls} calls")
        if calls == 0:
            wrong.append(f"{what}: never ran, nothing was counted")
        elif times == 0 and row["at_most"] > 0:
            wrong.append(f"{what}: never called, nothing was counted")
        elif times > row["at_most"]:
            wrong.append(f"{what}: {times} times, and the fact says at most {row['at_most']}")
    for line in wrong:
        print(f"facts.toml: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Refusal as refusal:
        sys.exit(str(refusal))
