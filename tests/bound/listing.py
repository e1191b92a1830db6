# SPDX-License-Identifier: Apache-2.0
"""What a linked image says: its instructions, its functions, its constant memory, its source lines."""

import bisect
import dataclasses
import functools
import re
import struct
import subprocess


class Refusal(Exception):
    """What a bound cannot be found for, or what cannot be read."""


@dataclasses.dataclass(slots=True)
class Instruction:
    address: int
    size: int
    op: str  # as objdump writes it
    args: str
    target: int | None = None  # of a branch, or of a constant that is read beside the code


LINE = re.compile(r"^\s*([0-9a-f]+):\t((?:[0-9a-f]{2,8} )+)\s*\t(\S+)(?:\s+(.*))?$")
ADDRESS = re.compile(r"^(?:.*[ ,])?([0-9a-f]+) <[^>]*>$")
BESIDE = re.compile(r"\s(?:;|@|//)\s*(.*)$")


def output_of(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


def instructions_of(text):
    """By address; what lies between the instructions (.word and its like) is not in it."""
    found = {}
    for line in text.splitlines():
        match = LINE.match(line)
        if not match or match[3].startswith("."):
            continue
        address, size = int(match[1], 16), len(match[2].replace(" ", "")) // 2
        args, target = (match[4] or "").strip(), None
        if beside := BESIDE.search(args):
            args = args[: beside.start()].strip()
            if word := re.search(r"\b([0-9a-f]+) <[^<>]*>?[^<>]*$", beside[1]):
                target = int(word[1], 16)
        if word := ADDRESS.match(args):
            target = int(word[1], 16)
            args = args[: word.start(1)].strip().rstrip(",")
        found[address] = Instruction(address, size, match[3], args, target)
    return found


@dataclasses.dataclass
class Section:
    address: int
    data: bytes
    written: bool


class Image:
    """`tools` is what the names of binutils begin with."""

    def __init__(self, tools, file):
        self.tools, self.file = tools, str(file)
        self.read_file()
        text = output_of(tools + "objdump", "-d", "-z", "-w", self.file)
        self.instructions = instructions_of(text)
        if not self.instructions or not self.functions:
            raise Refusal(f"{file}: no functions")
        self.entries = sorted(self.functions)
        self.sorted_addresses = sorted(self.instructions)

    def read_file(self):
        with open(self.file, "rb") as stream:
            data = stream.read()
        wide = data[4] == 2
        if data[:4] != b"\x7fELF" or data[5] != 1:
            raise Refusal(f"{self.file}: no ELF file of little words")
        self.machine = struct.unpack_from("<H", data, 18)[0]
        at = struct.unpack_from("<Q" if wide else "<I", data, 40 if wide else 32)[0]
        each, count = struct.unpack_from("<HH", data, 58 if wide else 46)
        headers = [
            struct.unpack_from("<IIQQQQIIQQ" if wide else "<IIIIIIIIII", data, at + n * each)
            for n in range(count)
        ]
        self.sections = []
        self.functions = {}  # name by address
        self.ends = {}
        self.marks = []  # (address, letter): where code and data begin
        for header in headers:
            _, kind, flags, address, offset, size, link, _, _, entry = header
            if kind == 1 and flags & 2:
                self.sections.append(Section(address, data[offset : offset + size], bool(flags & 1)))
            if kind == 2:
                names = headers[link][4]
                for n in range(size // entry):
                    self.read_symbol(data, offset + n * entry, names, wide)
        self.marks.sort()

    def read_symbol(self, data, at, names, wide):
        if wide:
            name, info, _, section, value, size = struct.unpack_from("<IBBHQQ", data, at)
        else:
            name, value, size, info, _, section = struct.unpack_from("<IIIBBH", data, at)
        start = names + name
        word = data[start : data.index(b"\0", start)].decode()
        if section == 0:
            return
        if info & 15 == 2:
            # An odd address is one in Thumb.
            place = value & ~1 if self.machine == 40 else value
            if place not in self.functions or info >> 4 == 1:
                self.functions[place] = word
                self.ends[place] = max(self.ends.get(place, 0), place + size)
        elif re.match(r"\$[atdx](\.|$)", word):
            self.marks.append((value & ~1 if word[1] == "t" else value, word[1]))

    def read(self, address, size):
        """Bytes of constant memory; None where something may be written, or nothing is."""
        for section in self.sections:
            if section.address <= address and address + size <= section.address + len(section.data):
                at = address - section.address
                return None if section.written else section.data[at : at + size]
        return None

    def marked(self, address):
        """a (Arm), t (Thumb), x (64-bit) or d (data)"""
        at = bisect.bisect_right(self.marks, (address, "z")) - 1
        return self.marks[at][1] if at >= 0 else ""

    def data_after(self, address):
        """The end of the data that begin there."""
        at = bisect.bisect_left(self.marks, (address, ""))
        while at < len(self.marks) and (self.marks[at][0] <= address or self.marks[at][1] == "d"):
            at += 1
        return self.marks[at][0] if at < len(self.marks) else address

    @functools.cached_property
    def words(self):
        """The names as C++ writes them, by address."""
        names = [self.functions[at] for at in self.entries]
        done = subprocess.run([self.tools + "c++filt"], input="\n".join(names) + "\n",
                              stdout=subprocess.PIPE, text=True, check=True)
        return dict(zip(self.entries, done.stdout.splitlines()))

    def word(self, address):
        if address in self.words:
            return self.words[address]
        at = bisect.bisect_right(self.entries, address) - 1
        return f"{self.words[self.entries[at]]}+{address - self.entries[at]:#x}" if at >= 0 else hex(address)

    def lines_of(self, addresses):
        """[(function, file, line) of the innermost first] by address; needs an image with -g."""
        addresses = list(addresses)
        if not addresses:
            return {}
        done = subprocess.run(
            [self.tools + "addr2line", "-a", "-i", "-f", "-C", "-e", self.file],
            input="".join(f"{at:#x}\n" for at in addresses), stdout=subprocess.PIPE, text=True, check=True)
        found, now, name = {}, None, None
        for line in done.stdout.splitlines():
            if re.fullmatch(r"0x[0-9a-f]+", line):
                now, name = found.setdefault(int(line, 16), []), None
            elif name is None:
                name = line
            else:
                place = re.sub(r" \(discriminator \d+\)$", "", line)
                file, _, number = place.rpartition(":")
                now.append((name, file, int(number) if number.isdigit() else 0))
                name = None
        return found
