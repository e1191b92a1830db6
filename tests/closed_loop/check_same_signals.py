# SPDX-License-Identifier: Apache-2.0
"""Canary of same_signals.py: check_same_signals.py GRABEN DBC.

A log is compared with itself, and with copies in which one bit, one frame or one definition is another:
only what is told apart by name and what means the same may pass."""

import pathlib
import subprocess
import sys
import tempfile

graben, dbc = sys.argv[1:]
compare = pathlib.Path(__file__).with_name("same_signals.py")
folder = tempfile.TemporaryDirectory()
here = pathlib.Path(folder.name)
log = here / "dig.log"


def expect(status, *texts, new=log, new_dbc=dbc, excepted=()):
    done = subprocess.run(
        [sys.executable, "-B", compare, log, new, "--old-dbc", dbc, "--new-dbc", new_dbc,
         *(["--except", *excepted] if excepted else [])],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    assert done.returncode == status, f"exit status {done.returncode}, not {status}:\n{done.stdout}"
    for text in texts:
        assert text in done.stdout, f"'{text}' is not said:\n{done.stdout}"


def other_log(name, lines):
    (here / name).write_text("".join(lines))
    return here / name


def other_dbc(name, old, new):
    text = pathlib.Path(dbc).read_text()
    assert text.count(old) == 1, f"{old!r} is {text.count(old)} times in the DBC"
    (here / name).write_text(text.replace(old, new))
    return here / name


subprocess.run([graben, "dig", "--out", here], stdout=subprocess.DEVNULL, check=True)
# The first seconds are enough of it.
lines = log.read_text().splitlines(keepends=True)[:6000]
log.write_text("".join(lines))
expect(0, f"frames: {len(lines)} old, {len(lines)} new", "the same to the bit")

# One bit of one signal in one frame: EngineSpeed of EEC1 begins in byte 3; nothing protects it.
at = next(k for k, line in enumerate(lines) if k > 3000 and "0CF00400#" in line)
head, data = lines[at].split("#")
raw = bytearray.fromhex(data.strip())
raw[3] ^= 0x01
bit = other_log("bit.log", [*lines[:at], f"{head}#{raw.hex().upper()}\n", *lines[at + 1:]])
expect(1, "DIFFERS: EEC1.EngineSpeed 1 times", new=bit)
expect(0, "excepted: EEC1.EngineSpeed differs in 1 frames", new=bit, excepted=["EEC1.EngineSpeed"])
expect(1, "DIFFERS: EEC1.EngineSpeed 1 times", new=bit, excepted=["EcuStatus"])
# A bit that no signal has.
raw[3] ^= 0x01
raw[7] ^= 0x80
expect(1, "DIFFERS: EEC1.(unused bits) 1 times",
       new=other_log("unused.log", [*lines[:at], f"{head}#{raw.hex().upper()}\n", *lines[at + 1:]]))

expect(1, "EEC1: 1 frames in the old log, 0 in the new",
       new=other_log("missing.log", lines[:at] + lines[at + 1:]))
expect(1, "EEC1: 1 frames in the old log, 2 in the new",
       new=other_log("twice.log", lines[:at] + lines[at:at + 1] + lines[at:]))
expect(0, "excepted: EEC1 (frames)",
       new=other_log("told.log", lines[:at] + lines[at + 1:]), excepted=["EEC1"])
# The last frame of its moment, a little later.
last = next(k for k in range(at, len(lines)) if lines[k].split()[0] != lines[k + 1].split()[0])
expect(1, "(frames) 2 times",
       new=other_log("later.log", [*lines[:last], lines[last].replace("0) vcan0", "1) vcan0"), *lines[last + 1:]]))
expect(1, "time runs backwards", new=other_log("reversed.log", lines[::-1]))
expect(1, "nothing differs there, or there is no such signal", excepted=["EEC1.EngineSped"])
expect(1, "no frame", new=other_log("empty.log", []))

# The same bits, defined otherwise.
speed = ' SG_ EngineSpeed : 24|16@1+ (0.125,0) [0|8031.875] "rpm" Graben'
expect(1, "DIFFERS: EEC1.EngineSpeed", "and another layout",
       new_dbc=other_dbc("scale.dbc", speed, speed.replace("0.125", "0.25")))
renamed = other_dbc("renamed.dbc", speed, speed.replace("EngineSpeed", "ShaftSpeed"))
expect(1, "EEC1.EngineSpeed is only in the old one", "EEC1.ShaftSpeed is only in the new one",
       new_dbc=renamed)
expect(0, new_dbc=renamed, excepted=["EEC1.EngineSpeed", "EEC1.ShaftSpeed"])
expect(1, "cannot decode this signal", new_dbc=other_dbc("sign.dbc", speed, speed.replace("@1+", "@1-")))
# The same value in other bits: the lower half of the engine's speed, moved by the log and the DBC.
moved = []
for line in lines:
    if "0CF00400#" in line:
        start, data = line.strip().split("#")
        line = f"{start}#{data[:2]}{data[6:10]}{data[2:6]}{data[10:]}\n"
    moved.append(line)
expect(0, "the same to the bit", new=other_log("moved.log", moved),
       new_dbc=other_dbc("moved.dbc", speed, speed.replace("24|16", "8|16")))
print("one bit, one frame and one definition are found")
