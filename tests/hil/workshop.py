# SPDX-License-Identifier: Apache-2.0
"""Diagnosis and stored faults of the deployed process on a real CAN kernel: workshop.py OUT GRABEN_ECU. Messages are
put together and decoded here, by J1939-21 and -73, and put together by the kernel's J1939 beside that; the store's
files by their layout and zlib's checksum."""

import json
import pathlib
import struct
import sys
import zlib

import bus_log
import resident
import run_programs
import stats_file
from bus_log import ECU_STATUS, SPN_BASE, STOPPING

ANNOUNCE, PACKET, TO_TOOL, ACKNOWLEDGMENT = "1CECFF82", "1CEBFF82", "1CECF982", "18E8FF82"
DM1, DM2, DM3, DM11, NOTHING = 0xFECA, 0xFECB, 0xFECC, 0xFED3, 0xFEEC
DONE, REFUSED = 0, 1
TOOL = 0xF9
# What is missing without a machine: strokes, pressures, swash, engine, operator, identity, valve.
MISSING = {1, 2, 3, 4, 5, 11, 20}
# As J1939-21 has the first. A packet to a tool alone goes between a broadcast's and moves its end by 60 ms.
GAPS_S, PERIOD_S = (0.050, 0.200), 1.05 + 2 * 0.06


def broadcasts(log: list[bus_log.Frame]) -> tuple[list[tuple[float, int, bytes]], list[str]]:
    """(time, group, bytes) of each that is whole, and what is wrong with others."""
    found, problems, at = [], [], None
    for frame in log:
        data = frame.data
        if frame.name == ANNOUNCE:
            if at is not None:
                problems.append(f"{frame.time}: a broadcast begins within another")
            size, packets = struct.unpack("<HB", data[1:4])
            if data[0] != 32 or packets != (size + 6) // 7:
                problems.append(f"{frame.time}: announced by {data.hex()}")
            at = (frame.time, size, packets, int.from_bytes(data[5:8], "little"), b"")
        elif frame.name == PACKET:
            last, size, packets, group, so_far = at
            if not GAPS_S[0] <= frame.time - last <= GAPS_S[1] or data[0] != len(so_far) // 7 + 1:
                problems.append(f"{frame.time}: packet {data[0]} after {frame.time - last:.3f} s")
            so_far += data[1:]
            at = (frame.time, size, packets, group, so_far)
            if len(so_far) == 7 * packets:
                found.append((frame.time, group, so_far[:size]))
                at = None
    return found, problems


def codes(message: bytes) -> set[tuple[int, int]]:
    """Number of the fault, failure mode."""
    fours = [message[at:at + 4] for at in range(2, len(message), 4)]
    return {((four[0] | four[1] << 8 | four[2] >> 5 << 16) - SPN_BASE, four[2] & 31) for four in fours}


def first_run(log: list[bus_log.Frame]) -> list[bus_log.Frame]:
    """Until the process is told to end for the first time; a broadcast may be cut there."""
    end = min(frame.time for frame in log if frame.name == ECU_STATUS and frame.mode == STOPPING)
    return [frame for frame in log if frame.time < end]


def check_bus(log: list[bus_log.Frame]) -> list[str]:
    log = first_run(log)
    found, problems = broadcasts(log)
    said = [(time, codes(message)) for time, group, message in found if group == DM1]
    if not said or {fault for fault, _ in said[-1][1]} != MISSING or {mode for _, mode in said[-1][1]} - {9, 14, 19, 31}:
        problems.append(f"DM1 says {sorted(said[-1][1]) if said else 'nothing'}")
    late = [later[0] - earlier[0] for earlier, later in zip(said, said[1:]) if later[0] - earlier[0] > PERIOD_S]
    # The tool does not take what it asked for alone: announced, then given up.
    alone = [frame.data[0] for frame in log if frame.name == TO_TOOL]
    if alone != [16, 255]:
        problems.append(f"to the tool alone: {alone}")
    answers = [(frame.data[0], frame.data[4], int.from_bytes(frame.data[5:8], "little"))
               for frame in log if frame.name == ACKNOWLEDGMENT]
    wanted = [(REFUSED, TOOL, NOTHING), (DONE, TOOL, DM3), (DONE, TOOL, DM3), (DONE, TOOL, DM11)]
    if answers != wanted:
        problems.append(f"acknowledged: {answers} instead of {wanted}")
    # What is stored is active: there is nothing that was active before.
    told = [frame.data for frame in log if frame.name == f"18{DM2:04X}82"]
    # One was asked for by `graben faults`.
    if len(told) != 2 or any(one[2:6] != bytes(4) for one in told):
        problems.append(f"DM2: {[data.hex() for data in told]}")
    print(f"workshop: {len(said)} DM1 of up to {max((len(one) for _, one in said), default=0)} codes, "
          f"{len(answers)} acknowledgments")
    return problems + ([f"DM1 late: {late}"] if late else [])


