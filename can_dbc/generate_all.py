#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes all committed files that are made of the frames' sources and of the code tables, or says which have drifted.

    generate_all.py [--check] [--root FOLDER]

From firmware/safety/faults.toml and limits.toml: the core's enums, its table of reactions, the texts of tool and
scope, the table in firmware/safety/README.md. From can_dbc/*.dbc.in: DBCs and codecs.
Exit codes: 0 done or unchanged, 1 drifted, 2 refused.
"""

from __future__ import annotations

import argparse
import pathlib
import sys

import generate
from dbcgen import codes, emit_codes, source

KINDS = ("excavator", "dozer")
STANDARDS = ("j1939", "zx200")  # Messages that are not ours.


def outputs(root: pathlib.Path) -> list[tuple[pathlib.Path, str]]:
    """Each file with its text."""
    table = codes.load(root / "firmware/safety")
    manual = root / "firmware/safety/README.md"
    frames = root / "can_dbc"
    made = [
        (root / "firmware/core/generated/codes.hpp", emit_codes.enums(table)),
        (root / "firmware/safety/generated/fault_rows.hpp", emit_codes.rows(table)),
        (root / "app/runs/generated/code_texts.hpp", emit_codes.texts(table)),
        (root / "app/scope/page/src/model/generated/limits.ts", emit_codes.limits_of_page(table)),
        (manual, emit_codes.readme(table, manual.read_text(encoding="utf-8"))),
        (frames / "generated/common_dbc.hpp", generate.made(frames / "common.dbc.in", "common_dbc.hpp")),
    ]
    for kind in KINDS + STANDARDS:
        for output in (frames / f"{kind}.dbc", frames / "generated" / f"{kind}_dbc.hpp"):
            made.append((output, generate.made(frames / f"{kind}.dbc.in", output.name)))
    return made


def main(words: list[str] | None = None) -> int:
    arguments = argparse.ArgumentParser(description="All that is generated and committed")
    arguments.add_argument("--check", action="store_true", help="compare instead of write")
    arguments.add_argument("--root", type=pathlib.Path, default=generate.HERE.parent)
    options = arguments.parse_args(words)
    # A copy of the tree has its own code tables.
    generate.CODES = options.root / "firmware/safety"
    try:
        return max(generate.write_or_compare(text, file, options.check, "can_dbc/generate_all.py")
                   for file, text in outputs(options.root))
    except (source.SourceError, codes.CodeError, OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
