# SPDX-License-Identifier: Apache-2.0
"""A DBC in short: one line a node, message or signal with its comment below, and what follows from it left out.

    DATABASE version 5
     "Comment of the database; that of what it includes follows it."
    INCLUDE common.dbc.in
    NODE Engine 0
     "Comment."
    BO_ 0CFF2080 BoomStroke Machine 10 ms, data id FF20, delta 3
     "Comment."
     SG_ BoomStroke 16|16 (0.05,0) [0|3200] "mm"
      "Comment."
     SG_ Enable 12|2 {Off On} start 0 to Valve,Machine
      "A comment may go on"
      "in the next line."

(factor,offset) is (1,0) and the unit none unless said. A message with a data id has its Crc and Counter. Signals of
2, 3, 4, 5, 8, 16, 24 or 32 bits have the special values of J1939 unless they are `plain`. The names in braces are those
of raw 0, 1, ..., which is then the range; {@faults} and {@limits} are those of the code table, @arm_blocks in a comment
its list. A signal starts as `not available` where another node than Graben sends a measured value, else at its physical
zero; `start na` or `start RAW` says another. Graben's go to Machine and Operator, all others to Graben, unless `to` says
another.
"""

from __future__ import annotations

import dataclasses
import pathlib
import re
from fractions import Fraction

from .codes import Codes
from .model import Refusal

SPECIALS = {2: (2, 3), 3: (6, 7), 4: (14, 15), 5: (30, 31), 8: (254, 255), 16: (0xFEFF, 0xFFFF),
            24: (0xFEFFFF, 0xFFFFFF), 32: (0xFEFFFFFF, 0xFFFFFFFF)}
OURS = "Graben"
CRC = "CRC-8 of the data id and bytes 1 to 7; polynomial 0x1D, AUTOSAR profile 11, mode BOTH."
COUNTER = "Counts up by one a frame, 0 .. 14, then 0 again; 15 is invalid."
_NUMBER = r"-?[\d.]+"
_DATABASE = re.compile(r"DATABASE(?: version (?P<version>\d+))?")
_INCLUDE = re.compile(r"INCLUDE (?P<file>\S+)")
_NODE = re.compile(r"NODE (?P<name>\w+) (?P<address>\d+)")
_MESSAGE = re.compile(r"BO_ (?P<id>[0-9A-F]{8}) (?P<name>\w+) (?P<sender>\w+) (?P<cycle>\d+) ms"
                      r"(?:, data id (?P<data_id>[0-9A-F]{4}), delta (?P<delta>\d+))?")
_SIGNAL = re.compile(
    rf"SG_ (?P<name>\w+) (?P<start_bit>\d+)\|(?P<width>\d+)(?: \((?P<factor>{_NUMBER}),(?P<offset>{_NUMBER})\))?"
    rf"(?: \[(?P<low>{_NUMBER})\|(?P<high>{_NUMBER})\])?(?: \"(?P<unit>[^\"]*)\")?(?: \{{(?P<states>[^}}]*)\}})?"
    r"(?: (?P<plain>plain))?(?: start (?P<start>na|\d+))?(?: spn (?P<spn>\d+))?(?: to (?P<to>[\w,]+))?")
_COMMENT = re.compile(r'"(?P<text>[^"]*)"')


@dataclasses.dataclass(frozen=True)
class Place:
    file: pathlib.Path
    line: int


class SourceError(Exception):
    """A source that is not understood, and where."""

    def __init__(self, place: Place, message: str):
        super().__init__(f"{place.file}:{place.line}: {message}")


@dataclasses.dataclass
class Entry:
    """A line of the source with its comment."""

    place: Place
    said: dict[str, str | None]
    comment: str = ""
    signals: list["Entry"] = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Source:
    """All that a file and what it includes say; what is included comes last."""

    database: Entry
    nodes: list[Entry] = dataclasses.field(default_factory=list)
    messages: list[Entry] = dataclasses.field(default_factory=list)
    included: dict[str, list[str]] = dataclasses.field(default_factory=dict)  # stem -> its messages' names


