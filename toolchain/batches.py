#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which sources are compiled as one: batches.py COUNT ROOT[:ROOT] SOURCE... prints the number of the batch
of each source; there are COUNT of them, or as many as it takes. Headers are found from the roots.

Two sources are never in the same batch if they call something alike: what an unnamed namespace of one has,
and anything that the other, or one of our headers that it reads, declares. So nobody has to choose a name
or a folder for the sake of the build. Read are the lines that begin in the first column, as clang-format
leaves declarations; too many names cost time, none costs a build.
"""

import functools
import pathlib
import re
import sys

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
DECLARED = re.compile(r"(?<![\w:])(~?\w+)\s*(?:\[[^\]]*\]\s*)*(?:[({=;]|:(?!:)|$)")
# A local constant that is called as an unnamed namespace's of another source would hide it.
LOCAL = re.compile(r"^\s+(?:static )?constexpr .*?\b(k[A-Z]\w*)\s*(?:\[[^\]]*\]\s*)*[={(]", re.MULTILINE)
MACRO = re.compile(r"^#define (\w+)|^namespace (\w+) =")


def names_of(line: str) -> set[str]:
    if match := MACRO.match(line):
        return {match[1] or match[2]}
    line = line.replace(" final ", " ")
    if not re.match(r"[\w\[]", line) or line.startswith(("namespace", "template", "using namespace", "static_assert")):
        return set()
    # What is in <> or [[]] is used, not declared.
    plain = re.sub(r"\[\[[^\]]*\]\]", "", line)
    while (shorter := re.sub(r"<[^<>]*>", "", plain)) != plain:
        plain = shorter
    match = DECLARED.search(plain)
    return {match[1]} if match else set()


@functools.lru_cache(None)
def read(path: pathlib.Path) -> tuple[frozenset[str], frozenset[str], tuple[str, ...]]:
    """Names of its unnamed namespaces, of all that it declares, and what it includes."""
    text = COMMENT.sub("", path.read_text(encoding="utf-8"))
    own, every, unnamed = set(), set(LOCAL.findall(text)), False
    for line in text.splitlines():
        if line.startswith("namespace {"):
            unnamed = True
        elif unnamed and line.startswith("}") and line.strip() == "}":
            unnamed = False
        found = names_of(line)
        every |= found
        if unnamed or line.startswith(("static ", "#define ")):
            own |= found
    return frozenset(own), frozenset(every), tuple(INCLUDE.findall(text))


def reached(source: pathlib.Path, roots: list[pathlib.Path]) -> set[str]:
    """All that the source and our headers that it reads declare."""
    seen, todo, found = set(), [source], set()
    while todo:
        path = todo.pop()
        if path in seen or not path.is_file():
            continue
        seen.add(path)
        _, every, headers = read(path)
        found |= every
        for header in headers:
            todo += [folder / header for folder in (path.parent, *roots)]
    return found


def main():
    count, roots = int(sys.argv[1]), [pathlib.Path(name) for name in sys.argv[2].split(":")]
    sources = [pathlib.Path(name) for name in sys.argv[3:]]
    own = {source: read(source)[0] for source in sources}
    every = {source: reached(source, roots) for source in sources}
    most = -(-len(sources) // count)
    batches: list[list[pathlib.Path]] = []
    for source in sources:
        fitting = [batch for batch in batches if len(batch) < most and not any(
            own[source] & every[other] or own[other] & every[source] for other in batch)]
        if not fitting:
            batches.append([])
            fitting = batches[-1:]
        fitting[0].append(source)
        print(next(number for number, batch in enumerate(batches) if batch is fitting[0]))


if __name__ == "__main__":
    main()
