#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a built page as a C++ source: embed.py scope|operator PAGE OUTPUT makes scope_page() or operator_page().

Nothing of it is compiled but one directive: the bytes are taken in by the assembler, since a
compiler takes a second for each megabyte of an array.
"""

import argparse
import pathlib
import sys

# Where a report has its setup; app/reports/report_file.cpp looks for the same.
MARK = '<script type="application/json" id="graben-setup">'

HEAD = """// Written by embed.py at build time.
#include "app/scope/page/scope_page.hpp"

#include <cstddef>
"""

PAGE = """
__asm__(".section .rodata\\n"
        "graben_{name}_begin: .incbin \\"{page}\\"\\n"
        "graben_{name}_end:\\n"
        ".previous\\n");
extern "C" const char graben_{name}_begin[];
extern "C" const char graben_{name}_end[];

namespace graben::scope {{
std::string_view {name}() {{
  return {{graben_{name}_begin, static_cast<std::size_t>(graben_{name}_end - graben_{name}_begin)}};
}}
}}  // namespace graben::scope
"""

# All by which a page could say something to where it came from.
VOICES = (".send(", "sendBeacon", "XMLHttpRequest", "WebTransport", "RTCPeerConnection", "<form",
          "method:")


def voices_of(page: str) -> list[str]:
    """What of VOICES is in a page that must have none."""
    return [voice for voice in VOICES if voice in page]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("name", choices=("scope", "operator"))
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    options = parser.parse_args()
    text = options.page.read_text(encoding="utf-8")
    if options.name == "scope":
        if text.count(MARK + "</script>") != 1:
            sys.exit(f"embed.py: {options.page} needs exactly one empty {MARK}")
    elif found := voices_of(text):
        sys.exit(f"embed.py: {options.page} only looks and must not be able to send, but has {found}")
    options.output.write_text(HEAD + PAGE.format(name=f"{options.name}_page", page=options.page), encoding="utf-8")


if __name__ == "__main__":
    main()
