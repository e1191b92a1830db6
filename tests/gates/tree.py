# SPDX-License-Identifier: Apache-2.0
"""The files that a gate looks at, the same for every gate."""

import argparse
import os
import pathlib
import subprocess
import sys

CXX = (".c", ".cpp", ".h", ".hpp")
# Seeded faults live in tests/canary: a canary hands one of its folders to a gate as --root.
NOT_OURS = ("tests/canary/",)


def arguments(what: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=what)
    parser.add_argument("--root", required=True, type=pathlib.Path, help="the tree to look at")
    parser.add_argument("--generated", type=pathlib.Path, help="the headers that the build has made")
    return parser


def files(root: pathlib.Path, seeds: bool = False) -> list[str]:
    """Tracked files and new ones that are not ignored, as paths relative to root; seeded faults too, if asked."""
    command = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        listed = subprocess.run(command, capture_output=True, check=True).stdout.decode()
        names = {name for name in listed.split("\0") if name}
    except (OSError, subprocess.CalledProcessError):
        names = set()
    # No git, an unpacked archive, or somebody else's checkout, which git refuses to read.
    names = names or set(walk(root))
    return sorted(n for n in names if (seeds or not n.startswith(NOT_OURS)) and (root / n).is_file())


def walk(root: pathlib.Path):
    skipped = {".git", "build", "out", "node_modules", "__pycache__"}
    for folder, folders, names in os.walk(root):
        folders[:] = [f for f in folders if f not in skipped]
        for name in names:
            yield (pathlib.Path(folder) / name).relative_to(root).as_posix()


def cxx_files(root: pathlib.Path) -> list[str]:
    return [n for n in files(root) if n.endswith(CXX)]


def report(gate: str, problems: list[str], looked_at: int, what: str = "files"):
    """Ends the gate. One that has looked at nothing is dead, which must not pass for green."""
    if looked_at == 0:
        problems = [f"no {what} to look at: the gate is dead"]
    for problem in problems:
        print(problem)
    print(f"{gate}: {looked_at} {what}, {len(problems)} problems")
    sys.exit(1 if problems else 0)
