# SPDX-License-Identifier: Apache-2.0
"""What `graben faults` says of a controller's store: check_faults.py GRABEN. The store's files are written here, by
the layout of app/ecu/store/record_format.hpp and zlib's checksum, not by the code that is tried."""

import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

FAULTS, FRAME = 1, 2
HASH = 0x00C0FFEE
NOON = 1_800_000_000  # 15 January 2027, 08:00 UTC


def record(kind, index, sequence, payload, profile=HASH, version=1):
    head = struct.pack("<4sHHHHIQI", b"GRBR", version, kind, index, 0, profile, sequence, len(payload))
    return head + struct.pack("<I", zlib.crc32(head + payload)) + payload


def history(*entries, lost=0):
    """(fault, occurrences, first, last, first since 1970, last, power cycle) each; 7 power cycles, 100 h."""
    return struct.pack("<IIIHIH", 360_000, 7, 0xB007, 20, lost, len(entries)) + b"".join(
        struct.pack("<HIIIIII", *entry) for entry in entries)


def frame(fault, kind=0):
    """Two samples, 20 ms before the fault and with it."""
    samples = b"".join(struct.pack("<hBBH17f", ms, mode, 0, 0b1000_0000_0011, *range(1, 17), 0.5)
                       for ms, mode in ((-20, 3), (0, 5)))
    return struct.pack("<HBBIIH", fault, kind, 2, 7_200, NOON, 2) + samples


ENTRIES = (1, 3, 3_600, 7_200, 0, NOON, 5), (11, 1, 90, 90, 0, 0, 7)


def call(graben, *arguments, status=0):
    done = subprocess.run([graben, "faults", *map(str, arguments)], capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == status, f"{arguments}: status {done.returncode}: {done.stderr}"
    return done


def refused(graben, needle, *arguments, status=1):
    done = call(graben, *arguments, status=status)
    assert needle in done.stderr and not done.stdout, f"{arguments}: {done.stderr}{done.stdout}"


def shown(graben, store):
    done = call(graben, "--store", store)
    assert not done.stderr, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0] == f"{store}: profile 00c0ffee, power cycle 7, 100.00 h of operation", lines[0]
    assert lines[2].split() == ["1", "3", "2", "yes", "1:00:00", "2:00:00", "(2027-01-15", "08:00", "UTC)",
                                *"a stroke or angle is missing".split()], lines[2]
    assert lines[3].split()[:6] == ["11", "1", "0", "no", "0:01:30", "0:01:30"], lines[3]
    assert len(lines) == 5, lines

    rows = call(graben, "--store", store, "--frame", 1).stdout.splitlines()
    assert rows[0] == "# fault 1: a stroke or angle is missing; 2:00:00 (2027-01-15 08:00 UTC)", rows[0]
    assert rows[1].startswith("time_s,mode,boom_m,arm_m,bucket_m,swing_rad,boom_cap_pa,"), rows[1]
    # Values that were not valid are empty: of the strokes two were, of the pressures the last one.
    assert rows[2] == "-0.020,Active,1,2,,,,,,,,,,12,13,14,15,16,0.5", rows[2]
    assert rows[3].startswith("0.000,Fault,1,2,") and len(rows) == 4, rows
    refused(graben, "fault 11 has none; there are those of 1", "--store", store, "--frame", 11)

    said = json.loads(call(graben, "--store", store, "--json").stdout)
    assert (said["profile"], said["power_cycle"], said["operation_s"], said["damaged"]) == ("00c0ffee", 7, 360_000, [])
    first, second = said["faults"]
    assert [first[key] for key in ("fault", "occurrences", "first_s", "last_s", "first_unix_s", "last_unix_s",
                                   "power_cycles_since")] == [1, 3, 3_600, 7_200, None, NOON, 2], first
    assert second["fault"] == 11 and second["frame"] is None, second
    assert [sample["time_s"] for sample in first["frame"]["samples"]] == [-0.02, 0.0]
    assert first["frame"]["samples"][0]["bucket_m"] is None and first["frame"]["samples"][1]["lambda"] == 0.5


