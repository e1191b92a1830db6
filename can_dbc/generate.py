#!/usr/bin/env python3
"""Writes the C++ codecs of a DBC, or says whether the written ones still match it.

    generate.py INPUT.dbc OUTPUT.hpp
    generate.py --check INPUT.dbc OUTPUT.hpp

Exit codes: 0 done or unchanged; 1 the header has drifted from the DBC; 2 the DBC is refused, with
`file:line: message`, or a file cannot be read or written.
"""

from __future__ import annotations

import argparse
import difflib
import pathlib
import sys

from dbcgen.check import check
from dbcgen.emit import emit
from dbcgen.model import Refusal
from dbcgen.parse import parse


def main(words: list[str] | None = None) -> int:
    """`words` are the command line's; None takes the process's own."""
    arguments = argparse.ArgumentParser(description="C++ codecs from a DBC")
    arguments.add_argument("--check", action="store_true", help="compare instead of write")
    arguments.add_argument("input", type=pathlib.Path)
    arguments.add_argument("output", type=pathlib.Path)
    options = arguments.parse_args(words)
    try:
        database = parse(options.input.read_bytes())
        check(database)
        text = emit(database, options.input.name)
        if not options.check:
            # What is the same keeps its time, so that nothing is built again for it.
            if not options.output.exists() or options.output.read_bytes() != text.encode("ascii"):
                options.output.write_text(text, encoding="ascii")
            return 0
        written = options.output.read_text(encoding="ascii")
    except Refusal as refusal:
        print(f"{options.input}:{refusal.line}: {refusal.message}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"{error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    if written == text:
        return 0
    diff = difflib.unified_diff(
        written.splitlines(), text.splitlines(), str(options.output), "generated", lineterm="", n=1
    )
    print(f"{options.output} does not match {options.input}; run generate.py without --check:")
    print("\n".join(list(diff)[:40]))
    return 1


if __name__ == "__main__":
    sys.exit(main())
