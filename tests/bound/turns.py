# SPDX-License-Identifier: Apache-2.0
"""How often a loop goes round again at most, proven from what is known of its registers (flow.py).

A loop is left by a test that each round passes. What it compares changes by the same step in each round, or
not at all; so the first round in which it leaves follows from the difference before the first.
"""

import math

from flow import Flow
from values import half, is_of, tests

# A count above this is as good as none.
MOST = 1 << 16
ROUNDS = 5


class Turns:
    """`proven` has the largest count by header, `unproven` the loops that have none."""

    def __init__(self, graph, machine, known=None, given=None):
        self.graph, self.machine = graph, machine
        self.proven, self.how = {}, {}
        self.sites = None  # of its calls (program.py)
        given = given or {}
        for _ in range(ROUNDS):
            self.flow = Flow(graph, machine, known, {**given, **self.proven})
            before = dict(self.proven)
            self.counts = {**given, **self.proven}
            # The outer ones first: the inner ones' starts follow from them.
            for loop in sorted(graph.loops.values(), key=lambda one: one.depth):
                self.find(loop)
                self.counts = {**given, **self.proven}
            if self.proven == before:
                break
        self.unproven = [loop for header, loop in graph.loops.items() if header not in self.proven]

    def find(self, loop):
        if loop.header not in self.flow.entering:
            self.keep(loop, 0, "nobody comes there")
            return
        if not any(self.comes_back(loop, latch) for latch in loop.latches):
            self.keep(loop, 0, "nobody comes back")
        # Ways within the loop that cannot be taken any more from some round on.
        ends = {}
        for at in loop.blocks:
            if at in self.flow.entering and any(way[1] for way in self.graph.blocks[at].successors):
                self.test(loop, at, ends)
        for count, how in sorted(set(ends.values())):
            if not self.goes_round(loop, {way for way, (most, _) in ends.items() if most <= count}):
                self.keep(loop, count, how)
                break

    def goes_round(self, loop, without):
        seen, todo = set(), [loop.header]
        while todo:
            at = todo.pop()
            for n, (to, _, _) in enumerate(self.graph.blocks[at].successors):
                if (at, n) in without or to not in loop.blocks:
                    continue
                leaving = self.flow.leaving.get(at)
                if leaving is None or leaving[n] is None:
                    continue
                if to == loop.header:
                    return True
                if to not in seen:
                    seen.add(to)
                    todo.append(to)
        return False

    def comes_back(self, loop, latch):
        return any(to == loop.header and state is not None for (to, _, _), state in
                   zip(self.graph.blocks[latch].successors, self.flow.leaving.get(latch, ())))

    def keep(self, loop, count, how):
        if count is not None and 0 <= count <= MOST and count < self.proven.get(loop.header, MOST + 1):
            self.proven[loop.header], self.how[loop.header] = count, how

    def test(self, loop, at, ends):
        """For each way out of a block: until which round it may be taken."""
        block = self.graph.blocks[at]
        state = self.flow.entering[at].copy()
        for instruction in block.instructions:
            self.flow.step(state, instruction)
        for n, (to, condition, register) in enumerate(block.successors):
            if to not in loop.blocks or condition is None:
                continue
            flags = state.flags if register is None else (state.get(register), (None, 0))
            for one, other, what in [found for a, b, true in tests(flags, condition)
                                     for found in state.implied(a, b, true)]:
                for count, how in (
                        (self.switched(loop, state, one, other, what), "a switch"),
                        (self.shrinking(loop, state, one, other, what), "a word that loses bits in each round"),
                        (self.counting(loop, state, one, other, what), "a counter")):
                    if count is not None and count >= 0:
                        ends[at, n] = min(ends.get((at, n), (count, how)), (count, how))

    # What changes. -------------------------------------------------------------------------------

    def evolution(self, header, value):
        """(steps, [(state, value before the first round)]) of what the header's symbol stands for."""
        place = value[0][2]
        symbol = ("p", header, place)
        starts, steps = [], set()
        loop = self.graph.loops[header]
        for before, state in self.flow.arriving(header, None):
            if before is None:
                return None
            now = state.places.get(place)
            if now is None:
                return None
            if before in loop.blocks:
                if now[0] != symbol:
                    return None
                steps.add(now[1])
            else:
                starts.append((state, now))
        return (steps, starts) if steps and starts else None

    def invariant(self, loop, symbol):
        if symbol is not None and symbol[0] == "l":
            symbol = symbol[1]
        if symbol is None or symbol[0] == "e":
            return True
        if symbol[0] == "p":
            return symbol[1] not in loop.blocks
        return symbol[0] == "d" and not any(
            block.first.address <= symbol[1] <= block.last.address for block in
            (self.graph.blocks[at] for at in loop.blocks))

    def part(self, loop, value):
        """(steps, [(state, value before the first round)]) of one side of a test; no states: it is always
        the same."""
        if is_of(value[0], loop.header):
            lower = value[0][0] == "l"
            found = self.evolution(loop.header, (value[0][1], 0) if lower else value)
            if found is None:
                return None
            steps, starts = found
            if lower:
                starts = [(state, half(start)) for state, start in starts]
            return steps, [(state, (start[0], start[1] + value[1])) for state, start in starts]
        return ({0}, []) if self.invariant(loop, value[0]) else None

    def counting(self, loop, state, a, b, condition):
        first, second = self.part(loop, a), self.part(loop, b)
        if first is None or second is None:
            return None
        steps = [one - other for one in first[0] for other in second[0]]
        if min(steps) <= 0 <= max(steps) or len(steps) > 1 and condition == "ne":
            return None
        # The slowest way.
        step = min(steps, key=abs)
        most = None
        count = max(len(first[1]), len(second[1]), 1)
        for n in range(count):
            one = first[1][n] if first[1] else (state, a)
            other = second[1][n] if second[1] else (state, b)
            found = self.until(loop, state, one, other, step, condition)
            if found is None:
                return None
            most = found if most is None else max(most, found)
        return most

    def until(self, loop, state, one, other, step, condition):
        """The first round in which `condition` is false of one + round * step and other."""
        (state_a, a), (state_b, b) = one, other
        exact = self.difference(loop, state_a, a, state_b, b)
        if exact is not None:
            low, high, stride = exact
            return self.solve(low, high, stride, step, condition)
        (a_low, a_high), (b_low, b_high) = state_a.range_of(a), state_b.range_of(b)
        now = state.range_of(b) if other[0] is state else (b_low, b_high)
        b_low, b_high = max(b_low, now[0]), min(b_high, now[1])
        bottom, top = state.limits(a[0] or b[0])
        if condition in ("cc", "lo", "ls") and step > 0 and b_low >= 0:
            a_low = max(a_low, 0)
        if condition in ("lt", "mi", "le", "cc", "lo", "ls") and step > 0:
            if b_high + step > top or a_low == bottom:
                return None
        elif condition in ("gt", "ge", "pl", "hi", "cs", "hs") and step < 0:
            if b_low + step < bottom or a_high == top or a_low == bottom and condition in ("hi", "cs", "hs"):
                return None
            if condition in ("hi", "cs", "hs") and b_low < -step - (condition == "hi"):
                return None
        elif condition == "ne":
            if a_low == bottom or a_high == top or b_low == bottom or b_high == top:
                return None
        else:
            return None
        return self.solve(a_low - b_high, a_high - b_low, 1, step, condition)

    @staticmethod
    def solve(low, high, stride, step, condition):
        """From a difference between low and high, a multiple of stride."""
        size = abs(step)
        if condition == "ne":
            if stride % size or low % size or high % size:
                return None
            if step > 0:
                return -low // size if high <= 0 else None
            return high // size if low >= 0 else None
        if condition in ("lt", "mi", "cc", "lo") and step > 0:
            return max(0, math.ceil(-low / size))
        if condition in ("le", "ls") and step > 0:
            return max(0, -low // size + 1)
        if condition in ("gt", "hi") and step < 0:
            return max(0, math.ceil(high / size))
        if condition in ("ge", "pl", "cs", "hs") and step < 0:
            return max(0, high // size + 1)
        return None

    # Differences. --------------------------------------------------------------------------------

    def difference(self, loop, state_a, a, state_b, b):
        """(low, high, stride) of a - b where both are the same something and what is known beside it."""
        forms_a, forms_b = self.forms(loop, state_a, a), self.forms(loop, state_b, b)
        best = None
        for base, offset, terms, low, high, stride in forms_a:
            for base_b, offset_b, terms_b, low_b, high_b, stride_b in forms_b:
                if base != base_b:
                    continue
                found = self.spread(offset - offset_b, terms, terms_b, low - high_b, high - low_b,
                                    math.gcd(stride, stride_b))
                if found and (best is None or found[1] - found[0] < best[1] - best[0]):
                    best = found
        return best

    def spread(self, offset, terms, terms_b, low, high, stride):
        low, high = low + offset, high + offset
        for header in {*terms, *terms_b}:
            step = terms.get(header, 0) - terms_b.get(header, 0)
            if step:
                if header not in self.counts:
                    return None
                way = step * self.counts[header]
                low, high, stride = low + min(way, 0), high + max(way, 0), math.gcd(stride, step)
        return low, high, stride

    def forms(self, loop, state, value):
        """[(symbol, offset, steps by header, low, high, stride)]: what the value is made of, in each way of
        saying it."""
        found = []
        now = (value[0], value[1], {}, 0, 0, 0)
        while now is not None and len(found) < 12:
            found.append(now)
            symbol, offset, terms, low, high, stride = now
            now = None
            if symbol is None:
                break
            if symbol in state.made and state.made[symbol][0] == "plus":
                _, (base, more), first, last, by = state.made[symbol]
                now = (base, offset + more, terms, low + first, high + last, math.gcd(stride, by))
            elif symbol[0] == "l" and symbol[1][0] == "p":
                now = self.earlier_half(loop, (symbol, offset, terms, low, high, stride))
                state = now[0] if now else state
                now = now[1] if now else None
            elif symbol[0] == "p" and symbol[1] in self.graph.loops and symbol[1] not in terms and \
                    symbol[1] != loop.header and loop.header in self.graph.loops[symbol[1]].blocks:
                evolution = self.evolution(symbol[1], (symbol, 0))
                if evolution and len(evolution[0]) == 1 and len({start for _, start in evolution[1]}) == 1:
                    (step,), starts = evolution
                    state, (base, more) = starts[0]
                    now = (base, offset + more, {**terms, symbol[1]: step}, low, high, stride)
        return found

    def earlier_half(self, loop, form):
        (_, symbol), offset, terms, low, high, stride = form
        header = symbol[1]
        if header not in self.graph.loops or header in terms or header == loop.header or \
                loop.header not in self.graph.loops[header].blocks:
            return None
        evolution = self.evolution(header, (symbol, 0))
        if not evolution or len(evolution[0]) != 1 or len({start for _, start in evolution[1]}) != 1:
            return None
        (step,), starts = evolution
        state, value = starts[0]
        base, more = half(value)
        return state, (base, offset + more, {**terms, header: step}, low, high, stride)

    def switched(self, loop, state, a, b, condition):
        """What is the same constant after each round decides the second one."""
        if a[0] is None or a[0][:2] != ("p", loop.header) or b[0] is not None:
            return None
        for before, arrived in self.flow.arriving(loop.header, None):
            if before in loop.blocks:
                value = arrived.places.get(a[0][2])
                if value is None or value[0] is not None or \
                        state.exact(state.signed(value[1] + a[1]), b[1], condition):
                    return None
        return 1

    def shrinking(self, loop, state, a, b, condition):
        """x &= x - 1, x >>= n: until nothing is left."""
        if b != (None, 0) or condition not in ("ne", "hi", "gt"):
            return None
        for place in {symbol[2] for symbol, _ in (a,) if symbol and symbol[:2] == ("p", loop.header)} | {
                place for place, value in state.places.items() if value == a}:
            start = ("p", loop.header, place)
            count = 0
            for before, arrived in self.flow.arriving(loop.header, None):
                if before not in loop.blocks:
                    continue
                now = arrived.places.get(place)
                how = arrived.made.get(now[0]) if now and now[1] == 0 else None
                if how is None:
                    count = None
                elif how[0] == "and" and {how[1], how[2]} == {(start, 0), (start, -1)}:
                    count = max(count, state.width(place))
                elif how[0] == "lsr" and how[1] == (start, 0) and how[2] > 0:
                    count = max(count, -(-state.width(place) // how[2]))
                else:
                    count = None
                if count is None:
                    break
            if count and a in ((start, 0), *(v for v in (state.places.get(place),) if v)):
                return count
        return None
