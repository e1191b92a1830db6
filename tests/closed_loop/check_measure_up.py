# SPDX-License-Identifier: Apache-2.0
"""What `graben measure-up` refuses, with place and what to do: logs that say nothing of the IMUs, rests that are no
touches, postures that are too much alike, profiles that have no place for what is found."""

import pathlib
import subprocess
import sys
import tempfile

import measure_up

SILENT_ARM = "0CF02AE3#"  # angular rates of address 227


def refused(graben, folder, words, *options):
    done = subprocess.run([graben, "measure-up", *options], capture_output=True, text=True, cwd=folder,
                          check=False)
    assert done.returncode != 0, f"{options}: not refused: {done.stdout}"
    for word in words:
        assert word in done.stderr, f"{options}: {word!r} is not in: {done.stderr}"
    assert not (folder / "new.toml").exists(), f"{options}: wrote a profile"


def written(graben, folder, options):
    """The turns and their deviations come into the profile's own text, and nothing else changes."""
    measure_up.call(graben, folder, "measure-up", *options, "--out", "found.toml")
    old, new = ((folder / file).read_text(encoding="utf-8").splitlines() for file in ("mine.toml", "found.toml"))
    changed = [line for line in new if line not in old]
    assert sum("turn = " in line for line in changed) == 3, changed
    assert sum("deviation = " in line and "touch.log sha256" in line for line in changed) == 3, changed
    assert [line for line in old if line not in new] == [line for line in old if "address = " in line], changed
    measure_up.call(graben, folder, "check", "found.toml")
    refused(graben, folder, ["found.toml: is there already"], *options, "--out", "found.toml")
    # What was found is right: then nothing is left to find.
    again = measure_up.call(graben, folder, "measure-up", *(word.replace("mine.toml", "found.toml") for word in options),
                            "--any-machine")
    assert again.count(" by 0.00 deg") + again.count(" by -0.00 deg") == 3, again


def bad_logs(graben, folder, options):
    log = (folder / "touch.log").read_text(encoding="ascii").splitlines(keepends=True)
    rest = [word for at, word in enumerate(options) if "--log" not in (word, options[at - 1])]

    def judged(name, lines, *words):
        (folder / name).write_text("".join(lines), encoding="ascii")
        refused(graben, folder, [name, *words], "--log", name, *rest, "--out", "new.toml")

    judged("silent.log", [line for line in log if SILENT_ARM not in line], "the arm's IMU (address 227)", "226, 228")
    judged("empty.log", [], "no angular rates")
    (folder / "short.log").write_text("".join(log[:9000]), encoding="ascii")
    refused(graben, folder, ["there is no rest 8"], "--log", "short.log", *rest)
    measure_up.call(graben, folder, "dig", "--profile", "mine.toml", "--out", "dug", "--loops", "0.2")
    refused(graben, folder, ["touches of the peg; at least 4"], "--log", "dug/dig.log", "--profile", "mine.toml", "--height",
            "-1.4")


def bad_words(graben, folder):
    log = ("--log", "touch.log", "--profile", "mine.toml")
    refused(graben, folder, ["--height", "--rise", "--keep"], *log, "--touches", "2-7", "--second", "8-13")
    refused(graben, folder, ["too much alike", "Missing: the arm turned by"], *log, "--touches", "2-7", "--height", "-1.45")
    refused(graben, folder, ["the rest at 1.0 s (line", "Leave it out (--touches)"], *log, "--touches", "1-7", "--second",
            "8-13", "--height", "-1.45", "--rise", "0")
    refused(graben, folder, ["no common point"], *log, "--touches", "2-13", "--height", "-1.45")
    for touches, words in (("2-", "a number is missing"), ("2-99", "there is no rest 99"), ("2;3", "what is this"),
                           ("0-4", "there is no rest 0")):
        refused(graben, folder, ["--touches", words, "1 .. 13"], *log, "--touches", touches, "--height", "-1.45")
    refused(graben, folder, ["rest 4 is of --touches and of --second"], *log, "--touches", "2-7", "--second", "4-9",
            "--height", "-1.45")
    refused(graben, folder, ["has no [imu]"], "--log", "touch.log", "--profile", "excavator_22t.toml", "--height", "-1.45")
    refused(graben, folder, ["has no [imu]"], "--record", "new.log", "--profile", "excavator_22t.toml")
    (folder / "like.toml").write_text('like = "whole"\n', encoding="utf-8")
    (folder / "whole.toml").write_text((folder / "excavator_22t.toml").read_text(encoding="utf-8")
                                       + measure_up.SECTION.format(machine="", bucket="at = [0.7, 0.0]").split("\n", 1)[1],
                                       encoding="utf-8")
    refused(graben, folder, ["its [imu] is that of the profile that it is like"], "--log", "touch.log", "--profile",
            "like.toml", "--height", "-1.45", "--out", "new.toml")
    (folder / "other.toml").write_text((folder / "mine.toml").read_text(encoding="utf-8").replace("0.3", "0.4"),
                                       encoding="utf-8")
    refused(graben, folder, ["is of a machine with profile", "--any-machine"], "--log", "touch.log", "--profile",
            "other.toml", "--height", "-1.45")
    refused(graben, folder, ["touch.log: is there already"], "--record", "touch.log", "--profile", "mine.toml")


def main():
    graben, machines = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        measure_up.machine_in(machines, folder, "excavator_22t")
        options = measure_up.touched(graben, folder, "--imu-mounting", "0.035", "--errors", "sensors", "--seed", "1")
        written(graben, folder, options)
        bad_logs(graben, folder, options)
        bad_words(graben, folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
