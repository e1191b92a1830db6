# SPDX-License-Identifier: Apache-2.0
"""What is known at each block of a function, over all ways there: the greatest fixed point of values.py.

Where ways meet, places that differ by the same on each of them keep that difference: they get one new
symbol, ("p", block, place), and their offsets from it.
"""

from listing import Refusal
from values import State, half, is_of

# After so many rounds a range that still grows has no end on that side.
PATIENCE = 3
MOST_ROUNDS = 100
# Looks at a block after which what still changes is given up.
RESTLESS = 16


class Flow:
    """`known` narrows arguments, by place: (low, high). `turns` are the counts that loops were proven to
    have, by header: the largest number of times that the loop goes round again."""

    def __init__(self, graph, machine, known=None, turns=None):
        self.graph, self.machine = graph, machine
        self.turns = turns or {}
        self.known = known or {}
        # Where pointers may write is found once: it follows from the function's own sums alone.
        self.floor = getattr(graph, "floor", None)
        self.run()
        if not hasattr(graph, "floor"):
            graph.floor = self.pointers() if graph.loops else None
            if graph.floor != self.floor:
                self.floor = graph.floor
                self.run()

    def symbol_rank(self, symbol):
        if symbol[0] == "l":
            symbol = symbol[1]
        if symbol[0] == "p":
            return (1, self.graph.rank[symbol[1]], 0)
        if symbol[0] == "d":
            return (1, 1 << 30, symbol[1])
        return (0, 0, 0) if symbol[0] == "e" else (2, 0, 0)

    def pointers(self):
        """The lowest address of the stack that a register other than its pointer had."""
        lowest, back = None, self.machine.longest_way_back(self.graph)
        for start in self.entering:
            state = self.entering[start].copy()
            for instruction in self.graph.blocks[start].instructions:
                self.step(state, instruction)
                for place, value in state.places.items():
                    if place not in self.machine.FRAME and value[0] == ("e", self.machine.STACK) and \
                            (not isinstance(place, tuple) or place[2] >= 4):
                        lowest = min(lowest, value[1]) if lowest is not None else value[1]
        return None if lowest is None else lowest + back

    def run(self):
        graph = self.graph
        self.entering = {}  # state by block
        self.leaving = {}  # [state by successor]
        self.widened, self.visits, self.forced, self.restless = {}, {}, {}, {}
        first = State(self.machine.BITS, self.floor)
        self.machine.enter(first)
        for place, (low, high) in self.known.items():
            if low == high:
                first.places[place] = (None, low)
            else:
                first.ranges[("e", place)] = (low, high)
        waiting = {graph.entry}
        rounds = 0
        while waiting:
            rounds += 1
            if rounds > MOST_ROUNDS * len(graph.order):
                raise Refusal(f"{graph.image.word(graph.entry)}: what its registers are finds no rest")
            at = min(waiting, key=graph.rank.get)
            waiting.remove(at)
            state = self.meet(at, first)
            if state is None:
                # Nobody comes here (any more).
                self.entering.pop(at, None)
                state_out = [None] * len(graph.blocks[at].successors)
                if self.leaving.get(at) == state_out:
                    continue
            else:
                self.visits[at] = self.visits.get(at, 0) + 1
                if at in self.entering and self.same(self.entering[at], state):
                    continue
                if self.visits[at] > RESTLESS and at in self.entering:
                    state = self.settle(at, state, first)
                self.entering[at] = state
                state_out = self.through(at, state.copy())
            self.leaving[at] = state_out
            for to, _, _ in graph.blocks[at].successors:
                waiting.add(to)

    def settle(self, at, state, first):
        """What still changes after so many looks is something of its own from here on."""
        old = self.entering[at]
        forced = self.forced.setdefault(at, set())
        forced |= {place for place, value in state.places.items() if old.places.get(place) != value}
        if self.visits[at] > 2 * RESTLESS:
            self.restless.setdefault(at, set()).update(
                symbol for symbol in {*state.ranges, *old.ranges}
                if state.ranges.get(symbol) != old.ranges.get(symbol))
        return self.meet(at, first)

    @staticmethod
    def same(a, b):
        return a.places == b.places and a.ranges == b.ranges and a.made == b.made and a.flags == b.flags

    def arriving(self, at, first):
        """[(block before, state)]"""
        found = [(None, first)] if at == self.graph.entry else []
        for before in dict.fromkeys(self.graph.blocks[at].predecessors):
            if before not in self.leaving:
                continue
            for (to, _, _), state in zip(self.graph.blocks[before].successors, self.leaving[before]):
                if to == at and state is not None:
                    found.append((before, state))
        return found

    def meet(self, at, first):
        states = [state for _, state in self.arriving(at, first)]
        if not states:
            return None
        header = at in self.graph.loops
        if len(states) == 1 and not header:
            return self.settled(at, states[0].copy())
        return self.settled(at, self.join(at, states, header))

    def settled(self, at, state):
        for symbol in self.restless.get(at, ()):
            state.ranges.pop(symbol, None)
        return state

    def join(self, at, states, header):
        merged = State(self.machine.BITS, self.floor)
        leaders, halves = {}, []
        one = states[0]
        kept = self.unchanged(at, states) if header else {}
        for place in sorted(one.places, key=str):
            values = [state.places.get(place) for state in states]
            if None in values:
                if not isinstance(place, tuple):
                    merged.places[place] = (("p", at, place), 0)
                continue
            if place in self.forced.get(at, ()):
                if not isinstance(place, tuple):
                    leaders[("forced", place)] = (place, values)
                    merged.places[place] = (("p", at, place), 0)
                continue
            whole = self.machine.whole(place)
            if whole is not None and all(state.places[place] == half(state.places[whole]) for state in states):
                halves.append((place, whole))
                continue
            if place in kept:
                merged.places[place] = kept[place]
                continue
            own = any(is_of(symbol, at) for symbol, _ in values)
            if not own and all(value == values[0] for value in values):
                merged.places[place] = values[0]
                continue
            key = tuple((symbol, offset - values[0][1]) for symbol, offset in values)
            if key not in leaders:
                leaders[key] = (place, values)
                merged.places[place] = (("p", at, place), 0)
            else:
                leader, others = leaders[key]
                merged.put(place, (("p", at, leader), values[0][1] - others[0][1]))
        for place, whole in halves:
            merged.places[place] = half(merged.places[whole])
        for leader, values in leaders.values():
            self.span(at, ("p", at, leader), values, states, merged, header)
        for symbol in {symbol for symbol, _ in merged.places.values() if symbol is not None}:
            if is_of(symbol, at):
                continue
            spans = [state.ranges.get(symbol) for state in states]
            if None not in spans:
                merged.ranges[symbol] = self.wide(at, symbol, min(s[0] for s in spans), max(s[1] for s in spans),
                                                  header)
            made = [state.made.get(symbol) for state in states]
            if made[0] is not None and all(how == made[0] for how in made) and not any(
                    isinstance(part, tuple) and is_of(part[0], at) for part in made[0]):
                merged.made[symbol] = made[0]
        return merged

    @staticmethod
    def unchanged(at, states):
        """What a loop leaves as it came, though an earlier look took it for changed."""
        kept = {}
        for place in states[0].places:
            values = [state.places.get(place) for state in states]
            others = {value for value in values if value and not is_of(value[0], at)}
            if None not in values and len(others) == 1:
                kept[place] = others.pop()
        falling = True
        while falling:
            falling = []
            for place, (base, offset) in kept.items():
                for state in states:
                    symbol, more = state.places[place]
                    if not is_of(symbol, at):
                        continue
                    leader = kept.get(symbol[2]) if symbol[0] == "p" else None
                    if leader is None or leader[0] != base or leader[1] + more != offset:
                        falling.append(place)
                        break
            for place in falling:
                del kept[place]
        return kept

    def span(self, at, symbol, values, states, merged, header):
        spans = [state.range_of(value) for state, value in zip(states, values)]
        low, high = min(s[0] for s in spans), max(s[1] for s in spans)
        low, high = self.wide(at, symbol, low, high, header)
        if at in self.turns:
            low, high = self.after_turns(at, symbol, values, states, low, high)
        if (low, high) != merged.limits(symbol):
            merged.ranges[symbol] = (low, high)

    def after_turns(self, at, symbol, values, states, low, high):
        """A step that is always the same, as often as the loop goes round at most."""
        steps = {offset for (base, offset) in values if base == symbol}
        starts = [state.range_of(value) for state, value in zip(states, values) if value[0] != symbol]
        back = sum(1 for base, _ in values if base == symbol)
        if len(steps) != 1 or back != len(self.graph.loops[at].latches) or not starts:
            return low, high
        way = steps.pop() * self.turns[at]
        return (max(low, min(s[0] for s in starts) + min(way, 0)),
                min(high, max(s[1] for s in starts) + max(way, 0)))

    def wide(self, at, symbol, low, high, header):
        if not header:
            return low, high
        key = (at, symbol)
        bottom, top = State(self.machine.BITS, None).limits(symbol)
        if key in self.widened:
            old, count = self.widened[key]
            if low < old[0] or high > old[1]:
                count += 1
                if count > PATIENCE:
                    low = bottom if low < old[0] else old[0]
                    high = top if high > old[1] else old[1]
            else:
                # Less again: kept, or ranges might swing.
                low, high = (low, high) if count <= PATIENCE else old
            self.widened[key] = ((low, high), count)
        else:
            self.widened[key] = ((low, high), 0)
        return low, high

    def through(self, at, state):
        block = self.graph.blocks[at]
        # Once only: nothing older has its symbol. A copy of a block may come after the block.
        state.again = at in self.graph.innermost or self.graph.copied
        for instruction in block.instructions:
            self.step(state, instruction)
        out = []
        for _, condition, register in block.successors:
            out.append(self.after(state, condition, register))
        return out

    def after(self, state, condition, register):
        if condition is None:
            return state.copy()
        if register is not None:
            flags, state.flags = state.flags, (state.get(register), (None, 0))
            found = state.given(condition, self.symbol_rank)
            state.flags = flags
            return found
        return state.given(condition, self.symbol_rank)

    def step(self, state, instruction):
        word = self.machine.word(instruction)
        if word.condition is None:
            self.machine.execute(state, instruction)
            return
        if word.kind not in ("next", "call", "call_pointer"):
            # What goes on here has not left.
            return
        # Done or left out.
        yes, no = (state.given(word.condition, self.symbol_rank),
                   state.given(self.machine.opposite(word.condition), self.symbol_rank))
        if yes is not None:
            self.machine.execute(yes, instruction)
        self.either(state, yes, no, instruction.address, word.condition)

    def either(self, state, yes, no, where, condition):
        if yes is None or no is None:
            one = yes or no
            if one is not None:
                state.places, state.ranges, state.made, state.flags = one.places, one.ranges, one.made, one.flags
            return
        flags = yes.flags if yes.flags == no.flags else None
        tests = state.tests(condition)
        tested = tests[0][:2] if len(tests) == 1 and len(state.flags) == 2 else None
        news = []
        places = {}
        for place, value in yes.places.items():
            other = no.places.get(place)
            if other == value:
                places[place] = value
            elif other is not None:
                spans = yes.range_of(value), no.range_of(other)
                made = ("either", *tested, condition, value, other) if tested else None
                news.append((place, min(s[0] for s in spans), max(s[1] for s in spans), made))
        ranges = {}
        for symbol, span in yes.ranges.items():
            if symbol in no.ranges:
                ranges[symbol] = min(span[0], no.ranges[symbol][0]), max(span[1], no.ranges[symbol][1])
        state.places, state.ranges = places, ranges
        state.made = {key: how for key, how in yes.made.items() if no.made.get(key) == how}
        state.flags = flags
        for place, *_ in news:
            # A constant that both ways have is one; the condition may have changed what is written.
            state.places[place] = (None, 0)
        for place, low, high, made in news:
            if (low, high) == state.limits(("d", where, place)):
                state.fresh(place, where, made=made)
            else:
                state.fresh(place, where, low, high, made=made)
