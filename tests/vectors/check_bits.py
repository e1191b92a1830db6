# SPDX-License-Identifier: Apache-2.0
"""Whether a target gives the bits that are written down: check_bits.py [--write|--flip] EXPECTED COMMAND...

COMMAND is print_bits with its cases, under an emulator or not. --write writes down what it says: after
a change of the optimiser, on the machine that builds, once every other test of it holds. --flip turns
the last bit of one result over, which must be told."""

import itertools
import subprocess
import sys

SHOWN = 5


def differences(expected, actual):
    """A line for each result that is not the one written down."""
    return [f"{number}: {ours or 'nothing'}\n  expected {wanted or 'nothing'}"
            for number, (wanted, ours) in enumerate(itertools.zip_longest(expected, actual), 1)
            if wanted != ours]


def main():
    option = sys.argv[1] if sys.argv[1].startswith("--") else ""
    path, *command = sys.argv[2 if option else 1:]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{command[0]}: status {done.returncode}\n{done.stdout[-500:]}")
    if option == "--write":
        with open(path, "w", encoding="ascii") as stream:
            stream.write(done.stdout)
        return
    with open(path, encoding="ascii") as stream:
        expected = stream.read().splitlines()
    if not expected:
        sys.exit(f"{path} is empty: nothing is compared")
    actual = done.stdout.splitlines()
    if option == "--flip":
        actual[-1] = actual[-1][:-1] + f"{int(actual[-1][-1], 16) ^ 1:x}"
    found = differences(expected, actual)
    print(*found[:SHOWN], sep="\n")
    print(f"{len(expected)} results, {len(found)} with other bits")
    sys.exit(1 if found else 0)


main()
