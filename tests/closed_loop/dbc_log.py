# SPDX-License-Identifier: Apache-2.0
"""A log by its DBC alone, read with code that is not the project's."""

import re

FRAME = re.compile(r"\((\d+\.\d{6})\) vcan0 ([0-9A-F]{8})#((?:[0-9A-F]{2})*)$")
MESSAGE = re.compile(r"^BO_ (\d+) (\w+)\s*: (\d+) \w+")
SIGNAL = re.compile(r'^ SG_ (\w+) : (\d+)\|(\d+)@1\+ \(([^,]+),([^)]+)\) \[([^|]+)\|([^\]]+)\] "([^"]*)"')
DATA_ID = re.compile(r'^BA_ "E2EDataId" BO_ (\d+) (\d+);')
CYCLE = re.compile(r'^BA_ "GenMsgCycleTime" BO_ (\d+) (\d+);')


def read_dbc(path):
    messages, current = {}, None
    with open(path, encoding="utf-8") as stream:
        for line in stream:
            if match := MESSAGE.match(line):
                current = {"name": match[2], "length": int(match[3]), "signals": [], "data_id": 0}
                messages[int(match[1])] = current
            elif match := SIGNAL.match(line):
                current["signals"].append((match[1], int(match[2]), int(match[3]),
                                           *(float(match[k]) for k in range(4, 8))))
            elif match := DATA_ID.match(line):
                messages[int(match[1])]["data_id"] = int(match[2])
            elif match := CYCLE.match(line):
                messages[int(match[1])]["cycle_s"] = int(match[2]) * 1e-3
    return {number & 0x1FFFFFFF: message for number, message in messages.items()
            if number & 0x80000000}


def crc8(data):
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x1D if crc & 0x80 else crc << 1) & 0xFF
    return crc


def decode(message, data):
    """Physical values; a 16-bit raw from 0xFB00, an 8-bit one from 0xFB and a 2-bit one from 2 are
    none of J1939's. An 8-bit count whose raw values end at 255 has no such ones."""
    value = int.from_bytes(data, "little")
    found = {}
    for name, start, length, factor, offset, least, most in message["signals"]:
        raw = value >> start & (1 << length) - 1
        physical = raw * factor + offset
        special = ((length == 16 and raw > 0xFAFF) or (length == 8 and raw > 0xFA and (most - offset) / factor <= 250)
                   or (length == 2 and raw > 1))
        assert special or least - 1e-9 <= physical <= most + 1e-9, \
            f"{message['name']}.{name} {physical} outside [{least}, {most}]"
        found[name] = None if special else physical
    return found


def frames(path, messages):
    """Time, message's name and values of each frame; every one is defined, in range and protected as
    the DBC says."""
    counters = {}
    with open(path, encoding="ascii") as stream:
        for line in stream:
            match = FRAME.match(line)
            assert match, f"not a candump line: {line!r}"
            number, data = int(match[2], 16), bytes.fromhex(match[3])
            assert number in messages, f"{number:08X} is not in the DBC"
            message = messages[number]
            assert len(data) == message["length"], f"{message['name']}: {len(data)} bytes"
            if message["data_id"]:
                counter = data[1] & 0x0F
                low, high = message["data_id"] & 0xFF, message["data_id"] >> 8
                assert crc8(bytes([low, high]) + data[1:]) == data[0], f"{line!r}: CRC"
                assert counter == counters.get(number, counter), f"{line!r}: counter"
                counters[number] = (counter + 1) % 15
            yield float(match[1]), message["name"], decode(message, data)


def check_counts(counts, messages, end_s):
    """Every message of the DBC is there, as often as its cycle time says."""
    assert set(counts) == {m["name"] for m in messages.values()}, f"messages in the log: {counts}"
    for message in messages.values():
        wanted = end_s / message["cycle_s"]
        if message["name"] == "MachineIdentity":
            # Sent in answer too.
            wanted += counts["EcuIdentity"]
        # A trouble code is also said at once: at the start everything is missing.
        more = 20 if message["name"] == "DM1" else 2
        assert -2 <= counts[message["name"]] - wanted <= more, f"{message['name']}: {counts}"