def not_files(graben, store):
    """What stands in a file's place is told as what it is, and is not waited for."""
    a, b = store / "faults.a", store / "faults.b"
    a.unlink()
    b.unlink()
    os.mkfifo(a)
    b.mkdir()
    refused(graben, f"{a}: is a pipe, no file\n", "--store", store)
    refused(graben, f"{b}: is a folder, no file\n", "--store", store)
    refused(graben, "no stored faults in it that can be read", "--store", store)
    a.unlink()
    b.rmdir()
    a.symlink_to(store / "frame-001.b")
    b.write_bytes(record(FAULTS, 0, 9, history(*ENTRIES)))
    done = call(graben, "--store", store)
    assert done.stderr == f"graben faults: {a}: is a link, no file\n" and "fault" in done.stdout, done.stderr
    said = json.loads(call(graben, "--store", store, "--json").stdout)
    assert said["unreadable"] == [f"{a}: is a link, no file"] and said["damaged"] == [], said
    a.unlink()
    if os.geteuid() != 0:  # Whom no permission keeps out.
        b.chmod(0)
        refused(graben, f"{b}: Permission denied\n", "--store", store)
        b.chmod(0o644)
    b.unlink()


def main():
    graben = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        store = pathlib.Path(folder)
        refused(graben, "neither faults.a nor faults.b is there", "--store", store)
        refused(graben, "there is no such folder", "--store", store / "none")
        # The newest counts, whichever it is; a frame of another profile is not this machine's.
        (store / "faults.a").write_bytes(record(FAULTS, 0, 8, history(*ENTRIES)) + b"the end of a longer one")
        (store / "faults.b").write_bytes(record(FAULTS, 0, 7, history()))
        (store / "frame-001.b").write_bytes(record(FRAME, 1, 1, frame(1)))
        (store / "frame-011.a").write_bytes(record(FRAME, 11, 9, frame(11), profile=HASH + 1))
        shown(graben, store)
        refused(graben, "is no folder", "--store", store / "faults.a")

        # One copy damaged: the other one, and the file's name.
        (store / "faults.b").write_bytes(b"GRBR" + bytes(60))
        done = call(graben, "--store", store)
        assert "damaged: faults.b" not in done.stdout and "faults.b" in done.stderr, done.stderr
        (store / "faults.b").write_bytes(record(FAULTS, 0, 9, history(*ENTRIES))[:-1])
        done = call(graben, "--store", store)
        assert done.stderr == f"graben faults: {store}: damaged: faults.b\n" and "fault" in done.stdout, done.stderr
        damaged = record(FAULTS, 0, 8, history(*ENTRIES))
        (store / "faults.a").write_bytes(damaged[:40] + bytes([damaged[40] ^ 1]) + damaged[41:])
        refused(graben, "damaged: faults.a, faults.b\n", "--store", store)
        refused(graben, "no stored faults in it that can be read", "--store", store)
        not_files(graben, store)
        (store / "faults.a").write_bytes(record(FAULTS, 0, 8, history(), version=2))
        refused(graben, "of a format that this version does not know: faults.a", "--store", store)
        (store / "faults.b").write_bytes(record(FAULTS, 0, 9, history(lost=4)))
        assert json.loads(call(graben, "--store", store, "--json").stdout)["other_format"] == ["faults.a"]
        done = call(graben, "--store", store)
        assert "no fault is stored" in done.stdout and "4 events or freeze frames were lost" in done.stdout

        refused(graben, "--store", status=2)
        refused(graben, "--jsn is no option; did you mean '--json'?", "--store", store, "--jsn", status=2)
        refused(graben, "0 is not a whole number from 1 to", "--store", store, "--frame", 0, status=2)
        for number in ("0x1", "01", "1.0", "-1"):
            refused(graben, f"{number} is not a whole number from 1 to", "--store", store, f"--frame={number}", status=2)
        long = "/" + "a" * 300
        refused(graben, f"graben faults: --store: {long}: File name too long", "--store", long)
        refused(graben, "--frame", "--store", store, "--frame", 1, "--json", status=2)
    print("graben faults: table, frame, JSON, damage and refusals")


if __name__ == "__main__":
    main()
