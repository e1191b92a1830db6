# SPDX-License-Identifier: Apache-2.0
"""A dozer from steel to a grade by the tool's own commands: commissioned, identified, checked; what was not tried is named
by identify and check, and grade refuses it unless told to go slowly.

check_dozer_identify.py GRABEN
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile


def call(folder, *arguments, status=0):
    done = subprocess.run([sys.argv[1], *map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == status, f"{arguments}: {done.returncode}: {done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def scores(text):
    """Of the table of speeds, by drive: the columns' errors, %."""
    return {name: [float(value) for value in re.findall(r"([\d.]+) %", rest)]
            for name, rest in re.findall(r"^(blade|tilt|tracks) +(.*)$", text, re.MULTILINE)}


def whole(here):
    text = call(here, "commission", "--profile", "dozer_9t_tilt", "--hidden", 3, "--log", "all.log")
    assert re.search(r"^tracks: from 3\.0 m behind to 3\.0 m before", text, re.MULTILINE), text
    machine_s = float(re.search(r"machine time (\d+) s", text).group(1))
    assert machine_s < 300.0, text
    assert "there already" in call(here, "commission", "--profile", "dozer_9t_tilt", "--log", "all.log", status=1)
    text = call(here, "identify", "--log", "all.log", "--profile", "dozer_9t_tilt", "--out", "better.toml",
                "--summary", "found.json", "--report", "page.html")
    assert "commissioned: every drive, both sides, and the tracks" in text, text
    for name, (old, new) in scores(text).items():
        assert new < 0.75 * old, (name, old, new)
    assert "not found: the gauge" in text and "report   page.html" in text, text
    page = (here / "page.html").read_text(encoding="utf-8")
    for needle in ("tilt, retracting", "implement.answer.tilt.retract.dead_time", "not found: the gauge", "<svg"):
        assert needle in page, needle
    assert page.count("<svg") == 4 and "http" not in page.replace("http://www.w3.org", ""), page[:500]
    found = json.loads((here / "found.json").read_text(encoding="ascii"))["found"]
    assert found["implement.answer.tilt.retract.dead_time"]["deviation"], found
    checked = call(here, "identify", "--check", "--log", "all.log", "--profile", "better.toml", "--before",
                   "dozer_9t_tilt")
    assert scores(checked) == scores(text), checked
    assert "is off" in call(here, "identify", "--check", "--log", "all.log", "--profile", "better.toml", "--limit", 1,
                            status=1).replace("% off", "is off")
    assert "commissioned: every drive" in call(here, "check", "better.toml")
    assert "another profile" in call(here, "identify", "--log", "all.log", "--profile", "dozer_9t", "--out",
                                     "other.toml", status=1)
    assert not (here / "other.toml").exists()


def part(here):
    text = call(here, "commission", "--profile", "dozer_9t", "--only", "blade", "--log", "blade.log")
    assert "left out, and so not identified: all of the tracks" in text, text
    text = call(here, "identify", "--log", "blade.log", "--profile", "dozer_9t", "--out", "blade.toml")
    assert "not driven, and so not found: tracks" in text and "not commissioned: tracks" in text, text
    (here / "blade.sim.toml").write_text("kind = \"dozer\"\nlike = \"dozer_9t\"\n", encoding="ascii")
    refused = call(here, "grade", "--profile", "blade.toml", "--out", "refused", status=1)
    assert "needs drives that were not commissioned: tracks" in refused and "--unknown-drives slow" in refused, refused
    assert "not commissioned: tracks" in call(here, "grade", "--profile", "blade.toml", "--within", "0.02",
                                              "--speed-mode", "constant", status=1)
    slow = call(here, "grade", "--profile", "blade.toml", "--unknown-drives", "slow", "--out", "slow")
    assert "not commissioned: tracks: at 30 % of the speed" in slow, slow
    for words, said in ((("--only", "swing"), "no such drive"), (("--no-touch", "boom-extended"), "--no-touch"),
                        (("--can", "vcan9"), "a dozer's windows are confirmed by a file"),
                        (("--simulated", "excavator_22t"), "--simulated")):
        text = call(here, "commission", "--profile", "dozer_9t", "--log", "none.log", *words, status=1)
        assert said in text, text
    (here / "windows.toml").write_text("[tracks]\nleast = -0.5\nmost = 3.0\nspeed = 1.0\n", encoding="ascii")
    text = call(here, "commission", "--profile", "dozer_9t", "--windows", "windows.toml", "--log", "none.log", status=1)
    assert "from -0.50 to 3.00 m; allowed: at least 1.5 m to each side" in text, text
    assert not (here / "none.log").exists()


with tempfile.TemporaryDirectory() as name:
    whole(pathlib.Path(name))
    part(pathlib.Path(name))
