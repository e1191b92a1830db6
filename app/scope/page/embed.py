#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the built page as a C++ source: scope_page().

Nothing of it is compiled but one directive: the bytes are taken in by the assembler, since a
compiler takes a second for each megabyte of an array.
"""

import argparse
import pathlib
import sys

# Where a report has its setup; app/reports/report_file.cpp looks for the same.
MARK = '<script type="application/json" id="graben-setup">'

SOURCE = """// Written by embed.py at build time.
#include "app/scope/page/scope_page.hpp"

#include <cstddef>

__asm__(".section .rodata\\n"
        "graben_scope_page_begin: .incbin \\"{page}\\"\\n"
        "graben_scope_page_end:\\n"
        ".previous\\n");
extern "C" const char graben_scope_page_begin[];
extern "C" const char graben_scope_page_end[];

namespace graben::scope {{
std::string_view scope_page() {{
  return {{graben_scope_page_begin,
          static_cast<std::size_t>(graben_scope_page_end - graben_scope_page_begin)}};
}}
}}  // namespace graben::scope
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    options = parser.parse_args()
    if options.page.read_text(encoding="utf-8").count(MARK + "</script>") != 1:
        sys.exit(f"embed.py: {options.page} needs exactly one empty {MARK}")
    options.output.write_text(SOURCE.format(page=options.page), encoding="utf-8")


if __name__ == "__main__":
    main()