def read(file: pathlib.Path, folders: tuple[pathlib.Path, ...]) -> Source:
    """What is included is looked for beside the file, then in `folders`."""
    source, others, last = Source(Entry(Place(file, 1), {"version": None})), [], None
    for number, line in enumerate(file.read_text(encoding="ascii").splitlines(), start=1):
        text, place = line.strip(), Place(file, number)
        if not text or text.startswith("#"):
            continue
        if match := _COMMENT.fullmatch(text):
            if last is None:
                raise SourceError(place, "a comment of nothing")
            last.comment = " ".join(f"{last.comment} {match['text']}".split())
        elif match := _INCLUDE.fullmatch(text):
            others.append(read(_find(match["file"], place, (file.parent, *folders)), folders))
        elif match := _DATABASE.fullmatch(text):
            source.database = last = Entry(place, match.groupdict())
        elif match := _NODE.fullmatch(text):
            source.nodes.append(last := Entry(place, match.groupdict()))
        elif match := _MESSAGE.fullmatch(text):
            source.messages.append(last := Entry(place, match.groupdict()))
        elif (match := _SIGNAL.fullmatch(text)) and source.messages:
            source.messages[-1].signals.append(last := Entry(place, match.groupdict()))
        else:
            raise SourceError(place, f"not understood: {text!r}")
    for other in others:
        source.included[other.database.place.file.name.split(".")[0]] = [m.said["name"] for m in other.messages]
        source.nodes += other.nodes
        source.messages += other.messages
        source.database.comment = f"{source.database.comment} {other.database.comment}".strip()
    return source


def _find(name: str, place: Place, folders: tuple[pathlib.Path, ...]) -> pathlib.Path:
    for folder in folders:
        if (folder / name).is_file():
            return folder / name
    raise SourceError(place, f"{name} is not found")


class Expansion:
    """The DBC of a source, line by line, and where each line comes from."""

    def __init__(self, source: Source, codes: Codes):
        self._codes = codes
        self._lines: list[str] = []
        self._places: list[Place] = []
        self._at = source.database.place
        self._write(source)

    @property
    def text(self) -> str:
        return "\n".join(self._lines) + "\n"

    def blame(self, refusal: Refusal) -> SourceError:
        """The place in the source of what a check has found in the DBC."""
        place = self._places[min(refusal.line, len(self._places)) - 1]
        return SourceError(place, refusal.message)

    def _put(self, text: str = "", entry: Entry | None = None) -> None:
        self._at = entry.place if entry is not None else self._at
        for line in text.split("\n"):
            self._lines.append(line)
            self._places.append(self._at)

    def _write(self, source: Source) -> None:
        self._put(_HEAD)
        self._put("BU_: " + " ".join(node.said["name"] for node in source.nodes))
        for message in source.messages:
            said = message.said
            self._put(f"\nBO_ {_raw_id(message)} {said['name']}: 8 {said['sender']}", message)
            for signal in _signals(message):
                self._put(self._layout(message, signal), signal)
        self._put("\n")
        self._put(f'CM_ "{source.database.comment}";', source.database)
        for node in source.nodes:
            self._put(f'CM_ BU_ {node.said["name"]} "{node.comment}";', node)
        for message in source.messages:
            self._put(f'CM_ BO_ {_raw_id(message)} "{message.comment}";', message)
            for signal in _signals(message):
                comment = signal.comment.replace("@arm_blocks", self._codes.arm_block_list())
                self._put(f'CM_ SG_ {_raw_id(message)} {signal.said["name"]} "{comment}";', signal)
        self._put(_ATTRIBUTES)
        self._put(f'BA_ "DbcVersion" {source.database.said["version"] or 1};', source.database)
        for node in source.nodes:
            self._put(f'BA_ "NmStationAddress" BU_ {node.said["name"]} {node.said["address"]};', node)
        for message in source.messages:
            for name, value in _message_attributes(message):
                self._put(f'BA_ "{name}" BO_ {_raw_id(message)} {value};', message)
        for message in source.messages:
            for signal in _signals(message):
                for name, value in self._signal_attributes(message, signal):
                    self._put(f'BA_ "{name}" SG_ {_raw_id(message)} {signal.said["name"]} {value};', signal)
        for message in source.messages:
            for signal in _signals(message):
                if choices := self._choices(signal):
                    table = "".join(f'{raw} "{text}" ' for raw, text in choices)
                    self._put(f'VAL_ {_raw_id(message)} {signal.said["name"]} {table};', signal)

    def _states(self, signal: Entry) -> list[str]:
        names = signal.said["states"]
        if names in ("@faults", "@limits"):
            return self._codes.fault_names() if names == "@faults" else self._codes.limit_names()
        return names.split() if names else []

    def _layout(self, message: Entry, signal: Entry) -> str:
        said = signal.said
        to = said["to"] or ("Machine,Operator" if message.said["sender"] == OURS else OURS)
        states = self._states(signal)
        if (said["low"] is None) != bool(states):
            raise SourceError(signal.place, f"{said['name']}: either a range or names of its states")
        span = f"0|{len(states) - 1}" if states else f"{said['low']}|{said['high']}"
        return (f" SG_ {said['name']} : {said['start_bit']}|{said['width']}@1+ ({said['factor'] or 1},"
                f"{said['offset'] or 0}) [{span}] \"{said['unit'] or ''}\" {to}")

    def _choices(self, signal: Entry) -> list[tuple[int, str]]:
        choices = list(enumerate(self._states(signal)))
        return [*choices, *zip(specials, ("Error", "NotAvailable"))] if (specials := _specials(signal)) else choices

    def _signal_attributes(self, message: Entry, signal: Entry) -> list[tuple[str, int]]:
        said = signal.said
        if "type" in said:
            return [("SigType", int(said["type"] or 0))]
        attributes = [("SPN", int(said["spn"]))] if said["spn"] else []
        specials = _specials(signal)
        measured = message.said["sender"] != OURS and specials and not said["states"]
        if said["start"] == "na" or (said["start"] is None and measured):
            if not specials:
                raise SourceError(signal.place, f"{said['name']}: has no 'not available'")
            start = specials[1]
        else:
            zero = -Fraction(said["offset"] or 0) / Fraction(said["factor"] or 1)
            start = int(said["start"] or zero)
        if start:
            attributes.append(("GenSigStartValue", start))
        return [*attributes, *zip(("SigErrorRaw", "SigNotAvailableRaw"), specials)]


