# SPDX-License-Identifier: Apache-2.0
"""Shipped profiles load, with and without the simulated machine's file; wrong ones of both files are
refused with every error listed, each of their keys if it is missing or out of range:
check_profiles.py GRABEN READ_PROFILE MACHINES_FOLDER."""

import os
import re
import subprocess
import sys
import tempfile
import tomllib

import dozer_cases
import excavator_cases
from profile_edit import changed, key_path, leaves, with_number, without

KINDS = {"excavator": "excavator_22t.toml", "dozer": "dozer_9t.toml"}
SIMULATED = "simulated-"
# Keys that a file need not have, and what can go with each, where the file has it.
OUTLINE = (("bucket", "floor"), ("bucket", "floor_angle"), ("boom", "bend"), ("boom", "radius"), ("arm", "radius"))
OPTIONAL = {"task.swash_on_demand": (("task", "pump_power"),), "bucket.width": (("bucket", "capacity"), *OUTLINE),
            "bucket.capacity": (("bucket", "width"),)}


def simulation(path):
    return path.replace(".toml", ".sim.toml")


class Reader:
    """Reads profiles by the loader of a kind; with a SIMULATED kind a text is that of the file beside."""

    def __init__(self, program, scratch, good):
        self._program = program
        self._path = os.path.join(scratch, "changed.toml")
        self._good = good

    def errors_of_file(self, kind, path):
        done = subprocess.run([self._program, kind, path], capture_output=True, text=True,
                              timeout=1800)
        assert done.returncode == (1 if done.stderr else 0) and not done.stdout, done
        return done.stderr

    def errors_of(self, kind, text):
        machine = text
        if kind.startswith(SIMULATED):
            machine = self._good[kind.removeprefix(SIMULATED)]
            with open(simulation(self._path), "w", encoding="utf-8") as stream:
                stream.write(text)
        with open(self._path, "w", encoding="utf-8") as stream:
            stream.write(machine)
        return self.errors_of_file(kind, self._path)


def wrong_cases(reader, kind, good, cases):
    for what, change, needles in cases:
        errors = reader.errors_of(kind, changed(good, change))
        missing = [needle for needle in needles if needle not in errors]
        if not errors or missing:
            yield f"{what}: without {missing}:\n{errors}"


def wrong_keys(reader, kind, good, ranges):
    """Each key is told if it is missing, and its range if its number is out of it."""
    for path in leaves(tomllib.loads(good)):
        key = key_path(path)
        errors = reader.errors_of(kind, without(good, path))
        # A simulated bucket may have no figures of its own; a machine's has all or none.
        optional = key in OPTIONAL and (kind.startswith(SIMULATED) or key != "bucket.capacity")
        if optional:
            less = without(good, path)
            for other in OPTIONAL[key]:
                if other[1] in tomllib.loads(less)[other[0]]:
                    less = without(less, other)
            errors = reader.errors_of(kind, less)
            if errors:
                yield f"{key} is missed: {errors}"
        if not optional and f"{key}: missing" not in errors:
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
            if kind != other:
                # The other's file with a word changed: two hundred keys are not called missing.
                errors = reader.errors_of(kind, text.replace(f'kind = "{other}"', f'kind = "{kind}"'))
                if "1 error" not in errors or f'is it "{other}"?' not in errors:
                    yield f"{other} that says {kind}: {errors}"


NFC = "excavator_22t_nfc"
LIKE = '"excavator_22t"'
# (what, text of the file, text with the slip, needles); what `like` names is in the same folder.
LIKE_CASES = [
    ("like nobody", LIKE, '"nobody"', ['mine.toml: 1 error', 'like (line ', '"nobody"', "there is no ",
                                         "nobody.toml"]),
    ("like itself", LIKE, '"mine"', ['mine.toml: 1 error', 'like (line ', '"mine" is this file itself']),
    ("like one that is like another", LIKE, f'"{NFC}"', [f"{NFC}.toml is like another itself"]),
    ("pressures that hardly differ", "pressure = [0.8e6, 3.0e6]", "pressure = [2.9e6, 3.0e6]",
     ["pump[0].negative_flow.pressure (line ", "at least 200000 Pa more"]),
    ("a side's bypass where none closes evenly", "closes_at = 0.25 }",
     "closes_at = 0.0 }\n[valve.answer.boom.extend]\nbypass_closes_at = 0.2",
     ["valve.answer.boom.extend.bypass_closes_at (line ", "0.2; allowed: only where valve.bypass.closes_at"]),
    ("a side's bypass that never closes", "closes_at = 0.25 }",
     "closes_at = 0.25 }\n[valve.answer.boom.retract]\nbypass_closes_at = 1.2",
     ["valve.answer.boom.retract.bypass_closes_at (line ", "1.2", "0.01 .. 1"]),
]


