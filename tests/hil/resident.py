# SPDX-License-Identifier: Apache-2.0
"""How much memory a process keeps: from what ecu.sh copies of /proc/<pid>/smaps_rollup and status."""

import pathlib
import re

MOST_KB = 6144
# Of what is resident; the kernel's own page in it is never locked.
LOCKED_SHARE = 0.99


def kb(text: str, name: str) -> int:
    return int(re.search(rf"^{name}:\s+(\d+) kB$", text, re.MULTILINE)[1])


def check(path: pathlib.Path) -> list[str]:
    text = path.read_text()
    # The sum over its mappings. VmRSS runs behind by what the kernel keeps for each thread: here by
    # some 0.5 to 1.8 MB.
    size, locked = kb(text, "Rss"), kb(text, "VmLck")
    print(f"graben-ecu: {size} kB resident, {locked} kB locked")
    problems = [] if max(size, locked) <= MOST_KB else [
        f"{size} kB resident, {locked} kB locked, {MOST_KB} kB is the most"]
    if locked < LOCKED_SHARE * size:
        problems.append(f"{locked} kB locked of {size} kB")
    return problems
