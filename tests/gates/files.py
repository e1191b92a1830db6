#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: no hand-written source is too long, few are short, no file knows the machine it was written on.

What is read together stands together: in no area may a fifth of the sources have 40 lines or fewer. A room's tuning.hpp
is as long as the room has judgements, and does not count.
A unit test that no CMakeLists.txt names is never run. The example of a machine kind keeps to what its recipe
promises."""

import pathlib
import re

import tree

SOURCES = (*tree.CXX, ".py", ".sh", ".cmake", ".js", ".ts", ".mjs", ".css", ".html", "CMakeLists.txt")
MAX_LINES = 400
LICENCE = "SPDX-License-Identifier"  # Its line does not count: it is in every file.
SHORT_LINES, SHORT_SHARE = 40, 0.20
COUNTED = (".cpp", ".hpp", ".py", ".ts")
# A machine kind by the recipe: what it takes is what the common rooms leave to it.
SMALL = ("tests/example_kind/", "12", "600")
AREAS = (("firmware/",), ("hal/",), ("platform/",), ("app/",), ("can_dbc/", "toolchain/"), ("tests/",))

# A home folder, or the server that a package came from, whoever's registry that is. The brackets keep this file from
# matching itself.
MACHINE = re.compile(
    r"(?<![\w.])/(?:roo[t]|hom[e]|User[s]|wor[k]|workspac[e])/"
    r"|(?<![\w.-])registr[y][.]\w|deb[.]debian[.]org|snapshot[.]debian|pypi[.]org|pythonhoste[d]|npmmirro[r]")

parser = tree.arguments(__doc__)
parser.add_argument("--small", nargs=3, default=SMALL, metavar=("FOLDER", "FILES", "LINES"),
                    help="a folder and the most that it may have")
options = parser.parse_args()
root = options.root.resolve()
names = tree.files(root)
problems, lengths = [], {}
for name in names:
    data = (root / name).read_bytes()
    if b"\0" in data:
        continue
    lines = data.decode("utf-8", errors="replace").splitlines()
    length = len(lines) - sum(LICENCE in line for line in lines[:3])
    if name.endswith(SOURCES):
        if length > MAX_LINES:
            problems.append(f"{name}: {length} lines; {MAX_LINES} is the most")
        if name.endswith(COUNTED) and not name.endswith("/tuning.hpp"):
            lengths[name] = length
    for number, line in enumerate(lines, 1):
        if match := MACHINE.search(line):
            problems.append(f"{name}:{number}: '{match[0]}' belongs to one machine or server")
for area in AREAS:
    counted = [length for name, length in lengths.items() if name.startswith(area)]
    short = sum(length <= SHORT_LINES for length in counted)
    if short >= SHORT_SHARE * len(counted) > 0:
        problems.append(f"{' and '.join(area)}: {short} of {len(counted)} sources have {SHORT_LINES} lines or fewer; "
                        f"under {SHORT_SHARE:.0%} may")
folder, most_files, most_lines = options.small[0], *map(int, options.small[1:])
inside = [sum(LICENCE not in line for line in (root / name).read_text().splitlines())
          for name in names if name.startswith(folder)]
if not 0 < len(inside) <= most_files or sum(inside) > most_lines:
    problems.append(f"{folder}: {len(inside)} files, {sum(inside)} lines; {most_files} and {most_lines} are the most")
lists = "\n".join((root / name).read_text() for name in names if name.endswith("CMakeLists.txt"))
words = set(re.findall(r"\w+", lists))
patterns = [pathlib.PurePath(pattern).name for pattern in re.findall(r"GLOB \w+ (\S+)\)", lists)]
for name in map(pathlib.PurePath, names):
    if (name.parts[:2] == ("tests", "unit") and name.match("test_*.cpp") and not any(map(name.match, patterns))
            and words.isdisjoint({name.stem, name.stem.removeprefix("test_")})):
        problems.append(f"{name}: no CMakeLists.txt names it, so it is never run")
tree.report("files", problems, len(names))
