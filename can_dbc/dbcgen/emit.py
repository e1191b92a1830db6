# SPDX-License-Identifier: Apache-2.0
"""The C++ header of a checked database."""

from __future__ import annotations

import textwrap
from fractions import Fraction

from . import derive
from .model import Database, Message, Signal

_HEAD = """\
// SPDX-License-Identifier: Apache-2.0
// Generated from {source} by can_dbc/generate.py; change the DBC and generate again.
// clang-format off
#pragma once
/// {comment}
/// Values are in the SI unit that their name ends with. A message that nobody has filled in carries
/// the start values. encode() rounds to the nearest raw value and saturates into [min|max]; NaN and
/// infinities become the signal's error value, or its start value where it has none; bits of no
/// signal are 1. CRC and counter are left to the end-to-end protection.

#include <array>
#include <cstdint>

{includes}

namespace graben::dbc::{namespace} {{

inline constexpr std::uint8_t kDbcVersion = {version};
"""

_MESSAGE = """\
struct {name} {{
  static constexpr const char* kName = "{name}";
  static constexpr const char* kSender = "{sender}";
  static constexpr std::uint32_t kId = 0x{id:08X};
  static constexpr std::uint8_t kLength = {length};
  static constexpr std::uint16_t kCycleTimeMs = {cycle};
  static constexpr bool kProtected = {protected};
  static constexpr std::uint16_t kDataId = 0x{data_id:04X};
  static constexpr std::uint8_t kMaxDeltaCounter = {max_delta};

{enums}{fields}

{members}

  /// Calls visitor(field, signal) for each signal.
  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {{
{visits}
  }}
  static constexpr {name} decode(const Payload& payload) {{
    return decode_message<{name}>(payload);
  }}
  constexpr Payload encode() const {{ return encode_message(*this); }}
}};
"""


def _comment(text: str, indent: str) -> str:
    return "\n".join(
        textwrap.wrap(
            text, 100, initial_indent=indent + "/// ", subsequent_indent=indent + "/// "
        )
    )


def _decimal(value: Fraction) -> str:
    return f"{float(value):g}" if abs(value) < 10**6 else str(value)


def _enum(database: Database, signal: Signal) -> str:
    named = derive.states(database, signal)
    lines = [f"  enum class {signal.name} : std::uint8_t {{"]
    lines += [f"    k{text} = {raw}," for raw, text in sorted(named.items())]
    return "\n".join(lines) + "\n  };\n"


def _field(database: Database, signal: Signal) -> str:
    low, high = derive.raw_range(signal)
    error, not_available = derive.special_raws(database, signal)
    offset, numerator, denominator = derive.scale(signal)
    start = database.value(signal, "GenSigStartValue")
    si = derive.UNITS[signal.unit].si
    return (
        f"  static constexpr Field k{signal.name}{{\n"
        f'      "{signal.name}", "{si}", {signal.start_bit}, {signal.width}, {low}U, {high}U, '
        f"{error}, {not_available}, {start}U,\n      {offset}, {numerator!r}, {denominator!r}}};"
    )


def _range(signal: Signal) -> str:
    unit = f" {signal.unit}" if signal.unit else ""
    return f" [{_decimal(signal.minimum)} .. {_decimal(signal.maximum)}{unit} on the bus]"


def _member(database: Database, signal: Signal) -> str:
    """The member, with the start value as its initial value."""
    kind = derive.kind(database, signal)
    start = database.value(signal, "GenSigStartValue")
    error, not_available = derive.special_raws(database, signal)
    state, value = "kValid", str(start) + "U"
    if start in (error, not_available):
        state, value = ("kError" if start == error else "kNotAvailable"), None
    typename = kind
    if kind == derive.CODED:
        typename = f"Coded<{signal.name}>"
        text = "{}" if value is None else f"{signal.name}::k{signal.choices[start][0]}"
    elif kind == derive.PHYSICAL:
        text = "0.0" if value is None else f"physical_of(k{signal.name}, {value})"
    else:
        text = "0U" if value is None else value
    comment = signal.comment + ("" if kind == derive.CODED else _range(signal))
    return (
        _comment(comment, "  ")
        + f"\n  {typename} {derive.member(signal)}{{{text}, RawState::{state}}};"
    )


def _message(database: Database, message: Message) -> str:
    signals = [s for s in message.signals if derive.carries_value(database, s)]
    coded = [s for s in signals if derive.kind(database, s) == derive.CODED]
    enums = "".join(_enum(database, signal) + "\n" for signal in coded)
    return _comment(message.comment, "") + "\n" + _MESSAGE.format(
        name=message.name,
        sender=message.sender,
        id=message.can_id,
        length=message.length,
        cycle=database.value(message, "GenMsgCycleTime"),
        protected=str(derive.is_protected(database, message)).lower(),
        data_id=database.value(message, "E2EDataId"),
        max_delta=database.value(message, "E2EMaxDeltaCounter"),
        enums=enums,
        fields="\n".join(_field(database, signal) for signal in signals),
        members="\n".join(_member(database, signal) for signal in signals),
        visits="\n".join(
            f"    visitor(k{signal.name}, self.{derive.member(signal)});" for signal in signals
        ),
    )


def emit(database: Database, source: str, included: dict[str, list[str]]) -> str:
    """`source` is the file name of the DBC; its stem names the namespace. The messages of `included` databases, by
    their stems, have their types there."""
    namespace = source.split(".")[0]
    names = [message.name for message in database.messages]
    elsewhere = {name: stem for stem, theirs in included.items() for name in theirs}
    includes = ["can_dbc/codec.hpp", *(f"can_dbc/generated/{stem}_dbc.hpp" for stem in included)]
    head = _HEAD.format(
        source=source,
        comment=_comment(database.comment, "").removeprefix("/// "),
        includes="\n".join(f'#include "{name}"' for name in includes),
        namespace=namespace,
        version=database.value(database, "DbcVersion"),
    )
    usings = [f"using {stem}::{name};" for name, stem in elsewhere.items()]
    infos = "".join(f"    message_info<{name}>(),\n" for name in names)
    return "\n".join(
        [
            head,
            *usings,
            *([""] if usings else []),
            *(_message(database, message) for message in database.messages if message.name not in elsewhere),
            "using AllMessages =",
            "    MessageList<" + ",\n                ".join(names) + ">;",
            "",
            f"inline constexpr std::array<MessageInfo, {len(names)}> kMessages{{{{",
            infos.rstrip("\n"),
            "}};",
            "",
            "/// All of this as one type, for what is the same on every machine kind's bus.",
            "struct Dbc {",
            *(f"  using {name} = {namespace}::{name};" for name in [*names, "AllMessages"]),
            f"  static constexpr const auto& kMessages = {namespace}::kMessages;",
            f"  static constexpr std::uint8_t kDbcVersion = {namespace}::kDbcVersion;",
            "};",
            "",
            f"}}  // namespace graben::dbc::{namespace}",
            "",
        ]
    )