def check_others(out: pathlib.Path) -> list[str]:
    """What j1939cat got of the kernel: every DM1, as it was put together here; and the one that it asked for alone."""
    log = first_run(bus_log.frames(out / "vcan0.log"))
    whole = [(time, message) for time, group, message in broadcasts(log)[0] if group == DM1]
    whole += [(frame.time, frame.data) for frame in log if frame.name == f"18{DM1:04X}82"]
    ours = b"".join(message for _, message in sorted(whole))
    kernels, alone = (out / "dm1").read_bytes(), (out / "to_f8").read_bytes()
    print(f"workshop: the kernel put together {len(kernels)} bytes of DM1 by broadcasts, {len(alone)} for one tool")
    problems = []
    # It goes on with what later runs say.
    if not ours or kernels[:len(ours)] != ours:
        problems.append(f"the kernel has {len(kernels)} bytes of DM1, put together here are {len(ours)}, or other ones")
    if not alone or codes(alone) != max((codes(message) for _, message in whole), key=len):
        problems.append(f"DM1 for one tool: {alone.hex()}")
    return problems


def check_sample(out: pathlib.Path) -> list[str]:
    """DM24 and DM25 as the kernel got them: 18 parameters, and the sample of a fault that came first."""
    both = (out / "to_f6").read_bytes()
    support, frame = both[:72], both[72:]
    fours = [support[at:at + 4] for at in range(0, len(support), 4)]
    spns = [four[0] | four[1] << 8 | four[2] >> 5 << 16 for four in fours]
    if len(both) != 112 or spns != list(range(520448, 520466)) or [four[3] for four in fours] != 17 * [2] + [1] or frame[0] != 39:
        return [f"DM24, DM25: {both.hex()}"]
    fault = (frame[1] | frame[2] << 8 | frame[3] >> 5 << 16) - SPN_BASE
    words = struct.unpack("<17H", frame[5:39])
    # Nothing is measured without a machine; every duty is 0, and the mode is Silent.
    if fault not in MISSING or set(words[:12]) != {0xFFFF} or set(words[12:16]) != {32000} or frame[39] != 0:
        return [f"DM25: fault {fault}, {words}, mode {frame[39]}"]
    return []


def check_tool(out: pathlib.Path) -> list[str]:
    """What `graben faults --can` says."""
    said = json.loads((out / "faults.json").read_text())
    active = {one["fault"] for one in said["active"]["codes"]}
    problems = []
    if active != MISSING or said["previous"]["codes"] or not said["active"]["amber_warning_lamp"] | said["active"]["red_stop_lamp"]:
        problems.append(f"graben faults: {said}")
    if "address 33: DM1: no answer" not in (out / "nobody").read_text() or "cleared" not in (out / "cleared").read_text():
        problems.append("graben faults: nobody, or what was cleared, is not said")
    return problems


