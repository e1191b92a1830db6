#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Canary: runs a command that has to refuse its input, for the expected reason."""

import argparse
import re
import subprocess
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--expect", required=True, help="regular expression; may span lines")
parser.add_argument("command", nargs=argparse.REMAINDER, help="after --")
arguments = parser.parse_args()
command = arguments.command[1:] if arguments.command[:1] == ["--"] else arguments.command

done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
print(done.stdout, end="")
if done.returncode == 0:
    sys.exit("canary: accepted, though the input is bad")
if not re.search(arguments.expect, done.stdout, re.DOTALL):
    sys.exit(f"canary: refused, but not for the expected reason: {arguments.expect}")
print(f"canary: refused as expected (exit status {done.returncode})")
