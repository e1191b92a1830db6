# SPDX-License-Identifier: Apache-2.0
"""`graben identify --log` and `--check`: a simulated commissioning becomes a better profile, and what is wrong with a
log, a profile or an output is said. check_identify_log.py GRABEN COMMISSION_LOG MACHINES"""

import gzip
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib

STROKE = {"boom": 0x0CFF2080, "arm": 0x0CFF2180, "bucket": 0x0CFF2280}
PRESSURE = {"boom": 0x0CFF2380, "arm": 0x0CFF2480, "bucket": 0x0CFF2580}
PUMPS, VALVE, IDENTITY, DUTY, ENGINE = 0x0CFF2680, 0x0CFF2983, 0x0CFF2880, 0x0CFF3082, 0x0CF00400
NEUTRAL = 32000
FROM = {"seed": 3}


class Log:
    """Lines of candump -L as (microseconds, id, bytes)."""

    def __init__(self, frames):
        self.frames = frames

    @classmethod
    def read(cls, path):
        frames = []
        for line in path.read_text().splitlines():
            stamp, _, frame = line.split()
            identity, data = frame.split("#")
            frames.append((int(stamp[1:-1].replace(".", "")), int(identity, 16), bytes.fromhex(data)))
        return cls(frames)

    def text(self):
        return "".join(f"({at // 10**6}.{at % 10**6:06d}) vcan0 {identity:08X}#{data.hex().upper()}\n"
                       for at, identity, data in self.frames)

    def until(self, seconds):
        begin = self.frames[0][0]
        return Log([frame for frame in self.frames if frame[0] < begin + seconds * 1e6])

    def without(self, *identities):
        return Log([frame for frame in self.frames if frame[1] not in identities])

    def edited(self, identities, edit):
        """edit(number of the frame among these, data) gives the new data, whose checksum is made here."""
        count = 0
        frames = []
        for at, identity, data in self.frames:
            if identity in identities:
                data = protected(identity, edit(count, bytearray(data)))
                count += 1
            frames.append((at, identity, data))
        return Log(frames)

    def shifted(self, after, by):
        begin = self.frames[0][0]
        return Log([(at + int(by * 1e6) * (at > begin + after * 1e6), identity, data)
                    for at, identity, data in self.frames])


def protected(identity, data):
    """The checksum of AUTOSAR profile 11 over data id and data; MachineIdentity and EEC1 have none."""
    if identity in (IDENTITY, ENGINE):
        return bytes(data)
    crc = 0
    for byte in ((identity >> 8) & 0xFF, (identity >> 16) & 0xFF, *data[1:]):
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x1D) & 0xFF if crc & 0x80 else crc << 1
    return bytes([crc, *data[1:]])


def put(*words):
    """An edit that writes these 16 bit words from byte 2 on."""
    def edit(_, data):
        for at, word in enumerate(words):
            data[2 + 2 * at:4 + 2 * at] = word.to_bytes(2, "little")
        return data
    return edit


def every(step, edit):
    return lambda count, data: edit(count, data) if count % step == 0 else data


class Tool:
    def __init__(self, graben, folder, machines):
        self.graben, self.folder, self.machines = graben, folder, machines
        self.profile = folder / "mine.toml"
        shutil.copy(machines / "excavator_22t.toml", self.profile)
        self.cases = 0

    def call(self, *arguments):
        return subprocess.run([self.graben, "identify", *map(str, arguments)], capture_output=True, text=True,
                              errors="replace")

    def files(self):
        return {path: path.stat().st_mtime_ns for path in self.folder.rglob("*")}

    def refused(self, needle, *arguments, status=1):
        self.cases += 1
        before = self.files()
        done = self.call(*arguments)
        assert done.returncode == status, f"{arguments}: status {done.returncode}, {done.stdout}{done.stderr}"
        assert needle in done.stderr, f"{arguments}: {needle!r} is not in: {done.stderr}"
        assert self.files() == before, f"{arguments}: left {set(self.files()) ^ set(before)}"

    def bad_log(self, needle, log, *arguments, name="bad.log"):
        path = self.folder / name
        path.write_bytes(log if isinstance(log, bytes) else log.text().encode())
        self.refused(needle, "--log", path, "--profile", self.profile, "--out", self.folder / "none.toml", *arguments)
        path.unlink()


