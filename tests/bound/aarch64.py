# SPDX-License-Identifier: Apache-2.0
"""What the instructions of 64-bit Arm make of a state (values.py), and where their tables of jumps lead. The
lower half of a register is a place of its own: w0 beside x0."""

import re

from aarch64_words import LOADED, PLAIN, REGISTERS, SILENT, SIZES, VECTOR, Word, bits_of, is_core, number, split
from listing import Refusal
from sums import either_bit, masked, multiple, scaled, shifted_span, spread, total
from values import OPPOSITE, half


class AArch64:
    BITS, STACK, FRAME = 64, "sp", ("sp", "x29", "w29")
    ARGUMENTS = tuple(f"{kind}{n}" for kind in "wx" for n in range(8))
    CALLED = [f"{kind}{n}" for kind in "xw" for n in (*range(19), 30)]

    def __init__(self, image):
        self.image = image
        self.words = {}
        self.kept = {}

    def word(self, instruction):
        at = instruction.address
        if at not in self.words:
            word = self.words[at] = Word(instruction)
            if word.kind == "table" and self.entries(instruction) is None:
                word.kind = "jump_pointer"
        return self.words[at]

    @staticmethod
    def whole(place):
        """Of what it is the lower half."""
        return "x" + place[1:] if isinstance(place, str) and place[0] == "w" else None

    @staticmethod
    def opposite(condition):
        return OPPOSITE[condition]

    # A table of jumps: an index that was compared, a distance read by it, the place that it is added to. ----

    def before(self, address, count):
        return [self.image.instructions[at] for at in range(address - 4, address - 4 * count - 4, -4)
                if at in self.image.instructions]

    def entries(self, instruction):
        lines = self.before(instruction.address, 24)
        if not lines or lines[0].op != "add":
            return None
        added = re.match(r"x\d+, (x\d+), w\d+, sxt([bhw])(?: #(\d))?$", lines[0].args)
        if not added:
            return None
        begin = next((one.target for one in lines if one.op == "adr" and one.args.startswith(f"{added[1]},")), None)
        read = next((one for one in lines if re.match(r"ldr[bh]?$|ldrs[bhw]$", one.op)), None)
        compared = next((one for one in lines if one.op == "cmp" and "#" in one.args), None)
        if begin is None or read is None or compared is None:
            return None
        place = re.match(r"w\d+, \[(x\d+), (w\d+|x\d+)", read.args)
        table = self.constant(place[1], read.address) if place else None
        count = number(compared.args.split(", ")[1]) + 1
        size = {"b": 1, "h": 2, "w": 4}[added[2]]
        data = self.image.read(table, size * count) if table is not None and 0 < count < 1000 else None
        if data is None:
            return None
        by = int(added[3] or 0)
        return sorted({begin + (int.from_bytes(data[n:n + size], "little", signed=True) << by)
                       for n in range(0, size * count, size)})

    def constant(self, register, address):
        """What adrp and add have put there."""
        more = 0
        for one in self.before(address, 40):
            if one.op == "add" and (found := re.match(rf"{register}, {register}, #(0x[0-9a-f]+|\d+)$", one.args)):
                more += int(found[1], 0)
            elif one.op == "adrp" and one.args.startswith(f"{register}"):
                return one.target + more
        return None

    def table(self, image, instruction):
        found = self.entries(instruction)
        if not found or any(to not in image.instructions for to in found):
            raise Refusal(f"{instruction.address:#x}: a table of jumps that cannot be read")
        return found

    # ---------------------------------------------------------------------------------------------

    def enter(self, state):
        for register in REGISTERS:
            state.places[register] = (("e", register), 0)

    @staticmethod
    def longest_way_back(graph):
        most = 0
        for block in graph.blocks.values():
            for instruction in block.instructions:
                if found := re.search(r"\[(?!sp|x29)\w+, #-(0x[0-9a-f]+|\d+)\]", instruction.args):
                    most = min(most, -int(found[1], 0))
        return most

    def get(self, state, name):
        return (None, 0) if name in ("xzr", "wzr") else state.places[name]

    def put(self, state, name, value, where, span=None, made=None):
        """Into a register; what its other half is follows."""
        if name in ("xzr", "wzr"):
            return
        if value is not None:
            state.put(name, value)
        elif span is not None:
            state.fresh(name, where, *span, made=made)
        else:
            state.fresh(name, where, made=made)
        if name == "sp":
            return
        now = state.places[name]
        if name[0] == "x":
            state.places["w" + name[1:]] = half(now)
            return
        other = "x" + name[1:]
        low, high = state.range_of(now)
        if now[0] is None:
            state.put(other, (None, now[1] & 0xFFFFFFFF))
        elif low >= 0:
            self.extended(state, other, now, where, low, high)
        else:
            state.fresh(other, where, 0, (1 << 32) - 1)

    @staticmethod
    def extended(state, name, value, where, low, high):
        """A whole register of a lower half that lies between low and high."""
        symbol, offset = value
        if symbol[0] == "l" and state.range_of((symbol[1], offset)) == (low, high):
            state.put(name, (symbol[1], offset))
        else:
            state.fresh(name, where, low, high, made=("plus", value, 0, 0, 0))

    def called(self, state, where, target):
        kept = self.kept.get(target, ())
        for register in self.CALLED:
            if register not in kept:
                state.fresh(register, where)
        state.flags = None
        state.drop_slots(state.floor)

    def execute(self, state, instruction):
        word, where = self.word(instruction), instruction.address
        base, args = word.base, word.args
        if word.kind in ("call", "call_pointer"):
            self.called(state, where, word.target)
        elif word.kind != "next" or base in SILENT:
            pass
        elif re.match(r"(ld|st)", base):
            self.memory(state, base, args, where)
        elif base in ("fcmp", "fcmpe", "fccmp", "fccmpe"):
            state.flags = None
        elif not is_core(args[0]):
            if not re.match(r"[bhsdqv]\d+", args[0]):
                raise Refusal(f"{where:#x}: nobody has said what {instruction.op} does")
        elif base[0] == "f" or base in ("umov", "smov") or base == "mov" and not is_core(args[1]) \
                and number(args[1]) is None:
            self.put(state, args[0], None, where)
        else:
            self.number(state, base, args, where, instruction)

    def operand(self, state, args):
        """(value, None), or (None, what is known of it): a constant, a register, one that is shifted."""
        n = number(args[0])
        if n is not None:
            by = int(re.search(r"\d+", args[1])[0]) if len(args) > 1 else 0
            return (None, n << by), None
        value = self.get(state, args[0])
        if len(args) == 1:
            return value, None
        how, _, by = args[1].partition(" ")
        by = number(by) or 0
        if how in ("lsl", "uxtx", "sxtx") and by == 0:
            return value, None
        if how in ("lsl", "uxtx", "sxtx", "sxtw") or how == "uxtw" and state.range_of(value)[0] >= 0:
            bits = 64 if how != "lsl" or args[0][0] == "x" else 32
            if value[0] is None:
                return (None, value[1] << by), None
            return None, scaled(state, value, by, bits) or (scaled_word(by) if how == "sxtw" else None)
        return None, None

    def number(self, state, base, args, where, instruction):
        flags = base in ("adds", "subs", "ands", "bics", "negs")
        name = base[:-1] if flags else base
        if name in ("cmp", "cmn", "tst"):
            name, flags, args = {"cmp": "sub", "cmn": "add", "tst": "and"}[name], True, ["xzr", *args]
            args[0] = "wzr" if args[1][0] == "w" else "xzr"
        if name == "neg":
            name, args = "sub", [args[0], "wzr" if args[0][0] == "w" else "xzr", *args[1:]]
        bits = bits_of(args[0])
        value = span = made = None
        if name in ("ccmp", "ccmn"):
            b, _ = self.operand(state, args[1:2])
            if name == "ccmp" and state.flags is not None:
                state.flags = (self.get(state, args[0]), b, state.flags, args[3], number(args[2]))
            else:
                state.flags = None
            return
        if name in ("adr", "adrp"):
            value = (None, instruction.target) if instruction.target is not None else None
        elif name in ("mov", "movz"):
            value, _ = self.operand(state, args[1:])
        elif name == "movn":
            n, _ = self.operand(state, args[1:])
            value = (None, ~n[1])
        elif name in ("add", "sub"):
            a = self.get(state, args[1])
            b, index = self.operand(state, args[2:])
            if b is None:
                if name == "sub" and index:
                    index = (-index[1], -index[0], index[2])
                value, span, made = spread(state, a, index, bits)
                minus = None
            else:
                value, span, made, minus = total(state, a, b, name == "sub", bits)
            if flags:
                state.flags = minus
                flags = minus is None
        elif name in ("and", "bic", "orr", "eor"):
            a = self.get(state, args[1])
            b, _ = self.operand(state, args[2:])
            if name in ("and", "bic"):
                value, span, made = masked(state, name, a, b)
            else:
                span = either_bit(state, a, b, name == "orr")
        else:
            value, span, made = self.other(state, name, args, bits)
        if name == "movk":
            old = self.get(state, args[0])
            by = int(re.search(r"\d+", args[2])[0]) if len(args) > 2 else 0
            value = (None, old[1] & ~(0xFFFF << by) | number(args[1]) << by) if old[0] is None else None
        if name in ("csel", "csinc", "cset", "cinc"):
            self.chosen(state, name, args, where)
            return
        if args[0] in ("xzr", "wzr"):
            if flags:
                state.flags = (self.get(state, args[1]), None) if args[1:2] == args[2:3] and name == "and" else None
            return
        self.put(state, args[0], value, where, span, made)
        if flags:
            state.flags = (state.get(args[0]), None)

    def other(self, state, name, args, bits):
        a = self.get(state, args[1]) if len(args) > 1 and is_core(args[1]) else None
        n = number(args[2]) if len(args) > 2 else None
        if name in ("lsl", "lsr", "asr") and a is not None:
            return shifted_span(state, name, a, n, bits) if n is not None else (None, None, None)
        if name in ("sxtb", "sxth", "uxtb", "uxth", "sxtw", "uxtw"):
            top = {"b": 8, "h": 16, "w": 32}[name[3]]
            first, last = (0, (1 << top) - 1) if name[0] == "u" else (-(1 << top - 1), (1 << top - 1) - 1)
            low, high = state.range_of(a)
            if first <= low and high <= last:
                if a[0] is not None and a[0][0] == "l" and bits == 64 and \
                        state.range_of((a[0][1], a[1])) == (low, high):
                    return (a[0][1], a[1]), None, None
                return None, (low, high), ("plus", a, 0, 0, 0)
            return None, (first, last) if last < 1 << bits - 1 else None, None
        if name in ("ubfx", "sbfx"):
            top = number(args[3])
            return None, (0, (1 << top) - 1) if name[0] == "u" else (-(1 << top - 1), (1 << top - 1) - 1), None
        if name in ("ubfiz", "sbfiz"):
            top = number(args[3])
            low, high = state.range_of(a)
            if (0 if name[0] == "u" else -(1 << top - 1)) <= low and high < 1 << top - (name[0] == "s"):
                return None, (low << n, high << n), ("lsl", a, n)
            first, last = (0, (1 << top) - 1) if name[0] == "u" else (-(1 << top - 1), (1 << top - 1) - 1)
            return None, (first << n, last << n), ("lsl", None, n)
        if name == "mul":
            return multiple(state, a, self.get(state, args[2]), bits)
        if name == "clz":
            return None, (0, bits), None
        if name == "udiv" and state.range_of(a)[0] >= 0:
            return None, (0, state.range_of(a)[1]), None
        if name in PLAIN or name in ("udiv", "lsl", "lsr", "asr", "csel", "csinc", "cset", "cinc"):
            return None, None, None
        raise Refusal(f"nobody has said what {name} does")

    def chosen(self, state, name, args, where):
        """One of two, by the flags."""
        condition = args[-1]
        if name == "cset":
            values, more = ((None, 1), (None, 0)), 0
        elif name == "cinc":
            a = self.get(state, args[1])
            values, more = ((a[0], a[1] + 1), a), 0
        else:
            a, b = self.get(state, args[1]), self.get(state, args[2])
            values, more = (a, (b[0], b[1] + (name == "csinc"))), 0
        del more
        yes, no = state.given(condition, lambda _: (0, 0, 0)), state.given(OPPOSITE[condition], lambda _: (0, 0, 0))
        if yes is None or no is None or values[0] == values[1]:
            self.put(state, args[0], values[0] if yes is not None else values[1], where)
            return
        spans = yes.range_of(values[0]), no.range_of(values[1])
        low, high = min(s[0] for s in spans), max(s[1] for s in spans)
        tests = state.tests(condition)
        made = ("either", *tests[0][:2], condition, *values) if len(tests) == 1 and len(state.flags) == 2 else None
        limits = -(1 << bits_of(args[0]) - 1), (1 << bits_of(args[0]) - 1) - 1
        self.put(state, args[0], None, where, (low, high) if (low, high) != limits else None, made)

    # ---------------------------------------------------------------------------------------------

    def memory(self, state, base, args, where):
        at = next((n for n, arg in enumerate(args) if arg.startswith("[")), None)
        if at is None:
            # Beside the code.
            self.put(state, args[0], None, where) if is_core(args[0]) else None
            return
        names = args[:at]
        if base in ("ld1", "st1", "ld2", "st2", "ld1r", "stxr", "stlxr", "ldxr", "ldaxr", "ldar", "stlr"):
            if base.startswith("st"):
                state.store((("x",), 0), 0, 16, None)
            for name in names:
                if is_core(name):
                    self.put(state, name, None, where)
            after = args[at + 1] if len(args) > at + 1 else None
            register = re.match(r"\[(\w+)", args[at])[1]
            if after is not None and (step := number(after)) is not None:
                state.put(register, (state.get(register)[0], state.get(register)[1] + step))
            elif after is not None:
                self.put(state, register, None, where)
            return
        plain = re.sub(r"^(ld|st)(u|n)(r|p)", r"\1\3", base)
        size = SIZES.get(plain) or (VECTOR[names[0][0]] if names[0][0] in VECTOR else bits_of(names[0]) // 8)
        inside = split(re.match(r"\[([^\]]*)\]", args[at])[1])
        register, before = inside[0], args[at].endswith("!")
        offset = number(inside[1]) if len(inside) > 1 else 0
        after = number(args[at + 1]) if len(args) > at + 1 else None
        place = state.get(register)
        known = offset is not None
        if base.startswith("st"):
            for n, name in enumerate(names):
                if known:
                    value = self.get(state, name) if is_core(name) and size >= 4 else None
                    state.store(place, offset + n * size, size, value)
                else:
                    state.store((("x",), 0), 0, size, None)
        if before or after is not None:
            state.put(register, (place[0], place[1] + (offset if before else after)))
            if register != "sp":
                self.put(state, register, state.get(register), where)
        if base.startswith("ld"):
            for n, name in enumerate(names):
                if is_core(name):
                    self.loaded(state, name, place, offset + n * size if known else None, plain, size, where)

    def loaded(self, state, name, place, offset, base, size, where):
        slot = state.slot(place, offset, size) if offset is not None else None
        if slot is not None and slot in state.places and base in ("ldr", "ldp"):
            self.put(state, name, state.places[slot], where)
            return
        if offset is not None and place[0] is None and (data := self.image.read(place[1] + offset, size)) is not None:
            self.put(state, name, (None, int.from_bytes(data, "little", signed="s" in base[3:])), where)
            return
        self.put(state, name, None, where, LOADED.get(base))
        if slot is not None and base in ("ldr", "ldp"):
            state.places[slot] = state.get(name) if name not in ("xzr", "wzr") else (None, 0)


def scaled_word(by):
    return -(1 << 31 + by), (1 << 31) - 1 << by, 1 << by
