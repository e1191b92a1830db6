# SPDX-License-Identifier: Apache-2.0
"""facts.toml: what no path of a function may do, though its graph has such paths.

    [[fact]]
    within = "regular expression"   # of the function in one call of which it holds
    calls = "regular expression"    # of functions that are called there, by itself or further down
    at_most = 3                     # so often, in one call of `within`
    of = "file.hpp: kConstant"      # optional: that number, by name (constants.py)
    price = 200                     # optional: instructions, see below
    group = "laws"                  # optional: of the facts of a group only one is true at a time
    machine = "keep_outs"           # optional: of an image's own machine so often that count of its setup (machine.py)
    each = 5                        # optional: for each of those
    only_with = "regulated_pumps"   # optional: the fact is of a machine without these; `at_most` is 0
    because = "why"
    proof = "the assertion that is in the fuzzed image, file:name"

The instructions of such a function are left out wherever it is called, and its bound is added at the end as
often as it may be called.

A `price` is for a function whose calls are counted in all and not by loop, as of `spend` by `Work`: each call
lowers the cost of the path by the price, and the price is added for all the calls that there may be. Whatever
the price, no path costs more than that; the best one is where one round of the dearest loop is paid by its calls.
"""

import dataclasses
import re
import tomllib

from listing import Refusal
from machine import holds, of_machine

NEEDED = {"within", "calls", "at_most", "because", "proof"}


@dataclasses.dataclass(eq=False)
class Fact:
    row: dict
    entries: tuple


class Facts:
    def __init__(self, file, machine=None):
        self.rows = []
        if file is not None:
            with open(file, "rb") as stream:
                self.rows = tomllib.load(stream).get("fact", [])
        for row in self.rows:
            if missing := NEEDED - set(row):
                raise Refusal(f"{file}: a fact without {', '.join(sorted(missing))}")
            if row["at_most"] != 0 and "only_with" in row:
                raise Refusal(f"{file}: {row['calls']}: what a machine does not have is called 0 times")
            row["at_most"] = of_machine(row, row["at_most"], machine)
        self.rows = [row for row in self.rows if holds(row, machine)]
        self.used = set()

    def assumed(self):
        return sum(1 for n in self.used if self.rows[n]["proof"].startswith("assumed"))

    def within(self, program, entry):
        found = []
        word = program.image.word(entry)
        for n, row in enumerate(self.rows):
            if not re.search(row["within"], word):
                continue
            entries = tuple(at for at in program.image.entries if re.search(row["calls"], program.image.word(at)))
            if entries:
                self.used.add(n)
                found.append(Fact(row, entries))
        return found

    def price(self, word):
        return max((row.get("price", 0) for row in self.rows if re.search(row["calls"], word)), default=0)

    def added(self, program, facts, outer):
        """[(times, Summary)] of what was left out: of a group the dearest."""
        every = outer | {at for fact in facts for at in fact.entries}
        groups = {}
        for fact in facts:
            ones = [program.of(at, (), every - {at}) for at in fact.entries if at not in outer]
            if not ones or fact.row["at_most"] == 0:
                continue
            if any(one.open for one in ones):
                raise Refusal(f"facts.toml: {fact.row['calls']}: has no bound by itself")
            dearest = max(ones, key=lambda one: one.bound)
            price = self.price(program.image.word(dearest.entry))
            dearest = dataclasses.replace(dearest, bound=dearest.bound + price)
            groups.setdefault(fact.row.get("group", id(fact)), []).append((fact.row["at_most"], dearest))
        return [max(ones, key=lambda one: one[0] * one[1].bound) for ones in groups.values()]
