#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what is made of the frames' sources and of the code tables, or says what has drifted.

    generate_all.py [--check] [--root FOLDER]     what is committed: DBCs, the table in firmware/safety/README.md
    generate_all.py --built FOLDER                what a build reads: codecs, the core's enums, its table of
                                                  reactions, the texts of tool and scope

The sources are firmware/safety/faults.toml and limits.toml, and can_dbc/*.dbc.in.
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


def committed(root: pathlib.Path) -> dict[str, str]:
    """Each file with its text."""
    manual = "firmware/safety/README.md"
    text = (root / manual).read_text(encoding="utf-8")
    made = {manual: emit_codes.readme(codes.load(generate.CODES), text)}
    for kind in KINDS + STANDARDS:
        made[f"can_dbc/{kind}.dbc"] = generate.made(root / f"can_dbc/{kind}.dbc.in", f"{kind}.dbc")
    return made


def built(root: pathlib.Path) -> dict[str, str]:
    table = codes.load(generate.CODES)
    made = {
        "firmware/core/generated/codes.hpp": emit_codes.enums(table),
        "firmware/safety/generated/fault_rows.hpp": emit_codes.rows(table),
        "app/runs/generated/code_texts.hpp": emit_codes.texts(table),
        "app/scope/page/src/model/generated/limits.ts": emit_codes.limits_of_page(table),
    }
    for name in ("common", *KINDS, *STANDARDS):
        made[f"can_dbc/generated/{name}_dbc.hpp"] = generate.made(root / f"can_dbc/{name}.dbc.in", f"{name}_dbc.hpp")
    return made


def main(words: list[str] | None = None) -> int:
    arguments = argparse.ArgumentParser(description="All that is generated")
    arguments.add_argument("--check", action="store_true", help="compare instead of write")
    arguments.add_argument("--root", type=pathlib.Path, default=generate.HERE.parent)
    arguments.add_argument("--built", type=pathlib.Path, help="write what a build reads into this folder")
    options = arguments.parse_args(words)
    # A copy of the tree has its own code tables.
    generate.CODES = options.root / "firmware/safety"
    try:
        files = built(options.root) if options.built else committed(options.root)
        return max(generate.write_or_compare(text, (options.built or options.root) / name, options.check,
                                             "can_dbc/generate_all.py") for name, text in files.items())
    except (source.SourceError, codes.CodeError, OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
