# SPDX-License-Identifier: Apache-2.0
"""The rules that a database keeps before code is made of it. One function for each subject."""

from __future__ import annotations

import re

from . import derive
from .model import Database, Message, Refusal, Signal

# Attributes that the generator reads: the kind of item that carries them, and their type.
_NEEDED = {
    "ProtocolType": ("", "STRING"),
    "DbcVersion": ("", "INT"),
    "NmStationAddress": ("BU_", "INT"),
    "VFrameFormat": ("BO_", "ENUM"),
    "GenMsgCycleTime": ("BO_", "INT"),
    "E2EDataId": ("BO_", "INT"),
    "E2EMaxDeltaCounter": ("BO_", "INT"),
    "SigType": ("SG_", "ENUM"),
    "GenSigStartValue": ("SG_", "INT"),
    "SigErrorRaw": ("SG_", "INT"),
    "SigNotAvailableRaw": ("SG_", "INT"),
}
_SIG_TYPES = ("Default", "MessageCounter", "MessageChecksum")
_NAME = re.compile(r"[A-Z][A-Za-z0-9]*")
_KEYWORDS = frozenset(
    "auto bool break case catch char class const continue default delete do double else enum "
    "explicit export extern false float for friend goto if inline int long mutable namespace new "
    "operator private protected public register return short signed sizeof static struct switch "
    "template this throw true try typedef typename union unsigned using virtual void volatile "
    "while decode encode visit".split()
)
# Names that the generated code uses itself.
_TAKEN = frozenset(
    "Name Sender Id Length CycleTimeMs Protected DataId MaxDeltaCounter AllMessages Dbc "
    "Payload Physical Coded Count Field MessageInfo MessageList RawState".split()
)


def check(database: Database) -> None:
    """Raises Refusal for the first rule that is broken."""
    _check_attributes(database)
    if not database.messages:
        raise Refusal(1, "no message")
    for message in database.messages:
        _check_message(database, message)
        for signal in message.signals:
            _check_signal(database, message, signal)
        _check_layout(message)
        _check_protection(database, message)
    _check_data_ids(database)


def _check_attributes(database: Database) -> None:
    for name, (scope, kind) in _NEEDED.items():
        if name not in database.attributes:
            raise Refusal(1, f"attribute {name} is not defined")
        attribute = database.attributes[name]
        if attribute.scope != scope:
            raise Refusal(attribute.line, f"attribute {name} belongs to another kind of item")
        if attribute.kind != kind:
            raise Refusal(attribute.line, f"attribute {name} is not of type {kind}")
        if attribute.default is None:
            raise Refusal(attribute.line, f"attribute {name} has no default")
    if database.value(database, "ProtocolType") != "J1939":
        raise Refusal(_line(database, "ProtocolType"), "ProtocolType is not J1939")
    if "DbcVersion" not in database.values:
        raise Refusal(1, "the database has no DbcVersion")


def _line(item, attribute: str) -> int:
    return item.values[attribute][1] if attribute in item.values else item.line


def _check_name(line: int, name: str) -> None:
    if not _NAME.fullmatch(name) or derive.snake_case(name) in _KEYWORDS or name in _TAKEN:
        raise Refusal(line, f"{name!r} cannot be a name in C++; names are CamelCase")


def _check_message(database: Database, message: Message) -> None:
    name, line = message.name, message.line
    _check_name(line, name)
    if not message.raw_id & 0x80000000:
        raise Refusal(line, f"{name}: 11-bit ids are not supported")
    if message.raw_id & ~0x9FFFFFFF:
        raise Refusal(line, f"{name}: the id has more than 29 bits")
    if message.length != 8:
        raise Refusal(line, f"{name}: length {message.length}; every message has 8 bytes")
    if message.sender not in database.nodes:
        raise Refusal(line, f"{name}: sender {message.sender} is not in BU_")
    address = database.value(database.nodes[message.sender], "NmStationAddress")
    if message.can_id & 0xFF != address:
        raise Refusal(line, f"{name}: the id's source address is not {message.sender}'s {address}")
    if not message.signals:
        raise Refusal(line, f"{name}: no signal")
    if not message.comment:
        raise Refusal(line, f"{name}: no comment")
    if database.value(message, "VFrameFormat") != "J1939PG":
        raise Refusal(_line(message, "VFrameFormat"), f"{name}: VFrameFormat is not J1939PG")
    if not 1 <= database.value(message, "GenMsgCycleTime") <= 65535:
        raise Refusal(
            _line(message, "GenMsgCycleTime"), f"{name}: no GenMsgCycleTime of 1 to 65535 ms"
        )
    if not 0 <= database.value(message, "E2EDataId") <= 0xFFFF:
        raise Refusal(_line(message, "E2EDataId"), f"{name}: E2EDataId has more than 16 bits")
    members = [derive.snake_case(signal.name) for signal in message.signals]
    for signal, member in zip(message.signals, members):
        if members.count(member) > 1:
            raise Refusal(signal.line, f"{signal.name}: two signals become {member} in C++")


