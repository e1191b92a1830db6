# SPDX-License-Identifier: Apache-2.0
"""What a DBC says. Numbers are exact (Fraction); every item knows its line, for messages."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction


class Refusal(Exception):
    """The DBC is not understood, or breaks a rule. Carries the line to point at."""

    def __init__(self, line: int, message: str):
        super().__init__(message)
        self.line = line
        self.message = message


@dataclass
class Attribute:
    """An attribute definition (BA_DEF_) with its default (BA_DEF_DEF_)."""

    name: str
    scope: str  # "" (database), "BU_", "BO_", "SG_"
    kind: str  # INT, HEX, FLOAT, STRING, ENUM
    line: int
    low: Fraction | None = None
    high: Fraction | None = None
    choices: tuple[str, ...] = ()
    default: object = None


@dataclass
class Item:
    """Whatever carries a comment and attribute values (BA_)."""

    name: str
    line: int
    comment: str = ""
    values: dict[str, tuple[object, int]] = field(default_factory=dict)  # name -> (value, line)


@dataclass
class Signal(Item):
    start_bit: int = 0
    width: int = 0
    factor: Fraction = Fraction(1)
    offset: Fraction = Fraction(0)
    minimum: Fraction = Fraction(0)
    maximum: Fraction = Fraction(0)
    unit: str = ""
    receivers: tuple[tuple[str, int], ...] = ()
    choices: dict[int, tuple[str, int]] = field(default_factory=dict)  # raw -> (text, line)


@dataclass
class Message(Item):
    raw_id: int = 0  # as in the file, with bit 31
    length: int = 0
    sender: str = ""
    signals: list[Signal] = field(default_factory=list)

    @property
    def can_id(self) -> int:
        return self.raw_id & 0x1FFFFFFF


@dataclass
class Database(Item):
    nodes: dict[str, Item] = field(default_factory=dict)
    messages: list[Message] = field(default_factory=list)
    attributes: dict[str, Attribute] = field(default_factory=dict)

    def value(self, item: Item, attribute: str):
        """The item's value of the attribute, or the attribute's default."""
        if attribute in item.values:
            return item.values[attribute][0]
        return self.attributes[attribute].default