def finds(tool, log_file):
    """One log, one better profile; all that the report, the summary and the file have to say."""
    out, report, summary = (tool.folder / name for name in ("better.toml", "new/better.html", "better.json"))
    begin = time.monotonic()
    done = tool.call("--log", log_file, "--profile", tool.profile, "--out", out, "--report", report, "--summary",
                     summary)
    assert done.returncode == 0 and not done.stderr, done.stdout + done.stderr
    said = json.loads(summary.read_text())
    print(f"{said['logs'][0]['length_s']:.0f} s of log in {time.monotonic() - begin:.1f} s; error of the speed "
          f"{100 * said['old']['error_share']:.1f} -> {100 * said['new']['error_share']:.1f} %")
    print(done.stdout)
    assert said["new"]["error_share"] < 0.5 * said["old"]["error_share"], said
    old, new = (tomllib.loads(path.read_text()) for path in (tool.profile, out))
    assert new["valve"]["answer"]["boom"]["extend"]["spool_to_duty"][0][1] != 200.0
    assert len(new["provenance"]) == len(said["values"]) > 20
    assert all("sha256" in entry["from"] for entry in new["provenance"].values())
    new["valve"].pop("answer"), new.pop("provenance")
    for axis in STROKE:
        old["valve"].pop(axis), new["valve"].pop(axis)
    for pumps in (old["pump"], new["pump"]):
        [pump.pop("displacement") for pump in pumps]
    found = {"valve": 0, "sensors": 0, "safety": 0, "control": 0}
    assert {**old, **found} == {**new, **found}
    # A late machine is led more slowly, by a law that bears it.
    late = ("law", "convergence_length", "servo_gain", "servo_damping", "pressure_filter")
    assert new["control"]["law"] == "servo"
    assert {**old["control"], **dict.fromkeys(late)} == {**new["control"], **dict.fromkeys(late)}
    assert old["valve"] == new["valve"]
    kept = [line for line in tool.profile.read_text().splitlines() if line.startswith("#")]
    assert [line for line in out.read_text().splitlines() if line in kept] == kept
    page = report.read_text()
    assert page.count("<svg") == 9 and "http" not in page.replace("http-equiv", ""), page.count("<svg")
    for word in ("What remains unexplained", "What is missing", "boom, extend", "valve.boom", "class=\"band\""):
        assert word in page, word
    return out


def checks(tool, log_file, better):
    """The old profile is off by the log, the new one is not."""
    done = tool.call("--check", "--log", log_file, "--profile", tool.profile)
    assert done.returncode == 0 and "than the profile says" in done.stdout, done.stdout + done.stderr
    done = tool.call("--check", "--log", log_file, "--profile", better, "--before", tool.profile, "--limit", "6",
                     "--summary", tool.folder / "check.json")
    print(done.stdout)
    assert done.returncode == 0, done.stdout + done.stderr
    said = json.loads((tool.folder / "check.json").read_text())
    assert said["now"]["error_share"] < 0.5 * said["before"]["error_share"], said
    # The log that a profile was found from is no stranger to it.
    done = tool.call("--check", "--log", log_file, "--profile", better)
    assert done.returncode == 0 and "later than the profile says" not in done.stdout, done.stdout + done.stderr
    done = tool.call("--check", "--log", log_file, "--profile", tool.profile, "--limit", "3")
    assert done.returncode == 1 and "--limit allows 3 %" in done.stderr, done.stderr
    # The arm gets slower: its strokes go only nine tenths of their way.
    slow = tool.folder / "slow.log"
    slow.write_text(Log.read(log_file).edited({STROKE["arm"]}, lambda _, data: put(
        round(0.92 * int.from_bytes(data[2:4], "little")))(_, data)).text())
    done = tool.call("--check", "--log", slow, "--profile", better, "--any-machine")
    assert "the arm, extending, is " in done.stdout and "% slower than the profile says" in done.stdout, done.stdout
    slow.unlink()


