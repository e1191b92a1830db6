#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""That changed_since.py sees each change, and takes everything for changed where it can't know: a clone of
depth 1, a commit that is not there, another tool, no record."""

import os
import pathlib
import subprocess
import tempfile

import changed_since

# Inside a hook or a worktree git would speak of another repository.
for name in subprocess.run(["git", "rev-parse", "--local-env-vars"], stdout=subprocess.PIPE, text=True,
                           check=True).stdout.split():
    os.environ.pop(name, None)


def git(where: pathlib.Path, *words: str) -> str:
    return subprocess.run(["git", "-c", "user.name=test", "-c", "user.email=test@example.org", "-c", "commit.gpgsign=false",
                           "-c", "core.hooksPath=/dev/null", "-C", str(where), *words], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, check=True).stdout.strip()


def commit(where: pathlib.Path, name: str, text: str) -> str:
    (where / name).parent.mkdir(parents=True, exist_ok=True)
    (where / name).write_text(text)
    git(where, "add", "-A")
    git(where, "commit", "-q", "-m", name)
    return git(where, "rev-parse", "HEAD")


def everything(where: pathlib.Path, why: str) -> None:
    names, said = changed_since.changed(where, "tidy")
    assert names is None and why in said, (names, said)


with tempfile.TemporaryDirectory() as folder:
    origin = pathlib.Path(folder, "origin")
    origin.mkdir()
    git(origin, "init", "-q")
    commit(origin, "firmware/a.cpp", "1")
    everything(origin, "no whole run")
    (origin / changed_since.RECORD).parent.mkdir(parents=True)
    changed_since.record(origin, ["tidy"])
    record = (origin / changed_since.RECORD).read_text()
    first = commit(origin, changed_since.RECORD, record)
    assert changed_since.changed(origin, "tidy")[0] == {changed_since.RECORD}
    commit(origin, "firmware/b.cpp", "2")
    (origin / "firmware/a.cpp").write_text("3")
    (origin / "new.cpp").write_text("4")
    names, _ = changed_since.changed(origin, "tidy")
    assert names == {changed_since.RECORD, "firmware/a.cpp", "firmware/b.cpp", "new.cpp"}, names
    assert changed_since.before(origin, "tidy", "firmware/a.cpp") == "1"
    assert changed_since.before(origin, "tidy", "firmware/b.cpp") == ""
    assert changed_since.below(names, ["firmware"]) == ["firmware/a.cpp", "firmware/b.cpp"]
    assert changed_since.below(names, ["firm", "b.cpp"]) == []
    assert changed_since.below(names, ["."]) == sorted(names)

    whole = pathlib.Path(folder, "whole")
    git(pathlib.Path(folder), "clone", "-q", f"file://{origin}", str(whole))
    assert changed_since.changed(whole, "tidy")[0] == {changed_since.RECORD, "firmware/b.cpp"}
    shallow = pathlib.Path(folder, "shallow")
    git(pathlib.Path(folder), "clone", "-q", "--depth", "1", f"file://{origin}", str(shallow))
    everything(shallow, "shallow")
    (whole / changed_since.RECORD).write_text(record.replace(first, "0" * 40).replace(
        git(origin, "rev-parse", f"{first}^"), "0" * 40))
    everything(whole, "not known here")
    (whole / changed_since.RECORD).write_text(record.replace("clang-tidy: ", "clang-tidy: another "))
    everything(whole, "the whole run had")
print("changed_since.py: 12 cases as wanted")
