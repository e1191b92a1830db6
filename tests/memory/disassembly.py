# SPDX-License-Identifier: Apache-2.0
"""What a function takes of the stack and whom it may call, from the disassembly of a linked image.

The compiler says how much stack its functions take (-fstack-usage), but not those of the libraries,
and a linked image says which of both are there. So the frames are read here, and `check_frames` holds
the reading against the compiler's word for every object file.
"""

import collections
import dataclasses
import pathlib
import re
import subprocess


class Refusal(Exception):
    """What an image must not do, or what cannot be read."""


@dataclasses.dataclass
class Function:
    name: str
    frame: int = 0  # bytes, with what a call pushes
    spilled: int = 0  # of these, for arguments that came in registers: not in the compiler's word
    dynamic: bool = False  # takes as much as it wants
    calls: set = dataclasses.field(default_factory=set)
    indirect: int = 0  # calls through pointers


def hexadecimal(text):
    return int(text, 0)


class Arm:
    """Thumb-2 and Arm; the same words for both."""

    called = 0
    direct = re.compile(r"^(?:bl|blx|b(?:[a-z]{2})?(?:\.[nw])?|cbn?z)\b.*?([0-9a-f]+) <([^>]+)>$")
    pushes = re.compile(r"^(?:push|stmfd|stmdb)(?:\.w)?\s+(?:sp!, )?\{([^}]*)\}$")
    vector_pushes = re.compile(r"^(?:vpush|vstmdb)\s+(?:sp!, )?\{([^}]*)\}$")
    lowered = re.compile(r"^sub(?:\.w|w)?\s+sp, (?:sp, )?#(\d+)")
    stored = re.compile(r"^(?:str|strd|vstr)(?:\.w)?\s.*\[sp, #-(\d+)\]!")
    lowered_by_register = re.compile(r"^sub(?:\.w|s)?\s+sp, (?:sp, )?r|^mov\s+sp, r|^bic.*\bsp, ")

    @classmethod
    def saves(cls, code):
        return cls.pushes.match(code) or cls.vector_pushes.match(code)

    @classmethod
    def spills(cls, before):
        """An argument that is partly in registers is put beside its rest before anything is saved."""
        lowering = [code for code in before if "sp" in code]
        return len(lowering) == 1 and cls.lowered.match(lowering[0])

    @staticmethod
    def registers(text):
        count = 0
        for part in text.split(","):
            ends = [int(re.sub(r"\D", "", end) or 0) for end in part.strip().split("-")]
            count += ends[1] - ends[0] + 1 if len(ends) == 2 else 1
        return count

    @classmethod
    def lowering(cls, code, _):
        if found := cls.vector_pushes.match(code):
            return (8 if found[1].strip().startswith("d") else 4) * cls.registers(found[1])
        if found := cls.pushes.match(code):
            return 4 * cls.registers(found[1])
        found = cls.lowered.match(code) or cls.stored.match(code)
        return int(found[1]) if found else 0

    @staticmethod
    def is_indirect(code, before):
        if re.match(r"^blx\s+r|^bx\s+(?!lr)|^mov\s+pc, (?!lr)", code):
            return True
        # A jump table follows the address that it is read from.
        return bool(
            re.match(r"^ldr(?:\.w)?\s+pc, \[(?!sp|pc)", code)
            and not any(line.startswith("adr") for line in before[-3:])
        )


class AArch64:
    called = 0
    direct = re.compile(r"^(?:bl|b(?:\.[a-z]+)?|cbn?z|tbn?z)\b.*?([0-9a-f]+) <([^>]+)>$")
    lowered_by_register = re.compile(r"^sub\s+sp, sp, x|^mov\s+sp, x(?!29)|^and\s+sp, ")

    @staticmethod
    def lowering(code, before):
        # A number that is too long for one word has been put into a register.
        if found := re.match(r"^sub\s+sp, sp, (x\d+)$", code):
            put = rf"^mov\s+{found[1]}, #(0x[0-9a-f]+|\d+)$"
            numbers = [number for line in before[-4:] if (number := re.match(put, line))]
            return hexadecimal(numbers[-1][1]) if numbers else 0
        if found := re.match(r"^st[rp]\s.*\[sp, #-(\d+)\]!", code):
            return int(found[1])
        found = re.match(r"^sub\s+sp, sp, #(0x[0-9a-f]+|\d+)(?:, lsl #(\d+))?", code)
        return hexadecimal(found[1]) << int(found[2] or 0) if found else 0

    @staticmethod
    def is_indirect(code, before):
        if re.match(r"^blr\b", code):
            return True
        return bool(
            re.match(r"^br\b", code)
            and not any(re.search(r"^add .*[su]xt[bhw]( #2)?$", line) for line in before[-3:])
        )


