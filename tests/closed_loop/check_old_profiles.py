# SPDX-License-Identifier: Apache-2.0
"""Profiles as they were shipped on 2026-11-28 (tests/old_profiles), without the keys that came later: they run, to the
same bits as with every key that has a default written out with it; or what reads them names each key to add.

check_old_profiles.py GRABEN READ_PROFILE
"""

import copy
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "unit" / "machines"))
from profile_edit import at, toml_text  # noqa: E402

OLD = pathlib.Path(__file__).parent.parent / "old_profiles"
GRABEN, READ = sys.argv[1:]
# Profile, section of the keys' reference, kind, what it runs, and how many defaults it has to have left out at least.
MACHINES = (("excavator_12t", "An excavator", "excavator", ("autodig", "--task", "flatten"), 12),
            ("dozer_9t", "A dozer", "dozer", ("grade",), 4))
# ProfileHash of MachineIdentity and EcuIdentity: two texts are two profiles.
HASH = re.compile(r"((?:0CFF2880|18FF3482)#).{8}")


def call(*arguments, status=0):
    done = subprocess.run([str(word) for word in arguments], capture_output=True, text=True, timeout=120)
    assert status is None or done.returncode == status, f"{arguments}: {done.returncode}: {done.stdout}{done.stderr}"
    return done.stderr if status is None else done.stdout


def defaults(reference, title):
    """Key and default of each row of a section that has one."""
    section = reference.split(f"\n## {title}\n")[1].split("\n## ")[0]
    for row in re.findall(r"^\| `(.*?)` \|.*\| (.*?) \|$", section, re.MULTILINE):
        if row[1] not in ("required", "optional"):
            yield from ((key, row[1]) for key in expanded(row[0]))


def expanded(key):
    """pump.{boom, arm}.x is two keys."""
    found = re.search(r"\{(.*?)\}", key)
    if not found:
        return [key]
    return [one for part in found[1].split(", ") for one in expanded(key[:found.start()] + part + key[found.end():])]


def places(document, steps, path=()):
    """Where a key may stand; pump[].x in each pump that there is."""
    if len(steps) == 1:
        return [(*path, steps[0])]
    head, rest = steps[0], steps[1:]
    if head.endswith("[]"):
        return [place for n in range(len(document.get(head[:-2], [])))
                for place in places(document[head[:-2]][n], rest, (*path, head[:-2], n))]
    return places(document.get(head, {}), rest, (*path, head))


def put(document, place, value):
    """False where the key is there already, or a table that others stand in for."""
    for step in place[:-1]:
        document = document[step] if isinstance(step, int) else document.setdefault(step, {})
    if not isinstance(document, dict) or place[-1] in document:
        return False
    document[place[-1]] = value
    return True


def written_out(file, reader, rows):
    """The file's text with each default that it leaves out and may have; and which those are."""
    document, added = tomllib.loads(file.read_text(encoding="utf-8")), []
    for key, default in rows:
        value = tomllib.loads(f"x = {default}")["x"]
        for place in places(document, key.split(".")):
            more = copy.deepcopy(document)
            if not put(more, place, value):
                continue
            file.write_text(toml_text(more), encoding="utf-8")
            # What goes only with a part that this machine has not is refused by its name.
            errors = call(READ, reader, file.with_name(file.name.replace(".sim", "")), status=None)
            if not errors:
                document = more
                added.append(place)
                assert at(document, place) == value
            else:
                assert place[-1] in errors or str(place[0]) in errors, f"{key}: {errors}"
    file.write_text(toml_text(document), encoding="utf-8")
    return added


def log_of(profile, words, folder):
    call(GRABEN, *words, "--profile", profile, "--out", folder)
    return HASH.sub(r"\1", (folder / f"{words[0]}.log").read_text(encoding="ascii"))


def runs_as_with_defaults(reference, scratch, machine, title, kind, words, least):
    old, new = scratch / f"{machine}.toml", scratch / "written" / f"{machine}.toml"
    new.parent.mkdir(exist_ok=True)
    for suffix in (".toml", ".sim.toml"):
        for at_file in (old, new):
            at_file.with_suffix(suffix).write_bytes((OLD / f"{machine}{suffix}").read_bytes())
    errors = call(READ, f"simulated-{kind}", old, status=None)
    if errors:
        lines = errors.strip().splitlines()[1:]
        assert lines and all(line.endswith(": missing") for line in lines), f"it does not say what to add: {errors}"
        return f"{machine}: to be added: {', '.join(line.strip() for line in lines)}"
    added = written_out(new, kind, defaults(reference, f"{title}: NAME.toml"))
    added += written_out(new.with_suffix(".sim.toml"), f"simulated-{kind}",
                         defaults(reference, f"{title}'s simulation: NAME.sim.toml"))
    assert len(added) >= least, f"{machine}: only {len(added)} defaults are written out: {added}"
    before, after = log_of(old, words, scratch / "a"), log_of(new, words, scratch / "b")
    assert len(before.splitlines()) > 10000 and before == after, f"{machine} runs otherwise with its defaults said"
    return f"{machine}: {len(added)} defaults"


with tempfile.TemporaryDirectory() as name:
    keys = call(GRABEN, "check", "--keys")
    for row in MACHINES:
        print(runs_as_with_defaults(keys, pathlib.Path(name), *row))