def like_cases(reader, folder, scratch):
    """What is wrong with `like`, with what the file says itself, and with what the other file says."""
    texts = {}
    for name in ("excavator_22t", NFC):
        with open(os.path.join(folder, f"{name}.toml"), encoding="utf-8") as stream:
            texts[name] = stream.read()
        with open(os.path.join(scratch, f"{name}.toml"), "w", encoding="utf-8") as stream:
            stream.write(texts[name])
    path = os.path.join(scratch, "mine.toml")
    for what, old, new, needles in LIKE_CASES:
        assert old in texts[NFC], old
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(texts[NFC].replace(old, new))
        errors = reader.errors_of_file("excavator", path)
        missing = [needle for needle in needles if needle not in errors]
        if missing:
            yield f"{what}: without {missing}:\n{errors}"
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(texts[NFC] + "\n[boom]\nlength = 5000.0\n")
    base = os.path.join(scratch, "excavator_22t.toml")
    with open(base, "w", encoding="utf-8") as stream:
        stream.write(with_number(texts["excavator_22t"], ["arm", "length"], 2900.0))
    errors = reader.errors_of_file("excavator", path)
    arm = re.search(r"^  arm\.length \(line (\d+) of (.*?)\): ", errors, re.MULTILINE)
    if not arm or arm[2] != base or not re.search(r"^  boom\.length \(line \d+\): ", errors, re.MULTILINE):
        yield f"a wrong number in the other file and one in this:\n{errors}"


def command_reports(graben, path):
    """The tool passes a profile's errors on: status 1, nothing on its output."""
    done = subprocess.run([graben, "pose", "--profile", path, "--strokes=1.0,1.1,0.4"],
                          capture_output=True, text=True, timeout=1800)
    if done.returncode != 1 or done.stdout or "here it must be excavator" not in done.stderr:
        yield f"graben pose: status {done.returncode}: {done.stdout}{done.stderr}"


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=1800)


def without_simulation(graben, scratch, good):
    """What a real machine needs: nothing of a simulated one. What simulates says which file lacks."""
    path = os.path.join(scratch, "alone.toml")
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(good["excavator"])
    line = ("plan", "--profile", path, "--out", scratch)
    for command in (("pose", "--profile", path, "--strokes=1.0,1.1,0.4"),
                    ("strokes", "--profile", path, "--x=5.5", "--y=-0.5", "--attitude=1.5"),
                    (*line, "--from=8.0,0.0,0.0,2.27", "--to=5.0,0.0,0.0,1.22", "--speed=0.3")):
        done = run(graben, *command)
        if done.returncode != 0 or not done.stdout or done.stderr:
            yield f"{command}: status {done.returncode}: {done.stdout}{done.stderr}"
    for command in (("dig", "--profile", path, "--out", scratch), line):
        done = run(graben, *command)
        if (done.returncode != 1 or done.stdout or f"{simulation(path)}: there is no such file" not in done.stderr
                or "masses" not in done.stderr):
            yield f"{command}: status {done.returncode}: {done.stdout}{done.stderr}"


def main():
    graben, program, folder = sys.argv[1:]
    shipped = [name for name in sorted(os.listdir(folder))
               if name.endswith(".toml") and not name.endswith(".sim.toml")]
    wrong = [] if shipped else ["no shipped profile"]
    good, simulated = {}, {}
    for kind, name in KINDS.items():
        path = os.path.join(folder, name)
        with open(path, encoding="utf-8") as stream:
            good[kind] = stream.read()
        with open(simulation(path), encoding="utf-8") as stream:
            simulated[kind] = stream.read()
    with tempfile.TemporaryDirectory() as scratch:
        reader = Reader(program, scratch, good)
        for name in shipped:
            path = os.path.join(folder, name)
            with open(path, "rb") as stream:
                kind = tomllib.load(stream)["kind"]
            wrong += [f"{name}: {text}" for read_as in (kind, SIMULATED + kind, "kind")
                      for text in [reader.errors_of_file(read_as, path)] if text]
        for kind, cases in (("excavator", excavator_cases), ("dozer", dozer_cases)):
            wrong += wrong_cases(reader, kind, good[kind], cases.CASES)
            wrong += wrong_keys(reader, kind, good[kind], cases.RANGES)
            wrong += wrong_cases(reader, SIMULATED + kind, simulated[kind], cases.SIMULATION_CASES)
            wrong += wrong_keys(reader, SIMULATED + kind, simulated[kind], cases.SIMULATION_RANGES)
        wrong += wrong_kind(reader, good)
        wrong += like_cases(reader, folder, scratch)
        wrong += without_simulation(graben, scratch, good)
        wrong += command_reports(graben, os.path.join(folder, KINDS["dozer"]))
    cases = sum(len(found) for kind in (excavator_cases, dozer_cases)
                for found in (kind.CASES, kind.SIMULATION_CASES))
    print("\n".join(wrong) or f"{len(shipped)} shipped, {cases} wrong profiles told")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
