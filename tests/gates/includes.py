# SPDX-License-Identifier: Apache-2.0
"""Who includes what in the tree. An #include counts wherever it stands, also where the preprocessor
leaves it out, but not in a comment."""

import pathlib
import posixpath
import re

import tree

# A raw string with quotes in it would end too early.
COMMENT_OR_QUOTED = re.compile(r"""//[^\n]*|/\*.*?\*/|(?<!')"(?:\\.|[^"\\\n])*\"""", re.DOTALL)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', re.MULTILINE)

NAMELESS = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?![ \t<"])([^\n]*)$', re.MULTILINE)


def blank(text: str) -> str:
    """As many lines, and nothing in them."""
    return re.sub(r"[^\n]", " ", text)


def without_comments(text: str, quoted_too: bool = False) -> str:
    return COMMENT_OR_QUOTED.sub(
        lambda match: blank(match[0]) if quoted_too or match[0][0] == "/" else match[0], text)


class Includes:
    """The sources of a tree, and for each its (line, header, quoted), a quoted header as a path from
    the root."""

    def __init__(self, root: pathlib.Path, generated: pathlib.Path | None = None):
        """What the build has made lies in a folder of its own, by the same names."""
        self.sources = {n: (root / n).read_text() for n in tree.files(root) if n.endswith(tree.CXX)}
        if generated:
            self.sources |= {n: (generated / n).read_text() for n in tree.walk(generated) if n.endswith(tree.CXX)}
        self.of = {name: list(self._read(name, text)) for name, text in self.sources.items()}

    def _read(self, name: str, text: str):
        for match in INCLUDE.finditer(without_comments(text)):
            line = text.count("\n", 0, match.start(2)) + 1
            quoted = match[1] == '"'
            header = match[2]
            if quoted:
                beside = posixpath.normpath(posixpath.join(posixpath.dirname(name), header))
                header = beside if beside in self.sources else posixpath.normpath(header)
            yield line, header, quoted

    def hidden(self):
        """(source, line, what) of each include that nobody looks into: named by a macro, or a file of
        ours with another suffix."""
        for name, text in self.sources.items():
            code = without_comments(text)
            for match in NAMELESS.finditer(code):
                yield name, code.count("\n", 0, match.start(1)) + 1, match[1].strip()
            for line, header, quoted in self.of[name]:
                if quoted and not header.endswith(tree.CXX):
                    yield name, line, header

    def reached_from(self, name: str) -> dict[str, str]:
        """Every header that name includes, directly or not, with the chain that leads there."""
        reached, todo = {}, [(name, name)]
        while todo:
            current, chain = todo.pop()
            for _, header, _ in self.of.get(current, []):
                if header not in reached:
                    reached[header] = f"{chain} -> {header}"
                    todo.append((header, reached[header]))
        return reached
