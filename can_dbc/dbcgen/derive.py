# SPDX-License-Identifier: Apache-2.0
"""What follows from a signal's definition: raw range, SI scale, C++ names."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction

from .model import Database, Message, Signal


@dataclass(frozen=True)
class Unit:
    suffix: str  # of the C++ member
    si: str  # unit of the decoded value
    factor: Fraction  # DBC unit in SI units
    times_pi: bool = False


# The only place where units are converted.
UNITS = {
    "": Unit("", "", Fraction(1)),
    "m": Unit("_m", "m", Fraction(1)),
    "mm": Unit("_m", "m", Fraction(1, 1000)),
    "mm/s": Unit("_mps", "m/s", Fraction(1, 1000)),
    "mrad": Unit("_rad", "rad", Fraction(1, 1000)),
    "rad": Unit("_rad", "rad", Fraction(1)),
    "rad/s": Unit("_radps", "rad/s", Fraction(1)),
    "degC": Unit("_degc", "degC", Fraction(1)),
    "mrad/s": Unit("_radps", "rad/s", Fraction(1, 1000)),
    "deg": Unit("_rad", "rad", Fraction(1, 180), times_pi=True),
    "deg/s": Unit("_radps", "rad/s", Fraction(1, 180), times_pi=True),
    "m/s2": Unit("_mps2", "m/s^2", Fraction(1)),
    "ms": Unit("_s", "s", Fraction(1, 1000)),
    "min": Unit("_s", "s", Fraction(60)),
    "kN": Unit("_n", "N", Fraction(1000)),
    "kg": Unit("_kg", "kg", Fraction(1)),
    "MPa": Unit("_pa", "Pa", Fraction(1_000_000)),
    "L/min": Unit("_m3ps", "m^3/s", Fraction(1, 60_000)),
    "rpm": Unit("_radps", "rad/s", Fraction(1, 30), times_pi=True),
    "%": Unit("_ratio", "", Fraction(1, 100)),
    "per mille": Unit("_ratio", "", Fraction(1, 1000)),
    "us": Unit("_us", "us", Fraction(1)),  # times stay integer microseconds in the core
}

PHYSICAL, CODED, COUNT = "Physical", "Coded", "Count"


def snake_case(name: str) -> str:
    words = re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", name)
    return re.sub(r"([A-Z])([A-Z][a-z])", r"\1_\2", words).lower()


def member(signal: Signal) -> str:
    return snake_case(signal.name) + UNITS[signal.unit].suffix


def largest_valid_raw(width: int) -> int | None:
    """Upper end of the valid range of a parameter with special values, J1939's; None: no such width."""
    return {2: 0x1, 3: 0x5, 4: 0xD, 5: 0x1D, 8: 0xFA, 16: 0xFAFF, 24: 0xFAFFFF, 32: 0xFAFFFFFF}.get(width)


def special_raws(database: Database, signal: Signal) -> tuple[int, int]:
    """Raw values of 'error' and 'not available', -1 for none."""
    return (
        database.value(signal, "SigErrorRaw"),
        database.value(signal, "SigNotAvailableRaw"),
    )


def says(special: int, width: int, raw: int) -> bool:
    """Of two bytes or more, the top byte alone makes the special value."""
    ignored = 0 if width < 16 else width - 8
    return special >= 0 and special >> ignored == raw >> ignored


def raw_range(signal: Signal) -> tuple[Fraction, Fraction]:
    return (
        (signal.minimum - signal.offset) / signal.factor,
        (signal.maximum - signal.offset) / signal.factor,
    )


def states(database: Database, signal: Signal) -> dict[int, str]:
    """Named raw values without the special ones."""
    specials = special_raws(database, signal)
    return {raw: text for raw, (text, _) in signal.choices.items() if raw not in specials}


def kind(database: Database, signal: Signal) -> str:
    if states(database, signal):
        return CODED
    unit = UNITS[signal.unit]
    plain = unit.factor == 1 and unit.si in ("", "us")
    return COUNT if plain and signal.factor == 1 and signal.offset == 0 else PHYSICAL


def scale(signal: Signal) -> tuple[int, float, float]:
    """(raw_offset, numerator, denominator): SI = (raw + raw_offset) * numerator / denominator."""
    unit = UNITS[signal.unit]
    factor = signal.factor * unit.factor
    numerator = float(factor.numerator) * (math.pi if unit.times_pi else 1.0)
    return int(signal.offset / signal.factor), numerator, float(factor.denominator)


def is_protected(database: Database, message: Message) -> bool:
    return database.value(message, "E2EDataId") != 0


def carries_value(database: Database, signal: Signal) -> bool:
    """False for CRC and counter, which belong to the end-to-end protection."""
    return database.value(signal, "SigType") not in ("MessageChecksum", "MessageCounter")
