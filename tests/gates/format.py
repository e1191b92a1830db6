#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: every C and C++ file is as clang-format with the tree's .clang-format leaves it."""

import shutil
import subprocess
import sys

import tree

root = tree.arguments(__doc__).parse_args().root.resolve()
tool = shutil.which("clang-format-14") or shutil.which("clang-format")
if tool is None:
    sys.exit("format: clang-format is missing; ./test installs it")

names = tree.cxx_files(root)
problems = []
if names:
    done = subprocess.run(
        [tool, "--dry-run", "-Werror", "--style=file", *names],
        cwd=root, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        version = subprocess.run([tool, "--version"], stdout=subprocess.PIPE, text=True, check=True)
        # The first place in each file; the tool's own listing is as long as the file is bad.
        found = [line for line in done.stderr.splitlines() if " error: " in line]
        first = {line.split(":")[0]: line for line in reversed(found)}
        problems = [*(sorted(first.values()) or [done.stderr.strip()]),
                    f"format: {tool} -i FILE puts it right (the house uses version 14; this is: "
                    f"{version.stdout.strip()})"]
tree.report("format", problems, len(names))
