#!/usr/bin/env python3
"""Writes the built page as a C++ source: scope_page_head() and scope_page_tail(), between which the
setup's JSON belongs.

Nothing of it is compiled but one directive: the bytes are taken in by the assembler, since a
compiler takes a second for each megabyte of an array.
"""

import argparse
import pathlib
import sys

MARK = '<script type="application/json" id="graben-setup">'


def part(name: str, file: pathlib.Path) -> str:
    return (
        f'__asm__(".section .rodata\\n"\n'
        f'        "{name}_begin: .incbin \\"{file}\\"\\n"\n'
        f'        "{name}_end:\\n"\n'
        f'        ".previous\\n");\n'
        f'extern "C" const char {name}_begin[];\n'
        f'extern "C" const char {name}_end[];\n'
    )


def function(name: str) -> str:
    return (
        f"std::string_view {name}() {{\n"
        f"  return {{{name}_begin, static_cast<std::size_t>({name}_end - {name}_begin)}};\n}}\n"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    options = parser.parse_args()

    head, mark, tail = options.page.read_text(encoding="utf-8").partition(MARK)
    if not mark or MARK in tail or not tail.lstrip().startswith("</script>"):
        sys.exit(f"embed.py: {options.page} needs exactly one empty {MARK}")
    text = '// Written by embed.py at build time.\n#include "app/scope/scope_page.hpp"\n\n'
    for name, data in (("scope_page_head", head + mark), ("scope_page_tail", tail)):
        file = options.output.with_name(name)
        file.write_text(data, encoding="utf-8")
        text += part(name, file)
    text += "\nnamespace graben::scope {\n"
    text += function("scope_page_head") + function("scope_page_tail")
    text += "}  // namespace graben::scope\n"
    options.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