class X86:
    called = 8  # the return address
    direct = re.compile(r"^(?:bnd |notrack )*(?:call|j[a-z]+)\s+([0-9a-f]+) <([^>]+)>$")
    lowered_by_register = re.compile(r"^sub\s+%r\w+,%rsp|^and\s+.*,%rsp")

    @staticmethod
    def lowering(code, _):
        if code.startswith("push"):
            return 8
        # By less than nothing it is raised: 128 takes one byte less so.
        if found := re.match(r"^sub\s+\$0x([0-9a-f]+),%rsp", code):
            return int(found[1], 16) if int(found[1], 16) < 1 << 63 else 0
        found = re.match(r"^add\s+\$0x(ffffffff[0-9a-f]{8}),%rsp", code)
        return (1 << 64) - int(found[1], 16) if found else 0

    @staticmethod
    def is_indirect(code, before):
        if re.match(r"^(?:bnd |notrack )*call\s+\*", code):
            return True
        return bool(
            re.match(r"^(?:bnd )?jmp\s+\*", code)
            and not re.search(r",8\)$", code)
            and not any(re.match(r"^add\s+%r", line) for line in before[-3:])
        )


MACHINES = {"ARM": Arm, "AArch64": AArch64, "Advanced Micro Devices X86-64": X86}


def output_of(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


def machine_of(tools, file):
    header = output_of(tools + "readelf", "-h", file)
    name = re.search(r"Machine:\s+(.*)", header)[1].strip()
    if name not in MACHINES:
        raise Refusal(f"{file}: nobody has said how to read {name}")
    return MACHINES[name]


HEADER = re.compile(r"^([0-9a-f]+) <(.+)>:$")
LINE = re.compile(r"^\s*[0-9a-f]+:\t(.*)$")


def functions_of(tools, file):
    """Every function of a file by its address: two may have the same name."""
    machine = machine_of(tools, file)
    functions = {}
    now = None
    before = []
    is_object = pathlib.Path(file).suffix in (".o", ".obj")
    text = output_of(tools + "objdump", "-d", "--no-show-raw-insn", file)
    for line in text.splitlines():
        if header := HEADER.match(line):
            # The same place may be in two sections of an object file.
            key = (len(functions), header[2]) if is_object else int(header[1], 16)
            now = functions[key] = Function(header[2], machine.called)
            before = []
        elif (found := LINE.match(line)) and now is not None:
            code = re.sub(r"\s*[@;] .*$|\s*// .*$|\s+# .*$", "", found[1].replace("\t", " ")).strip()
            read(machine, now, code, before)
            before.append(code)
    if not functions:
        raise Refusal(f"{file}: no functions")
    return functions


def read(machine, function, code, before):
    lowering = machine.lowering(code, before)
    if machine is Arm and 0 < function.frame <= 16 and Arm.saves(code) and Arm.spills(before):
        function.spilled = function.frame
    function.frame += lowering
    if not lowering and machine.lowered_by_register.match(code):
        function.dynamic = True
    if found := machine.direct.match(code):
        # A branch within the function is none, a call of itself is one.
        if found[2].split("+0x")[0] != function.name or re.match(r"bl |blx |call", code):
            function.calls.add((int(found[1], 16), found[2]))
    elif machine.is_indirect(code, before):
        function.indirect += 1


def usage_of(file):
    """The compiler's word: bytes and kind of every function of an object file's .su."""
    rows = [line.rsplit("\t", 2) for line in pathlib.Path(file).read_text("utf-8").splitlines()]
    return [(name, int(size), kind) for name, size, kind in rows]


def check_frames(tools, objects):
    """Of every object file: no variable frame, and all frames read as the compiler has them."""
    compared = 0
    for file in objects:
        # Empty where a source is only declarations.
        usage = usage_of(pathlib.Path(file).with_suffix(".su"))
        for name, _, kind in usage:
            # Bounded: what it pushes for those it calls.
            if kind == "dynamic":
                raise Refusal(f"{name}: {kind} stack: a variable array?")
        if not usage:
            continue
        read_there = collections.Counter(
            at.frame - at.spilled for at in functions_of(tools, file).values())
        said = collections.Counter(size for _, size, kind in usage if kind == "static")
        # What a cold part has taken is its function's; it has no line of its own.
        if missing := said - read_there:
            raise Refusal(
                f"{file}: frames of {sorted(missing)} B by the compiler were read as "
                f"{sorted(read_there - said)} B"
            )
        compared += len(usage)
    if not compared:
        raise Refusal("no function's stack to compare: compiled without -fstack-usage?")
    return compared