def works_on_less(tool, log):
    """What a log does not have stays, and is said."""
    def keep(axis):
        field = {"boom": 0, "arm": 1, "bucket": 2}[axis]

        def edit(_, data):
            words = [int.from_bytes(data[at:at + 2], "little") if at == 2 + 2 * field else NEUTRAL for at in (2, 4, 6)]
            return put(*words)(_, data)
        still = {STROKE[other] for other in STROKE if other != axis}
        return log.edited({DUTY, VALVE}, edit).edited(still, put(12000))

    path, out = tool.folder / "part.log", tool.folder / "part.toml"
    path.write_text(keep("boom").text())
    done = tool.call("--log", path, "--profile", tool.profile, "--out", out)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "arm, extend: was not driven" in done.stdout, done.stdout
    new = tomllib.loads(out.read_text())
    assert set(new["valve"]["answer"]) == {"boom"}, new["valve"]["answer"].keys()
    out.unlink()
    # What no limit can judge is named, not passed in silence.
    done = tool.call("--check", "--log", path, "--profile", tool.profile, "--limit", "99")
    assert done.returncode == 0 and "no steady speed to judge: the arm, extending; " in done.stdout, done.stdout
    path.write_text(log.shifted(150.0, 30.0).text())
    done = tool.call("--log", path, "--profile", tool.profile, "--out", out)
    assert done.returncode == 0 and "a gap of 30.0 s at " in done.stdout, done.stdout + done.stderr
    # A second time only by --force, and another machine only by --any-machine.
    tool.refused("is there already; --force overwrites it", "--log", path, "--profile", tool.profile, "--out", out)
    other = log.edited({IDENTITY}, lambda _, data: bytes([data[0] ^ 1, *data[1:]]))
    path.write_text(other.text())
    done = tool.call("--log", path, "--profile", tool.profile, "--out", out, "--force", "--any-machine")
    assert done.returncode == 0, done.stdout + done.stderr
    path.unlink(), out.unlink()


def bad_contents(tool, log):
    short = log.until(40.0)
    text = short.text()
    tool.bad_log("is empty", b"")
    tool.bad_log("bad.log:1: \"not a log\" is not a line of candump -L", b"not a log\n")
    tool.bad_log("bad.log:1: is no text", b"\x00\x01\x02\xff" * 100)
    tool.bad_log("bad.log:3: is no text", b"(1.000000) can0 123#00\n" * 2 + b"(1.0\x0000) can0 123#00\n" * 2)
    tool.bad_log("is cut off or damaged (gzip)", gzip.compress(text.encode())[:-3000], name="bad.log.gz")
    tool.bad_log("no frame of an excavator on our bus (2 frames of others)",
                 b"(1.000000) can0 123#00\n(1.010000) can0 123#00\n")
    tool.bad_log("is the log of a dozer's bus",
                 Log([(10000 * n, 0x0CFF5080, protected(0x0CFF5080, bytes(8))) for n in range(800)]))
    tool.bad_log("the machine speaks version 3 of the DBC",
                 short.edited({IDENTITY}, lambda _, data: bytes([*data[:4], 3, *data[5:]])))
    tool.bad_log("two machines in one log",
                 short.edited({IDENTITY}, lambda n, data: bytes([data[0] ^ (n > 8), *data[1:]])))
    tool.bad_log("is of a machine with profile",
                 short.edited({IDENTITY}, lambda _, data: bytes([data[0] ^ 1, *data[1:]])))
    tool.bad_log("no 5 s in one piece are in it", short.until(3.0), name="short.log")
    tool.bad_log("s of motion; at least 20 s are needed", short.until(12.0))
    tool.bad_log("is not in it", Log([f for f in short.frames if f[1] in (*STROKE.values(), DUTY)]))
    tool.bad_log("no SpoolCommand is in it", Log([f for f in short.frames if f[1] in STROKE.values()]))
    tool.bad_log("the stroke of the arm is not in it", short.without(STROKE["arm"]))
    tool.bad_log("the cap pressure of the bucket is not in it", short.without(PRESSURE["bucket"]))
    tool.bad_log("the engine's speed is not in it", short.without(ENGINE))
    tool.bad_log("the swash of pump 1 is not in it", short.without(PUMPS))
    tool.bad_log("the stroke of the boom: 50 % of its frames have no value in range",
                 short.edited({STROKE["boom"]}, every(2, put(0xFFFF))))
    tool.bad_log("the rod pressure of the arm: 100 % of its frames have no value in range",
                 short.edited({PRESSURE["arm"]}, lambda _, data: bytes([*data[:4], 0xFE, 0xFF, *data[6:]])))
    tool.bad_log("the boom's stroke is 1.900 m; the profile's cylinder has 0 .. 1.26 m",
                 short.edited({STROKE["boom"]}, every(500, put(38000))))
    damaged = [(at, identity, bytes([data[0] ^ (n % 10 == 0 and identity not in (IDENTITY, ENGINE)), *data[1:]]))
               for n, (at, identity, data) in enumerate(short.frames)]
    tool.bad_log("of its frames have a wrong checksum or length", Log(damaged))
    still = short.edited(set(STROKE.values()), put(12000)).edited({DUTY, VALVE}, put(NEUTRAL, NEUTRAL, NEUTRAL))
    tool.bad_log("no cylinder moves by its valve", still)
    tool.bad_log("the engine stands throughout",
                 short.edited({ENGINE}, lambda _, data: bytes([*data[:3], 0, 0, *data[5:]])))
    # Every duty is a whole one: nothing says where a valve begins to open.
    saturated = log.edited({DUTY, VALVE}, lambda _, data: put(*(
        NEUTRAL + (20000 if word > NEUTRAL + 200 else -20000 if word < NEUTRAL - 200 else 0)
        for word in (int.from_bytes(data[at:at + 2], "little") for at in (2, 4, 6))))(_, data))
    path = tool.folder / "full.log"
    path.write_text(saturated.text())
    done = tool.call("--log", path, "--profile", tool.profile, "--out", tool.folder / "full.toml")
    assert done.returncode in (0, 1) and ("old value" in done.stdout or "nothing was written" in done.stderr), done
    assert (tool.folder / "full.toml").exists() == (done.returncode == 0)
    (tool.folder / "full.toml").unlink(missing_ok=True), path.unlink()


