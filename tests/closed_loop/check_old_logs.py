# SPDX-License-Identifier: Apache-2.0
"""Logs of the DBC versions before this one, as they were written then: compared, exported, identified, each by its own
version's layout of EcuStatus; of any other version they are refused with both versions. The page: old_logs.test.ts.

check_old_logs.py GRABEN
"""

import pathlib
import re
import subprocess
import sys
import tempfile

LOGS = pathlib.Path(__file__).parent.parent / "old_logs"
EXCAVATORS = LOGS / "excavator_10.log", LOGS / "excavator_11.log", LOGS / "excavator_12.log"
DOZERS = LOGS / "dozer_7.log", LOGS / "dozer_8.log", LOGS / "dozer_9.log", LOGS / "dozer_10.log"
EXCAVATOR, DOZER = EXCAVATORS[0], DOZERS[0]
# The oldest that is read and this version.
EXCAVATOR_READS, DOZER_READS = (10, 13), (7, 11)


def call(folder, *arguments, status=0):
    done = subprocess.run([sys.argv[1], *map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=60)
    assert done.returncode == status, f"{arguments}: {done.returncode}: {done.stdout}{done.stderr}"
    return done.stderr if status else done.stdout


def shares(folder, log):
    """How long what held lambda, % of the time Active from the first word of it."""
    table = call(folder, "compare", log, log)
    rows = re.findall(r"^held by (.*?)  +([\d.]+)", table, re.MULTILINE)
    return {name: float(share) for name, share in rows if float(share) > 0.0}


def words(folder, log):
    """Limits in the states that an export has in words."""
    call(folder, "export", log, "--mcap", "log.mcap", "--force")
    return re.findall(r'"Mode":"([^"]*)","Limit":"([^"]*)"', (folder / "log.mcap").read_bytes().decode("latin-1"))


def with_version(folder, log, version):
    """The log as controller and machine of another version would have said it."""
    other = folder / f"version_{version}.log"
    other.write_text(re.sub(r"(18FF3482#|0CFF2880#)(.{8})..", rf"\g<1>\g<2>{version:02X}",
                            log.read_text(encoding="ascii")), encoding="ascii")
    return other


def refused(folder, log, version, reads):
    both = f"speaks version {version} of the DBC, this tool reads versions {reads[0]} to {reads[1]}"
    for arguments in (("compare", log, EXCAVATOR), ("compare", DOZER, log), ("export", log, "--mcap", "other.mcap")):
        said = call(folder, *arguments, status=1)
        assert both in said, said
    assert not (folder / "other.mcap").exists()


with tempfile.TemporaryDirectory() as name:
    here = pathlib.Path(name)
    for log in EXCAVATORS:
        found = shares(here, log)
        assert found == {"nothing": 33.3, "behind the plan": 66.7}, (log, found)
        assert words(here, log) == [("Active", "behind the plan"), ("Active", "none")], log
    for log in DOZERS:
        found = shares(here, log)
        assert found == {"what lies ahead": 40.0, "rise of lambda": 60.0}, (log, found)
        assert words(here, log) == [("Active", "what lies ahead"), ("Active", "rise of lambda")], log
    # A fraction of a second is no motion to identify by; that it is of the version before is no reason.
    PROFILE = ("--profile", "excavator_12t", "--out", "new.toml")
    assert "no 5 s in one piece are in it" in call(here, "identify", "--log", EXCAVATOR, *PROFILE, status=1)
    for version in (9, 14):
        other = with_version(here, EXCAVATOR, version)
        refused(here, other, version, EXCAVATOR_READS)
        said = call(here, "identify", "--log", other, *PROFILE, status=1)
        assert f"speaks version {version} of the DBC, this tool reads versions 10 to 13" in said, said
    refused(here, with_version(here, DOZER, 6), 6, DOZER_READS)