def _raw_id(message: Entry) -> int:
    return int(message.said["id"] or "0", 16) | 0x80000000


def _signals(message: Entry) -> list[Entry]:
    if message.said["data_id"] is None:
        return message.signals
    plain = {"factor": None, "offset": None, "unit": None, "states": None, "plain": "plain",
             "to": message.signals[0].said["to"] if message.signals else None}
    return [Entry(message.place, {"name": "Crc", "start_bit": "0", "width": "8", "low": "0", "high": "255",
                                  "type": "12", **plain}, CRC),
            Entry(message.place, {"name": "Counter", "start_bit": "8", "width": "4", "low": "0", "high": "14",
                                  "type": "11", **plain}, COUNTER),
            *message.signals]


def _specials(signal: Entry) -> tuple[int, ...]:
    return () if signal.said["plain"] else SPECIALS.get(int(signal.said["width"] or 0), ())


def _message_attributes(message: Entry) -> list[tuple[str, int]]:
    said = message.said
    attributes = [("VFrameFormat", 3), ("GenMsgCycleTime", int(said["cycle"] or 0))]
    if said["data_id"] is not None:
        attributes += [("E2EDataId", int(said["data_id"], 16)), ("E2EMaxDeltaCounter", int(said["delta"] or 0))]
    return attributes


_HEAD = 'VERSION "4"\n\n\nNS_ :\n\t' + "\n\t".join(
    "NS_DESC_ CM_ BA_DEF_ BA_ VAL_ CAT_DEF_ CAT_ FILTER BA_DEF_DEF_ EV_DATA_ ENVVAR_DATA_ SGTYPE_ SGTYPE_VAL_"
    " BA_DEF_SGTYPE_ BA_SGTYPE_ SIG_TYPE_REF_ VAL_TABLE_ SIG_GROUP_ SIG_VALTYPE_ SIGTYPE_VALTYPE_ BO_TX_BU_"
    " BA_DEF_REL_ BA_REL_ BA_DEF_DEF_REL_ BU_SG_REL_ BU_EV_REL_ BU_BO_REL_ SG_MUL_VAL_".split()) + "\n\nBS_:\n"

_ATTRIBUTES = """\
BA_DEF_ "ProtocolType" STRING;
BA_DEF_ "DbcVersion" INT 1 250;
BA_DEF_ BU_ "NmStationAddress" INT 0 254;
BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","reserved","J1939PG";
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;
BA_DEF_ BO_ "E2EDataId" INT 0 65535;
BA_DEF_ BO_ "E2EMaxDeltaCounter" INT 0 14;
BA_DEF_ SG_ "SPN" INT 0 524287;
BA_DEF_ SG_ "SigType" ENUM "Default","Range","RangeSigned","ASCII","Discrete","Control","ReferencePGN","DTC",\
"StringDelimiter","StringLength","StringLengthControl","MessageCounter","MessageChecksum";
BA_DEF_ SG_ "GenSigStartValue" INT 0 4294967295;
BA_DEF_ SG_ "SigErrorRaw" INT -1 4294967295;
BA_DEF_ SG_ "SigNotAvailableRaw" INT -1 4294967295;
BA_DEF_DEF_ "ProtocolType" "J1939";
BA_DEF_DEF_ "DbcVersion" 1;
BA_DEF_DEF_ "NmStationAddress" 254;
BA_DEF_DEF_ "VFrameFormat" "J1939PG";
BA_DEF_DEF_ "GenMsgCycleTime" 0;
BA_DEF_DEF_ "E2EDataId" 0;
BA_DEF_DEF_ "E2EMaxDeltaCounter" 0;
BA_DEF_DEF_ "SPN" 0;
BA_DEF_DEF_ "SigType" "Default";
BA_DEF_DEF_ "GenSigStartValue" 0;
BA_DEF_DEF_ "SigErrorRaw" -1;
BA_DEF_DEF_ "SigNotAvailableRaw" -1;
BA_ "ProtocolType" "J1939";"""
