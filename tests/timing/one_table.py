#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a reviewer asks first, for every target in one table: instructions of a cycle and a solve
(counts/observed.json) and bytes of stack, RAM and flash (tests/memory/observed.toml). Prints it."""

import json
import pathlib
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
COUNTS = HERE / "counts" / "observed.json"
MEMORY = HERE.parent / "memory" / "observed.toml"
HEAD = ["target", "cycle, excavator", "cycle, dozer", "solve", "stack, B", "RAM, B", "flash, B"]
# Of a group of counts what is dearest, whatever the bus brings.
CYCLES = {"cycle, excavator": ("22t", "22t-queue", "12t", "12t-queue"),
          "cycle, dozer": ("dozer", "dozer-queue"), "solve": ("solve", "solve-any")}
# The build's own word for the machine that builds.
SAME = {"x86_64": "x86_64-linux-gnu"}


def spaced(number: int) -> str:
    return f"{number:,}".replace(",", " ")


def table(counts: dict, memory: dict) -> list[str]:
    counted = {SAME.get(target, target): groups for target, groups in counts.items()}
    if counted.keys() != memory.keys():
        sys.exit(f"one_table: counted are {sorted(counted)}, measured {sorted(memory)}")
    rows = [HEAD, ["---", *["---:"] * (len(HEAD) - 1)]]
    for target in sorted(counted):
        most = [spaced(max(counted[target][group]["count"] for group in groups))
                for groups in CYCLES.values()]
        images = memory[target]
        sizes = [" / ".join(spaced(images[kind][figure]) for kind in ("excavator", "dozer"))
                 for figure in ("stack", "ram", "flash")]
        rows.append([target, *most, *sizes])
    return ["| " + " | ".join(row) + " |" for row in rows]


if __name__ == "__main__":
    print("\n".join(table(json.loads(COUNTS.read_text("utf-8")), tomllib.loads(MEMORY.read_text("utf-8")))))
