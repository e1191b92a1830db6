# SPDX-License-Identifier: Apache-2.0
"""Machines with parts off the shelf, on their bus profiles: each digs its path, and what was on its bus, and frames that
standards and data sheets print, read by Wireshark, a decoder that is not ours.  check_buses.py GRABEN"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

# bus, most of the true tip's largest error without errors, m
BUSES = (("slopes", 0.015), ("encoders", 0.010), ("inclinometers", 0.015), ("aux_valves", 0.030),
         ("valve_driver", 0.010), ("retrofit", 0.050))
NODES = {1, 2, 3, *range(33, 39)}
OUR_ADDRESS = 130
START, BOOT_UP, PRE_OPERATIONAL, OPERATIONAL = 1, 0, 127, 5
# EAO series 09 keypad manual, boot-up sequence; Pepperl+Fuchs, Absolute Rotary Encoder, CANopen manual 2017-04, table
# 7.10; Honeywell TARS-LCASS user manual 32332897 B, 7.2; ISO 11783-7, B.13: half flow, extend.
PRINTED = """(0000000001.000000) can0 70B#00
(0000000001.010000) can0 70B#7F
(0000000001.020000) can0 000#010B
(0000000001.030000) can0 70B#05
(0000000001.040000) can0 18B#201C0000
(0000000001.050000) can0 0CF029E2#00007D00007D0005
(0000000001.060000) can0 0CFE3182#7DFF31FFFFFFFFFF
"""


def dissected(log, protocol, fields):
    """Rows of a log's frames of a protocol, by tshark; a number or a text a field, None where there is none."""
    words = ["tshark", "-r", str(log), "-d", f"can.subdissector,{protocol}", "-Y", protocol, "-T", "fields", "-E",
             "separator=;"]
    for field in fields:
        words += ["-e", field]
    text = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    rows = []
    for line in text.splitlines():
        cells = line.split(";")
        rows.append([None if not cell else cell if field.endswith(("bytes", "data")) else int(cell, 0)
                     for cell, field in zip(cells, fields)])
    return rows


CANOPEN = ("canopen.node_id", "canopen.nmt_ctrl.cd", "canopen.nmt_ctrl.node_id", "canopen.nmt_guard.state",
           "canopen.pdo.data.bytes")
J1939 = ("j1939.pgn", "j1939.src_addr", "j1939.data")


def of_bytes(text):
    return bytes.fromhex(text.replace(":", ""))


def check_printed(folder):
    log = folder / "printed.log"
    log.write_text(PRINTED, encoding="utf-8")
    rows = dissected(log, "canopen", CANOPEN)
    states = [row[3] for row in rows if row[3] is not None]
    assert states == [BOOT_UP, PRE_OPERATIONAL, OPERATIONAL], rows
    assert [(row[1], row[2]) for row in rows if row[1] is not None] == [(START, 0x0B)], rows
    assert [of_bytes(row[4]) for row in rows if row[4]] == [(7200).to_bytes(4, "little")], rows
    rows = dissected(log, "j1939", J1939)
    wanted = [(61481, 0xE2, "00007d00007d0005"), (65073, OUR_ADDRESS, "7dff31ffffffffff")]
    assert [(row[0], row[1], of_bytes(row[2]).hex()) for row in rows] == wanted, rows


def check_nodes(log):
    """Each boots, is told to start, and only then sends what it measures."""
    booted, told, runs = set(), [], set()
    for node, command, meant, state, data in dissected(log, "canopen", CANOPEN):
        if command is not None:
            assert command == START and meant in booted, (command, meant)
            told.append(meant)
        elif state is not None:
            assert state != BOOT_UP or node not in booted, f"node {node} booted twice"
            assert state != OPERATIONAL or node in told, f"node {node} runs untold"
            booted.add(node)
        elif data:
            assert node in told, f"node {node} measures untold"
            runs.add(node)
    assert set(told) == NODES and runs == NODES, (told, runs)


def check_valves(log):
    flows = {}
    for group, address, data in dissected(log, "j1939", J1939):
        if 65072 <= group <= 65087:
            said = of_bytes(data)
            assert address == OUR_ADDRESS and said[0] <= 250 and said[2] & 0x0F in (0, 1, 2) and said[2] >> 6 == 0, data
            assert said[2] & 0x0F or said[0] == 0, f"{data}: a flow to neither side"
            flows.setdefault(group, set()).add(said[2] & 0x0F)
    assert flows == {group: {0, 1, 2} for group in (65072, 65073, 65074)}, flows


def check_slopes(log):
    seen = set()
    for group, address, data in dissected(log, "j1939", J1939):
        if group == 61481:
            pitch = int.from_bytes(of_bytes(data)[:3], "little") / 32768 - 250
            assert -180 <= pitch <= 180, data
            seen.add(address)
    assert seen == {0xE2, 0xE3, 0xE4, 0xE5}, seen


def check_profile_on(graben, folder):
    """`check --bus` says what a machine does without on that bus, and the hash that its controller then has."""
    for bus, words in (("slopes", "slope sensors or joint angles"), ("zx200", "zx200: angles, pilot pressures"),
                       ("encoders", "nothing")):
        done = subprocess.run([graben, "check", "excavator_22t", "--bus", bus, "--out", str(folder)], capture_output=True,
                              text=True, check=False)
        assert done.returncode == 0 and words in done.stdout, f"{bus}: {done.stdout}{done.stderr}"
        if bus != "zx200":
            number = re.search(r"hash ([0-9a-f]{8})", done.stdout)[1]
            on_bus = bytes.fromhex(number)[::-1].hex().upper()
            assert f"#{on_bus}" in (folder / bus / "dig.log").read_text(encoding="ascii"), f"{bus}: {number}"
    for profile, bus, words in (("dozer_9t", "zx200", "a dozer is on no bus but ours"),
                                ("excavator_12t", "zx200", "it carries no swing"), ("excavator_22t", "none", "none")):
        done = subprocess.run([graben, "check", profile, "--bus", bus, "--out", str(folder)], capture_output=True, text=True,
                              check=False)
        assert done.returncode == 1 and words in done.stderr, f"{profile} on {bus}: {done.stdout}{done.stderr}"


def main():
    graben = sys.argv[1]
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        check_printed(folder)
        for bus, most in BUSES:
            out = folder / bus
            summary = folder / f"{bus}.json"
            done = subprocess.run([graben, "dig", "--bus", bus, "--out", str(out), "--summary", str(summary)],
                                  capture_output=True, text=True, check=False)
            assert done.returncode == 0, f"{bus}: {done.stdout}{done.stderr}"
            error = json.loads(summary.read_text(encoding="utf-8"))["max_error_true_m"]
            print(f"{bus}: {error * 1e3:.1f} mm")
            assert error < most, f"{bus}: {error} m"
        check_profile_on(graben, folder)
        check_nodes(folder / "retrofit" / "dig.log")
        check_valves(folder / "retrofit" / "dig.log")
        check_slopes(folder / "slopes" / "dig.log")
    return 0


if __name__ == "__main__":
    sys.exit(main())
