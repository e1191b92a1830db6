#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: clang-tidy, with the tree's .clang-tidy, finds nothing in our sources.

The sources of a folder are looked at as one: what takes the time is to read their headers, and to
match every check against them.

What was clean is remembered in the build folder under a hash of everything of ours that goes into
it: the source, each of our headers that it includes, the compile command, .clang-tidy, the tool's
version. A system header that changes is not noticed; a fresh build folder knows nothing.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

import changed_since
import tree

JUDGED = ("firmware/", "hal/", "platform/", "app/")
OURS = ("firmware", "hal", "can_dbc", "platform", "app", "tests")
REFUSED = re.compile(r"^([^:\n]+):\d+:\d+: (?:error|warning): ", re.MULTILINE)
# The tool refuses a list without any check of its own, which the compiler's warnings are not.
JUST_COMPILED = "-*,clang-diagnostic-*,misc-unused-alias-decls"
INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"]', re.MULTILINE)
UNITY = re.compile(r"/Unity/unity_\d+_cxx[.]cxx$")
UNITY_INCLUDE = re.compile(r'^#include "([^"]+)"$', re.MULTILINE)
# GCC, whose warnings are errors, decides on its own; these differ from it in kind, not in care:
# clang counts signedness as part of -Wconversion, sees a promotion in the macro NAN, and knows not
# all of GCC's flags.
CLANG_ONLY = ("-Wno-unknown-warning-option", "-Wno-sign-conversion", "-Wno-double-promotion")

# Of the core the analyzer gives up on a dozen functions, whatever it may take: they have more paths than
# anybody follows. With a fifth of what it takes by itself it has still been in all basic blocks of
# motion, mcv and safety but 11 of 638 (3 with all), in three quarters of the time (debug.Stats).
ANALYZER = ("-Xclang", "-analyzer-config", "-Xclang", "max-nodes=50000")

# Version 14 matches every check against every template of the system headers: four to eight seconds
# a source, a minute with these. They, and all of app/, get a short list: defects that neither GCC nor
# the sanitizers would show; the whole list is for what moves metal. Tests are not looked at: GCC's
# warnings judge them, and the sanitizers run them.
HEAVY = re.compile(rb"^(nlohmann/json[.]hpp|CLI/|toml[+][+]/)")
SHORT_LIST = ("-*,clang-diagnostic-*,bugprone-use-after-move,bugprone-branch-clone,"
              "bugprone-dangling-handle,bugprone-integer-division,bugprone-suspicious-enum-usage,"
              "misc-redundant-expression,cppcoreguidelines-slicing")


def our_entries() -> list[dict]:
    wanted = {str(root / name) for name in tree.cxx_files(root)}
    entries = [each for entry in json.loads((arguments.build / "compile_commands.json").read_text())
               for each in apart(entry)]
    tests = root / "tests"
    for entry in entries:
        entry["path"] = os.path.realpath(os.path.join(entry["directory"], entry["file"]))
    return [without_precompiled(e) for e in entries if e["path"] in wanted
            and not pathlib.Path(e["path"]).is_relative_to(tests)]


def apart(entry: dict) -> list[dict]:
    """What is compiled as one, source by source."""
    if not UNITY.search(entry["file"]):
        return [entry]
    words = shlex.split(entry["command"])
    return [{**entry, "file": name, "as_one": True, "command": shlex.join(
                [name if word == entry["file"] else word for word in words])}
            for name in UNITY_INCLUDE.findall(pathlib.Path(entry["file"]).read_text())]


def without_precompiled(entry: dict) -> dict:
    """As if nothing were precompiled: what GCC made of it, clang cannot read."""
    words, kept = iter(shlex.split(entry["command"])), []
    for word in words:
        if word == "-include":
            header = next(words)
            kept += [] if header.endswith("/cmake_pch.hxx") else [word, header]
        elif word != "-Winvalid-pch":
            kept.append(word)
    return {**entry, "command": shlex.join(kept)}


def our_inputs(entry: dict) -> tuple[list[pathlib.Path], bool]:
    """The source and every header it reaches below our -I folders, and whether one is HEAVY."""
    folders = [pathlib.Path(entry["directory"], word[2:])
               for word in shlex.split(entry["command"]) if word.startswith("-I")]
    found, heavy, todo = set(), False, [pathlib.Path(entry["path"])]
    while todo:
        current = todo.pop().resolve()
        if current in found or not current.is_file():
            continue
        found.add(current)
        for header in INCLUDE.findall(current.read_bytes()):
            heavy = heavy or bool(HEAVY.match(header))
            todo += [folder / header.decode() for folder in (current.parent, *folders)]
    return sorted(found), heavy


def key_of(entry: dict, inputs: list[pathlib.Path]) -> str:
    digest = hashlib.sha256(f"{version}\n{entry['command']}".encode())
    for path in (config, pathlib.Path(__file__), *inputs):
        digest.update(f"\n{path}\n".encode() + path.read_bytes())
    return digest.hexdigest()


def batches_of(entries: list[dict]) -> list[list[dict]]:
    """What is not remembered as clean, by folder, flags, list of checks and how it is compiled: one pass
    reads their headers once."""
    together: dict[tuple, list[dict]] = {}
    for entry in entries:
        inputs, heavy = our_inputs(entry)
        remembered = cache / key_of(entry, inputs)
        if remembered.exists():
            continue
        words = shlex.split(entry["command"])
        flags = tuple(word for word in words if word.startswith(("-D", "-f", "-I", "-std")))
        path = pathlib.Path(entry["path"])
        checks = SHORT_LIST if heavy or path.is_relative_to(root / "app") else ""
        # What was left out of the others' unity has names that others there have, too.
        together.setdefault((path.parent, flags, checks, "as_one" in entry), []).append(
            {**entry, "remembered": remembered, "checks": checks})
    return list(together.values())


