#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: every shell script parses in the shell that its first line names."""

import subprocess

import tree

root = tree.arguments(__doc__).parse_args().root.resolve()


def shell_of(name: str) -> str | None:
    with open(root / name, "rb") as script:
        first = script.readline(100).decode("ascii", errors="replace").strip()
    if first.startswith("#!"):
        last = first.replace("/", " ").split()[-1] if len(first) > 2 else ""
        return last if last in ("sh", "bash", "dash") else None
    return "sh" if name.endswith(".sh") else None


scripts = [(name, shell) for name in tree.files(root) if (shell := shell_of(name))]
problems = []
for name, shell in scripts:
    # What sh accepts here, bash must too: some systems' sh is bash.
    for parser in {shell, "bash"}:
        done = subprocess.run([parser, "-n", name], cwd=root, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            problems.append(f"{parser} -n {name}: {done.stderr.strip()}")
tree.report("shell", problems, len(scripts), "scripts")
