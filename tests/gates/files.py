#!/usr/bin/env python3
"""Gate: no hand-written source is too long, no file knows the machine it was written on."""

import re

import tree

SOURCES = (*tree.CXX, ".py", ".sh", ".cmake", ".js", ".mjs", ".css", ".html", "CMakeLists.txt")
MAX_LINES = 450
WARN_LINES = 400

# A home folder, or the server that a package came from. The brackets keep this file from
# matching itself.
MACHINE = re.compile(
    r"(?<![\w.])/(?:roo[t]|hom[e]|User[s]|wor[k]|workspac[e])/"
    r"|registr[y][.]npm|deb[.]debian[.]org|snapshot[.]debian|pypi[.]org|pythonhoste[d]|npmmirro[r]")

root = tree.arguments(__doc__).parse_args().root.resolve()
names = tree.files(root)
problems = []
for name in names:
    data = (root / name).read_bytes()
    if b"\0" in data:
        continue
    lines = data.decode("utf-8", errors="replace").splitlines()
    if name.endswith(SOURCES) and not tree.is_generated(name):
        if len(lines) > MAX_LINES:
            problems.append(f"{name}: {len(lines)} lines; {MAX_LINES} is the most")
        elif len(lines) > WARN_LINES:
            print(f"WARNING {name}: {len(lines)} lines, nearing {MAX_LINES}")
    for number, line in enumerate(lines, 1):
        if match := MACHINE.search(line):
            problems.append(f"{name}:{number}: '{match[0]}' belongs to one machine or server")
tree.report("files", problems, len(names))