def as_one(batch: list[dict]) -> tuple[str, list[tuple[str, int]]]:
    """The sources one behind the other, and for each line whence it is. They are copied, not included:
    the analyzer follows paths only through what stands in the main file."""
    lines, whence = [], []
    for number, entry in enumerate(batch):
        path = pathlib.Path(entry["path"])
        # Whoever looks for an #include too many begins again behind a macro.
        for line, text in enumerate([f"#define GRABEN_TIDY_{number}", *path.read_text().splitlines()]):
            lines.append(text)
            whence.append((str(path), line))
    return "\n".join(lines) + "\n", whence


def run(batch: list[dict], checks: str) -> str:
    """What clang-tidy has to say on sources as if they were one; nothing when they are clean."""
    passes.append(len(batch))
    text, whence = as_one(batch)
    with tempfile.TemporaryDirectory(dir=cache) as folder:
        one = pathlib.Path(folder, "sources.cpp").resolve()
        one.write_text(text)
        words = [str(one) if word == batch[0]["file"] else word
                 for word in shlex.split(batch[0]["command"])]
        words.insert(1, f"-I{os.path.dirname(batch[0]['path'])}")
        pathlib.Path(folder, "compile_commands.json").write_text(json.dumps(
            [{"directory": batch[0]["directory"], "file": str(one), "command": shlex.join(words)}]))
        done = subprocess.run(
            [tool, "-p", folder, "--quiet", f"--config-file={config}",
             f"--header-filter=^{re.escape(str(root))}/({'|'.join(OURS)})/",
             *(f"--extra-arg={flag}" for flag in (*CLANG_ONLY, *ANALYZER)),
             *([f"--checks={checks}"] if checks else []), str(one)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode == 0 and not done.stdout.strip():
        return ""

    def at_home(match: re.Match) -> str:
        path, line = whence[int(match[1]) - 1]
        return f"{path}:{line}"
    return (re.sub(re.escape(str(one)) + r":(\d+)", at_home, done.stdout).strip()
            or f"{batch[0]['path']}: {done.stderr.strip()}")


def check(batch: list[dict]) -> list[str]:
    """What there is to say on a batch. Some cannot stand behind the others, as their unnamed namespaces
    have the same names: those that are complained of make up the next batch, and in the end only
    what is said of a source alone counts."""
    alone = len(batch) == 1
    # The whole list takes long: first whether they can stand together at all. The short one is
    # hardly dearer than just that.
    first = JUST_COMPILED if not alone and not batch[0]["checks"] else ""
    said = (first and run(batch, first)) or run(batch, batch[0]["checks"])
    if not said:
        for entry in batch:
            entry["remembered"].touch()
        return []
    if alone:
        return [said]
    refused = set(REFUSED.findall(said))
    later = [e for e in batch if e["path"] in refused]
    if not 0 < len(later) < len(batch):
        later = batch[len(batch) // 2:]
    return check([e for e in batch if e not in later]) + check(later)


def unseen(seen: set[str]) -> list[str]:
    """A source of the core or of an app that no command compiles is one that nobody looks at."""
    return [f"{name}: nothing compiles it here, so it was not read"
            for name in sorted(tree.cxx_files(root)) if name.endswith(".cpp")
            and name.startswith(JUDGED) and str(root / name) not in seen]


parser = tree.arguments(__doc__)
parser.add_argument("--build", required=True, type=pathlib.Path)
parser.add_argument("--cache", required=True, type=pathlib.Path)
parser.add_argument("--leave-out", metavar="FOLDER", help="whose sources are not read; it is said")
parser.add_argument("--changed", action="store_true",
                    help="only sources that changed since the last whole run, or a header of theirs did; the others are counted")
parser.add_argument("--config", type=pathlib.Path, help="another one than the tree's .clang-tidy")
arguments = parser.parse_args()
root = arguments.root.resolve()
config = (arguments.config or root / ".clang-tidy").resolve()
cache = arguments.cache
cache.mkdir(parents=True, exist_ok=True)
tool = shutil.which("clang-tidy-14") or shutil.which("clang-tidy")
if tool is None:
    sys.exit("tidy: clang-tidy is missing; ./test installs it")
version = subprocess.run([tool, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout

passes: list[int] = []  # how many sources each one read
entries = our_entries()
compiled = {entry["path"] for entry in entries}
if arguments.leave_out:
    kept = [e for e in entries if not pathlib.Path(e["path"]).is_relative_to(root / arguments.leave_out)]
    print(f"tidy: {len(entries) - len(kept)} sources of {arguments.leave_out}/ are NOT read")
    entries = kept
names, since = changed_since.changed(root, "tidy") if arguments.changed else (None, "asked for")
if names is None:
    print(f"tidy: everything, as {since}")
elif ".clang-tidy" not in names:
    touched = {(root / name).resolve() for name in names}
    kept = [e for e in entries if not touched.isdisjoint(our_inputs(e)[0])]
    print(f"tidy: {len(entries) - len(kept)} sources are as they were {since} and are NOT read")
    entries = kept
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    # A header's finding comes up in every batch that includes it; once is enough.
    problems = list(dict.fromkeys(text for texts in pool.map(check, batches_of(entries))
                                  for text in texts))
problems += unseen(compiled)
print(f"tidy: {sum(passes)} sources read in {len(passes)} passes")
print(f"tidy: {len(entries)} of {len(compiled)} sources judged")
tree.report("tidy", problems, len(compiled), "sources")
