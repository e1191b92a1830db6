#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: every constant of firmware/ says its unit and where its value is from.

The comment at a constant, before it or behind it, ends with `[unit; source: text]`:

    derived   follows from what the text names: a profile's figure, other constants, arithmetic
    paper     the text names the paper and its equation or table
    standard  of a standard, of a message's layout, or of nature
    size      how much room there is, or how often a loop runs: the text says for what
    measured  found by the command between backquotes; the text says what was seen
    chosen    a judgement: the text says what else was tried, or 'not tried'

A unit is '-' where there is none, and the one that the name ends with (_mps: m/s). What is measured or chosen
stands in the tuning.hpp of its room, under a name that no other room has. `--table` prints how many are of which
source, by room; `--list` prints each.
"""

import collections
import re

import tree

SOURCES = ("derived", "paper", "standard", "size", "measured", "chosen")
TUNED = ("measured", "chosen")
PER = {"m": "m", "s": "s", "mm": "mm", "rad": "rad", "kg": "kg", "n": "N", "nm": "N m", "pa": "Pa", "hz": "Hz", "w": "W",
       "us": "us", "ms": "ms", "m2": "m2", "m3": "m3", "mps": "m/s", "mps2": "m/s2", "mps3": "m/s3", "radps": "rad/s",
       "radps2": "rad/s2", "ps": "1/s", "ps2": "1/s2", "pm": "1/m", "pm2": "1/m2", "m3ps": "m3/s", "kgpm3": "kg/m3",
       "mpn": "m/N", "npm": "N/m", "paps": "Pa/s", "m2ps2": "m2/s2", "paspm3": "Pa s/m3", "pas2pm6": "Pa s2/m6",
       "paspm": "Pa s/m", "ppa": "1/Pa", "radpm": "rad/m", "m3prad": "m3/rad", "mpsn": "m/(s N)", "nsps": "N s/s",
       "kgm2": "kg m2", "mpspa": "m/(s Pa)", "jpkg": "J/kg", "npm2": "N/m2", "bytes": "bytes", "bits": "bits",
       "share": "-", "shares": "-", "ratio": "-"}
PLAIN = {"-", "cycles", "K", "degC", "bit/s", "1/cycle", "m/s/cycle"} | set(PER.values())
DECLARED = re.compile(
    r"^[ \t]*(?:inline |static )*constexpr (?P<type>[\w:<>, ]*?) ?\b(?P<name>k[A-Z]\w*)(?:\[\w*\])?\s*(?:=|\{)", re.MULTILINE)
NUMBERS = re.compile(r"^(?:double|float|bool|auto|int|unsigned|TimeUs|std::size_t|std::u?int\d+_t"
                     r"|std::array<(?:double|float|std::u?int\d+_t),.*)$")
TAG = re.compile(r"\[(?P<unit>[^;\[\]]+); (?P<source>\w+)(?::(?P<text>.*))?\]$", re.DOTALL)


def comment_of(lines: list[str], first: int, last: int) -> str:
    """What stands behind a constant of these lines and goes on under it; or else right before it."""
    found = [match[1] for match in [re.search(r"//+<?\s*(.*)", line) for line in lines[first:last + 1]] if match]
    if found:
        for line in lines[last + 1:]:
            match = re.match(r"\s{8,}///?<?\s*(.*)", line)
            if not match:
                break
            found.append(match[1])
        return " ".join(found).strip()
    for line in reversed(lines[:first]):
        match = re.match(r"\s*///?\s*(.*)", line)
        if not match:
            break
        found.insert(0, match[1])
    return " ".join(found).strip()


def constants(text: str):
    """(line, name, comment) of each constant that is a number, or several."""
    lines = text.splitlines()
    for match in DECLARED.finditer(text):
        if not NUMBERS.match(match["type"].strip()):
            continue
        first = text.count("\n", 0, match.start("name"))
        # `constexpr std::array<double, 3>` may stand on the line before its name.
        begins = text.count("\n", 0, match.start() + len(match[0]) - len(match[0].lstrip()))
        last = text.count("\n", 0, text.find(";", match.end()))
        yield first + 1, match["name"], comment_of(lines, begins, last)


def wrong(name: str, comment: str, source_file: str) -> tuple[str, str]:
    """(its source, what is wrong with it, or nothing)."""
    tag = TAG.search(comment)
    if not tag:
        return "", "its comment does not end with [unit; source: text]"
    ending = PER.get(name.rsplit("_", 1)[1]) if "_" in name else None
    text = (tag["text"] or "").strip()
    checks = (
        (tag["unit"] not in PLAIN, f"'{tag['unit']}' is no unit that the gate knows"),
        (ending is not None and tag["unit"] != ending, f"its name says {ending}, its comment {tag['unit']}"),
        ("_" in name and ending is None, f"the gate knows no unit '_{name.rsplit('_', 1)[-1]}'"),
        (tag["source"] not in SOURCES, f"'{tag['source']}' is no source: {', '.join(SOURCES)}"),
        (len(text) < 3, "it does not say from what"),
        (tag["source"] == "measured" and text.count("`") < 2, "it is measured, but by no `command`"),
        (tag["source"] == "chosen" and "tried" not in text, "it is chosen: say what was tried, or 'not tried'"),
        (len(comment[:tag.start()].split()) < 2, "it does not say what it is"),
        (tag["source"] in TUNED and not source_file.endswith("/tuning.hpp"),
         f"it is {tag['source']}: its place is the tuning.hpp of its room"),
    )
    return tag["source"], next((why for is_wrong, why in checks if is_wrong), "")


parser = tree.arguments(__doc__)
parser.add_argument("--table", action="store_true")
parser.add_argument("--list", action="store_true")
arguments = parser.parse_args()
root = arguments.root.resolve()
problems, looked_at, rooms = [], 0, collections.defaultdict(collections.Counter)
homes: dict[str, str] = {}
for path in sorted([*root.glob("firmware/**/*.hpp"), *root.glob("firmware/**/*.cpp")]):
    name_of_file = str(path.relative_to(root))
    for line, name, comment in constants(path.read_text()):
        looked_at += 1
        source, why = wrong(name, comment, name_of_file)
        rooms[str(path.parent.relative_to(root))][source or "not said"] += 1
        if not why and name_of_file.endswith("/tuning.hpp") and homes.setdefault(name, name_of_file) != name_of_file:
            why = f"{homes[name]} has one of that name"
        if why:
            problems.append(f"{name_of_file}:{line}: {name}: {why}")
        if arguments.list:
            print(f"{name_of_file}:{line}: {name}: {comment}")
if arguments.table:
    head = [*SOURCES, "not said"]
    rows = {**dict(sorted(rooms.items())), "all": sum(rooms.values(), collections.Counter())}
    print(f"| room | {' | '.join(head)} |\n|---|{'---|' * len(head)}")
    for room, row in rows.items():
        print(f"| {room} | {' | '.join(str(row[word]) for word in head)} |")
else:
    tree.report("constants", problems, looked_at, "constants")
