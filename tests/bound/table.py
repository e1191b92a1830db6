# SPDX-License-Identifier: Apache-2.0
"""loops.toml: counts of the loops that no register tells, each with the line that keeps it.

A row says of which loops it is by two regular expressions: `function`, of the names as C++ writes them, and
`line`, of file, number and text of the source where the loop goes round again. It holds only where no count was
proven, or where it `tightens` one. `count` is how often the loop's end is reached at most; of a row of
`constants` the line's first group names the one that it is. Where a row is `per_call`, the count is that of all
rounds in one call of the function, of whatever the compiler has made of the statement. Where it is
`by_arguments`, the loop is looked at again for each call, as its count may follow from the arguments there. Where a
row has a `machine`, the loop goes over something that a machine has many or few of (machine.py).
"""

import functools
import pathlib
import re
import tomllib

from listing import Refusal
from machine import of_machine


class Table:
    def __init__(self, file, root, machine=None):
        self.root = pathlib.Path(root)
        self.rows = []
        if file is not None:
            with open(file, "rb") as stream:
                self.rows = tomllib.load(stream).get("loop", [])
        for row in self.rows:
            if "constants" in row:
                row["count"] = max(row["constants"].values())
            if missing := {"function", "count", "keeps", "test"} - set(row):
                raise Refusal(f"{file}: a row without {', '.join(sorted(missing))}")
            row["count"] = of_machine(row, row["count"], machine)
        self.used = {}  # places by number of a row
        self.lines = {}  # [(function, file, line)] by address

    def prepare(self, image, graphs):
        self.lines = image.lines_of(sorted({at for graph in graphs for loop in graph.loops.values()
                                            for at in self.tested(graph, loop)}))

    @staticmethod
    def tested(graph, loop):
        """Addresses of the ends, of the tests that leave the loop, and of its head."""
        found = [graph.blocks[latch].last.address for latch in loop.latches]
        for at in sorted(loop.blocks, key=graph.rank.get):
            block = graph.blocks[at]
            if graph.innermost[at] is loop and (at in loop.latches or any(
                    to not in loop.blocks for to, _, _ in block.successors)):
                found += [one.address for one in block.instructions]
        return [*found, graph.blocks[loop.header].first.address]

    @functools.lru_cache(maxsize=None)
    def source(self, file):
        try:
            return pathlib.Path(file).read_text("utf-8").splitlines()
        except OSError:
            return []

    @functools.lru_cache(maxsize=None)
    def whole(self, file):
        """The compiler names the files of the tree from its root on, which addr2line puts where it was built."""
        parts = pathlib.Path(file).parts
        for n in range(1, len(parts)):
            if (self.root / pathlib.Path(*parts[n:])).is_file():
                return str(self.root / pathlib.Path(*parts[n:]))
        return file

    def frames(self, graph, loop):
        """(function, file, line, text) of what the loop's ends and its head come of, the innermost first."""
        found = []
        for at in self.tested(graph, loop):
            for name, file, line in self.lines.get(at, ()):
                file = self.whole(file)
                lines = self.source(file) if line else []
                text = "\n".join(part.strip() for part in lines[line - 1 : line + 1]) if line <= len(lines) else ""
                if file.startswith(f"{self.root}/"):
                    file = file[len(f"{self.root}/"):]
                frame = (name, file, line, text)
                if frame not in found:
                    found.append(frame)
        return found or [(graph.image.word(graph.entry), "", 0, "")]

    def row(self, graph, loop, proven):
        """The row that holds; None without one."""
        if not self.rows:
            return None
        frames = self.frames(graph, loop)
        names = {graph.image.word(graph.entry), *(frame[0] for frame in frames)}
        for n, row in enumerate(self.rows):
            if proven is not None and not row.get("tightens"):
                continue
            if not any(re.search(row["function"], name) for name in names):
                continue
            if "line" in row and not any(re.search(row["line"], f"{file}:{line}: {text}")
                                         for _, file, line, text in frames):
                continue
            if "constants" in row:
                named = [found[1] for _, file, line, text in frames
                         if (found := re.search(row["line"], f"{file}:{line}: {text}"))]
                if named[0] not in row["constants"]:
                    continue
                row = {**row, "count": row["constants"][named[0]]}
            self.used.setdefault(n, set()).add(self.place(graph, loop))
            said = next((frame[1:3] for frame in frames if re.search(
                row.get("line", "."), f"{frame[1]}:{frame[2]}: {frame[3]}")), None)
            return {**row, "place": (n, said)}
        return None

    def place(self, graph, loop):
        """The line of the statement, where it is found; else of the loop's end."""
        frames = self.frames(graph, loop)
        said = [frame for frame in frames if re.search(r"\b(for|while) \(", frame[3].split("\n")[0])] or \
            [frame for frame in frames if frame[3]] or frames
        name, file, line, text = said[0]
        at = graph.blocks[loop.latches[0]].last.address
        return f"{file or '?'}:{line} ({name.split('(')[0] or graph.image.word(graph.entry)}, {at:#x}): " + \
            text.split("\n")[0]
