# SPDX-License-Identifier: Apache-2.0
"""Faults, reasons for not arming and limits: the rows of firmware/safety/faults.toml and limits.toml, checked."""

from __future__ import annotations

import dataclasses
import pathlib
import re
import tomllib

FIRST_SPN = 520192
KINDS = ("excavator", "dozer")
FMIS = {2: "erratic", 7: "not responding", 9: "abnormal update rate", 10: "abnormal rate of change", 12: "bad device",
        14: "special instructions", 19: "received network data in error", 31: "condition exists"}
# What becomes of the pilot pressure.
PILOT = {"stays": "-", "later": "cut 1 s later", "at once": "cut at once", "kept": "cut at once, kept",
         "by motion": "cut at once, kept after motion"}
INDICES = ("", "pump", "drive", "fault", "track", "fence", "source")
_NAME = re.compile(r"[A-Z][A-Za-z0-9]*")


class CodeError(Exception):
    """A row that breaks a rule; names its file and key."""


@dataclasses.dataclass(frozen=True)
class Fault:
    name: str
    code: int
    doc: str
    text: str
    help: str
    reaction: str
    lamp: str
    fmi: int
    blocks: str
    cuts_pilot: bool
    pilot: str
    kinds: tuple[str, ...]

    @property
    def spn(self) -> int:
        return FIRST_SPN + self.code


@dataclasses.dataclass(frozen=True)
class ArmBlock:
    name: str
    code: int
    doc: str
    text: str


@dataclasses.dataclass(frozen=True)
class Limit:
    name: str
    code: int
    doc: str
    text: str
    of: str


@dataclasses.dataclass(frozen=True)
class Codes:
    faults: tuple[Fault, ...]
    arm_blocks: tuple[ArmBlock, ...]
    limits: tuple[Limit, ...]

    def fault_names(self) -> list[str]:
        """By number, from `None` on."""
        return ["None", *(fault.name for fault in self.faults)]

    def limit_names(self) -> list[str]:
        return ["None", *(limit.name for limit in self.limits)]

    def arm_block_list(self) -> str:
        """One word group a bit, from bit 0, for a comment."""
        return ", ".join(re.sub(r"(?<=[a-z])(?=[A-Z])", " ", block.name).lower() for block in self.arm_blocks)


class _Table:
    """One table of a file; says what is missing, unknown or not as allowed."""

    def __init__(self, where: str, values: dict):
        self.where = where
        self._left = dict(values)

    def error(self, what: str) -> CodeError:
        return CodeError(f"{self.where}: {what}")

    def take(self, key: str, kind: type, allowed=None, default=None):
        if key not in self._left:
            if default is None:
                raise self.error(f"{key} is missing")
            return default
        value = self._left.pop(key)
        if not isinstance(value, kind) or isinstance(value, bool):
            raise self.error(f"{key} is not a {kind.__name__}")
        if allowed is not None and value not in allowed:
            raise self.error(f"{key} {value!r} is none of {', '.join(map(str, allowed))}")
        return value

    def text(self, key: str) -> str:
        value = self.take(key, str)
        if not value.isascii() or '"' in value or "|" in value or not value.strip():
            raise self.error(f'{key} is empty, not ASCII, or has a " or |')
        return value

    def end(self) -> None:
        if self._left:
            raise self.error(f"unknown key {next(iter(self._left))}")


def _fault(where: str, name: str, values: dict, blocks: tuple[str, ...]) -> Fault:
    row = _Table(f"{where}: [{name}]", values)
    does = _Table(f"{where}: [{name}] does", row.take("does", dict))
    kinds = row.take("kinds", list, default=list(KINDS))
    if not kinds or any(kind not in KINDS for kind in kinds):
        raise row.error(f"kinds are some of {', '.join(KINDS)}")
    fault = Fault(name, row.take("code", int), row.text("doc"), row.text("text"), row.text("help"),
                  does.take("reaction", str, ("stop", "degrade", "warn")), does.take("lamp", str, ("red", "amber")),
                  does.take("fmi", int, tuple(FMIS)), does.take("blocks", str, blocks),
                  does.take("cuts", str, ("pilot",), default="") == "pilot",
                  does.take("pilot", str, tuple(PILOT)), tuple(kinds))
    row.end()
    does.end()
    if fault.cuts_pilot and fault.reaction != "stop":
        raise row.error("what cuts the pilot pressure stops")
    if (fault.pilot == "stays") != (fault.reaction != "stop"):
        raise row.error("the pilot pressure goes after every stop, and after nothing else")
    if fault.cuts_pilot and fault.pilot not in ("kept", "by motion"):
        raise row.error("what the spools do not obey keeps the pilot pressure cut")
    return fault


def _in_order(where: str, rows: list, first: int, most: int) -> tuple:
    """Numbers without gaps, so that a range check tells known from unknown ones; texts that differ."""
    for number, row in enumerate(rows, start=first):
        if not _NAME.fullmatch(row.name):
            raise CodeError(f"{where}: [{row.name}] is not CamelCase")
        if row.code != number:
            raise CodeError(f"{where}: [{row.name}] has number {row.code} and not {number}")
        if number > most:
            raise CodeError(f"{where}: [{row.name}]: {number} is more than the bus can say, {most}")
    texts = [row.text for row in rows]
    for row in rows:
        if texts.count(row.text) > 1:
            raise CodeError(f"{where}: [{row.name}] has the text of another")
    return tuple(rows)


def _table(file: pathlib.Path) -> dict:
    try:
        return tomllib.loads(file.read_text(encoding="ascii"))
    except tomllib.TOMLDecodeError as error:
        raise CodeError(f"{file.name}: {error}") from error


def load(folder: pathlib.Path) -> Codes:
    """Raises CodeError for the first rule that is broken."""
    sections = _table(folder / "limits.toml")
    blocks, limits = [], []
    for name, values in sections.get("arm", {}).items():
        row = _Table(f"limits.toml: [arm.{name}]", values)
        blocks.append(ArmBlock(name, row.take("bit", int), row.text("doc"), row.text("text")))
        row.end()
    for name, values in sections.get("limit", {}).items():
        row = _Table(f"limits.toml: [limit.{name}]", values)
        limits.append(Limit(name, row.take("code", int), row.text("doc"), row.text("text"),
                            row.take("of", str, INDICES, default="")))
        row.end()
    if unknown := [name for name in sections if name not in ("arm", "limit")]:
        raise CodeError(f"limits.toml: unknown section {unknown[0]}")
    names = tuple(block.name for block in blocks)
    faults = [_fault("faults.toml", name, values, names) for name, values in _table(folder / "faults.toml").items()]
    # 29: the last valid number of 5 bits; 31: the last bit; 127: the last bit of a FaultSet.
    return Codes(_in_order("faults.toml", faults, 1, 127), _in_order("limits.toml", blocks, 0, 31),
                 _in_order("limits.toml", limits, 1, 29))
