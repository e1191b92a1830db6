#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares two candump logs signal by signal, each decoded by its own tree's DBC.

Every signal of every frame must be the same to the bit at every time stamp. A signal whose place in the
frame, width or scale differs between the two DBCs is compared by its exact physical value instead. What
may differ is named: --except Message.Signal or --except Message. A name that excepts nothing is an
error, so that the list stays as short as it has to be. Exit status 1 on any difference.
"""

import argparse
import pathlib
import re
import sys
from collections import Counter
from fractions import Fraction

from dbc_log import FRAME, MESSAGE

SIGNAL = re.compile(r"^ SG_ (\w+) : (\d+)\|(\d+)@1\+ \(([^,]+),([^)]+)\) \[")
# Bits that no signal has, as a signal of that name.
UNUSED = "(unused bits)"
SHOWN = 10


def layouts(path):
    """Id without the frame-format bit -> message's name, length in bytes, and each signal's place and
    scale. Signed, big-endian or multiplexed signals are refused: they would be passed over."""
    found, current = {}, None
    for number, line in enumerate(pathlib.Path(path).read_text(encoding="utf-8").splitlines(), 1):
        if match := MESSAGE.match(line):
            current = found[int(match[1]) & 0x1FFFFFFF] = (match[2], int(match[3]), {})
        elif match := SIGNAL.match(line):
            current[2][match[1]] = (int(match[2]), int(match[3]), Fraction(match[4]), Fraction(match[5]))
        elif line.lstrip().startswith("SG_ "):
            sys.exit(f"{path}:{number}: cannot decode this signal: {line.strip()}")
    if not found:
        sys.exit(f"{path}: no message")
    return found


def read(log, messages):
    """(time stamp, message's name) -> the raw signals of each such frame, in the log's order."""
    found, order = {}, []
    for number, line in enumerate(pathlib.Path(log).read_text(encoding="ascii").splitlines(), 1):
        match = FRAME.match(line)
        if not match:
            sys.exit(f"{log}:{number}: not a candump line: {line!r}")
        if int(match[2], 16) not in messages:
            sys.exit(f"{log}:{number}: {match[2]} is not in the DBC")
        name, length, signals = messages[int(match[2], 16)]
        data = bytes.fromhex(match[3])
        if len(data) != length:
            sys.exit(f"{log}:{number}: {name} has {len(data)} bytes, its DBC says {length}")
        value, unused = int.from_bytes(data, "little"), (1 << 8 * length) - 1
        raws = {}
        for signal, (start, width, _, _) in signals.items():
            raws[signal] = value >> start & (1 << width) - 1
            unused &= ~((1 << width) - 1 << start)
        raws[UNUSED] = value & unused
        if order and float(match[1]) < float(order[-1][0]):
            sys.exit(f"{log}:{number}: time runs backwards")
        found.setdefault((match[1], name), []).append(raws)
        order.append((match[1], name))
    if not order:
        sys.exit(f"{log}: no frame")
    return found, order


class Comparison:
    def __init__(self, old, new, excepted):
        self.old = {name: signals for name, _, signals in old.values()}
        self.new = {name: signals for name, _, signals in new.values()}
        self.excepted, self.met = excepted, set()
        self.differences, self.first = Counter(), []
        self.values, self.signals, self.passed_over = 0, set(), Counter()

    def is_excepted(self, message, signal=None):
        for name in (message, f"{message}.{signal}"):
            if name in self.excepted:
                self.met.add(name)
                return True
        return False

    def say(self, subject, where, text):
        self.differences[subject] += 1
        if self.differences[subject] == 1 and len(self.first) < SHOWN:
            self.first.append(f"{where} {text}")

    def definitions(self):
        """What only one DBC defines can't be compared, so it has to be excepted by name."""
        for message in sorted(self.old.keys() ^ self.new.keys()):
            if not self.is_excepted(message):
                side = "old" if message in self.old else "new"
                self.say(message, "DBC:", f"{message} is only in the {side} one")
        for message in sorted(self.old.keys() & self.new.keys()):
            for signal in sorted(self.old[message].keys() ^ self.new[message].keys()):
                if not self.is_excepted(message, signal):
                    side = "old" if signal in self.old[message] else "new"
                    self.say(f"{message}.{signal}", "DBC:",
                             f"{message}.{signal} is only in the {side} one")

    def frames(self, old, new):
        for key in sorted(old.keys() | new.keys(), key=lambda key: (float(key[0]), key[1])):
            stamp, message = key
            before, after = old.get(key, []), new.get(key, [])
            if len(before) != len(after):
                if not self.is_excepted(message):
                    self.say(f"{message} (frames)", f"{stamp} s:",
                             f"{message}: {len(before)} frames in the old log, {len(after)} in the new")
                else:
                    self.passed_over[f"{message} (frames)"] += 1
                continue
            for pair in zip(before, after):
                self.one(stamp, message, *pair)

    def one(self, stamp, message, before, after):
        layout_before, layout_after = self.old.get(message, {}), self.new.get(message, {})
        for signal in sorted(before.keys() & after.keys()):
            if signal == UNUSED:
                if before.keys() != after.keys() or layout_before != layout_after:
                    continue  # other bits are unused now
                text = f"{before[signal]:#x} -> {after[signal]:#x}"
                same = before[signal] == after[signal]
            elif layout_before[signal][1:] == layout_after[signal][1:]:
                text = f"raw {before[signal]} -> {after[signal]}"
                same = before[signal] == after[signal]
            else:
                pair = [raw * layout[2] + layout[3] for raw, layout in
                        ((before[signal], layout_before[signal]), (after[signal], layout_after[signal]))]
                text = f"{float(pair[0])!r} -> {float(pair[1])!r}, and another layout"
                same = pair[0] == pair[1]
            if not same and self.is_excepted(message, signal):
                self.passed_over[f"{message}.{signal}"] += 1
                continue
            if signal != UNUSED:
                self.values += 1
                self.signals.add((message, signal))
            if not same:
                self.say(f"{message}.{signal}", f"{stamp} s:", f"{message}.{signal}: {text}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", help="candump log of the tree before")
    parser.add_argument("new", help="candump log of this tree")
    parser.add_argument("--old-dbc", required=True)
    parser.add_argument("--new-dbc", required=True)
    parser.add_argument("--except", nargs="+", default=[], metavar="MESSAGE[.SIGNAL]", dest="excepted")
    arguments = parser.parse_args()
    dbc_old, dbc_new = layouts(arguments.old_dbc), layouts(arguments.new_dbc)
    old, order_old = read(arguments.old, dbc_old)
    new, order_new = read(arguments.new, dbc_new)
    comparison = Comparison(dbc_old, dbc_new, set(arguments.excepted))
    comparison.definitions()
    comparison.frames(old, new)
    for name in sorted(comparison.excepted - comparison.met):
        comparison.say(name, "--except", f"{name}: nothing differs there, or there is no such signal")
    print(f"frames: {len(order_old)} old, {len(order_new)} new; compared: "
          f"{len({message for message, _ in comparison.signals})} messages, "
          f"{len(comparison.signals)} signals, {comparison.values} values")
    for name, count in sorted(comparison.passed_over.items()):
        print(f"excepted: {name} differs in {count} frames")
    if order_old != order_new and Counter(order_old) == Counter(order_new):
        print("note: frames of the same time stamp stand in another order")
    for line in comparison.first:
        print(line)
    for subject, count in sorted(comparison.differences.items()):
        print(f"DIFFERS: {subject} {count} times")
    if comparison.values == 0:
        sys.exit("nothing was compared")
    if comparison.differences:
        sys.exit(1)
    print("the same to the bit")


if __name__ == "__main__":
    main()