def bad_files(tool, log_file, better):
    out = tool.folder / "none.toml"
    usual = ("--log", log_file, "--profile", tool.profile)
    tool.refused("there is no such file", "--log", tool.folder / "gone.log", "--profile", tool.profile, "--out", out)
    tool.refused("is a folder", "--log", tool.folder, "--profile", tool.profile, "--out", out)
    tool.refused("is the same log as", "--log", log_file, log_file, "--profile", tool.profile, "--out", out)
    tool.refused("there is no such file", "--log", log_file, "--profile", tool.folder / "gone.toml", "--out", out)
    tool.refused("here it must be excavator", "--log", log_file, "--profile", "dozer_9t", "--out", out)
    tool.refused("describes a simulated machine", "--log", log_file, "--profile",
                 tool.machines / "excavator_22t.sim.toml", "--out", out)
    broken = tool.folder / "broken.toml"
    broken.write_text("kind = \"excavator\"\n[boom\n")
    tool.refused("line 2", "--log", log_file, "--profile", broken, "--out", out)
    broken.write_text(tool.profile.read_text().replace("displacement = 119e-6", "displacement = nan"))
    tool.refused("pump[0].displacement", "--log", log_file, "--profile", broken, "--out", out)
    broken.unlink()
    tool.refused("would overwrite", *usual, "--out", tool.profile)
    tool.refused("would overwrite", *usual, "--out", tool.profile, "--force")
    tool.refused("would overwrite", *usual, "--out", log_file, "--force")
    tool.refused("would overwrite", *usual, "--out", out, "--report", out)
    tool.refused("is there already", *usual, "--out", better)
    tool.refused("can't be written", *usual, "--out", log_file / "folder.toml")
    # A place that takes no file is known before the fit.
    tool.refused("can't be written", *usual, "--out", "/proc/better.toml")
    tool.refused("can't be written", *usual, "--out", out, "--report", log_file / "folder.html")
    tool.refused("can't be written", *usual, "--out", out, "--summary", tool.folder)
    foreign = tool.folder / "foreign.toml"
    foreign.write_text(re.sub(r"sha256 [0-9a-f]{12}", "sha256 000000000000", better.read_text()))
    tool.refused("is of a machine with profile", "--check", "--log", log_file, "--profile", foreign)
    foreign.unlink()
    for needle, arguments in (
            ("--csv, or --log of a machine's log, as `graben commission` writes it, is required", ("--summary", out)),
            ("--profile is required", ("--log", log_file, "--out", out)),
            ("--out, or --check, is required", usual),
            ("not with", (*usual, "--out", out, "--check")),
            ("not with", (*usual, "--out", out, "--csv", log_file)),
            ("only with", (*usual, "--before", tool.profile, "--out", out)),
            ("is not a number", (*usual, "--check", "--limit", "nan"))):
        tool.refused(needle, *arguments, status=2)


