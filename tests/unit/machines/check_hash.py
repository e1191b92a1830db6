# SPDX-License-Identifier: Apache-2.0
"""The profile's hash covers the values and nothing else: the same for other comments, order, layout and
spelling of numbers, another for each key's change: check_hash.py READ_PROFILE MACHINES_FOLDER."""

import copy
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

from profile_edit import at, key_path, leaves, toml_text

# Keys whose value cannot be changed alone: another kind has other keys, one pump has no other, and the
# design's and the path's ends are tied to others.
TIED = {"kind", "like", "pump[0].kind", "pump[1].kind", "task.path.x", "task.path.attitude",
        *(f"valve.pump.{drive}" for drive in ("boom", "arm", "bucket", "swing"))}

# What no shipped file needs to have.
ANSWERS = "".join(f"""
[valve.answer.{drive}.{side}]
spool_to_duty = [[0.0, 412.0], [0.1, 455.0], [1.0, 1000.0]]
dead_time = 0.18
lag = 0.07
spool_time_constant = 0.03
driven = [0.42, 0.90]
""" for drive in ("boom", "arm", "bucket") for side in ("extend", "retract")) + """
[provenance]
"valve.answer.boom.extend.lag" = { deviation = 0.004, from = "drive.log, 2026-11-24" }
"control.law" = { from = "tried" }
"""


def profiles(folder):
    """Names and texts of those that are shipped, and of one that has everything."""
    for file in sorted(pathlib.Path(folder).glob("*.toml")):
        if not file.name.endswith(".sim.toml"):
            yield file.name, file.read_text(encoding="utf-8")
    file = pathlib.Path(folder, "excavator_22t.toml")
    yield f"{file.name} with answers", file.read_text(encoding="utf-8") + ANSWERS


def hash_of(program, path, document_text):
    path.write_text(document_text, encoding="utf-8")
    done = subprocess.run([program, "hash", path], capture_output=True, text=True, timeout=1800)
    return done.stdout.strip() if done.returncode == 0 else None


def as_power(number):
    """0.035 as 35e-3."""
    return f"{number[1].lstrip('0') or 0}e-{len(number[1])}"


def candidates(value):
    """Values a little beside this one."""
    if isinstance(value, list):
        if isinstance(value[-1], list):
            # The second number of the last but one pair: the ends are bound.
            place = -2 if len(value) > 2 else -1
            return [value[:place] + [[*value[place][:-1], v]] + value[len(value) + place + 1:]
                    for v in candidates(value[place][-1])]
        return [[v, *value[1:]] for v in candidates(value[0])]
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1]
    if isinstance(value, str):
        return [v for v in ("retract", "extend", "none", "global", "connected", "servo", "kim") if v != value]
    step = 1e-6 * abs(value) or 1e-12
    return [value + step, value - step]


def main():
    program, folder = sys.argv[1:]
    wrong, keys = [], 0
    with tempfile.TemporaryDirectory() as scratch:
        path = pathlib.Path(scratch, "changed.toml")
        for name, text in profiles(folder):  # What `like` names.
            pathlib.Path(scratch, name).write_text(text, encoding="utf-8")
        for name, text in profiles(folder):
            document = tomllib.loads(text)
            usual = hash_of(program, path, text)
            same = {"a comment": text + "\n# Nothing.\n", "another layout": toml_text(document),
                    "another order": toml_text(dict(reversed(document.items()))),
                    "whole numbers": re.sub(r"(?<![\d.])(\d+)\.0(?![\d.])", r"\1", text),
                    "powers of ten": re.sub(r"(?<![\d.])0\.(\d+)(?![\de.])", as_power, text)}
            wrong += [f"{name}: {what} changes the hash" for what, other in same.items()
                      if other == text or hash_of(program, path, other) != usual]
            for leaf in leaves(document):
                keys += 1
                found = []
                for value in candidates(at(document, leaf)):
                    changed = copy.deepcopy(document)
                    at(changed, leaf[:-1])[leaf[-1]] = value
                    found.append(hash_of(program, path, toml_text(changed)))
                if usual in found:
                    wrong.append(f"{name}: {key_path(leaf)} is not in the hash")
                if not any(found) and key_path(leaf) not in TIED:
                    wrong.append(f"{name}: {key_path(leaf)}: no other value is taken")
    print("\n".join(wrong) or f"{keys} keys are in the hash")
    return 1 if wrong or keys < 200 else 0


if __name__ == "__main__":
    sys.exit(main())
