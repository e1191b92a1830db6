# SPDX-License-Identifier: Apache-2.0
"""A function's bound of those that it calls: loops, the longest path, the stack."""

import dataclasses
import re
import tomllib

from graph import Graph
from listing import Refusal
from paths import dearest
from turns import Turns


@dataclasses.dataclass
class LoopFound:
    entry: int
    header: int
    latch: int
    count: int | None
    how: str


@dataclasses.dataclass
class Site:
    """A call: the range of each argument that is known there, and bytes of stack below the function's entry."""

    where: int
    target: int | None
    known: tuple
    depth: int


@dataclasses.dataclass
class Summary:
    entry: int
    bound: int = 0
    stack: int = 0
    own: int = 0  # instructions of the longest path that are the function's own
    calls: list = dataclasses.field(default_factory=list)  # (times, Summary) of the longest path
    below: list = dataclasses.field(default_factory=list)  # every Summary that it may call
    loops: list = dataclasses.field(default_factory=list)
    vague: bool = False  # a count may follow from arguments
    open: set = dataclasses.field(default_factory=set)  # (entry, header) without a count, of those below too


class Program:
    def __init__(self, image, machine, calls_file, table, facts, before=None):
        """`before`: another of the same image, whose graphs and registers are known already."""
        self.image, self.machine = image, machine
        self.graphs, self.turns = (before.graphs, before.turns) if before else ({}, {})
        self.summaries = {}
        with open(calls_file, "rb") as stream:
            self.listed = tomllib.load(stream)["call"]
        self.table = table
        self.facts = facts
        self.way = []

    def graph(self, entry):
        if entry not in self.graphs:
            self.graphs[entry] = Graph(self.image, self.machine, entry)
        return self.graphs[entry]

    def entry_of(self, pattern):
        found = [at for at in self.image.entries if re.search(pattern, self.image.word(at))]
        if len(found) != 1:
            raise Refusal(f"{len(found)} functions are called {pattern}")
        return found[0]

    def targets(self, entry, target, where):
        if target is not None:
            return [target]
        word = self.image.word(entry)
        rows = [row for row in self.listed if re.search(row["from"], word)]
        if not rows:
            raise Refusal(f"{word}: a call through a pointer at {where:#x} that calls.toml does not list")
        found = {at for row in rows for at in self.image.entries if re.search(row["to"], self.image.word(at))}
        if not found:
            raise Refusal(f"{word}: no function is what calls.toml lists")
        return sorted(found)

    def kept(self, graph, turns):
        kept = set(self.machine.CALLED)
        for at, state in turns.flow.entering.items():
            block = graph.blocks[at]
            if not block.leaves:
                continue
            state = state.copy()
            for instruction in block.instructions:
                turns.flow.step(state, instruction)
            word = self.machine.word(block.last)
            if word.condition is not None and word.kind == "return":
                self.machine.execute(state, block.last)
            kept = {register for register in kept if state.places[register] == (("e", register), 0)}
            for _, target in block.calls:
                # Last of all it may go on in another.
                if block.last.address in graph.tails or target is None:
                    kept &= self.machine.kept.get(target, set())
        return kept

    # A function, in what is known of its arguments. ------------------------------------------------

    def of(self, entry, known=(), cut=frozenset()):
        """`known`: ranges of its arguments; `cut`: functions whose instructions are counted elsewhere."""
        plain = self.once(entry, (), cut)
        return plain if not (plain.open or plain.vague) or not known else self.once(entry, known, cut)

    def once(self, entry, known, cut):
        if (entry, known, cut) not in self.summaries:
            self.summaries[entry, known, cut] = self.summary(entry, known, cut)
        return self.summaries[entry, known, cut]

    def summary(self, entry, known, cut):
        if entry in self.way:
            names = [self.image.word(at) for at in self.way[self.way.index(entry):]]
            raise Refusal("recursion: " + " -> ".join([*names, self.image.word(entry)]))
        self.way.append(entry)
        try:
            return self.walk(entry, known, cut)
        finally:
            self.way.pop()

    def walk(self, entry, known, outer):
        graph = self.graph(entry)
        # What they leave alone is known to those who call them.
        for block in graph.blocks.values():
            for where, target in block.calls:
                for to in self.targets(entry, target, where):
                    self.of(to)
        turns = self.counts(graph, known)
        facts = self.facts.within(self, entry)
        cut = outer | {at for fact in facts for at in fact.entries}
        found = Summary(entry)
        bodies, calls = {}, {}
        proven = dict(turns.proven)
        for header, loop in graph.loops.items():
            row = self.table.row(graph, loop, proven.get(header))
            how = turns.how.get(header, "")
            if row is not None and proven.get(header, row["count"]) >= row["count"]:
                bodies[header], how = row["count"], "a row"
                if row.get("per_call"):
                    calls.setdefault((row["place"], row["count"]), []).append(header)
                found.vague = found.vague or row.get("by_arguments", False)
                proven.pop(header, None)
            for latch in loop.latches:
                found.loops.append(LoopFound(entry, header, latch, proven.get(header, bodies.get(header)), how))
            if header not in proven and header not in bodies:
                found.open.add((entry, header))
        cost, called = self.costs(graph, turns, entry, cut)
        found.below = list({id(one): one for ones in called.values() for _, one in ones}.values())
        for one in found.below:
            found.open |= one.open
            found.vague = found.vague or one.vague
        found.stack = self.stack(graph, turns, called)
        if found.open:
            return found
        found.bound, times = dearest(graph, turns.flow.leaving, proven, bodies, calls, cost)
        found.own = sum(len(graph.blocks[at].instructions) * n for at, n in times.items())
        for at, ones in called.items():
            if times.get(at):
                found.calls += [(times[at], one) for _, one in ones if one.bound]
        for times_within, one in self.facts.added(self, facts, outer):
            found.bound += times_within * one.bound
            found.calls.append((times_within, one))
        return found

    def counts(self, graph, known):
        key = (graph.entry, known)
        if key not in self.turns:
            self.turns[key] = Turns(graph, self.machine, {place: (low, high) for place, low, high in known})
            if not known:
                self.machine.kept[graph.entry] = self.kept(graph, self.turns[key])
        return self.turns[key]

    def sites(self, graph, turns):
        """({block: [Site]}, how deep the stack pointer goes); the same whatever is called there costs."""
        if turns.sites is not None:
            return turns.sites
        found, deepest = {}, 0
        for at, state in turns.flow.entering.items():
            block, state = graph.blocks[at], state.copy()
            ones = dict(block.calls)
            for instruction in block.instructions:
                depth = self.depth(graph, state)
                deepest = max(deepest, depth)
                if instruction.address in ones:
                    found.setdefault(at, []).append(
                        Site(instruction.address, ones[instruction.address], self.arguments(state), depth))
                turns.flow.step(state, instruction)
            deepest = max(deepest, self.depth(graph, state))
        turns.sites = found, deepest
        return turns.sites

    def costs(self, graph, turns, entry, cut):
        """Cost by block, and [(address, Summary)] by block."""
        sites, _ = self.sites(graph, turns)
        cost = {at: len(block.instructions) for at, block in graph.blocks.items()}
        called = {}
        for at, ones in sites.items():
            for site in ones:
                summaries = []
                for to in self.targets(entry, site.target, site.where):
                    one = self.of(to, site.known, cut - {to})
                    if to in cut:
                        paid = self.facts.price(self.image.word(to))
                        one = dataclasses.replace(one, bound=-paid, open=set(), vague=False)
                    summaries.append(one)
                summaries.sort(key=lambda one: -one.bound)
                cost[at] += summaries[0].bound
                called.setdefault(at, []).append((site.where, summaries[0]))
                called[at] += [(site.where, dataclasses.replace(one, bound=0)) for one in summaries[1:]]
        return cost, called

    def arguments(self, state):
        known = []
        limits = state.limits()
        for place in self.machine.ARGUMENTS:
            value = state.places.get(place)
            if value is not None:
                low, high = state.range_of(value)
                # What is not wide says something of a count; an address says nothing.
                if (low, high) != limits and high - low < 1 << 16 and abs(high) < 1 << 24:
                    known.append((place, low, high))
        return tuple(known)

    def stack(self, graph, turns, called):
        """Bytes: the deepest that its pointer goes, with whom it calls there."""
        sites, most = self.sites(graph, turns)
        for at, ones in sites.items():
            for site in ones:
                below = max(one.stack for where, one in called[at] if where == site.where)
                most = max(most, site.depth + below)
        return most

    def depth(self, graph, state):
        symbol, offset = state.places[self.machine.STACK]
        if symbol != ("e", self.machine.STACK):
            raise Refusal(f"{self.image.word(graph.entry)}: takes as much stack as it wants")
        return -offset
