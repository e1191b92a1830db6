# SPDX-License-Identifier: Apache-2.0
"""What is known of the registers and the stack at one place of a function.

A value is (symbol, offset): a constant where the symbol is None, else something that is not known, the same
one wherever the symbol stands in a state. Of a symbol there may be a range, as a signed number, and how it
came about. All sums are modulo the width of a register.
"""

OPPOSITE = {"eq": "ne", "cs": "cc", "mi": "pl", "vs": "vc", "hi": "ls", "ge": "lt", "gt": "le", "hs": "lo"}
OPPOSITE["bit"] = "nobit"  # of a word that is not looked at here
OPPOSITE |= {other: one for one, other in OPPOSITE.items()}


def half(value):
    """The lower half of a value: ("l", symbol) stands for that of what the symbol stands for."""
    symbol, offset = value
    if symbol is None or symbol[0] != "l":
        offset &= 0xFFFFFFFF
        offset -= (offset >> 31) << 32
        return (None, offset) if symbol is None else (("l", symbol), offset)
    return value


def is_of(symbol, block):
    """Whether it stands for what this block has made of several."""
    if symbol is not None and symbol[0] == "l":
        symbol = symbol[1]
    return symbol is not None and symbol[:2] == ("p", block)


def mentions(part, symbol):
    return isinstance(part, tuple) and (part == symbol or any(mentions(one, symbol) for one in part))


def tests(flags, condition):
    """Flags are (a, b), of a - b; (a, None), of a alone; or (a, b, those before, condition, flags where that
    was false), as a comparison under a condition has it."""
    if flags is None or condition in ("bit", "nobit"):
        return []
    if len(flags) == 5:
        a, b, before, under, otherwise = flags
        if holds(otherwise, condition):
            return []
        return [*tests(before, under), *tests((a, b), condition)]
    a, b = flags
    if b is None:
        return [(a, (None, 0), condition)] if condition in ("eq", "ne", "mi", "pl") else []
    return [(a, b, condition)]


def holds(flags, condition):
    n, z, c, v = (bool(flags & bit) for bit in (8, 4, 2, 1))
    return {"eq": z, "ne": not z, "cs": c, "hs": c, "cc": not c, "lo": not c, "mi": n, "pl": not n, "vs": v,
            "vc": not v, "hi": c and not z, "ls": not c or z, "ge": n == v, "lt": n != v,
            "gt": not z and n == v, "le": z or n != v}[condition]