def _check_signal(database: Database, message: Message, signal: Signal) -> None:
    name, line = signal.name, signal.line
    _check_name(line, name)
    for receiver, receiver_line in signal.receivers:
        if receiver not in database.nodes:
            raise Refusal(receiver_line, f"{name}: receiver {receiver} is not in BU_")
    if signal.unit not in derive.UNITS:
        raise Refusal(line, f"{name}: unknown unit {signal.unit!r}")
    if not signal.comment:
        raise Refusal(line, f"{name}: no comment")
    if not 1 <= signal.width <= 32:
        raise Refusal(line, f"{name}: {signal.width} bits; 1 to 32 are supported")
    if signal.start_bit < 0 or signal.start_bit + signal.width > 8 * message.length:
        raise Refusal(line, f"{name}: lies beyond the {message.length} bytes of the message")
    if signal.factor <= 0:
        raise Refusal(line, f"{name}: factor {signal.factor} is not positive")
    if (signal.offset / signal.factor).denominator != 1:
        raise Refusal(line, f"{name}: the offset is not a multiple of the factor")
    if not -(2**31) <= signal.offset / signal.factor < 2**31:
        raise Refusal(line, f"{name}: the offset is more than 32 bits of raw counts")
    if database.value(signal, "SigType") not in _SIG_TYPES:
        raise Refusal(_line(signal, "SigType"), f"{name}: SigType is not supported")
    _check_range(database, signal)
    _check_states(database, message, signal)


def _check_range(database: Database, signal: Signal) -> None:
    name = signal.name
    error, not_available = derive.special_raws(database, signal)
    largest = 2**signal.width - 1
    for attribute, special in (("SigErrorRaw", error), ("SigNotAvailableRaw", not_available)):
        if special < 0:
            continue
        valid = derive.largest_valid_raw(signal.width)
        if valid is None:
            raise Refusal(
                _line(signal, attribute), f"{name}: {signal.width} bits have no special values"
            )
        if not valid < special <= largest:
            raise Refusal(
                _line(signal, attribute),
                f"{name}: {attribute} {special} is not between {valid} and {largest}",
            )
    if not_available >= 0 and derive.says(error, signal.width, not_available):
        raise Refusal(
            _line(signal, "SigErrorRaw"), f"{name}: 'error' and 'not available' are the same"
        )
    if error >= 0 or not_available >= 0:
        largest = derive.largest_valid_raw(signal.width)
    low, high = derive.raw_range(signal)
    if low.denominator != 1 or high.denominator != 1:
        raise Refusal(signal.line, f"{name}: [min|max] falls between raw values")
    if not 0 <= low <= high <= largest:
        raise Refusal(
            signal.line, f"{name}: [min|max] is raw {low} to {high}; valid are 0 to {largest}"
        )
    start = database.value(signal, "GenSigStartValue")
    if not low <= start <= high and start not in (error, not_available):
        raise Refusal(
            _line(signal, "GenSigStartValue"), f"{name}: start value {start} is outside [min|max]"
        )


def _check_states(database: Database, message: Message, signal: Signal) -> None:
    named = derive.states(database, signal)
    if not named:
        return
    line = next(iter(signal.choices.values()))[1]
    low, high = derive.raw_range(signal)
    # Without gaps a range check tells known from unknown states.
    if sorted(named) != list(range(int(low), int(high) + 1)):
        raise Refusal(line, f"{signal.name}: the value table must name all of [min|max], no more")
    if signal.factor != 1 or signal.offset != 0 or signal.unit:
        raise Refusal(line, f"{signal.name}: a state has no scale and no unit")
    if signal.width > 8:
        raise Refusal(line, f"{signal.name}: a state has at most 8 bits")
    if signal.name == message.name:
        raise Refusal(line, f"{signal.name}: a state cannot have its message's name")
    for text in named.values():
        _check_name(line, text)
    if len(set(named.values())) != len(named):
        raise Refusal(line, f"{signal.name}: two states have the same name")


def _check_layout(message: Message) -> None:
    owner: dict[int, Signal] = {}
    for signal in message.signals:
        for bit in range(signal.start_bit, signal.start_bit + signal.width):
            if bit in owner:
                raise Refusal(
                    signal.line, f"{signal.name}: overlaps {owner[bit].name} in bit {bit}"
                )
            owner[bit] = signal


def _check_protection(database: Database, message: Message) -> None:
    protected = derive.is_protected(database, message)
    for sig_type, start_bit, width, top in (
        ("MessageChecksum", 0, 8, 255),
        ("MessageCounter", 8, 4, 14),
    ):
        found = [s for s in message.signals if database.value(s, "SigType") == sig_type]
        if not protected and found:
            raise Refusal(
                found[0].line, f"{found[0].name}: {sig_type} in a message without E2EDataId"
            )
        if not protected:
            continue
        if len(found) != 1:
            raise Refusal(
                message.line, f"{message.name}: needs one {sig_type}, has {len(found)}"
            )
        signal = found[0]
        if (signal.start_bit, signal.width) != (start_bit, width):
            raise Refusal(
                signal.line, f"{signal.name}: a {sig_type} lies at {start_bit}|{width}"
            )
        if derive.raw_range(signal) != (0, top) or signal.unit or signal.choices:
            raise Refusal(signal.line, f"{signal.name}: a {sig_type} is a plain [0|{top}]")
    delta = database.value(message, "E2EMaxDeltaCounter")
    if protected != (1 <= delta <= 14):
        raise Refusal(
            _line(message, "E2EMaxDeltaCounter"),
            f"{message.name}: E2EMaxDeltaCounter {delta} (1 to 14 if protected, else 0)",
        )


def _crc8(data: bytes) -> int:
    crc = 0
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x1D) & 0xFF if crc & 0x80 else crc << 1
    return crc


def _check_data_ids(database: Database) -> None:
    """Two ids that leave the CRC in the same state could not tell a masquerading message."""
    seen: dict[int, Message] = {}
    for message in database.messages:
        if not derive.is_protected(database, message):
            continue
        remainder = _crc8(database.value(message, "E2EDataId").to_bytes(2, "little"))
        if remainder in seen:
            raise Refusal(
                _line(message, "E2EDataId"),
                f"{message.name}: its E2EDataId looks like {seen[remainder].name}'s to the CRC",
            )
        seen[remainder] = message
