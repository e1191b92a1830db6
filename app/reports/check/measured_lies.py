# SPDX-License-Identifier: Apache-2.0
"""The table of lies in the safety case (firmware/safety/README.md, tests/lies) as a header of C++, so that `graben
check` says what was measured and nobody types it twice.

measured_lies.py README HEADER
"""

import pathlib
import sys

BEGIN, END = "<!-- lies.py: from here -->\n", "<!-- lies.py: to here -->\n"


def rows(text):
    """Name, wanted and a cell for each speed; the first two lines are the head."""
    lines = text.split(BEGIN)[1].split(END)[0].splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def parts(cell):
    """'47 of 60, 3.8 / 55.4 s; 0.35 / 5.73': how many were stopped, after what time, how far off; no time where none was."""
    seen, off = cell.split("; ")
    stopped, _, after = seen.partition(", ")
    return stopped, after.removesuffix(" s") or "-", off


def header(found):
    told = ""
    for name, wanted, *speeds in found:
        cells = ", ".join("{" + ", ".join(f'"{part}"' for part in parts(cell)) + "}" for cell in speeds)
        told += f'    {{"{name}", "{wanted}", {{{{{cells}}}}}}},\n'
    return f"""// Made by app/reports/check/measured_lies.py of firmware/safety/README.md.
#pragma once
#include <array>
namespace graben::reports {{
/// Of the draws at one speed: how many were stopped, s until then and m off by then, each two figures.
struct MeasuredAtSpeed {{
  const char* stopped;
  const char* after_s;
  const char* off_m;
}};
struct MeasuredLie {{
  const char* name;
  const char* wanted_m;
  std::array<MeasuredAtSpeed, 3> at;  ///< Speed 1, 0.3, 0.1.
}};
inline constexpr MeasuredLie kMeasuredLies[] = {{
{told}}};
}}  // namespace graben::reports
"""


def main():
    readme, out = map(pathlib.Path, sys.argv[1:])
    found = rows(readme.read_text(encoding="utf-8"))
    assert found and all(len(row) == 5 for row in found), found
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(header(found), encoding="utf-8")


if __name__ == "__main__":
    main()
