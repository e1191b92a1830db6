# SPDX-License-Identifier: Apache-2.0
"""Which mutated files are as they were when all were last tried (changed_since.py): they, their tests, and all of ours
that these include. What generates a header counts for all."""

import functools
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "gates"))
import changed_since  # noqa: E402

OF_ALL = ("tests/mutation", "can_dbc", "firmware/safety/faults.toml", "firmware/safety/limits.toml")


@functools.lru_cache(maxsize=None)
def includes(file: pathlib.Path, root: pathlib.Path) -> frozenset[str]:
    """Files of ours that it includes, and they in turn."""
    found, due = set(), [file]
    while due:
        text = due.pop().read_text(encoding="utf-8")
        for name in re.findall(r'#include "([^"]+)"', text):
            if name not in found and (root / name).is_file():
                found.add(name)
                due.append(root / name)
    return frozenset(found)


def test_of(root: pathlib.Path, job) -> str:
    """A test that is compiled once is named by its object."""
    if job.compiled != job.mutated:
        return job.compiled
    found = [name for name in re.findall(r"/__/(unit/[\w/]+\.cpp)\.o", " ".join(job.linked)) if (root / "tests" / name).is_file()]
    if len(found) != 1:
        sys.exit(f"mutation: {job.mutated}: which test it has is not known: {', '.join(job.linked)}")
    return f"tests/{found[0]}"


def as_before(root: pathlib.Path, jobs: list) -> tuple[list, str]:
    """Those jobs of which nothing has changed, and since when; none where that can't be known."""
    names, since = changed_since.changed(root, "mutation")
    if names is None:
        return [], since
    if changed_since.below(names, list(OF_ALL)):
        return [], "what is of all files changed"
    same = []
    for job in jobs:
        files = {job.mutated, test_of(root, job)}
        every = files.union(*(includes(root / file, root) for file in files))
        if not names & every:
            same.append(job)
    return same, since
