# SPDX-License-Identifier: Apache-2.0
"""A loop that has several ways in gets one: what the other ways lead to is copied, up to where it meets the
loop's head. Paths stay what they were; a copy's number is that of the block and COPY times more."""

import dataclasses

from listing import Refusal

COPY = 1 << 48
MOST_COPIES = 2000


def split_loops(graph):
    blocks = graph.blocks
    made = 0
    while (found := several_ways_in(graph)) is not None:
        part, entries = found
        head = max(entries, key=lambda at: (sum(before in part for before in blocks[at].predecessors), -at))
        made += len(part)
        if made > MOST_COPIES:
            raise Refusal(f"{graph.image.word(graph.entry)}: a loop with too many ways in")
        copy_beside(blocks, part, head)


def copy_beside(blocks, part, head):
    number = 1
    while any(at + number * COPY in blocks for at in part):
        number += 1
    copies = {at: at + number * COPY for at in part if at != head}
    for at, other in copies.items():
        successors = [(copies.get(to, to), condition, register) for to, condition, register in blocks[at].successors]
        blocks[other] = dataclasses.replace(blocks[at], start=other, successors=successors, predecessors=[])
    for at in list(blocks):
        if at not in part and at not in copies.values():
            blocks[at].successors = [(copies.get(to, to), condition, register)
                                     for to, condition, register in blocks[at].successors]
    for block in blocks.values():
        block.predecessors = []
    for block in blocks.values():
        for to, _, _ in block.successors:
            blocks[to].predecessors.append(block.start)


def several_ways_in(graph):
    """(blocks of a loop, its entries), the outermost first; None when every loop has one entry."""
    todo = [set(graph.blocks)]
    while todo:
        inside = todo.pop()
        for part in components(graph.blocks, inside):
            if len(part) == 1:
                continue
            entries = {at for at in part if at == graph.entry or any(
                before not in part for before in graph.blocks[at].predecessors)}
            if len(entries) > 1:
                return part, entries
            todo.append(part - entries)
    return None


def components(blocks, inside):
    """The strongly connected parts of some of the blocks (Tarjan), without recursion."""
    number, low, stack, on, found = {}, {}, [], set(), []
    for root in sorted(inside):
        if root in number:
            continue
        todo = [(root, iter(blocks[root].successors))]
        number[root] = low[root] = len(number)
        stack.append(root)
        on.add(root)
        while todo:
            at, rest = todo[-1]
            for to, _, _ in rest:
                if to not in inside:
                    continue
                if to not in number:
                    number[to] = low[to] = len(number)
                    stack.append(to)
                    on.add(to)
                    todo.append((to, iter(blocks[to].successors)))
                    break
                if to in on:
                    low[at] = min(low[at], number[to])
            else:
                todo.pop()
                if todo:
                    low[todo[-1][0]] = min(low[todo[-1][0]], low[at])
                if low[at] == number[at]:
                    part = set()
                    while at not in part:
                        one = stack.pop()
                        on.discard(one)
                        part.add(one)
                    found.append(part)
    return found
