# SPDX-License-Identifier: Apache-2.0
"""The blocks of a function, who dominates whom, and its loops."""

import dataclasses

from listing import Refusal
from split import split_loops


@dataclasses.dataclass
class Block:
    start: int
    instructions: list = dataclasses.field(default_factory=list)
    # (block, condition, register): the condition is of the flags, or of the register beside nought
    successors: list = dataclasses.field(default_factory=list)
    predecessors: list = dataclasses.field(default_factory=list)
    calls: list = dataclasses.field(default_factory=list)  # (address, entry, or None through a pointer)
    leaves: bool = False  # the function may end here

    @property
    def first(self):
        return self.instructions[0]

    @property
    def last(self):
        return self.instructions[-1]


@dataclasses.dataclass
class Loop:
    header: int
    latches: list
    blocks: set
    parent: "Loop | None" = None

    @property
    def depth(self):
        return 1 + (self.parent.depth if self.parent else 0)


class Graph:
    """Of the function at `entry`. A part of it may lie elsewhere (its cold one)."""

    def __init__(self, image, machine, entry):
        self.image, self.machine, self.entry = image, machine, entry
        self.blocks = {}
        self.find_blocks()
        before = len(self.blocks)
        split_loops(self)
        self.copied = len(self.blocks) > before
        self.order_blocks()
        self.find_dominators()
        self.find_loops()

    # Blocks. -------------------------------------------------------------------------------------

    def is_other(self, address):
        """Another function begins there, which is not a part of this one."""
        if address == self.entry or address not in self.image.functions:
            return False
        own, other = self.image.functions[self.entry], self.image.functions[address]
        return not (other.startswith(own.split(".")[0]) and ".cold" in other)

    def find_blocks(self):
        code, machine = self.image.instructions, self.machine
        leads = {self.entry}
        ways = {}  # by the address of an instruction that does not only go on: [(to, condition, register)]
        self.tails = {}
        seen, todo = set(), [self.entry]
        while todo:
            at = todo.pop()
            while at not in seen:
                if at not in code:
                    raise Refusal(f"{self.image.word(self.entry)}: no instruction at {at:#x}")
                seen.add(at)
                word = machine.word(code[at])
                after = at + code[at].size
                if word.kind in ("next", "call", "call_pointer") and (after not in code or self.is_other(after)):
                    # Whom it has called does not come back.
                    ways[at] = []
                    break
                if word.kind in ("next", "call", "call_pointer"):
                    at = after
                    continue
                found = self.ways_of(code[at], word, after)
                ways[at] = found
                for to, _, _ in found:
                    leads.add(to)
                    todo.append(to)
                break
        # Where two ways meet.
        for at in seen:
            if at in ways:
                leads.add(at + code[at].size)
        now = None
        for at in sorted(seen):
            if at in leads or now is None or now.last.address + now.last.size != at:
                now = self.blocks[at] = Block(at)
            now.instructions.append(code[at])
        for block in self.blocks.values():
            last = block.last
            word = machine.word(last)
            if last.address in ways:
                block.successors = ways[last.address]
                block.leaves = word.kind in ("return", "jump_pointer") or not block.successors or \
                    last.address in self.tails
            else:
                block.successors = [(last.address + last.size, None, None)]
            for instruction in block.instructions:
                kind = machine.word(instruction).kind
                if kind == "call":
                    block.calls.append((instruction.address, instruction.target))
                elif kind in ("call_pointer", "jump_pointer"):
                    block.calls.append((instruction.address, None))
            if last.address in self.tails:
                block.calls.append((last.address, self.tails[last.address]))
        for block in self.blocks.values():
            for to, _, _ in block.successors:
                self.blocks[to].predecessors.append(block.start)

    def ways_of(self, instruction, word, after):
        condition, register = word.implied
        ways = []
        if word.kind == "jump":
            if self.is_other(word.target):
                self.tails[instruction.address] = word.target
            else:
                ways.append((word.target, condition, register))
        elif word.kind == "table":
            ways += [(to, condition, None) for to in self.machine.table(self.image, instruction)]
        if condition is not None:
            ways.append((after, self.machine.opposite(condition), register))
        return ways

    # Order, dominators, loops. -------------------------------------------------------------------

    def order_blocks(self):
        order, seen = [], {self.entry}
        todo = [(self.entry, iter(self.blocks[self.entry].successors))]
        while todo:
            at, rest = todo[-1]
            for to, _, _ in rest:
                if to not in seen:
                    seen.add(to)
                    todo.append((to, iter(self.blocks[to].successors)))
                    break
            else:
                order.append(at)
                todo.pop()
        self.order = order[::-1]
        self.rank = {at: n for n, at in enumerate(self.order)}

    def find_dominators(self):
        self.above = {self.entry: self.entry}
        changed = True
        while changed:
            changed = False
            for at in self.order[1:]:
                new = None
                for before in self.blocks[at].predecessors:
                    if before in self.above:
                        new = before if new is None else self.meet(new, before)
                if self.above.get(at) != new:
                    self.above[at] = new
                    changed = True

    def meet(self, a, b):
        while a != b:
            while self.rank[a] > self.rank[b]:
                a = self.above[a]
            while self.rank[b] > self.rank[a]:
                b = self.above[b]
        return a

    def dominates(self, a, b):
        while self.rank[b] > self.rank[a]:
            b = self.above[b]
        return a == b

    def find_loops(self):
        latches = {}
        for at in self.order:
            for to, _, _ in self.blocks[at].successors:
                if self.rank[to] <= self.rank[at]:
                    if not self.dominates(to, at):
                        raise Refusal(f"{self.image.word(self.entry)}: a loop with two ways in at {to:#x}")
                    if at not in latches.setdefault(to, []):
                        latches[to].append(at)
        self.loops = {}
        for header, ends in latches.items():
            inside, todo = {header}, list(ends)
            while todo:
                at = todo.pop()
                if at not in inside:
                    inside.add(at)
                    todo += self.blocks[at].predecessors
            self.loops[header] = Loop(header, ends, inside)
        for loop in self.loops.values():
            around = [other for other in self.loops.values()
                      if other is not loop and loop.header in other.blocks]
            loop.parent = min(around, key=lambda other: len(other.blocks), default=None)
        self.innermost = {}
        for loop in sorted(self.loops.values(), key=lambda one: -len(one.blocks)):
            for at in loop.blocks:
                self.innermost[at] = loop

    def back_edges(self):
        """By addresses: a copy of a block is the block."""
        return {(self.blocks[latch].last.address, self.blocks[header].first.address)
                for header, loop in self.loops.items() for latch in loop.latches}
