# SPDX-License-Identifier: Apache-2.0
"""What is made of the codes: the core's enums, its table of reactions, the texts, the table of a README."""

from __future__ import annotations

from .codes import FMIS, KINDS, PILOT, ArmBlock, Codes, Fault, Limit

BEGIN, END = "<!-- faults: begin -->", "<!-- faults: end -->"
_HEAD = """\
// SPDX-License-Identifier: Apache-2.0
// Generated from firmware/safety/faults.toml and limits.toml by can_dbc/generate_all.py.
// clang-format off
#pragma once
/// {comment}

{includes}

namespace {namespace} {{

"""


def _head(comment: str, includes: tuple[str, ...], namespace: str = "graben") -> str:
    lines = "\n".join("" if not name else f"#include {name}" for name in includes)
    return _HEAD.format(comment=comment, includes=lines, namespace=namespace)


def _enum(name: str, comment: str, rows: tuple, none: bool) -> str:
    lines = [f"/// {comment}", f"enum class {name} : std::uint8_t {{"]
    if none:
        lines.append("  kNone = 0,")
    lines += [f"  k{row.name} = {row.code},  ///< {row.doc}" for row in rows]
    return "\n".join([*lines, "};", ""])


def enums(codes: Codes) -> str:
    return (
        _head("Codes on the bus that faults.toml and limits.toml number.", ("<cstdint>",))
        + _enum("Fault", "What stopped the machine or took a function away (firmware/safety/README.md).",
                codes.faults, none=True)
        + f"inline constexpr int kFaultCount = {len(codes.faults) + 1};  ///< With kNone.\n\n"
        + _enum("ArmBlock", "Why the mode is neither Armed nor Active: bit numbers of "
                "MachineStatus::why_not_armed.", codes.arm_blocks, none=False)
        + f"inline constexpr int kArmBlockCount = {len(codes.arm_blocks)};\n\n"
        + _enum("LimitKind", "Limits that hold lambda below 1.", codes.limits, none=True)
        + f"inline constexpr int kLimitKindCount = {len(codes.limits) + 1};  ///< With kNone.\n\n"
        + "}  // namespace graben\n")


def _row(fault: Fault) -> str:
    red, cuts = (str(flag).lower() for flag in (fault.lamp == "red", fault.cuts_pilot))
    return (f"    {{Fault::k{fault.name}, Reaction::k{fault.reaction.capitalize()}, {fault.fmi}, {red}, {cuts}, "
            f"ArmBlock::k{fault.blocks}}},")


def rows(codes: Codes) -> str:
    return (
        _head("The rows of the fault table, for fault_table.cpp alone.",
              ("<array>", "", '"firmware/safety/fault_table.hpp"'))
        + "inline constexpr std::array<FaultRow, kFaultCount> kFaultRows{{\n    {},\n"
        + "\n".join(map(_row, codes.faults)) + "\n}};\n\n}  // namespace graben\n")


def _pilot(after: str) -> str:
    return "k" + "".join(word.capitalize() for word in after.split())


def texts(codes: Codes) -> str:
    def table(name: str, kind: str, lines: list[str]) -> str:
        return f"inline constexpr std::array<{kind}, {len(lines)}> {name}{{{{\n" + "\n".join(lines) + "\n}};\n\n"

    return (
        _head("Texts of faults, arm conditions and limits, by their numbers.", ("<array>",), "graben::runs")
        + "/// What becomes of the pilot pressure, as faults.toml says.\n"
        + f"enum class PilotAfter {{ {', '.join(map(_pilot, PILOT))} }};\n\n"
        + "struct FaultText {\n  const char* text;\n  const char* help;  ///< What to do.\n"
        + "  PilotAfter pilot;\n};\n\n"
        + "enum class LimitOf { kNothing, kPump, kDrive, kFault, kTrack, kFence, kSource };\n\n"
        + "struct LimitText {\n  const char* text;\n  LimitOf of;  ///< Whose number the limit's index is.\n};\n\n"
        + table("kFaultTexts", "FaultText", ['    {"none", "", PilotAfter::kStays},',
                *(f'    {{"{fault.text}",\n     "{fault.help}", PilotAfter::{_pilot(fault.pilot)}}},'
                  for fault in codes.faults)])
        + table("kArmBlockTexts", "const char*", [f'    "{block.text}",' for block in codes.arm_blocks])
        + table("kLimitTexts", "LimitText", ['    {"none", LimitOf::kNothing},',
                *(f'    {{"{limit.text}", LimitOf::k{limit.of.capitalize() or "Nothing"}}},'
                  for limit in codes.limits)])
        + "}  // namespace graben::runs\n")


def limits_of_page(codes: Codes) -> str:
    lines = [f"  {{text: '{limit.text}', of: '{limit.of}'}}," for limit in codes.limits]
    return "\n".join([
        "// SPDX-License-Identifier: Apache-2.0",
        "/// Generated from firmware/safety/limits.toml by can_dbc/generate_all.py.", "",
        "/// What holds lambda, by EcuStatus.LimitKind, and whose number LimitIndex is.",
        "export const LIMITS: readonly {readonly text: string; readonly of: string}[] = [",
        "  {text: 'none', of: ''},", *lines, "];", ""])


def _fault_line(fault: Fault) -> str:
    kinds = "all" if fault.kinds == KINDS else ", ".join(fault.kinds)
    return (f"| {fault.code} | `{fault.name}` | {fault.text} | {fault.reaction} | {PILOT[fault.pilot]} | {fault.lamp} "
            f"| {fault.fmi} ({FMIS[fault.fmi]}) | {fault.spn} | {fault.blocks} | {kinds} | {fault.help} |")


def _short_line(row: ArmBlock | Limit) -> str:
    return f"| {row.code} | `{row.name}` | {row.text} |"


def readme_part(codes: Codes) -> str:
    """Between the markers, without them."""
    return "\n".join([
        "| code | fault | text | reaction | pilot pressure | lamp | FMI | SPN | blocks | kinds | what to do |",
        "|---|---|---|---|---|---|---|---|---|---|---|", *map(_fault_line, codes.faults), "",
        "Reasons in `EcuHealth.WhyNotArmed`, by bit:", "",
        "| bit | reason | text |", "|---|---|---|", *map(_short_line, codes.arm_blocks), "",
        "What holds lambda, `EcuStatus.LimitKind`:", "",
        "| code | limit | text |", "|---|---|---|", *map(_short_line, codes.limits)])


def readme(codes: Codes, written: str) -> str:
    """The README with its part made newly; ValueError without the markers."""
    before, _, rest = written.partition(BEGIN)
    _, found, after = rest.partition(END)
    if not found:
        raise ValueError(f"no {BEGIN} ... {END}")
    return f"{before}{BEGIN}\n{readme_part(codes)}\n{END}{after}"
