# SPDX-License-Identifier: Apache-2.0
"""DBC text to model. Every keyword that is not listed here is refused with its line."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction

from .model import Attribute, Database, Item, Message, Refusal, Signal

_TOKEN = re.compile(
    r"""(?P<space>[ \t\r\n]+)
      | "(?P<string>[^"]*)"
      | (?P<number>[+-]?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)
      | (?P<word>[A-Za-z_]\w*)
      | (?P<punctuation>[:;|@()\[\],+-])""",
    re.VERBOSE,
)

_REASONS = {
    "SIG_VALTYPE_": "floating-point signals are not supported",
    "SG_MUL_VAL_": "multiplexed signals are not supported",
    "BO_TX_BU_": "a message with several senders is not supported",
}


@dataclass
class _Token:
    kind: str
    text: str
    line: int
    at_line_start: bool


def _tokens(text: str) -> list[_Token]:
    tokens, position, line, line_start = [], 0, 1, 0
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            what = text[position]
            raise Refusal(line, "string without an end" if what == '"' else f"unexpected {what!r}")
        kind = match.lastgroup or "string"
        if kind != "space":
            tokens.append(_Token(kind, match.group(kind), line, position == line_start))
        newlines = match.group().count("\n")
        if newlines:
            line += newlines
            line_start = match.start() + match.group().rindex("\n") + 1
        position = match.end()
    tokens.append(_Token("end", "end of file", line, True))
    return tokens


class _Parser:
    def __init__(self, text: str):
        self._tokens = _tokens(text)
        self._next = 0
        self._database = Database(name="", line=1)
        self._by_id: dict[int, Message] = {}

    def parse(self) -> Database:
        sections = {
            "VERSION": self._version,
            "NS_": self._new_symbols,
            "BS_": self._bit_timing,
            "BU_": self._nodes,
            "BO_": self._message,
            "SG_": self._signal,
            "CM_": self._comment,
            "BA_DEF_": self._attribute_definition,
            "BA_DEF_DEF_": self._attribute_default,
            "BA_": self._attribute_value,
            "VAL_": self._value_table,
        }
        while self._peek().kind != "end":
            token = self._take("word")
            if token.text not in sections:
                reason = _REASONS.get(token.text, "unknown keyword")
                raise Refusal(token.line, f"{token.text}: {reason}")
            sections[token.text](token.line)
        return self._database

    # Tokens

    def _peek(self) -> _Token:
        return self._tokens[self._next]

    def _take(self, kind: str, text: str | None = None) -> _Token:
        token = self._peek()
        if token.kind != kind or (text is not None and token.text != text):
            raise Refusal(token.line, f"expected {text or kind}, found {token.text!r}")
        self._next += 1
        return token

    def _accept(self, text: str) -> bool:
        if self._peek().text == text and self._peek().kind in ("word", "punctuation"):
            self._next += 1
            return True
        return False

    def _symbol(self, text: str) -> None:
        self._take("punctuation", text)

    def _integer(self) -> int:
        token = self._take("number")
        if not re.fullmatch(r"[+-]?\d+", token.text):
            raise Refusal(token.line, f"expected an integer, found {token.text!r}")
        return int(token.text)

    def _fraction(self) -> Fraction:
        return Fraction(self._take("number").text)

    # Sections

    def _version(self, _line: int) -> None:
        self._take("string")

    def _new_symbols(self, _line: int) -> None:
        self._symbol(":")
        while self._peek().kind == "word" and not self._peek().at_line_start:
            self._next += 1

    def _bit_timing(self, _line: int) -> None:
        self._symbol(":")
        if not self._peek().at_line_start:
            raise Refusal(self._peek().line, "BS_: bit timing is not supported")

    def _nodes(self, line: int) -> None:
        self._symbol(":")
        while self._peek().kind == "word" and self._peek().line == line:
            node = self._take("word")
            if node.text in self._database.nodes:
                raise Refusal(node.line, f"node {node.text} is defined twice")
            self._database.nodes[node.text] = Item(node.text, node.line)

    def _message(self, line: int) -> None:
        raw_id = self._integer()
        name = self._take("word").text
        self._symbol(":")
        length = self._integer()
        sender = self._take("word").text
        if raw_id in self._by_id:
            raise Refusal(line, f"id {raw_id} is defined twice")
        if any(message.name == name for message in self._database.messages):
            raise Refusal(line, f"message {name} is defined twice")
        message = Message(name, line, raw_id=raw_id, length=length, sender=sender)
        self._by_id[raw_id] = message
        self._database.messages.append(message)

    def _signal(self, line: int) -> None:
        if not self._database.messages:
            raise Refusal(line, "SG_ outside of a message")
        message = self._database.messages[-1]
        name = self._take("word").text
        if self._peek().kind == "word":
            raise Refusal(line, f"{name}: multiplexed signals are not supported")
        self._symbol(":")
        start_bit = self._integer()
        self._symbol("|")
        width = self._integer()
        self._symbol("@")
        if self._integer() != 1:
            raise Refusal(line, f"{name}: Motorola byte order is not supported")
        if self._accept("-"):
            raise Refusal(line, f"{name}: signed raw values are not supported, use an offset")
        self._symbol("+")
        self._symbol("(")
        factor = self._fraction()
        self._symbol(",")
        offset = self._fraction()
        self._symbol(")")
        self._symbol("[")
        minimum = self._fraction()
        self._symbol("|")
        maximum = self._fraction()
        self._symbol("]")
        unit = self._take("string").text
        receivers = [self._take("word")]
        while self._accept(","):
            receivers.append(self._take("word"))
        if any(signal.name == name for signal in message.signals):
            raise Refusal(line, f"signal {name} is defined twice")
        message.signals.append(
            Signal(
                name,
                line,
                start_bit=start_bit,
                width=width,
                factor=factor,
                offset=offset,
                minimum=minimum,
                maximum=maximum,
                unit=unit,
                receivers=tuple((token.text, token.line) for token in receivers),
            )
        )

    def _scope(self) -> str:
        for scope in ("BU_", "BO_", "SG_"):
            if self._accept(scope):
                return scope
        if self._peek().kind == "word":
            raise Refusal(self._peek().line, f"{self._peek().text}: not supported here")
        return ""

    def _referenced(self, scope: str) -> Item:
        """The item that a CM_, BA_ or VAL_ is about."""
        line = self._peek().line
        if scope == "":
            return self._database
        if scope == "BU_":
            name = self._take("word").text
            if name not in self._database.nodes:
                raise Refusal(line, f"unknown node {name}")
            return self._database.nodes[name]
        raw_id = self._integer()
        if raw_id not in self._by_id:
            raise Refusal(line, f"unknown message id {raw_id}")
        message = self._by_id[raw_id]
        if scope == "BO_":
            return message
        name = self._take("word").text
        for signal in message.signals:
            if signal.name == name:
                return signal
        raise Refusal(line, f"message {message.name} has no signal {name}")

    def _comment(self, line: int) -> None:
        item = self._referenced(self._scope())
        if item.comment:
            raise Refusal(line, f"second comment for {item.name or 'the database'}")
        item.comment = " ".join(self._take("string").text.split())
        self._symbol(";")

    def _attribute_definition(self, line: int) -> None:
        scope = self._scope()
        name = self._take("string").text
        kind = self._take("word").text
        if name in self._database.attributes:
            raise Refusal(line, f"attribute {name} is defined twice")
        attribute = Attribute(name, scope, kind, line)
        if kind in ("INT", "HEX", "FLOAT"):
            attribute.low, attribute.high = self._fraction(), self._fraction()
        elif kind == "ENUM":
            choices = [self._take("string").text]
            while self._accept(","):
                choices.append(self._take("string").text)
            attribute.choices = tuple(choices)
        elif kind != "STRING":
            raise Refusal(line, f"attribute {name}: unknown type {kind}")
        self._symbol(";")
        self._database.attributes[name] = attribute

    def _attribute(self) -> Attribute:
        token = self._take("string")
        if token.text not in self._database.attributes:
            raise Refusal(token.line, f"attribute {token.text} is not defined")
        return self._database.attributes[token.text]

    def _value_of(self, attribute: Attribute) -> object:
        """A value of the attribute's type; of an ENUM, its text, given as text or as index."""
        token = self._peek()
        if attribute.kind == "STRING":
            return self._take("string").text
        if attribute.kind == "ENUM":
            if token.kind == "string":
                if token.text not in attribute.choices:
                    raise Refusal(token.line, f"{attribute.name} has no choice {token.text!r}")
                return self._take("string").text
            index = self._integer()
            if not 0 <= index < len(attribute.choices):
                raise Refusal(token.line, f"{attribute.name} has no choice {index}")
            return attribute.choices[index]
        value = self._fraction() if attribute.kind == "FLOAT" else Fraction(self._integer())
        if not attribute.low <= value <= attribute.high:
            raise Refusal(
                token.line,
                f"{attribute.name} {token.text} is outside [{attribute.low}, {attribute.high}]",
            )
        return value if attribute.kind == "FLOAT" else int(value)

    def _attribute_default(self, line: int) -> None:
        attribute = self._attribute()
        if attribute.default is not None:
            raise Refusal(line, f"second default of attribute {attribute.name}")
        attribute.default = self._value_of(attribute)
        self._symbol(";")

    def _attribute_value(self, line: int) -> None:
        attribute = self._attribute()
        scope = self._scope()
        if scope != attribute.scope:
            raise Refusal(line, f"attribute {attribute.name} belongs to another kind of item")
        item = self._referenced(scope)
        if attribute.name in item.values:
            raise Refusal(line, f"second value of attribute {attribute.name}")
        item.values[attribute.name] = (self._value_of(attribute), line)
        self._symbol(";")

    def _value_table(self, line: int) -> None:
        signal = self._referenced("SG_")
        if signal.choices:
            raise Refusal(line, f"second value table for {signal.name}")
        while not self._accept(";"):
            raw = self._integer()
            text = self._take("string").text
            if raw in signal.choices:
                raise Refusal(line, f"{signal.name}: raw value {raw} is named twice")
            signal.choices[raw] = (text, line)


def parse(data: bytes) -> Database:
    """Raises Refusal with the line of what is not understood."""
    for number, line in enumerate(data.split(b"\n"), start=1):
        if not line.isascii():
            raise Refusal(number, "not ASCII")
    return _Parser(data.decode("ascii")).parse()