class State:
    """`places` has (symbol, offset) by place: a register's name, or ("s", bytes above the stack pointer at
    the function's entry, size)."""

    __slots__ = ("places", "ranges", "flags", "made", "bits", "floor", "again")

    def __init__(self, bits, floor):
        self.places, self.ranges, self.made = {}, {}, {}
        self.flags = None  # see tests()
        self.bits = bits
        self.again = True  # what is done here may be done once more
        self.floor = floor  # what lies from here up in the stack may be written through pointers

    def copy(self):
        other = State(self.bits, self.floor)
        other.places, other.ranges = dict(self.places), dict(self.ranges)
        other.made, other.flags, other.again = dict(self.made), self.flags, self.again
        return other

    def width(self, place):
        """Bits of a place; on a machine of 64 a register has a half of its own, and a slot may be one."""
        half = place[0] == "w" if isinstance(place, str) else place[2] == 4
        return 32 if half else self.bits

    def limits(self, symbol=None):
        if symbol is None:
            bits = self.bits
        elif symbol[0] == "l":
            bits = 32
        else:
            bits = self.width(symbol[1] if symbol[0] == "e" else symbol[2])
        return -(1 << (bits - 1)), (1 << (bits - 1)) - 1

    def signed(self, number, bits=None):
        bits = bits or self.bits
        number &= (1 << bits) - 1
        return number - (1 << bits) if number >> (bits - 1) else number

    def get(self, place):
        return self.places[place]

    def put(self, place, value):
        symbol, offset = value
        self.places[place] = (symbol, self.signed(offset, self.width(place)))

    def fresh(self, place, where, low=None, high=None, made=None):
        """Something new, which this instruction makes."""
        symbol = ("d", where, place)
        if self.again:
            self.forget(symbol)
        if low is not None:
            if low == high:
                self.put(place, (None, low))
                return
            self.ranges[symbol] = (low, high)
        if made is not None and not mentions(made, symbol):
            self.made[symbol] = made
        self.places[place] = (symbol, 0)

    def forget(self, symbol):
        """Of an older round of a loop: what had this symbol is something else."""
        for place in [place for place, value in self.places.items() if value[0] in (symbol, ("l", symbol))]:
            if isinstance(place, tuple):
                del self.places[place]
            else:
                self.places[place] = (("x", symbol, place), 0)
        self.ranges.pop(symbol, None)
        self.ranges.pop(("l", symbol), None)
        self.made.pop(symbol, None)
        for other in [key for key, how in self.made.items() if mentions(how, symbol)]:
            del self.made[other]
        if mentions(self.flags, symbol):
            self.flags = None

    def range_of(self, value):
        symbol, offset = value
        if symbol is None:
            return offset, offset
        low, high = self.limits(symbol)
        if symbol in self.ranges:
            first, last = self.ranges[symbol]
        elif symbol[0] == "l" and symbol[1] in self.ranges:
            first, last = self.ranges[symbol[1]]
            if first < low or last > high:
                return low, high
        else:
            return low, high
        first, last = first + offset, last + offset
        return (first, last) if low <= first and last <= high else (low, high)

    def narrow(self, value, first, last):
        """False where nothing is left."""
        now = self.range_of(value)
        first, last = max(first, now[0]), min(last, now[1])
        if first > last:
            return False
        symbol, offset = value
        if symbol is not None:
            low, high = self.limits(symbol)
            if low <= first - offset and last - offset <= high and (first, last) != (low, high):
                old = self.ranges.get(symbol, (low, high))
                new = max(old[0], first - offset), min(old[1], last - offset)
                if new[0] <= new[1]:
                    self.ranges[symbol] = new
                    whole = self.ranges.get(symbol[1]) if symbol[0] == "l" else None
                    if whole and low <= whole[0] and whole[1] <= high:
                        self.ranges[symbol[1]] = new
        return True

    # Memory of the stack. ------------------------------------------------------------------------

    def slot(self, base, offset, size):
        """The place in the stack that an address is, or None."""
        symbol, at = base
        return ("s", at + offset, size) if symbol == ("e", "sp") else None

    def store(self, base, offset, size, value):
        place = self.slot(base, offset, size)
        if place is None:
            # By a pointer that is not the stack's: whatever a pointer may have been taken of. What came from
            # the caller or is constant leads to nothing of this function's own.
            given = base[0] is None or base[0][0] == "e"
            self.drop_slots(0 if given and self.floor is not None else self.floor)
            return
        first = place[1]
        for other in [key for key in self.places if isinstance(key, tuple)
                      and key[1] < first + size and first < key[1] + key[2]]:
            del self.places[other]
        if value is not None:
            self.places[place] = value

    def drop_slots(self, floor):
        if floor is not None:
            for other in [key for key in self.places if isinstance(key, tuple) and key[1] >= floor]:
                del self.places[other]

    # Conditions. ---------------------------------------------------------------------------------

    def given(self, condition, rank):
        """This state where `condition` of the flags is true; None where it can't be."""
        state = self.copy()
        tests = self.tests(condition)
        for a, b, what in tests:
            for one, other, true in self.implied(a, b, what):
                if not state.assume(one, other, true, rank):
                    return None
            state.decide(a, b, what)
        return state

    def tests(self, condition):
        """[(a, b, condition)]: what the flags say where `condition` is true."""
        return tests(self.flags, condition)

    def decide(self, a, b, condition):
        """What is one of two by this very condition is one of them now."""
        for symbol, how in self.made.items():
            if how[0] != "either" or how[1:3] != (a, b) or condition not in (how[3], OPPOSITE[how[3]]):
                continue
            base, offset = how[4] if condition == how[3] else how[5]
            for place, value in list(self.places.items()):
                if value[0] == symbol:
                    self.put(place, (base, offset + value[1]))

    def implied(self, a, b, condition):
        """What else is true where `condition` is: of a value that is one of two, it may say which."""
        found, todo = [], [(a, b, condition)]
        while todo and len(found) < 8:
            a, b, condition = todo.pop()
            found.append((a, b, condition))
            how = self.made.get(a[0])
            if how is None or how[0] != "either" or b[0] is not None:
                continue
            _, one, other, tested, yes, no = how
            for value, otherwise, what in ((yes, no, OPPOSITE[tested]), (no, yes, tested)):
                if value[0] is None and not self.exact(self.signed(value[1] + a[1]), b[1], condition):
                    todo.append((one, other, what))
                    todo.append(((otherwise[0], otherwise[1] + a[1]), b, condition))
        return found

    def assume(self, a, b, condition, rank):
        if a[0] == b[0]:
            return self.exact(a[1], b[1], condition) if a[0] is None else \
                not (condition == "ne" and a[1] == b[1]) and not (condition == "eq" and a[1] != b[1])
        (a_low, a_high), (b_low, b_high) = self.range_of(a), self.range_of(b)
        low, high = self.limits(a[0] or b[0])
        if condition == "eq":
            if not (self.narrow(a, b_low, b_high) and self.narrow(b, a_low, a_high)):
                return False
            self.equate(a, b, rank)
            return True
        if condition == "ne":
            return self.differ(a, b) and self.differ(b, a)
        if condition in ("lt", "mi"):
            return self.narrow(a, low, b_high - 1) and self.narrow(b, a_low + 1, high)
        if condition == "le":
            return self.narrow(a, low, b_high) and self.narrow(b, a_low, high)
        if condition == "gt":
            return self.narrow(a, b_low + 1, high) and self.narrow(b, low, a_high - 1)
        if condition in ("ge", "pl"):
            return self.narrow(a, b_low, high) and self.narrow(b, low, a_high)
        # Without a sign: where the greater one is not negative, none is.
        if condition in ("cc", "lo") and b_low >= 0:
            return self.narrow(a, 0, b_high - 1) and (a_low < 0 or self.narrow(b, a_low + 1, high))
        if condition == "ls" and b_low >= 0:
            return self.narrow(a, 0, b_high) and (a_low < 0 or self.narrow(b, a_low, high))
        if condition == "hi" and a_low >= 0:
            return self.narrow(b, 0, a_high - 1) and (b_low < 0 or self.narrow(a, b_low + 1, high))
        if condition in ("cs", "hs") and a_low >= 0:
            return self.narrow(b, 0, a_high) and (b_low < 0 or self.narrow(a, b_low, high))
        return True

    def exact(self, a, b, condition):
        mask = (1 << self.bits) - 1
        return {"eq": a == b, "ne": a != b, "lt": a < b, "le": a <= b, "gt": a > b, "ge": a >= b,
                "mi": self.signed(a - b) < 0, "pl": self.signed(a - b) >= 0,
                "cc": a & mask < b & mask, "lo": a & mask < b & mask, "ls": a & mask <= b & mask,
                "hi": a & mask > b & mask, "cs": a & mask >= b & mask, "hs": a & mask >= b & mask,
                }.get(condition, True)

    def differ(self, a, b):
        first, last = self.range_of(b)
        low, high = self.range_of(a)
        if first == last:
            if low == first:
                return self.narrow(a, low + 1, high)
            if high == first:
                return self.narrow(a, low, high - 1)
        return True

    def equate(self, a, b, rank):
        """From here on the younger one is written as the elder."""
        if b[0] is not None and (a[0] is None or rank(a[0]) <= rank(b[0])):
            a, b = b, a
        if a[0] is None:
            return
        for place, (symbol, offset) in list(self.places.items()):
            if symbol == a[0]:
                self.put(place, (b[0], b[1] + offset - a[1]))
