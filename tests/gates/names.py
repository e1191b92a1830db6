#!/usr/bin/env python3
"""Gate: a source of the core includes what it uses of others, itself or by a header of ours.

With the headers from outside precompiled the compiler would not miss an #include. Looked at are all
names with std:: or Eigen::, and what Eigen's modules add to a matrix; the table has to know them.
"""

import re

import tree
from freestanding import FREESTANDING
from includes import Includes

TABLE = {
    "algorithm": "all_of clamp copy copy_n find_if max min min_element transform upper_bound",
    "array": "array",
    "cmath": "abs acos asin atan2 ceil copysign cos exp floor isfinite pow signbit sin sqrt tan",
    "cstddef": "size_t",
    "cstdint": "uint8_t uint16_t uint32_t uint64_t int8_t int16_t int32_t int64_t",
    "cstring": "memcpy",
    "initializer_list": "initializer_list",
    "limits": "numeric_limits",
    "type_traits": "has_unique_object_representations_v is_floating_point_v",
    "Eigen/Core": "Eigen::Matrix Eigen::Matrix3d Eigen::Vector2d Eigen::Vector3d Eigen::Vector4d",
    "Eigen/Geometry": ".cross( .eulerAngles( .unitOrthogonal(",
    "Eigen/LU": ".determinant( .inverse() .partialPivLu( .fullPivLu( .computeInverseWithCheck(",
}
HEADER_OF = {name if name.startswith((".", "Eigen::")) else f"std::{name}": header
             for header, names in TABLE.items() for name in names.split()}
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
NAME = re.compile(r"\b(?:std|Eigen)::\w+|(?<![\w:])(?:u?int\d+_t|size_t)\b|"
                  + "|".join(re.escape(name) for name in HEADER_OF if name[0] == "."))


def names_of(text: str):
    """(line, name) of each that is used, the first time."""
    code = COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
    first: dict[str, int] = {}
    for match in NAME.finditer(code):
        first.setdefault(match[0], code.count("\n", 0, match.start()) + 1)
    return [(line, name) for name, line in first.items()]


includes = Includes(tree.arguments(__doc__).parse_args().root.resolve())
problems, looked_at = [], 0
for source, text in includes.sources.items():
    if not source.startswith(FREESTANDING):
        continue
    reached = includes.reached_from(source)
    for line, name in names_of(text):
        looked_at += 1
        header = HEADER_OF.get(name)
        if header is None:
            problems.append(f"{source}:{line}: {name} is not in the table of tests/gates/names.py")
        elif header not in reached:
            problems.append(f"{source}:{line}: {name} without <{header}>")
tree.report("names", problems, looked_at, "names")
