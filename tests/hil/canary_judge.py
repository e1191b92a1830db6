# SPDX-License-Identifier: Apache-2.0
"""Proves that a judge of what a scenario left can say no: as it is, then with one thing of it changed."""

import contextlib
import io
import pathlib
import re
import shutil
import sys
import tempfile
from collections.abc import Callable

import guest
from scenario import Nowhere

Seed = Callable[[pathlib.Path], None]


def prove(name: str, left: pathlib.Path, last: pathlib.Path, judge: Callable[[pathlib.Path], list[str]],
          seeds: dict[str, tuple[Seed, str]]) -> int:
    """`last` is what hil_NAME leaves at its end; each seed changes what it left, which one of the words tells."""
    if not last.exists():
        return guest.give_up(f"{name}'s canary", Nowhere(f"hil_{name} left nothing to judge"))
    with contextlib.redirect_stdout(io.StringIO()):
        if problems := judge(left):
            sys.exit(f"canary: refused as it is: {problems}")
    for seeded, (seed, words) in seeds.items():
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            out = pathlib.Path(folder, "out")
            shutil.copytree(left, out)
            seed(out)
            problems = judge(out)
        if not any(re.search(words, problem) for problem in problems):
            sys.exit(f"canary: {seeded}: '{words}' is not among {problems}")
        print(f"canary: {seeded}: as expected")
    return 0
