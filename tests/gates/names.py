#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: a source of the core includes what it takes of std and Eigen, itself or by a header of ours.

With the headers from outside precompiled the compiler would not miss an #include. Looked at is every
name with std:: or Eigen:: before it, which the table has to know; integers of C are to be written with
std::, and neither namespace is to be taken in whole. Macros are not looked at.
"""

import re

import tree
from freestanding import FREESTANDING
from includes import Includes, without_comments

TABLE = {
    "algorithm": "all_of clamp copy copy_n count fill find_if max max_element min min_element none_of transform upper_bound",
    "array": "array",
    "cmath": "abs acos asin atan2 ceil copysign cos exp floor frexp hypot isfinite remainder signbit sin sqrt tan",
    "cstddef": "size_t",
    "cstdint": "uint8_t uint16_t uint32_t uint64_t int8_t int16_t int32_t int64_t",
    "cstring": "memcpy",
    "initializer_list": "initializer_list",
    "limits": "numeric_limits",
    "type_traits": "decay_t has_unique_object_representations_v is_floating_point_v",
    "Eigen/Core": "Eigen::Array Eigen::Matrix Eigen::Matrix2d Eigen::Matrix3d Eigen::Vector2d Eigen::Vector3d Eigen::Vector4d",
}
HEADER_OF = {name if "::" in name else f"std::{name}": header
             for header, names in TABLE.items() for name in names.split()}
TAKEN = re.compile(r"\b(std|Eigen)\s*::\s*(\w+)")
REFUSED = {
    "write std:: before it": re.compile(
        r"(?<![\w:])(?:::)?(?:u?int(?:_fast|_least)?\d+_t|size_t|ptrdiff_t)\b"),
    "take what is needed, by its name": re.compile(
        r"\b(?:using\s+namespace|namespace\s+\w+\s*=)\s*(?:std|Eigen)\b"),
}


def findings(text: str):
    """(line, name, header that it needs, or None, or what is wrong with it)."""
    code = without_comments(text, quoted_too=True)

    def line(match: re.Match) -> int:
        return code.count("\n", 0, match.start()) + 1
    taken = {f"{match[1]}::{match[2]}": line(match) for match in reversed(list(TAKEN.finditer(code)))}
    for name, number in sorted(taken.items(), key=lambda item: item[1]):
        yield number, name, HEADER_OF.get(name), "" if name in HEADER_OF else (
            "is not in the table of tests/gates/names.py (may the core have it?)")
    code = TAKEN.sub(lambda match: re.sub(r"\S", "~", match[0]), code)
    for wrong, pattern in REFUSED.items():
        for match in pattern.finditer(code):
            yield line(match), match[0], None, wrong


arguments = tree.arguments(__doc__).parse_args()
includes = Includes(arguments.root.resolve(), arguments.generated)
problems, looked_at = [], 0
for source, text in includes.sources.items():
    if not source.startswith(FREESTANDING):
        continue
    reached = includes.reached_from(source)
    for line, name, header, wrong in findings(text):
        looked_at += 1
        if wrong:
            problems.append(f"{source}:{line}: {name}: {wrong}")
        elif header not in reached:
            problems.append(f"{source}:{line}: {name} without <{header}>")
tree.report("names", problems, looked_at, "names")
