# SPDX-License-Identifier: Apache-2.0
"""What toolchain/batches.py may put together, and what it must not: check_batches.py COMPILER. All that it
does put together has to compile as one."""

import pathlib
import subprocess
import sys
import tempfile

compiler, = sys.argv[1:]
BATCHES = pathlib.Path(__file__).resolve().parents[2] / "toolchain/batches.py"
SOURCES = {
    "plain.cpp": "namespace house {\nnamespace {\n\nint helper() { return 1; }\n\n}\nint plain() { return helper(); }\n}\n",
    "other.cpp": "namespace house {\nnamespace {\n\nint another() { return 2; }\n\n}\nint other() { return another(); }\n}\n",
    "same_function.cpp": "namespace house {\nnamespace {\n\nint helper() { return 3; }\n\n}\n"
                         "int same() { return helper(); }\n}\n",
    "same_type.cpp": "namespace house {\nnamespace {\n\nstruct [[nodiscard]] Row final {\n  int a;\n};\n"
                     "constexpr int kLimits[] = {1};\n\n}\nint row() { return Row{4}.a + kLimits[0]; }\n}\n",
    "in_header.cpp": '#include "row.hpp"\nnamespace house {\nint in_header() { return Row{}.b; }\n}\n',
    "in_braces.cpp": "namespace house {\nnamespace {\n\nconstexpr int kLimits{5};\n\n}\nint braces() { return kLimits; }\n}\n",
    "own.cpp": "namespace house {\nnamespace {\n\nconstexpr int kOwn = 6;\n\n}\nint own() { return kOwn; }\n}\n",
    "local.cpp": "namespace house {\nint local() {\n  constexpr int kOwn = 7;\n  return kOwn;\n}\n}\n",
    "alias_one.cpp": "namespace house {\nnamespace {\n\nnamespace bus = house;\n\n}\nint one() { return 1; }\n}\n",
    "alias_two.cpp": "namespace yard {}\nnamespace house {\nnamespace {\n\nnamespace bus = yard;\n\n}\nint two() { return 2; }\n}\n",
    "macro.cpp": "#define another 7\nnamespace house {\nint macro() { return another; }\n}\n",
}
HEADER = "#pragma once\nnamespace house {\n\nstruct Row {\n  int b = 0;\n};\n\n}\n"
APART = [("plain.cpp", "same_function.cpp"), ("same_type.cpp", "in_header.cpp"), ("same_type.cpp", "in_braces.cpp"),
         ("own.cpp", "local.cpp"), ("other.cpp", "macro.cpp"), ("alias_one.cpp", "alias_two.cpp")]

with tempfile.TemporaryDirectory() as folder:
    here = pathlib.Path(folder)
    for name, text in {**SOURCES, "row.hpp": HEADER}.items():
        (here / name).write_text(text)
    found = subprocess.run([sys.executable, "-B", str(BATCHES), "1", folder, *(str(here / name) for name in SOURCES)],
                           stdout=subprocess.PIPE, text=True, check=True).stdout.split()
    batch_of = dict(zip(SOURCES, found, strict=True))
    for one, other in APART:
        assert batch_of[one] != batch_of[other], f"{one} and {other} are in the same batch: {batch_of}"
    assert batch_of["plain.cpp"] == batch_of["other.cpp"] == "0", f"these can stand together: {batch_of}"
    for batch in set(found):
        names = [name for name in SOURCES if batch_of[name] == batch]
        one = "".join(f'#include "{here / name}"\n' for name in names)
        done = subprocess.run([compiler, "-std=c++17", "-Wall", "-Werror", "-fsyntax-only", "-I", folder, "-x", "c++", "-"],
                              input=one, stderr=subprocess.PIPE, text=True, check=False)
        assert done.returncode == 0, f"{names} do not compile as one:\n{done.stderr}"
print(f"{len(SOURCES)} sources in {len(set(found))} batches")
