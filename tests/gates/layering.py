#!/usr/bin/env python3
"""Gate: #include points one way, app -> platform -> hal -> firmware.

firmware and hal take no header that needs an operating system or a heap, and no third party but
Eigen. The plant, which stands in for the real machine, must not even indirectly see the model
that the controller has of it: otherwise a wrong sign would cancel itself.
"""

import posixpath
import re

import tree
from freestanding import ALLOWED_HEADERS, FREESTANDING

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', re.MULTILINE)

# Folder: what a file in it must not include.
FORBIDDEN = {
    "firmware/": ("hal/", "platform/", "app/", "can_dbc/", "tests/"),
    "hal/": ("platform/", "app/", "tests/"),
    "can_dbc/": ("platform/", "app/", "tests/"),
    "platform/": ("app/", "tests/"),
    "app/": ("tests/",),
    # The controller's process opens no TCP socket.
    "app/ecu/": ("app/scope/", "app/cli/"),
}
# The same through any number of headers in between.
FORBIDDEN_INDIRECTLY = {
    "app/plant/": tuple(f"firmware/{part}/" for part in (
        "hydraulics", "mcv", "kinematics", "motion", "travel", "safety")),
}


def includes_of(name: str, text: str):
    """(line, header, quoted) with a quoted header as a path from the root."""
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start(2)) + 1
        quoted = match[1] == '"'
        header = match[2]
        if quoted:
            beside = posixpath.normpath(posixpath.join(posixpath.dirname(name), header))
            header = beside if beside in sources else posixpath.normpath(header)
        yield line, header, quoted


def reached_from(name: str) -> dict[str, str]:
    """Every header that name includes, directly or not, with the chain that leads there."""
    reached, todo = {}, [(name, name)]
    while todo:
        current, chain = todo.pop()
        for _, header, _ in includes.get(current, []):
            if header not in reached:
                reached[header] = f"{chain} -> {header}"
                todo.append((header, reached[header]))
    return reached


root = tree.arguments(__doc__).parse_args().root.resolve()
sources = {n: (root / n).read_text() for n in tree.files(root) if n.endswith(tree.CXX)}
includes = {name: list(includes_of(name, text)) for name, text in sources.items()}

problems = []
for name, found in includes.items():
    for folder, forbidden in FORBIDDEN.items():
        problems += [f"{name}:{line}: {folder} must not include {header}"
                     for line, header, _ in found
                     if name.startswith(folder) and header.startswith(forbidden)]
    if name.startswith(FREESTANDING):
        problems += [f"{name}:{line}: <{header}> is not on the list of freestanding headers"
                     for line, header, quoted in found
                     if header not in ALLOWED_HEADERS and header not in sources
                     and (quoted or not header.startswith("Eigen/"))]
    for folder, forbidden in FORBIDDEN_INDIRECTLY.items():
        if name.startswith(folder):
            problems += [f"{folder} must not see {header}: {chain}"
                         for header, chain in reached_from(name).items()
                         if header.startswith(forbidden)]
tree.report("layering", sorted(set(problems)), sum(map(len, includes.values())), "includes")