def check_claim(out: pathlib.Path) -> list[str]:
    """Who has address 130: said 250 ms before all else, kept five times a second, and lost for good."""
    log = bus_log.frames(out / "vcan1.log")
    ours = bytes.fromhex("0500000000FF0030")
    claims = [frame.time for frame in log if frame.name == "18EEFF82" and frame.data == ours]
    rivals = [frame.time for frame in log if frame.name == "18EEFF82" and frame.data != ours]
    first = min((frame.time for frame in log if frame.name[-2:] == "82" and not frame.name.startswith("18EEFF")), default=0.0)
    problems = []
    if not claims or not 0.245 <= first - claims[0] <= 1.0:
        problems.append(f"claimed {first - claims[0] if claims else 0.0:.3f} s before the first frame")
    storm = [time for time in claims if rivals[1] + 0.5 < time < rivals[1] + 1.5]
    if not 4 <= len(storm) <= 6:
        problems.append(f"{len(storm)} claims in a second of a storm")
    # It was given both, 130 first.
    if not any(frame.name == "18EEFF81" and frame.data == bytes.fromhex("AA00000000000080") for frame in log):
        problems.append("j1939acd has not taken address 129")
    lost = rivals[-1]
    later = [frame for frame in log if frame.time > lost + 0.02 and frame.name[-2:] in ("82", "FE")]
    if [(frame.name, frame.data) for frame in later] != [("18EEFFFE", ours)] or later[0].time > lost + 0.18:
        problems.append(f"after the loss: {[(frame.name, frame.data.hex()) for frame in later][:8]}")
    stats, wrong = stats_file.read(out / "stats_claim")
    if (stats["address_lost"], int(stats["claims_defended"]) >= 2000) != ("1", True) or wrong:
        problems.append(f"stats_claim: lost {stats['address_lost']}, defended {stats['claims_defended']}, {wrong}")
    print(f"workshop: {len(claims)} claims against {len(rivals)}, lost after {lost - claims[0]:.1f} s")
    return problems


def stored(folder: pathlib.Path) -> dict[int, int]:
    """Fault -> occurrences, of the newest copy."""
    newest, payload = -1, b""
    for copy in "ab":
        path = folder / f"faults.{copy}"
        record = path.read_bytes() if path.exists() else bytes(32)
        magic, version, kind, _, _, _, sequence, length, sum_ = struct.unpack("<4sHHHHIQII", record[:32])
        body = record[32:32 + length]
        if magic == b"GRBR" and zlib.crc32(record[:28] + body) == sum_ and (version, kind) == (1, 1) and sequence > newest:
            newest, payload = sequence, body
    entries = struct.iter_unpack("<HIIIIII", payload[20:20 + 26 * int.from_bytes(payload[18:20], "little")])
    return {fault: occurrences for fault, occurrences, *_ in entries}


def check(out: pathlib.Path) -> list[str]:
    problems = check_bus(bus_log.frames(out / "vcan0.log")) + check_others(out) + check_tool(out) + check_sample(out) + check_claim(out)
    before, after = stored(out / "before"), stored(out / "after")
    if set(before) != MISSING or set(before.values()) != {1} or after:
        problems.append(f"stored: {before}, after DM11 {after}")
    frames = {int(path.name[6:9]) for path in (out / "before").glob("frame-*")}
    if frames != MISSING:
        problems.append(f"freeze frames of {sorted(frames)}")
    for name, wanted in (("stats", ("1", "0", "0")), ("stats_again", ("1", "0", "0")), ("stats_full", ("1", "1", "0"))):
        stats, wrong = stats_file.read(out / name)
        problems += [f"{name}: {what}" for what in wrong]
        if (said := tuple(stats[key] for key in ("store", "store_failed", "store_dropped"))) != wanted:
            problems.append(f"{name}: store, store_failed, store_dropped {said} instead of {wanted}")
    lines = (out / "ecu.err").read_text().splitlines()
    begins = ["store /store: new, nothing was there; power cycle 1,", "store /store: read; power cycle 1,",
              "SILENT: address 130 is claimed by another station, NAME 3000ff0000000004, lower than ours,",
              "store /full/store: new, nothing was there;", "store: /full/store/faults.a: No space left on device;"]
    if len(lines) != len(begins) or not all(f"graben-ecu: {begin}" in line for begin, line in zip(begins, lines)):
        problems.append(f"said: {lines}")
    return [*problems, *resident.check(out / "memory")]


if __name__ == "__main__":
    sys.exit(run_programs.main("workshop.sh", check, timeout_s=90.0, modules=("can_j1939",), tools=("j1939cat", "j1939acd")))
