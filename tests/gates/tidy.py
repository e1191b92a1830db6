#!/usr/bin/env python3
"""Gate: clang-tidy, with the tree's .clang-tidy, finds nothing in our sources.

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

import tree

OURS = ("firmware", "hal", "can_dbc", "platform", "app", "tests")
INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"]', re.MULTILINE)
# GCC, whose warnings are errors, decides on its own; these differ from it in kind, not in care:
# clang counts signedness as part of -Wconversion, sees a promotion in the macro NAN, and knows not
# all of GCC's flags.
CLANG_ONLY = ("-Wno-unknown-warning-option", "-Wno-sign-conversion", "-Wno-double-promotion")

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
    entries = json.loads((arguments.build / "compile_commands.json").read_text())
    tests = root / "tests"
    return [e for e in entries if os.path.realpath(e["file"]) in wanted
            and not pathlib.Path(e["file"]).resolve().is_relative_to(tests)]


def our_inputs(entry: dict) -> tuple[list[pathlib.Path], bool]:
    """The source and every header it reaches below our -I folders, and whether one is HEAVY."""
    folders = [pathlib.Path(entry["directory"], word[2:])
               for word in shlex.split(entry["command"]) if word.startswith("-I")]
    found, heavy, todo = set(), False, [pathlib.Path(entry["file"])]
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


def check(entry: dict) -> str:
    """What clang-tidy has to say on a source; nothing when it is clean."""
    inputs, heavy = our_inputs(entry)
    short = heavy or pathlib.Path(entry["file"]).resolve().is_relative_to(root / "app")
    remembered = cache / key_of(entry, inputs)
    if remembered.exists():
        return ""
    done = subprocess.run(
        [tool, "-p", str(arguments.build), "--quiet", f"--config-file={config}",
         f"--header-filter=^{re.escape(str(root))}/({'|'.join(OURS)})/",
         *(f"--extra-arg={flag}" for flag in CLANG_ONLY),
         *([f"--checks={SHORT_LIST}"] if short else []), entry["file"]],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode == 0 and not done.stdout.strip():
        remembered.touch()
        return ""
    return done.stdout.strip() or f"{entry['file']}: {done.stderr.strip()}"


parser = tree.arguments(__doc__)
parser.add_argument("--build", required=True, type=pathlib.Path)
parser.add_argument("--cache", required=True, type=pathlib.Path)
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

entries = our_entries()
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    # A header's finding comes up in every source that includes it; once is enough.
    problems = list(dict.fromkeys(text for text in pool.map(check, entries) if text))
tree.report("tidy", problems, len(entries), "sources")
