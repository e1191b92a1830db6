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


def header(found):
    told = "".join("    {" + ", ".join(f'"{cell}"' for cell in row) + "},\n" for row in found)
    return f"""// Made by app/reports/check/measured_lies.py of firmware/safety/README.md.
#pragma once
namespace graben::reports {{
struct MeasuredLie {{
  const char* name;
  const char* wanted;
  const char* at_1;
  const char* at_03;
  const char* at_01;
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
