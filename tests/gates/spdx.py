#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: the head of every source says its licence, as a line that tools read (SPDX). --add writes it where it lacks."""

import re

import tree

LINE = "SPDX-License-Identifier: Apache-2.0"
# How a kind of file says a comment.
SLASHES, HASH, BLOCK, MARKUP = "// {}", "# {}", "/* {} */", "<!-- {} -->"
KINDS = {**dict.fromkeys((*tree.CXX, ".ts", ".js", ".mjs"), SLASHES), ".css": BLOCK, ".html": MARKUP,
         **dict.fromkeys((".py", ".sh", ".cmake", "CMakeLists.txt"), HASH)}
# Not before these: what names the interpreter, or what a browser has to see first.
FIRST = re.compile(r"#!|<!doctype", re.IGNORECASE)
HEAD_LINES = 3


def kind_of(name: str, text: str) -> str | None:
    """Scripts have no suffix, but name their interpreter."""
    if suffix := next((suffix for suffix in KINDS if name.endswith(suffix)), None):
        return KINDS[suffix]
    return HASH if "." not in name.rsplit("/", 1)[-1] and re.match(r"#!.*\b(sh|bash|python3)\b", text) else None


def with_line(text: str, comment: str) -> str:
    lines = text.splitlines(keepends=True)
    at = 1 if lines and FIRST.match(lines[0]) else 0
    return "".join([*lines[:at], comment.format(LINE) + "\n", *lines[at:]])


parser = tree.arguments(__doc__)
parser.add_argument("--add", action="store_true", help="write the line where it lacks")
options = parser.parse_args()
root = options.root.resolve()
problems, looked_at = [], 0
for name in tree.files(root):
    data = (root / name).read_bytes()
    comment = kind_of(name, data[:200].decode("utf-8", errors="replace"))
    if comment is None:
        continue
    looked_at += 1
    text = data.decode("utf-8")
    if LINE in "\n".join(text.splitlines()[:HEAD_LINES]):
        continue
    if options.add:
        (root / name).write_bytes(with_line(text, comment).encode())
    else:
        problems.append(f"{name}: its first {HEAD_LINES} lines do not say '{LINE}' (tests/gates/spdx.py --add)")
tree.report("spdx", problems, looked_at, "sources")
