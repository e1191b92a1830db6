"""Shipped profiles load; wrong ones are refused with every error listed, each of their keys if it is
missing or out of range: check_profiles.py GRABEN READ_PROFILE MACHINES_FOLDER."""

import os
import re
import subprocess
import sys
import tempfile
import tomllib

import dozer_cases
import excavator_cases
from profile_edit import key_path, leaves, with_number, without

KINDS = {"excavator": "excavator_22t.toml", "dozer": "dozer_9t.toml"}


class Reader:
    """Reads profiles by the loader of a kind."""

    def __init__(self, program, scratch):
        self._program = program
        self._path = os.path.join(scratch, "changed.toml")

    def errors_of_file(self, kind, path):
        done = subprocess.run([self._program, kind, path], capture_output=True, text=True,
                              timeout=60)
        assert done.returncode == (1 if done.stderr else 0) and not done.stdout, done
        return done.stderr

    def errors_of(self, kind, text):
        with open(self._path, "w", encoding="utf-8") as stream:
            stream.write(text)
        return self.errors_of_file(kind, self._path)


def wrong_cases(reader, kind, good, cases):
    for what, change, needles in cases:
        errors = reader.errors_of(kind, change(good))
        missing = [needle for needle in needles if needle not in errors]
        if not errors or missing:
            yield f"{what}: without {missing}:\n{errors}"


def wrong_keys(reader, kind, good, ranges):
    """Each key is told if it is missing, and its range if its number is out of it."""
    for path in leaves(tomllib.loads(good)):
        key = key_path(path)
        if f"{key}: missing" not in reader.errors_of(kind, without(good, path)):
            yield f"{key} is not missed"
    keys = {key_path(path) for path in leaves(tomllib.loads(good))} - {"kind"}
    if ranges and keys != set(ranges):
        yield f"{kind}: not in both file and table: {keys ^ set(ranges)}"
    for key, allowed in ranges.items():
        for number in (-1e18, 1e18):
            errors = reader.errors_of(kind, with_number(good, key.split("."), number))
            if not re.search(rf"^  {re.escape(key)}[ \[].*; allowed: {re.escape(allowed)}$", errors,
                             re.MULTILINE):
                yield f"{key} at {number}: not '{allowed}' in:\n{errors}"


def wrong_kind(reader, good):
    """Neither loader takes the other's file, and says which it needs."""
    for kind in KINDS:
        for other, text in good.items():
            errors = reader.errors_of(kind, text)
            if kind == other and errors:
                yield f"{other}: {errors}"
            needle = f"a machine of kind {other}; here it must be {kind}"
            if kind != other and ("1 error" not in errors or needle not in errors):
                yield f"{other} as {kind}: {errors}"


def command_reports(graben, path):
    """The tool passes a profile's errors on: status 1, nothing on its output."""
    done = subprocess.run([graben, "pose", "--profile", path, "--strokes=1.0,1.1,0.4"],
                          capture_output=True, text=True, timeout=60)
    if done.returncode != 1 or done.stdout or "here it must be excavator" not in done.stderr:
        yield f"graben pose: status {done.returncode}: {done.stdout}{done.stderr}"


def main():
    graben, program, folder = sys.argv[1:]
    shipped = [name for name in sorted(os.listdir(folder)) if name.endswith(".toml")]
    wrong = [] if shipped else ["no shipped profile"]
    good = {}
    for kind, name in KINDS.items():
        with open(os.path.join(folder, name), encoding="utf-8") as stream:
            good[kind] = stream.read()
    with tempfile.TemporaryDirectory() as scratch:
        reader = Reader(program, scratch)
        for name in shipped:
            path = os.path.join(folder, name)
            with open(path, "rb") as stream:
                kind = tomllib.load(stream)["kind"]
            wrong += [f"{name}: {text}" for read_as in (kind, "kind")
                      for text in [reader.errors_of_file(read_as, path)] if text]
        for kind, cases in (("excavator", excavator_cases), ("dozer", dozer_cases)):
            wrong += wrong_cases(reader, kind, good[kind], cases.CASES)
            wrong += wrong_keys(reader, kind, good[kind], cases.RANGES)
        wrong += wrong_kind(reader, good)
        wrong += command_reports(graben, os.path.join(folder, KINDS["dozer"]))
    cases = len(excavator_cases.CASES) + len(dozer_cases.CASES)
    print("\n".join(wrong) or f"{len(shipped)} shipped, {cases} wrong profiles told")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
