# SPDX-License-Identifier: Apache-2.0
"""j1939.dbc against frames and formulas as Honeywell prints them (TARS-LCASS user manual, 32332897 issue B, 7.1 to
7.5), by a reader of DBCs that is not the generator's.  check_j1939_bytes.py ROOT"""

import pathlib
import random
import sys

ROOT = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(ROOT / "tests/closed_loop"))
import dbc_log  # noqa: E402

DRAWS = 200


def slope(data, at):
    """Angle = (uint32 - 8192000) / 32768, of Table 8."""
    return (data[at] + (data[at + 1] << 8) + (data[at + 2] << 16) - 8192000) / 32768


def rate(data, at):
    """250 deg/s off, 128 counts each; 0x7D00 is 0 in the example of 7.4."""
    return (data[at] + (data[at + 1] << 8) - 32000) / 128


def acceleration(data, at):
    """Acceleration = (uint16 - 32000) / 100, of Table 12."""
    return (data[at] + (data[at + 1] << 8) - 32000) / 100


# id, example, signals with their formula, their first byte and their width in bytes
PRINTED = (
    (0x0CF029E2, "00007D00007D0005", {"Pitch": (slope, 0, 3), "Roll": (slope, 3, 3)}),
    (0x0CF02AE2, "007D007D007D0005", {"PitchRate": (rate, 0, 2), "RollRate": (rate, 2, 2), "YawRate": (rate, 4, 2)}),
    (0x08F02DE2, "007D007DD5800005",
     {"Lateral": (acceleration, 0, 2), "Longitudinal": (acceleration, 2, 2), "Vertical": (acceleration, 4, 2)}),
)
EXAMPLE = {"Pitch": 0.0, "Roll": 0.0, "PitchRate": 0.0, "RollRate": 0.0, "YawRate": 0.0, "Lateral": 0.0,
           "Longitudinal": 0.0, "Vertical": 9.81}


def main():
    messages = dbc_log.read_dbc(ROOT / "can_dbc/j1939.dbc")
    assert set(messages) == {number for number, _, _ in PRINTED}, sorted(map(hex, messages))
    draw = random.Random(1)
    for number, text, signals in PRINTED:
        data = bytes.fromhex(text)
        values = dbc_log.decode(messages[number], data)
        for name in signals:
            assert abs(values[name] - EXAMPLE[name]) < 1e-9, f"{name}: {values[name]}"
        for _ in range(DRAWS):
            drawn = bytearray(data)
            for _, at, width in signals.values():
                # Within +-200 of each: the top byte decides.
                drawn[at:at + width] = bytes([*(draw.randrange(256) for _ in range(width - 1)), draw.randrange(25, 225)])
            values = dbc_log.decode(messages[number], bytes(drawn))
            for name, (formula, at, _) in signals.items():
                assert abs(values[name] - formula(drawn, at)) < 1e-9, f"{name} of {drawn.hex()}: {values[name]}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