def interrupted(tool, log_file):
    """Whenever it is stopped, there is a whole profile or none."""
    before = tool.files()
    for wait in (0.05, 0.4, 1.5):
        process = subprocess.Popen([tool.graben, "identify", "--log", log_file, "--profile", tool.profile, "--out",
                                    tool.folder / "none.toml", "--report", tool.folder / "none.html"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(wait)
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=1800) in (-signal.SIGINT, 130, 1), process.returncode
        assert tool.files() == before
    tool.cases += 1


def worse(tool, log_file, better):
    """A log that contradicts what was fitted is worth no profile: here each cylinder goes the other way."""
    log = Log.read(log_file)
    path = tool.folder / "worse.log"
    turned = log.edited({STROKE[axis] for axis in STROKE}, lambda _, data: put(
        20000 - min(20000, int.from_bytes(data[2:4], "little")))(_, data))
    path.write_text(turned.text())
    tool.refused("nothing was written", "--log", log_file, path, "--profile", better, "--any-machine", "--out",
                 tool.folder / "none.toml")
    path.unlink()


def commissions_one_pump(graben, folder):
    """A machine whose bus has room for a pump that it has not, and that swings: all of it is found and said."""
    def run(*words):
        return subprocess.run([graben, *words], capture_output=True, text=True, check=False)

    log, better = folder / "one.log", folder / "one.toml"
    done = run("commission", "--profile", "excavator_12t", "--hidden", "5", "--log", log)
    assert done.returncode == 0 and "graben identify" in done.stdout, done.stdout[-400:] + done.stderr
    assert "swing, right: step 4 of 4" in done.stdout and "left out" not in done.stdout, done.stdout
    done = run("identify", "--log", log, "--profile", "excavator_12t", "--out", better, "--summary", folder / "one.json")
    assert done.returncode == 0, done.stdout[-400:] + done.stderr
    for word in ("swing, left", "swing, right", "once its command is neutral", "commissioned: every drive, both sides"):
        assert word in done.stdout, (word, done.stdout)
    text = better.read_text(encoding="utf-8")
    assert "[valve.answer.swing.retract]" in text and "swing.inertia" in text, text
    assert json.loads((folder / "one.json").read_text())["swing"]["coasts_left"]["angle_rad"] > 0.02
    log.unlink()
    done = run("commission", "--profile", "excavator_12t", "--hidden", "5", "--log", log, "--only", "bucket",
               "--no-touch", "bucket-retracted,bucket-extended", "--no-bursts")
    assert "left out, and so not identified: all of the swing" in done.stdout, done.stdout
    done = run("identify", "--log", log, "--profile", "excavator_12t", "--out", better, "--force")
    assert "swing, left: was not driven" in done.stdout, done.stdout + done.stderr
    assert "not commissioned: boom, extend; boom, retract; arm" in done.stdout, done.stdout


def main(graben, commission_log, machines):
    with tempfile.TemporaryDirectory() as name:
        tool = Tool(graben, pathlib.Path(name), pathlib.Path(machines))
        log_file = tool.folder / "drive.log"
        subprocess.run([commission_log, tool.machines / "excavator_22t.toml", str(FROM["seed"]), log_file], check=True)
        log = Log.read(log_file)
        better = finds(tool, log_file)
        checks(tool, log_file, better)
        bad_contents(tool, log)
        bad_files(tool, log_file, better)
        works_on_less(tool, log)
        worse(tool, log_file, better)
        interrupted(tool, log_file)
        commissions_one_pump(graben, tool.folder)
        print(f"{tool.cases} bad cases refused")
        assert tool.cases >= 50, tool.cases


main(*sys.argv[1:])
