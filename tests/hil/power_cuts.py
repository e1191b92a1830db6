# SPDX-License-Identifier: Apache-2.0
"""The store of the deployed process on an ext4 disk whose power is cut: power_cuts.py OUT CUTS GRABEN_ECU.

The guest's QEMU is killed at a random quarter of a second, CUTS times, three times on the same disk: what the guest's
kernel had not told the disk to keep is gone. Whenever the process has ended by itself, its files are as good as
acknowledged: afterwards the disk must have each of these records, or a newer one, whole by its checksum, and the next
start must read them."""

import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

import guest
import machine
from scenario import Broken, Nowhere, Scenario
from workshop import MISSING

HERE = pathlib.Path(__file__).resolve().parent
PROFILE = HERE.parents[1] / "app" / "machines" / "excavator_22t.toml"
MODULES = ("virtio_blk", "crc32c_generic", "ext4")
DISK_MB = 16
# A disk bears 32 writes at once (wear_budget.hpp): eight a run.
CUTS_A_DISK = 3
# Quarters of a second of the guest; a run has 53 and some.
CUT_BETWEEN = (30, 115)
PATIENCE_S = 900.0
BEGAN = re.compile(r"^began: graben-ecu: store \S+: (.*?); power cycle (\d+),", re.MULTILINE)
KEPT = re.compile(r"^kept: (\S+)\.[ab] ([0-9a-f]{48})$", re.MULTILINE)
HEAD = "<4sHHHHIQII"


def cut(arguments: list[str], console: pathlib.Path, chance: random.Random) -> str:
    """Starts the guest and kills it; what it said."""
    with open(console, "wb") as stream:
        process = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=stream, stderr=subprocess.STDOUT,
                                   start_new_session=True)
        try:
            until, wanted = time.monotonic() + PATIENCE_S, chance.randint(*CUT_BETWEEN)
            while console.read_text(errors="replace").count("tick") < wanted:
                if process.poll() is not None or time.monotonic() > until:
                    raise Broken(f"the guest ended by itself: {console.read_text(errors='replace')[-2000:]}")
                time.sleep(0.02)
        finally:
            # timeout and QEMU, which it started: a group of their own.
            subprocess.run(["kill", "-KILL", "--", f"-{process.pid}"], check=False)
            process.wait()
    return console.read_text(errors="replace").replace("\r", "")


def files_on(disk: pathlib.Path, work: pathlib.Path) -> pathlib.Path:
    """The store's folder on a copy of the disk, its journal replayed."""
    copy, files = work / "copy", work / "files"
    shutil.copyfile(disk, copy)
    shutil.rmtree(files, ignore_errors=True)
    files.mkdir()
    checked = subprocess.run([machine.which("e2fsck"), "-fy", copy], capture_output=True, text=True, check=False)
    if checked.returncode > 1:
        raise Broken(f"e2fsck: {checked.stdout}{checked.stderr}")
    subprocess.run([machine.which("debugfs"), "-R", f"rdump /store {files}", copy], capture_output=True, check=True)
    return files / "store"


def sequence(record: bytes) -> int:
    """Of a record that is whole; else -1."""
    size = struct.calcsize(HEAD)
    if len(record) < size:
        return -1
    magic, *_, number, length, sum_ = struct.unpack(HEAD, record[:size])
    body = record[size:size + length]
    return number if magic == b"GRBR" and zlib.crc32(record[:size - 4] + body) == sum_ else -1


def on_disk(folder: pathlib.Path) -> dict[str, int]:
    """Newest sequence of each record."""
    found: dict[str, int] = {}
    for path in folder.glob("*.[ab]"):
        found[path.stem] = max(found.get(path.stem, -1), sequence(path.read_bytes()))
    return found


def acknowledged_in(said: str) -> dict[str, int]:
    found: dict[str, int] = {}
    for name, head in KEPT.findall(said):
        number = struct.unpack_from("<Q", bytes.fromhex(head), struct.calcsize("<4sHHHHI"))[0]
        found[name] = max(found.get(name, -1), number)
    return found


def check_round(number: int, said: str, before: dict[str, int], disk: pathlib.Path, work: pathlib.Path):
    """What is acknowledged by now, and what is wrong."""
    problems = []
    for at, (words, _) in enumerate(BEGAN.findall(said)):
        # A first run that was cut may have written by then, or not.
        if words != "read" and (before or at or words != "new, nothing was there"):
            problems.append(f"cut {number}: start {at + 1} says '{words}'")
    if "FAIL" in said or "store_failed 1" in said:
        problems.append(f"cut {number}: {said[-600:]}")
    acknowledged = before | acknowledged_in(said)
    there = on_disk(files_on(disk, work))
    lost = {name: (told, there.get(name, -1)) for name, told in acknowledged.items() if there.get(name, -1) < told}
    if lost:
        problems.append(f"cut {number}: record: (acknowledged, on the disk) {lost}")
    return acknowledged, problems


def new_disk(disk: pathlib.Path):
    with open(disk, "wb") as stream:
        stream.truncate(DISK_MB << 20)
    subprocess.run([machine.which("mkfs.ext4"), "-q", "-F", disk], check=True)


def run(out: pathlib.Path, cuts: int, program: pathlib.Path) -> list[str]:
    kernel = machine.prepare(guest.CACHE)
    scenario = Scenario(script=HERE / "power_cuts.sh", programs=[program], modules=MODULES, timeout_s=3600.0,
                        files={"ecu.sh": HERE / "ecu.sh", PROFILE.name: PROFILE}, patience_s=PATIENCE_S)
    guest.empty(out)
    (out / "console.txt").touch()
    chance, acknowledged, problems, most = random.Random(50), {}, [], 0
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        disk, ramdisk = work / "disk", work / "ramdisk"
        ramdisk.write_bytes(machine.guest_tree(kernel, scenario).pack())
        arguments = [*machine.command(kernel.image, str(ramdisk), scenario, out),
                     "-drive", f"file={disk},if=virtio,format=raw,cache=writeback"]
        for number in range(1, cuts + 1):
            if number % CUTS_A_DISK == 1:
                new_disk(disk)
                acknowledged = {}
            said = cut(arguments, out / f"console_{number}.txt", chance)
            acknowledged, wrong = check_round(number, said, acknowledged, disk, work)
            problems += wrong
            most = max(most, len(acknowledged))
            print(f"cut {number}: {len(BEGAN.findall(said))} starts, {len(acknowledged)} records acknowledged, newest "
                  f"{max(acknowledged.values(), default=0)}", flush=True)
    if most < 1 + len(MISSING):
        problems.append(f"at most {most} records were acknowledged: nothing was tried")
    return problems


def main() -> int:
    out, cuts, program = pathlib.Path(sys.argv[1]), int(sys.argv[2]), pathlib.Path(sys.argv[3])
    try:
        problems = run(out, cuts, program)
    except Nowhere as reason:
        return guest.give_up("power_cuts.sh", reason)
    except Broken as problem:
        problems = [str(problem)]
    print("\n".join([*problems, f"hil: power_cuts.sh: {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
