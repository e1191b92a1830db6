#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the counts of loops.toml are those that the source has now: constants.py --source ROOT [--generated DIR]
[--rows FILE].

A row says by `of` where its count comes from: "FILE: EXPRESSION", the expression of whole numbers and constants that
the file, or one that it reads, has as `constexpr`. A count below the largest of them is red: the bound would be too
low, and nobody would see it. So is a row of constants without `of`, and a constant that is not there. A fact of
facts.toml beside them whose number is a constant is held the same way.
"""

import argparse
import ast
import functools
import pathlib
import re
import sys
import tomllib

NAME = re.compile(r"\bk[A-Z]\w*|\b[A-Z]\w*::k[A-Z]\w*")
DEFINED = r"constexpr\s+[\w:]+\s+{}\s*(?:=\s*([^;{{}}]+);|\{{([^;{{}}]+)\}};)"
# A template's.
BOUNDED = r"static_assert\([^;]*\b{}\s*<=\s*(\d+)"
OPERATIONS = {ast.Add: int.__add__, ast.Sub: int.__sub__, ast.Mult: int.__mul__, ast.FloorDiv: int.__floordiv__}


class Unknown(Exception):
    """No such constant, or no whole number."""


class Source:
    def __init__(self, folders):
        self.folders = [pathlib.Path(folder) for folder in folders]

    @functools.lru_cache(maxsize=None)
    def text(self, name):
        for folder in self.folders:
            if (folder / name).is_file():
                return (folder / name).read_text(encoding="utf-8")
        raise Unknown(f"no file {name}")

    @functools.lru_cache(maxsize=None)
    def files_of(self, name):
        """The file and all that it reads of ours, the nearest first."""
        found, due = [], [name]
        while due:
            file = due.pop(0)
            if file not in found:
                found.append(file)
                due += [read for read in re.findall(r'#include "([^"]+)"', self.text(file)) if self.has(read)]
        return found

    def has(self, name):
        return any((folder / name).is_file() for folder in self.folders)

    def constant(self, name, word):
        for file in self.files_of(name):
            if found := re.search(DEFINED.format(re.escape(word.split("::")[-1])), self.text(file)):
                return self.value(file, found[1] or found[2])
            if found := re.search(BOUNDED.format(re.escape(word)), self.text(file)):
                return int(found[1])
        raise Unknown(f"{name} has no constant {word}")

    def size(self, name, word):
        """Of a std::array."""
        for file in self.files_of(name):
            if found := re.search(rf"std::array<[^;=]*,\s*(\d+)>\s+{re.escape(word)}\b", self.text(file)):
                return int(found[1])
        raise Unknown(f"{name} has no array {word}")

    def value(self, name, expression):
        """Of whole numbers, + - * /, and constants."""
        plain = re.sub(r"static_cast<[\w: ]+>", "", expression.replace("'", "").replace("\n", " ")).replace("/", "//")
        plain = re.sub(r"\b(\d+)[uUlL]+\b", r"\1", plain)
        plain = re.sub(r"\b(k\w+)\.size\(\)", lambda word: str(self.size(name, word[1])), plain)
        plain = NAME.sub(lambda word: str(self.constant(name, word[0])), plain)
        try:
            return self.number(ast.parse(plain.strip(), mode="eval").body)
        except (SyntaxError, KeyError, AttributeError) as error:
            raise Unknown(f"{name}: '{expression.strip()}' is no whole number") from error

    def number(self, node):
        if isinstance(node, ast.Constant) and isinstance(node.value, int):
            return node.value
        return OPERATIONS[type(node.op)](self.number(node.left), self.number(node.right))


def problems_of(row, source):
    name = f"{row['function']} {row.get('line', '')}".strip()
    if "constants" not in row and "of" not in row:
        if NAME.search(row["keeps"]):
            yield f"{name}: its count is of constants, and `of` does not say where they are"
        return
    for place in row.get("of", ()):
        file, _, expression = place.partition(": ")
        try:
            value = source.value(file, expression)
        except Unknown as error:
            yield f"{name}: {error}"
            continue
        counts = row.get("constants", {})
        count = counts[expression] if expression in counts else row.get("count", 0)
        if count < value:
            yield f"{name}: {count} rounds, and {expression} in {file} is {value}"
    told = {place.partition(": ")[2] for place in row.get("of", ())}
    for word in row.get("constants", {}):
        if NAME.search(word) and word not in told:
            yield f"{name}: where {word} is, `of` does not say"


def test_is_there(row, root, facts):
    """Of a row its `test`: "unit_x: case", a test of CTest's, "facts.toml: CALLS", "library" of a function of one, or
    "own condition" of a line that names its constant."""
    test, _, case = row["test"].partition(": ")
    if test == "library":
        return "__" in row["function"]
    if test == "own condition":
        return "constants" in row or bool(NAME.search(row["line"]))
    if test == "facts.toml":
        return any(fact["calls"] == case for fact in facts)
    if case:
        part = test.removeprefix("unit_")
        files = [file for file in (root / "tests/unit").rglob("test_*.cpp")
                 if part in (name := file.stem.removeprefix("test_"), f"{file.parent.name}_{name}")]
        return any(re.search(rf"TEST\({case}\b", file.read_text(encoding="utf-8")) for file in files)
    words = [file.read_text(encoding="utf-8") for file in (root / "tests").rglob("CMakeLists.txt")]
    stem, _, of = test.partition("_")
    return any(re.search(rf"\b{re.escape(test)}\b", text) for text in words) or \
        any(file.stem == f"test_{of}" for file in (root / "tests/unit").rglob("test_*.cpp") if stem == "unit") or \
        any(re.search(rf"\b{re.escape(test.rpartition('_')[0])}_\$", text) for text in words)


def all_facts(file):
    facts = file.with_name("facts.toml")
    return tomllib.loads(facts.read_text(encoding="utf-8"))["fact"] if facts.exists() else []


def facts_beside(file):
    """Those with a constant, as rows."""
    found = all_facts(file)
    return [{"function": fact["calls"], "count": fact["at_most"], "of": [fact["of"]]} for fact in found if "of" in fact]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", required=True)
    parser.add_argument("--generated", default=[], action="append")
    parser.add_argument("--rows", default=pathlib.Path(__file__).resolve().parent / "loops.toml", type=pathlib.Path)
    arguments = parser.parse_args()
    source = Source([arguments.source, *arguments.generated])
    rows = tomllib.loads(arguments.rows.read_text(encoding="utf-8"))["loop"] + facts_beside(arguments.rows)
    problems = [problem for row in rows for problem in problems_of(row, source)]
    facts = all_facts(arguments.rows)
    problems += [f"{row['function']} {row.get('line', '')}: no such test: {row['test']}" for row in rows
                 if "test" in row and not test_is_there(row, pathlib.Path(arguments.source), facts)]
    for problem in problems:
        print(f"constants: {problem}")
    held = sum(len(row.get("of", ())) for row in rows)
    if not held:
        problems.append("no row has a constant: the gate is dead")
        print(f"constants: {problems[-1]}")
    print(f"constants: {len(rows)} rows, {held} constants of theirs held against the source")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
