#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the DBC of a source or the C++ codecs of a source or DBC, or says whether the written ones still match.

    generate.py INPUT.dbc.in OUTPUT.dbc
    generate.py INPUT.dbc.in OUTPUT.hpp
    generate.py INPUT.dbc OUTPUT.hpp
    generate.py --check INPUT OUTPUT

Exit codes: 0 done or unchanged; 1 the output has drifted from the input; 2 the input is refused, with
`file:line: message`, or a file cannot be read or written.
"""

from __future__ import annotations

import argparse
import difflib
import pathlib
import sys

from dbcgen import codes, source
from dbcgen.check import check
from dbcgen.emit import emit
from dbcgen.model import Refusal
from dbcgen.parse import parse

HERE = pathlib.Path(__file__).resolve().parent
CODES = HERE.parent / "firmware" / "safety"


def made_from_source(file: pathlib.Path, output: str) -> str:
    """DBC or header of a `.dbc.in`; the DBC is checked either way."""
    read = source.read(file, (HERE,))
    expansion = source.Expansion(read, codes.load(CODES))
    try:
        database = parse(expansion.text.encode("ascii"))
        check(database)
    except Refusal as refusal:
        raise expansion.blame(refusal) from refusal
    return expansion.text if output.endswith(".dbc") else emit(database, file.name, read.included)


def made(file: pathlib.Path, output: str) -> str:
    if file.name.endswith(".dbc.in"):
        return made_from_source(file, output)
    database = parse(file.read_bytes())
    check(database)
    return emit(database, file.name, {})


def write_or_compare(text: str, output: pathlib.Path, compare: bool, origin: str) -> int:
    """0, or 1 with a difference printed. What is the same keeps its time, so that nothing is built again for it."""
    written = output.read_text(encoding="utf-8") if compare or output.exists() else None
    if written == text:
        return 0
    if not compare:
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_text(text, encoding="utf-8")
        return 0
    diff = difflib.unified_diff((written or "").splitlines(), text.splitlines(), str(output), "generated",
                                lineterm="", n=1)
    print(f"{output} does not match {origin}; run it again without --check:")
    print("\n".join(list(diff)[:40]))
    return 1


def main(words: list[str] | None = None) -> int:
    """`words` are the command line's; None takes the process's own."""
    arguments = argparse.ArgumentParser(description="DBC and C++ codecs")
    arguments.add_argument("--check", action="store_true", help="compare instead of write")
    arguments.add_argument("input", type=pathlib.Path)
    arguments.add_argument("output", type=pathlib.Path)
    options = arguments.parse_args(words)
    try:
        text = made(options.input, options.output.name)
        return write_or_compare(text, options.output, options.check, str(options.input))
    except Refusal as refusal:
        print(f"{options.input}:{refusal.line}: {refusal.message}", file=sys.stderr)
    except (source.SourceError, codes.CodeError) as error:
        print(error, file=sys.stderr)
    except OSError as error:
        print(f"{error.filename}: {error.strerror}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
