# SPDX-License-Identifier: Apache-2.0
"""Instructions of Arm and Thumb-2, taken apart: what they are called, what they work on, where they lead."""

import re

from listing import Refusal
from values import OPPOSITE

BITS = 32
WITH_FLAGS = ("neg mov mvn add sub rsb and bic orr eor orn lsl lsr asr ror rrx mul mla adc sbc rsc").split()
OTHERS = ("movw movt addw subw cmp cmn tst teq mls umull smull umlal smlal udiv sdiv uxtb uxth sxtb sxth "
          "uxtab uxtah sxtab sxtah ubfx sbfx bfi bfc clz rbit rev rev16 revsh adr ldr ldrb ldrh ldrsb ldrsh "
          "ldrd str strb strh strd ldm ldmia ldmdb ldmfd ldmib stm stmia stmdb stmib push pop b bl bx blx cbz "
          "cbnz tbb tbh nop umaal umlal smulbb smlabb smmul uqadd8 usat ssat sel uadd8 dmb dsb isb bkpt svc "
          "pld udf smlatb smulwb uxtb16 sxtb16 smuad qadd qsub smlalbb smultb smulbt smultt smlabt pkhbt pkhtb "
          "cpsid cpsie mrs msr").split()
WORDS = {}
for _base in WITH_FLAGS + OTHERS:
    for _s in ("", "s") if _base in WITH_FLAGS else ("",):
        for _condition in ("", *OPPOSITE):
            WORDS.setdefault(_base + _s + _condition, (_base, bool(_s), _condition or None))
NAMES = {"ip": "r12", "fp": "r11", "sl": "r10", "sb": "r9", "r13": "sp", "r14": "lr", "r15": "pc"}
SIZES = {"ldr": 4, "ldrb": 1, "ldrh": 2, "ldrsb": 1, "ldrsh": 2, "ldrd": 8,
         "str": 4, "strb": 1, "strh": 2, "strd": 8}
LOADED = {"ldrb": (0, 255), "ldrh": (0, 65535), "ldrsb": (-128, 127), "ldrsh": (-32768, 32767)}
CORE = [f"r{n}" for n in range(13)] + ["sp", "lr"]
CALLED = ["r0", "r1", "r2", "r3", "r12", "lr"] + [f"s{n}" for n in range(16)]
REGISTERS = CORE + [f"s{n}" for n in range(32)]
ARGUMENTS = ("r0", "r1", "r2", "r3")


class Word:
    """An instruction, taken apart."""

    __slots__ = ("base", "flags", "condition", "args", "vector", "kind", "target", "suffix")

    def __init__(self, instruction):
        op = re.sub(r"\.[nw]$", "", instruction.op)
        self.args = [NAMES.get(arg, arg) for arg in split(instruction.args)]
        self.target = instruction.target
        self.vector = op.startswith("v")
        self.suffix = ""
        if self.vector:
            name, _, self.suffix = op.partition(".")
            found = re.fullmatch(r"(v[a-z0-9]+?)(eq|ne|cs|hs|cc|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)?", name)
            # vcls, vmls, vnmls end as a condition does.
            whole = name in ("vmls", "vfms", "vnmls", "vfnms", "vcvt", "vabs", "vmrs", "vmsr") or not found[2]
            self.base, self.condition = (name, None) if whole else (found[1], found[2])
            self.flags = False
        elif re.fullmatch(r"it[te]*", op):
            self.base, self.flags, self.condition = "it", False, None
        elif op in WORDS:
            self.base, self.flags, self.condition = WORDS[op]
            if self.base == "neg":
                self.base, self.args = "rsb", [*self.args[:2], "#0"]
        else:
            raise Refusal(f"{instruction.address:#x}: nobody has said what {op} does")
        self.kind = self.flow()

    def flow(self):
        """next, jump, call, call_pointer, return, table, jump_pointer"""
        if self.base in ("b", "cbz", "cbnz"):
            return "jump"
        if self.base == "bl" or (self.base == "blx" and self.target is not None):
            return "call"
        if self.base == "blx":
            return "call_pointer"
        if self.base == "bx":
            return "return" if self.args[0] == "lr" else "jump_pointer"
        if self.base in ("tbb", "tbh"):
            return "table"
        if self.base in ("pop", "ldm", "ldmia", "ldmfd", "ldmdb") and re.search(r"\bpc\b", self.args[-1]):
            return "return"
        if self.args and self.args[0] == "pc" and not self.base.startswith(("str", "cmp", "pld")):
            if self.base == "ldr":
                return "return" if self.args[1].startswith("[sp") else "table"
            if self.base == "mov" and self.args[1] == "lr":
                return "return"
            return "table" if self.base == "add" else "jump_pointer"
        return "next"

    @property
    def implied(self):
        """The condition of a jump and what it is of, where that is not the flags."""
        if self.base in ("cbz", "cbnz"):
            return ("eq" if self.base == "cbz" else "ne"), self.args[0]
        return self.condition, None


def split(text):
    return [part.strip() for part in re.findall(r"(?:\[[^\]]*\]!?|\{[^}]*\}|[^,\[{])+", text)] if text else []


def number(text):
    return int(text[1:], 0) if re.fullmatch(r"#-?(0x[0-9a-f]+|\d+)", text) else None


def listed(text):
    found = []
    for part in text.strip("{}^ ").split(","):
        ends = [NAMES.get(end.strip(), end.strip()) for end in part.split("-")]
        if len(ends) == 1:
            found.append(ends[0])
        else:
            letter = ends[0][0]
            found += [f"{letter}{n}" for n in range(int(ends[0][1:]), int(ends[1][1:]) + 1)]
    return found


def singles(register):
    """The single ones that a register of the vector unit is."""
    if re.fullmatch(r"d\d+", register):
        n = int(register[1:])
        return [f"s{2 * n}", f"s{2 * n + 1}"] if n < 16 else []
    return [register] if re.fullmatch(r"s\d+", register) else []


class Memory:
    """[base, #offset]!, [base], #offset, [base, index, lsl #2]"""

    def __init__(self, args):
        inside = split(re.match(r"\[([^\]]*)\]", args[0])[1])
        self.base = NAMES.get(inside[0], inside[0])
        self.before = args[0].endswith("!")
        self.offset, self.index, self.shift = 0, None, 0
        self.after = None
        if len(inside) > 1:
            step = number(inside[1])
            if step is not None:
                self.offset = step
            else:
                self.index = NAMES.get(inside[1].lstrip("-"), inside[1])
                self.shift = int(re.search(r"\d+", inside[2])[0]) if len(inside) > 2 else 0
        if len(args) > 1:
            self.after = number(args[1])
