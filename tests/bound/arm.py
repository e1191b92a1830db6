# SPDX-License-Identifier: Apache-2.0
"""What the instructions of Arm and Thumb-2 make of a state (values.py), and where their tables of jumps lead."""

import re

from arm_words import ARGUMENTS, BITS, CALLED, CORE, LOADED, NAMES, REGISTERS, SIZES, Memory, Word, listed, number, \
    singles
from listing import Refusal
from sums import either_bit, masked, multiple, scaled, shifted, shifted_span, spread, total
from values import OPPOSITE

STACK = "sp"


class Arm:
    BITS, STACK, FRAME, ARGUMENTS, CALLED = BITS, STACK, (STACK,), ARGUMENTS, CALLED

    def __init__(self, image):
        self.image = image
        self.words = {}
        self.kept = {}  # registers that a function leaves as they were, by entry

    def word(self, instruction):
        at = instruction.address
        if at not in self.words:
            word = self.words[at] = Word(instruction)
            if word.base == "ldr" and word.kind == "table" and re.match(r"\[pc, #", word.args[1]):
                # A far jump to one place.
                data = self.image.read(instruction.target, 4)
                word.kind, word.target = "jump", int.from_bytes(data, "little") & ~1
        return self.words[at]

    @staticmethod
    def whole(_):
        return None

    @staticmethod
    def opposite(condition):
        return OPPOSITE[condition]

    def table(self, image, instruction):
        """Where a jump by a table may go."""
        word = self.word(instruction)
        after = instruction.address + instruction.size
        if word.base in ("tbb", "tbh"):
            size = 1 if word.base == "tbb" else 2
            end = image.data_after(after)
            data = image.read(after, end - after)
            entries = [int.from_bytes(data[n:n + size], "little") for n in range(0, end - after, size)]
            if size == 1 and entries and entries[-1] == 0:
                entries.pop()  # to an even address
            found = {after + 2 * entry for entry in entries}
        elif word.base == "ldr" and word.args[1].startswith("[pc"):
            begin = (instruction.address + (8 if instruction.size == 4 and image.marked(instruction.address) == "a"
                                            else 4)) & ~3
            found = self.addresses(image, begin, image.data_after(begin))
        else:
            raise Refusal(f"{instruction.address:#x}: a table of jumps of which nobody has said where it is")
        if not found or any(to not in image.instructions for to in found):
            raise Refusal(f"{instruction.address:#x}: a table of jumps that cannot be read")
        return sorted(found)

    @staticmethod
    def addresses(image, begin, end):
        data = image.read(begin, end - begin) or b""
        found = set()
        for n in range(0, len(data) - 3, 4):
            to = int.from_bytes(data[n:n + 4], "little") & ~1
            if to not in image.instructions:
                break
            found.add(to)
        return found

    def enter(self, state):
        for register in REGISTERS:
            state.places[register] = (("e", register), 0)

    def longest_way_back(self, graph):
        """The most that an access goes below a pointer, which is not the stack's own."""
        most = 0
        for block in graph.blocks.values():
            for instruction in block.instructions:
                if found := re.search(r"\[(?!sp|pc|r13)\w+, #-(0x[0-9a-f]+|\d+)\]", instruction.args):
                    most = min(most, -int(found[1], 0))
        return most

    def called(self, state, where, target):
        kept = self.kept.get(target, ())
        for register in CALLED:
            if register not in kept:
                state.fresh(register, where)
        state.flags = None
        state.drop_slots(state.floor)

    def execute(self, state, instruction):
        word, where = self.word(instruction), instruction.address
        if word.base in ("it", "nop", "b", "cbz", "cbnz", "pld", "dmb", "dsb", "isb", "bkpt", "svc", "udf",
                         "cpsid", "cpsie", "msr"):
            return
        if word.kind in ("call", "call_pointer"):
            self.called(state, where, word.target)
        elif word.kind == "next" or word.base == "pop":
            if word.vector:
                self.vector(state, word, where)
            elif word.base in SIZES:
                self.memory(state, word, where, instruction)
            elif word.base in ("push", "pop") or word.base[:3] in ("ldm", "stm"):
                self.several(state, word, where)
            else:
                self.number(state, word, where, instruction)

    # ---------------------------------------------------------------------------------------------

    def operand(self, state, args):
        """The last operand: a constant, a register, or one that is shifted (None: not known)."""
        if (constant := number(args[0])) is not None:
            return (None, state.signed(constant))
        value = state.get(args[0])
        if len(args) > 1:
            found = re.fullmatch(r"(lsl|lsr|asr|ror) #(\d+)", args[1])
            if found and value[0] is None:
                return (None, state.signed(shifted(value[1], found[1], int(found[2]))))
            return None
        return value

    def number(self, state, word, where, instruction):
        base, args = word.base, word.args
        if base in ("cmp", "cmn", "tst", "teq"):
            a, b = state.get(args[0]), self.operand(state, args[1:])
            if base == "cmp" and b is not None:
                state.flags = (a, b)
            elif base == "cmn" and b is not None and b[0] is None:
                state.flags = (a, (None, -b[1]))
            elif base == "tst" and b is not None and a == b:
                state.flags = (a, None)
            else:
                state.flags = None
            return
        target = args[0]
        flags = word.flags
        made = None
        if base in ("umull", "smull", "umlal", "smlal", "umaal", "smlalbb"):
            state.fresh(args[0], where)
            state.fresh(args[1], where)
            state.flags = None if flags else state.flags
            return
        value, span = None, None
        rest = args[1:]
        if base in ("mov", "movw"):
            value = self.operand(state, rest)
            if value is None and len(rest) == 2:
                kind, _, by = rest[1].partition(" ")
                rest, base = [rest[0], by], kind
        elif base == "mvn":
            operand = self.operand(state, rest)
            value = (None, ~operand[1]) if operand and operand[0] is None else None
        elif base == "movt":
            old = state.get(target)
            value = (None, old[1] & 0xFFFF | number(rest[0]) << 16) if old[0] is None else None
        elif base == "adr" or (base in ("add", "addw", "sub", "subw") and rest[0] == "pc"):
            value = (None, instruction.target)
            if instruction.target is None:
                ahead = where + 8 if self.image.marked(where) == "a" else where + 4 & ~3
                by = number(rest[-1])
                value = (None, ahead - by if base.startswith("sub") else ahead + by)
        if value is None and base in ("add", "addw", "sub", "subw", "rsb"):
            value, span, made, minus = self.sum(state, base, target, rest)
            if flags and minus is not None:
                state.flags = minus
                flags = None
        elif value is None and base in ("and", "bic", "lsl", "lsr", "asr", "ubfx", "uxtb", "uxth", "sxtb", "sxth",
                                        "udiv", "mul", "clz", "sbfx"):
            value, span, made = self.bits(state, base, target, rest)
        elif value is None and base in ("orr", "eor"):
            a = state.get(rest[0]) if len(rest) > 1 else state.get(target)
            b = self.operand(state, rest[1:] if len(rest) > 1 else rest)
            span = either_bit(state, a, b, base == "orr")
        if value is not None:
            state.put(target, value)
        elif span is not None:
            state.fresh(target, where, *span, made=made)
        else:
            state.fresh(target, where, made=made)
        if flags:
            state.flags = (state.get(target), None)
        elif flags is None and state.flags and any(part and part[0] == ("d", where, target) for part in state.flags):
            state.flags = None

    def sum(self, state, base, target, rest):
        """(value, range, how it was made, what the flags are of)"""
        if len(rest) == 1 or (len(rest) == 2 and re.match(r"(lsl|lsr|asr|ror) ", rest[1])):
            rest = [target, *rest]
        a, b = state.get(rest[0]), self.operand(state, rest[1:])
        if base == "rsb":
            a, b = b, a
        if a is None or b is None:
            index = self.span(state, rest[1:]) if base in ("add", "addw") else None
            return (*spread(state, a, index, BITS), None)
        return total(state, a, b, base not in ("add", "addw"), BITS)

    def span(self, state, rest):
        """(low, high, stride) of a shifted operand."""
        if len(rest) == 2 and (found := re.fullmatch(r"lsl #(\d+)", rest[1])):
            return scaled(state, state.get(rest[0]), int(found[1]), BITS)
        return None

    def bits(self, state, base, target, rest):
        if base in ("and", "bic", "lsl", "lsr", "asr", "mul") and \
                (len(rest) == 1 or re.match(r"(lsl|lsr|asr|ror) ", rest[-1]) and len(rest) == 2):
            rest = [target, *rest]
        a = state.get(rest[0])
        low, high = state.range_of(a)
        b = self.operand(state, rest[1:]) if len(rest) > 1 and base not in ("ubfx", "sbfx") else None
        n = b[1] if b and b[0] is None else None
        if base == "clz":
            return None, (0, 32), None
        if base in ("uxtb", "uxth", "sxtb", "sxth") and len(rest) == 1:
            top = 8 if base.endswith("b") else 16
            span = (0, (1 << top) - 1) if base[0] == "u" else (-(1 << top - 1), (1 << top - 1) - 1)
            return (a, None, None) if span[0] <= low and high <= span[1] else (None, span, None)
        if base == "ubfx":
            return None, (0, (1 << number(rest[2])) - 1), None
        if base == "sbfx":
            top = number(rest[2]) - 1
            return None, (-(1 << top), (1 << top) - 1), None
        if base in ("and", "bic"):
            return masked(state, base, a, b)
        if n is not None and base in ("lsl", "lsr", "asr"):
            return shifted_span(state, base, a, n & 255, BITS)
        if base == "udiv" and low >= 0:
            return None, (0, high), None
        if base == "mul" and b is not None:
            return multiple(state, a, b, BITS)
        return None, None, None

    # ---------------------------------------------------------------------------------------------

    def memory(self, state, word, where, instruction):
        base = word.base
        size = SIZES[base]
        first = next((n for n, arg in enumerate(word.args) if arg.startswith("[")), 0)
        registers, rest = word.args[:first], word.args[first:]
        if size == 8 and first == 1:
            # Of Arm's own words the second one is implied.
            registers = [registers[0], CORE[CORE.index(registers[0]) + 1]]
        loads = base.startswith("ldr")
        if not registers:
            raise Refusal(f"{where:#x}: a load that cannot be read")
        place = Memory(rest)
        if place.base == "pc":
            data = self.image.read(instruction.target, size) if instruction.target is not None and loads else None
            for n, register in enumerate(registers):
                if data is not None and size >= 4:
                    state.put(register, (None, int.from_bytes(data[4 * n:4 * n + 4], "little")))
                else:
                    state.fresh(register, where, *LOADED.get(base, (None, None)))
            return
        at = state.get(place.base)
        offset = place.offset
        known = place.index is None
        if not loads:
            if known:
                for n, register in enumerate(registers):
                    state.store(at, offset + 4 * n, min(size, 4), state.get(register) if size >= 4 else None)
            else:
                state.store((("x",), 0), 0, size, None)
        self.back(state, place, at, where)
        if loads:
            for n, register in enumerate(registers):
                self.loaded(state, register, at, offset + 4 * n, base, known, where)

    def loaded(self, state, register, at, offset, base, known, where):
        size = min(SIZES[base], 4)
        slot = state.slot(at, offset, size) if known else None
        span = LOADED.get(base, (None, None))
        if slot is not None and slot in state.places:
            state.put(register, state.places[slot])
            return
        if known and at[0] is None:
            data = self.image.read(at[1] + offset, size)
            if data is not None:
                state.put(register, (None, int.from_bytes(data, "little", signed="s" in base[3:])))
                return
        state.fresh(register, where, *span)
        if slot is not None and size == 4:
            state.places[slot] = state.get(register)

    def back(self, state, place, at, where):
        step = place.offset if place.before else place.after
        if place.before and place.index or place.after is None and not place.before:
            if place.before:
                state.fresh(place.base, where)
            return
        state.put(place.base, (at[0], at[1] + step))

    def several(self, state, word, where):
        base = word.base
        if base in ("push", "pop"):
            register, registers, back = "sp", listed(word.args[0]), True
        else:
            register = NAMES.get(word.args[0].rstrip("!"), word.args[0].rstrip("!"))
            registers, back = listed(word.args[1]), word.args[0].endswith("!")
        down = base in ("push", "stmdb", "ldmdb")
        size = 4 * len(registers)
        at = state.get(register)
        first = -size if down else 4 if base in ("ldmib", "stmib") else 0
        if base in ("push",) or base.startswith("stm"):
            for n, name in enumerate(registers):
                state.store(at, first + 4 * n, 4, state.get(name))
        if back:
            state.put(register, (at[0], at[1] + (-size if down else size)))
        if base == "pop" or base.startswith("ldm"):
            for n, name in enumerate(registers):
                if name != "pc" and not (name == register and back):
                    self.loaded(state, name, at, first + 4 * n, "ldr", True, where)

    def vector(self, state, word, where):
        base, args = word.base, word.args
        if base in ("vpush", "vpop") or base[:4] in ("vldm", "vstm"):
            own = base in ("vpush", "vpop")
            register = "sp" if own else NAMES.get(args[0].rstrip("!"), args[0].rstrip("!"))
            registers = listed(args[-1])
            size = (8 if registers[0][0] == "d" else 4) * len(registers)
            at = state.get(register)
            down = base in ("vpush", "vstmdb", "vldmdb")
            if base == "vpush" or base.startswith("vst"):
                state.store(at, -size if down else 0, size, None)
            else:
                for name in registers:
                    for single in singles(name):
                        state.fresh(single, where)
            if own or args[0].endswith("!"):
                state.put(register, (at[0], at[1] + (-size if down else size)))
        elif base == "vstr":
            place = Memory(args[1:])
            state.store(state.get(place.base), place.offset, 8 if args[0][0] == "d" else 4,
                        state.get(args[0]) if args[0][0] == "s" else None)
        elif base == "vmrs":
            if args[0].lower() in ("apsr_nzcv", "pc"):
                state.flags = None
            else:
                state.fresh(args[0], where)
        elif base in ("vcmp", "vcmpe", "vmsr"):
            pass
        elif base == "vmov":
            self.moved(state, args, where)
        else:
            self.written(state, args[:1], where)

    def moved(self, state, args, where):
        """Between the two kinds of registers a word may be kept."""
        if len(args) == 2 and number(args[1]) is None:
            from_one, to_one = args[1], args[0]
            if singles(to_one) == [to_one] and (from_one in CORE or singles(from_one) == [from_one]) or \
                    to_one in CORE and singles(from_one) == [from_one]:
                state.put(to_one, state.get(from_one))
                return
            if len(singles(to_one)) == 2 and len(singles(from_one)) == 2:
                for one, other in zip(singles(to_one), singles(from_one)):
                    state.put(one, state.get(other))
                return
        if len(args) == 3 and args[0] in CORE and len(singles(args[2])) == 2:
            for one, other in zip(args[:2], singles(args[2])):
                state.put(one, state.get(other))
            return
        if len(args) == 3 and len(singles(args[0])) == 2:
            for one, other in zip(singles(args[0]), args[1:]):
                state.put(one, state.get(other))
            return
        if len(args) == 4 and args[0] in CORE:
            self.written(state, args[:2], where)
            return
        self.written(state, args[: 1 if len(args) < 4 else 2], where)

    def written(self, state, registers, where):
        for register in registers:
            register = re.sub(r"\[\d+\]$", "", register)
            for name in singles(register) or ([register] if register in CORE else []):
                state.fresh(name, where)
