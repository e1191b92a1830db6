#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""That a mutated file is tried again where it, its test or a header of either changed, and else is not."""

import dataclasses
import pathlib

import unchanged

ROOT = pathlib.Path(__file__).resolve().parents[2]


@dataclasses.dataclass(frozen=True)
class Job:
    mutated: str
    compiled: str
    linked: tuple


GATE = Job("firmware/drives/drive_gate.cpp", "firmware/drives/drive_gate.cpp",
           ("b/mutation.dir/./__/unit/firmware/test_gate.cpp.o", "b/libgraben_firmware.a"))
HEADER = Job("hal/link/e2e.hpp", "tests/unit/hal/test_e2e.cpp", ("b/alone.cpp.o",))


def same(names) -> list:
    unchanged.changed_since.changed = lambda root, area: (names, "since then")
    return unchanged.as_before(ROOT, [GATE, HEADER])[0]


assert same({"README.md", "firmware/dozer/blade.cpp"}) == [GATE, HEADER]
for file in (GATE.mutated, "firmware/drives/drive_gate.hpp", "tests/unit/firmware/test_gate.cpp"):
    assert same({file}) == [HEADER], file
# A header that another one includes.
assert GATE not in same({"firmware/core/time.hpp"})
assert same({"hal/link/e2e.hpp"}) == [GATE]
assert same({"tests/mutation/equivalent.toml"}) == [] and same({"firmware/safety/faults.toml"}) == []
assert same(None) == []
