# SPDX-License-Identifier: Apache-2.0
"""Instructions of 64-bit Arm, taken apart: what they are called, what they work on, where they lead."""

import re

SIZES = {"ldrb": 1, "ldrh": 2, "ldrsb": 1, "ldrsh": 2, "ldrsw": 4, "strb": 1, "strh": 2, "ldpsw": 4}
LOADED = {"ldrb": (0, 255), "ldrh": (0, 65535), "ldrsb": (-128, 127), "ldrsh": (-32768, 32767),
          "ldrsw": (-(1 << 31), (1 << 31) - 1), "ldpsw": (-(1 << 31), (1 << 31) - 1)}
VECTOR = {"b": 1, "h": 2, "s": 4, "d": 8, "q": 16}
SILENT = {"nop", "bti", "paciasp", "autiasp", "hint", "prfm", "dmb", "dsb", "isb", "brk", "udf", "msr", "xpaclri"}
# Of one register, from others: nothing is known of what they make.
PLAIN = {"mvn", "eon", "orn", "bfi", "bfxil", "bfc", "rbit", "rev", "rev16", "rev32", "cls", "madd", "msub", "mneg",
         "smull", "umull", "smaddl", "umaddl", "smulh", "umulh", "smsubl", "umsubl", "smnegl", "umnegl", "sdiv",
         "ror", "extr", "adc", "sbc", "ngc", "mrs", "csinv", "csneg", "cneg", "cinv", "csetm", "movk"}
REGISTERS = [f"{kind}{n}" for kind in "xw" for n in range(31)] + ["sp"]


class Word:
    __slots__ = ("base", "condition", "args", "kind", "target", "implied")

    def __init__(self, instruction):
        self.base, _, under = instruction.op.partition(".")
        self.args = split(instruction.args)
        self.target = instruction.target
        self.condition = None  # no instruction is left out
        self.implied = (under or None, None) if self.base == "b" else (None, None)
        self.kind = self.flow()

    def flow(self):
        base = self.base
        if base in ("cbz", "cbnz"):
            self.implied = "eq" if base == "cbz" else "ne", self.args[0]
        elif base in ("tbz", "tbnz"):
            top = 31 if self.args[0][0] == "w" else 63
            signed = number(self.args[1]) == top
            names = ("pl", "mi") if signed else ("nobit", "bit")
            self.implied = names[base == "tbnz"], self.args[0] if signed else None
        elif base == "bl":
            return "call"
        elif base == "blr":
            return "call_pointer"
        elif base == "ret":
            return "return"
        elif base == "br":
            return "table"
        elif base != "b":
            return "next"
        return "jump"


def split(text):
    return [part.strip() for part in re.findall(r"(?:\[[^\]]*\]!?|\{[^}]*\}|[^,\[{])+", text)] if text else []


def number(text):
    return int(text[1:], 0) if re.fullmatch(r"#-?(0x[0-9a-f]+|\d+)", text) else None


def is_core(name):
    return bool(re.fullmatch(r"[xw](\d+|zr)|sp|wsp", name))


def bits_of(name):
    return 32 if name[0] == "w" else 64
