"""The log of a dig by the DBC alone: check_log.py GRABEN DBC PROFILE.

Reads the DBC and the kinematics with its own code, not the project's: every frame of the log must be
defined, in range, protected as the DBC says, and the tip that the decoded strokes give must show the
error that the summary names."""

import cmath
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter

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
    none of J1939's."""
    value = int.from_bytes(data, "little")
    found = {}
    for name, start, length, factor, offset, least, most in message["signals"]:
        raw = value >> start & (1 << length) - 1
        physical = raw * factor + offset
        special = ((length == 16 and raw > 0xFAFF) or (length == 8 and raw > 0xFA and factor != 1)
                   or (length == 2 and raw > 1))
        assert special or least - 1e-9 <= physical <= most + 1e-9, \
            f"{message['name']}.{name} {physical} outside [{least}, {most}]"
        found[name] = None if special else physical
    return found


def rotated(x, angle):
    return x * cmath.exp(1j * angle)


def triangle(a, b, length):
    return math.acos((abs(a) ** 2 + abs(b) ** 2 - length ** 2) / (2 * abs(a) * abs(b)))


def circles_meet(a, radius_a, b, radius_b):
    """The point on the left of a -> b."""
    gap = abs(b - a)
    along = (radius_a ** 2 - radius_b ** 2 + gap ** 2) / (2 * gap)
    return a + (along + 1j * math.sqrt(radius_a ** 2 - along ** 2)) * (b - a) / gap


def tip(profile, strokes):
    pin = lambda pair: complex(*pair)
    boom, arm, bucket = (profile[axis] for axis in ("boom", "arm", "bucket"))
    lengths = [axis["cylinder"]["closed_length"] + stroke
               for axis, stroke in zip((boom, arm, bucket), strokes)]
    base, eye = pin(boom["cylinder"]["base"]), pin(boom["cylinder"]["eye"])
    boom_angle = triangle(base, eye, lengths[0]) - cmath.phase(eye) + cmath.phase(base)
    base, eye = pin(arm["cylinder"]["base"]) - boom["length"], pin(arm["cylinder"]["eye"])
    arm_angle = -triangle(base, eye, lengths[1]) - cmath.phase(eye) + cmath.phase(base)
    link = bucket["linkage"]
    pivot, lug, foot = pin(link["rocker_pivot"]), pin(link["lug"]), complex(arm["length"])
    end = circles_meet(pin(bucket["cylinder"]["base"]), lengths[2], pivot, link["rocker"])
    lug_at = circles_meet(end, link["coupler"], foot, abs(lug))
    bucket_angle = cmath.phase(lug_at - foot) - cmath.phase(lug)
    return (rotated(boom["length"], boom_angle) + rotated(arm["length"], boom_angle + arm_angle)
            + rotated(bucket["length"], boom_angle + arm_angle + bucket_angle))


def distance_to_path(path, point):
    """From the rounded rectangle: the inner rectangle's offset, by its signed distance."""
    radius = path["corner_radius"]
    half = complex(path["x"][1] - path["x"][0], path["y"][1] - path["y"][0]) / 2
    centre = complex(sum(path["x"]), sum(path["y"])) / 2
    x = abs((point - centre).real) - half.real + radius
    y = abs((point - centre).imag) - half.imag + radius
    outside = abs(complex(max(x, 0.0), max(y, 0.0)))
    return abs(outside + min(max(x, y), 0.0) - radius)


def read_log(path, messages):
    counters, counts, strokes = {}, Counter(), {}
    moments = []
    with open(path, encoding="ascii") as stream:
        for line in stream:
            match = FRAME.match(line)
            assert match, f"not a candump line: {line!r}"
            time, number, data = float(match[1]), int(match[2], 16), bytes.fromhex(match[3])
            assert number in messages, f"{number:08X} is not in the DBC"
            message = messages[number]
            assert len(data) == message["length"], f"{message['name']}: {len(data)} bytes"
            counts[message["name"]] += 1
            if message["data_id"]:
                counter = data[1] & 0x0F
                low, high = message["data_id"] & 0xFF, message["data_id"] >> 8
                assert crc8(bytes([low, high]) + data[1:]) == data[0], f"{line!r}: CRC"
                assert counter == counters.get(number, counter), f"{line!r}: counter"
                counters[number] = (counter + 1) % 15
            values = decode(message, data)
            for axis in ("Boom", "Arm", "Bucket"):
                if message["name"] == f"{axis}Stroke":
                    strokes[axis] = values[f"{axis}Stroke"] * 1e-3
            if message["name"] == "BucketStroke":
                moments.append((time, strokes["Boom"], strokes["Arm"], strokes["Bucket"]))
    return counts, moments


def main():
    graben, dbc, profile_path = sys.argv[1:]
    with open(profile_path, "rb") as stream:
        profile = tomllib.load(stream)
    messages = read_dbc(dbc)
    with tempfile.TemporaryDirectory() as folder:
        summary_path = os.path.join(folder, "summary.json")
        subprocess.run([graben, "dig", "--out", folder, "--summary", summary_path], check=True,
                       capture_output=True, timeout=120)
        with open(summary_path, encoding="utf-8") as stream:
            summary = json.load(stream)
        counts, moments = read_log(os.path.join(folder, "dig.log"), messages)
    assert set(counts) == {m["name"] for m in messages.values()}, f"messages in the log: {counts}"
    for message in messages.values():
        wanted = moments[-1][0] / message["cycle_s"]
        # A trouble code is also said at once: at the start everything is missing.
        more = 20 if message["name"] == "DM1" else 2
        assert -2 <= counts[message["name"]] - wanted <= more, f"{message['name']}: {counts}"
    begin = summary["approach_s"]
    errors = [distance_to_path(profile["experiment"]["path"], tip(profile, strokes))
              for time, *strokes in moments
              if begin - 1e-6 <= time <= begin + summary["loop_s"] + 1e-6]
    rmse = math.sqrt(sum(e * e for e in errors) / len(errors))
    print(f"{sum(counts.values())} frames, max error {max(errors) * 1e3:.2f} mm, RMSE {rmse * 1e3:.2f} mm")
    assert abs(max(errors) - summary["max_error_measured_m"]) < 1e-6
    assert abs(rmse - summary["rmse_error_measured_m"]) < 1e-6


if __name__ == "__main__":
    main()
