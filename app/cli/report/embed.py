#!/usr/bin/env python3
"""Writes the report's template, style, scripts and chart library as one C++ source.

The template has a marker @@name@@ for each file given as name=file, and @@data@@ where the
program puts the run's data: what precedes it becomes report_head(), what follows report_tail().
"""

import argparse
import pathlib
import re
import sys

MARKER = re.compile(r"@@([\w.]+)@@")
# What would end the element that a file is put into, by the ending of the file's name.
CLOSES = {"js": "</script", "css": "</style", "license": "--"}


def fill(template: str, files: dict[str, str]) -> tuple[str, str]:
    """One pass over the template only: a marker inside an embedded file stays as it is."""
    used = set()

    def replace(match: re.Match) -> str:
        name = match[1]
        if name not in files:
            sys.exit(f"embed.py: no file given for the marker @@{name}@@")
        used.add(name)
        return files[name]

    head, marker, tail = template.partition("@@data@@")
    if not marker or "@@data@@" in tail:
        sys.exit("embed.py: the template needs exactly one @@data@@")
    parts = MARKER.sub(replace, head), MARKER.sub(replace, tail)
    if unused := files.keys() - used:
        sys.exit(f"embed.py: no marker in the template for {', '.join(sorted(unused))}")
    return parts


def array(name: str, text: str) -> str:
    """Bytes, not a literal: compilers limit the length of literals, not of arrays."""
    data = text.encode("utf-8")
    rows = (",".join(map(str, data[i : i + 32])) for i in range(0, len(data), 32))
    body = ",\n".join(rows)
    return f"const unsigned char {name}[] = {{\n{body}}};\n"


def function(name: str, data: str) -> str:
    return (
        f"std::string_view {name}() {{\n"
        f"  return {{reinterpret_cast<const char*>({data}), sizeof {data}}};\n}}\n"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--template", required=True, type=pathlib.Path)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("files", nargs="*", metavar="name=file")
    options = parser.parse_args()

    files = {}
    for pair in options.files:
        name, _, path = pair.partition("=")
        text = pathlib.Path(path).read_text(encoding="utf-8").strip()
        closing = CLOSES[name.rpartition(".")[2]]
        if closing in text.lower():
            sys.exit(f"embed.py: {path} contains '{closing}', which would end its element")
        files[name] = text

    head, tail = fill(options.template.read_text(encoding="utf-8"), files)
    options.output.write_text(
        "// Written by embed.py at build time.\n"
        '#include "app/cli/report/report_template.hpp"\n\n'
        "namespace graben::cli {\nnamespace {\n"
        + array("kHead", head)
        + array("kTail", tail)
        + "}  // namespace\n"
        + function("report_head", "kHead")
        + function("report_tail", "kTail")
        + "}  // namespace graben::cli\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()
