# SPDX-License-Identifier: Apache-2.0
"""The small commands of `graben` as a user types them, good and bad."""

import json
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

MACHINES = pathlib.Path(__file__).resolve().parents[2] / "app" / "machines"


def call(graben, *arguments):
    return subprocess.run([graben, *arguments], capture_output=True, text=True, timeout=1800)


def good(graben, *arguments):
    done = call(graben, *arguments)
    assert done.returncode == 0 and not done.stderr, f"{arguments}: {done.stderr}"
    return json.loads(done.stdout)


def refused(graben, needle, *arguments, status=1):
    done = call(graben, *arguments)
    assert done.returncode == status, f"{arguments}: status {done.returncode}"
    assert needle in done.stderr, f"{arguments}: {done.stderr}"
    assert not done.stdout, f"{arguments}: {done.stdout}"


def pose_and_back(graben):
    machine = ("--profile", "excavator_22t")
    pose = good(graben, "pose", *machine, "--strokes", "1.0,1.1,0.4")
    assert set(pose) == {"x_m", "y_m", "attitude_rad", "joints_rad"}
    assert abs(sum(pose["joints_rad"]) + math.pi - pose["attitude_rad"]) < 1e-12
    strokes = good(graben, "strokes", *machine, "--x", repr(pose["x_m"]), "--y", repr(pose["y_m"]),
                   "--attitude", repr(pose["attitude_rad"]))
    assert strokes["status"] == "ok"
    assert max(abs(a - b) for a, b in zip(strokes["strokes_m"], (1.0, 1.1, 0.4))) < 1e-9
    swung = good(graben, "pose", *machine, "--strokes", "1.0,1.1,0.4", "--swing", "0.5")
    x, y, z = swung["position_m"]
    # The boom foot is 0.10 m ahead of the swing axis and 1.75 m above the ground.
    assert abs(math.hypot(x, y) - pose["x_m"] - 0.10) < 1e-12
    assert abs(math.atan2(y, x) - 0.5) < 1e-12 and abs(z - pose["y_m"] - 1.75) < 1e-12
    far = good(graben, "strokes", *machine, "--x", "15", "--y", "0", "--attitude", "1.5")
    assert far == {"strokes_m": None, "status": "out_of_reach"}
    negative = good(graben, "strokes", *machine, "--x", "-3", "--y", "-1", "--attitude", "-1.5")
    assert negative["status"] != "ok"


def bad_usage(graben):
    machine = ("--profile", "excavator_22t")
    refused(graben, "allowed: 0 .. 1.26 m", "pose", *machine, "--strokes", "2.0,1.1,0.4")
    refused(graben, "arm stroke -0.1 m", "pose", *machine, "--strokes", "1.0,-0.1,0.4")
    refused(graben, "arm stroke: nan is no length; allowed: 0 .. ", "pose", *machine, "--strokes", "1.0,nan,0.4")
    refused(graben, "no_such", "pose", "--profile", "no_such", "--strokes", "1,1,1")
    refused(graben, "strokes", "pose", *machine, status=2)
    refused(graben, "", "pose", *machine, "--strokes", "1.0,1.1", status=2)
    refused(graben, "", "strokes", *machine, "--x", "five", "--y", "0", "--attitude", "1", status=2)
    refused(graben, "", "solve", "--policy", "guess", status=2)
    refused(graben, "", "no-such-command", status=2)
    refused(graben, "", status=2)
    refused(graben, "--can", "plant", status=2)
    refused(graben, "no_such", "plant", "--can", "no_such0")
    refused(graben, "no_such", "plant", "--can", "can0", "--profile", "no_such")
    refused(graben, "nan is not a number", "plant", "--can", "can0", "--speed", "nan", status=2)
    refused(graben, "operator", "plant", "--can", "can0", "--operator", "nobody", status=2)
    program = ("plant", "--can", "can0", "--operator", "program", "--profile")
    refused(graben, "an excavator with a swing drive", *program, "excavator_22t")
    refused(graben, "an excavator", *program, "dozer_9t")
    refused(graben, "'no_such': there is no such file", *program, "excavator_12t", "--task", "no_such")
    refused(graben, "soil, errors none: not with", *program, "excavator_12t", "--soil")
    refused(graben, "0 to 3", *program, "excavator_12t", "--task-number", "4", status=2)
    refused(graben, "only with --operator program", "plant", "--can", "can0", "--task", "flatten")
    refused(graben, "only with --operator program", "plant", "--can", "can0", "--task-number", "0")
    refused(graben, "", "dig", "--speed", "7", status=2)
    refused(graben, "nan is not a number", "dig", "--loops", "nan", status=2)
    refused(graben, "nan is not a number", "dig", "--speed", "nan", status=2)
    refused(graben, "-1 is not a whole number", "dig", "--seed=-1", status=2)
    refused(graben, "'fuzzy' is none of servo, oil, kim", "dig", "--law", "fuzzy", status=2)
    law_without_oil(graben)
    refused(graben, "whole number", "dig", "--seed", "99999999999999999999", status=2)
    refused(graben, "outside the work space", "dig", "--start", "20,0,1.5")
    refused(graben, "--start-strokes: entry 2", "dig", "--start-strokes", "1.0,9.0,0.4")
    refused(graben, "", "dig", "--start", "5,0,1.5", "--random-start", status=2)


def bad_tasks(graben):
    """What is of Kim's path alone goes with no task, and is not silently left out."""
    for option in (("--air",), ("--obstacle",), ("--stiff-oil",),
                   ("--dead-time", "0.1"), ("--fixed-lambda",), ("--law", "kim"), ("--start-strokes", "1,1,0.4"),
                   ("--start", "5,0,1.5"), ("--random-start",), ("--loops", "1")):
        done = call(graben, "dig", "--task", "flatten", *option)
        assert done.returncode == 2 and not done.stdout, f"{option}: {done}"
        assert ": not with " in done.stderr and option[0] in done.stderr and "--task" in done.stderr, \
            f"{option}: {done.stderr}"
    for command, words, of in (("dig", ("--task", ""), "--task"), ("dig", ("--bus", ""), "--bus"),
                               ("dig", ("--summary=",), "--summary"), ("grade", ("--design", ""), "--design"),
                               ("export", ("dig.log", "--mcap", ""), "--mcap"), ("compare", ("", "a"), "an argument"),
                               ("new-machine", ("--out", ""), "--out"), ("campaign dig", ("--draws", "2", "--summary", ""), "--summary")):
        refused(graben, f"graben {command}: {of}: is empty;", *command.split(), *words, status=2)
    refused(graben, "--soil kim: not with --task; there are sand", "dig", "--task", "flatten", "--soil")
    refused(graben, "'mud' is none of kim, sand, loam, clay, stones", "dig", "--soil", "mud", status=2)
    refused(graben, "--soil: only with --sim", "scope", "--log", "no_such", "--soil")
    refused(graben, "of an excavator alone", "scope", "--sim", "grade", "--port", "0", "--soil", "sand")
    refused(graben, "this machine's swing is held", "dig", "--task", "flatten", "--profile",
            "excavator_22t")
    refused(graben, "none, stroke-bias, sensors, parameters, kim, all", "autodig", "--errors", "some",
            status=2)
    refused(graben, "0.01 is not a number from 0.05 to 1", "autodig", "--speed", "0.01", status=2)
    refused(graben, "1.1 is not a number from 0.05 to 1", "autodig", "--swash", "1.1", status=2)
    refused(graben, "nan is not a number", "autodig", "--duration", "nan", status=2)
    refused(graben, "-1 is not a whole number", "autodig", "--seed=-1", status=2)
    refused(graben, "", "autodig", "--rounds", "0", status=2)
    refused(graben, "", "autodig", "--start", "5,0,1.5", status=2)


def uncommissioned(graben):
    """A task that needs drives which `identify` did not find is refused with that reason, or tried slowly."""
    with tempfile.TemporaryDirectory() as name:
        part, folder = pathlib.Path(name) / "part.toml", pathlib.Path(name) / "out"

        def said(drives):
            part.write_text('kind = "excavator"\nlike = "excavator_12t"\n' + "".join(
                f"[valve.answer.{drive}.{side}]\ndriven = [0.3, 0.9]\n" for drive in drives
                for side in ("extend", "retract")), encoding="ascii")

        machine = ("--profile", part, "--simulated", "excavator_12t", "--out", folder)
        said(("boom", "arm", "bucket"))
        needle = "part: needs drives that were not commissioned: swing, left; swing, right; commission and identify"
        refused(graben, needle, "autodig", "--task", "truck_loading", *machine)
        refused(graben, needle, "dig", "--task", "truck_loading", *machine)
        done = call(graben, "autodig", "--task", "truck_loading", *machine, "--unknown-drives", "slow", "--seconds", "1")
        assert "not commissioned: swing, left; swing, right: at 30 % of the speed" in done.stdout, done
        assert "was not finished in time" in done.stderr and ": at 30 % of the speed" in (folder / "autodig.html").read_text(), done
        said(("arm", "bucket", "swing"))
        refused(graben, "not commissioned: boom, extend; boom, retract;", "dig", *machine)
        refused(graben, "is none of slow", "dig", *machine, "--unknown-drives", "fast", status=2)
        # Every command that has a task done: of the boom, of the swing; nothing is begun.
        draws, machine = pathlib.Path(name) / "draws.csv", machine[:4]
        campaign = ("--summary", draws, "--draws", "1", "--jobs", "1", *machine)
        boom, swing = "commissioned: boom, extend; boom, retract; commission", "commissioned: swing, left; swing, right; commission"
        refused(graben, boom, "campaign", "dig", *campaign)
        refused(graben, boom, "campaign", "assist", *campaign)
        refused(graben, boom, "scope", "--sim", "dig", "--port", "0", *machine)
        refused(graben, boom, "plant", "--can", "no_such0", "--operator", "dig", *machine)
        refused(graben, "no_such0", "plant", "--can", "no_such0", *machine)
        done = call(graben, "plant", "--can", "no_such0", "--operator", "dig", *machine, "--unknown-drives", "slow")
        assert "not commissioned: boom" in done.stderr and "no_such0" in done.stderr and not done.stdout, done
        refused(graben, "only with --sim", "scope", "--can", "no_such0", "--unknown-drives", "slow")
        said(("boom", "arm", "bucket"))
        refused(graben, swing, "campaign", "autodig", *campaign)
        refused(graben, swing, "campaign", "fences", *campaign)
        refused(graben, swing, "scope", "--sim", "autodig", "--port", "0", *machine)
        refused(graben, swing, "plant", "--can", "no_such0", "--operator", "program", *machine)
        assert not draws.exists()
        done = call(graben, "campaign", "fences", *campaign, "--unknown-drives", "slow")
        assert done.returncode == 0 and ": at 30 % of the speed" in done.stdout and draws.exists(), done
        (pathlib.Path(name) / "blade.sim.toml").write_text('kind = "dozer"\nlike = "dozer_9t"\n', encoding="ascii")
        blade = pathlib.Path(name) / "blade.toml"
        blade.write_text('kind = "dozer"\nlike = "dozer_9t"\n[hst]\ndriven = [0.1, 0.9]\n', encoding="ascii")
        dozer, needle = ("--profile", blade), "commissioned: blade, extend; blade, retract; commission"
        for kind in ("grade", "designs", "ground"):
            refused(graben, needle, "campaign", kind, "--summary", draws.with_name("dozer.csv"), "--draws", "1", *dozer)
        refused(graben, needle, "scope", "--sim", "grade", "--port", "0", *dozer)
        refused(graben, needle, "plant", "--can", "no_such0", "--operator", "grade", *dozer)


def bad_grades(graben):
    refused(graben, "bounded, constant", "grade", "--speed-mode", "fast", status=2)
    refused(graben, "nan is not a number", "grade", "--speed", "nan", status=2)
    refused(graben, "3.1 is not a number from 0.05 to 3", "grade", "--speed", "3.1", status=2)
    refused(graben, "899 is not a number from 900 to 2200", "grade", "--engine-rpm", "899", status=2)
    refused(graben, "none, all", "grade", "--errors", "sensors", status=2)
    refused(graben, "-1 is not a whole number", "grade", "--errors", "all", "--seed=-1", status=2)
    refused(graben, "it needs --seed", "grade", "--errors", "all")
    refused(graben, "it needs --speed-mode constant", "grade", "--within", "0.02")
    refused(graben, "2 is not a number from 0.001 to 1", "grade", "--within", "2", status=2)
    refused(graben, "no_such", "grade", "--profile", "no_such")
    refused(graben, "a machine of kind excavator; here it must be dozer", "grade", "--profile",
            "excavator_22t")
    refused(graben, "a machine of kind dozer; here it must be excavator", "dig", "--profile",
            "dozer_9t")
    plant = ("plant", "--can", "no_such0")
    dozer = (*plant, "--profile", "dozer_9t")
    refused(graben, "no_such0", *dozer)
    refused(graben, "--operator dig: the profile is not one of an excavator", *dozer, "--operator",
            "dig")
    refused(graben, "--operator grade: the profile is not one of a dozer", *plant, "--operator",
            "grade")
    refused(graben, "--engine-rpm: the profile is not one of a dozer", *plant, "--engine-rpm", "1000")
    for option in (("--soil",), ("--dead-time", "0.1"), ("--errors", "sensors"), ("--fixed-lambda",)):
        refused(graben, "the profile is not one of an excavator", *dozer, *option)


def bad_finds(graben):
    for command in (("dig",), ("autodig",), ("campaign", "dig", "--summary", "no_such.csv")):
        refused(graben, "'colour' is unknown; allowed: oil (0.1 .. 100 GPa)", *command, "--found", "colour=1",
                status=2)
        refused(graben, "oil is there twice; allowed: once, 0.1 .. 100 GPa", *command, "--found", "oil=1,oil=2",
                status=2)
        refused(graben, "mass: a value is missing; allowed: 0.1 .. 10", *command, "--found", "mass=", status=2)
        refused(graben, "exponent: 'nan'; allowed: 0.5 .. 4", *command, "--found", "exponent=nan", status=2)
        refused(graben, "dead_time: '0.6'; allowed: 0 .. 0.5 s", *command, "--found", "dead_time=0.6", status=2)
    refused(graben, "the oil is told to be stiff and of a found bulk modulus", "dig", "--stiff-oil", "--found",
            "oil=1")


def bad_machines(graben):
    """A simulated machine that is not there, is of other drives, or is asked for where none runs."""
    for command in (("dig",), ("autodig",), ("campaign", "dig", "--summary", "no_such.csv"),
                    ("plant", "--can", "no_such0"), ("scope", "--sim", "dig", "--port", "0")):
        refused(graben, "simulated machine 'no_such': there is no such file", *command, "--simulated", "no_such")
        refused(graben, "-1 is not a whole number", *command, "--hidden=-1", status=2)
    refused(graben, "the simulated machine, excavator_22t, has 3 and 2", "dig", "--profile", "excavator_12t",
            "--simulated", "excavator_22t_found")
    refused(graben, "of an excavator alone", "scope", "--sim", "grade", "--port", "0", "--hidden", "1")
    refused(graben, "only with --sim", "scope", "--can", "no_such0", "--hidden", "1")
    refused(graben, "the profile is not one of an excavator", "plant", "--can", "no_such0", "--profile",
            "dozer_9t", "--hidden", "1")


def law_without_oil(graben):
    """A profile may have no [oil]; then it has not that law either."""
    with tempfile.TemporaryDirectory() as folder:
        for name in ("excavator_12t.toml", "excavator_12t.sim.toml"):
            with open(os.path.join(MACHINES, name), encoding="utf-8") as stream:
                text = re.sub(r"^\[oil\].*?(?=^\[)", "", stream.read(), flags=re.MULTILINE | re.DOTALL)
            with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
                stream.write(text.replace('law = "oil"', 'law = "servo"'))
        refused(graben, "the profile has no section [oil]", "dig", "--law", "oil", "--profile",
                os.path.join(folder, "excavator_12t.toml"))


def no_constant_speed(graben):
    """Where not even the slowest will do, the trials are shown and the status says so."""
    done = call(graben, "grade", "--speed-mode", "constant", "--speed", "0.07", "--within", "0.001",
                "--errors", "all", "--seed", "1")
    assert done.returncode == 1 and "no constant speed" in done.stderr, done.stderr
    assert "0.05" in done.stdout and "0.07" in done.stdout, done.stdout
    # Out of tolerance is what this mode is for, and it says so.
    done = call(graben, "grade", "--speed-mode", "constant")
    assert done.returncode == 0 and "cut below it" in done.stdout and "status 0 all the same" in done.stdout, done.stdout


def identify_says_what_next(graben):
    """After a profile, and where none was written; and what a figure that is not there means."""
    with tempfile.TemporaryDirectory() as name:
        log, better = pathlib.Path(name) / "drive.log", pathlib.Path(name) / "better.toml"
        # A swing's fit finds a little more in the same log each time.
        done = call(graben, "commission", "--profile", "excavator_12t", "--log", log, "--only", "boom", "arm", "bucket")
        assert done.returncode == 0 and "swing" in done.stdout, done
        done = call(graben, "identify", "--log", log, "--profile", "excavator_12t", "--out", better)
        assert f"next     graben identify --check --log {log} --profile {better}" in done.stdout, done
        assert re.search(r"^boom, retract .* - ", done.stdout, re.MULTILINE) and "(-: not to be judged" in done.stdout, done
        done = call(graben, "identify", "--log", log, "--profile", better, "--any-machine", "--out",
                    better.with_name("none.toml"))
        needle = f"next: graben identify --check --log {log} --profile {better} says how well it fits"
        assert done.returncode == 1 and needle in done.stderr, done
        # A table without the one drive that is asked for.
        windows, nothing = pathlib.Path(name) / "windows.toml", pathlib.Path(name) / "nothing.log"
        windows.write_text("")
        done = call(graben, "commission", "--profile", "excavator_12t", "--log", nothing, "--only", "swing", "--windows", windows)
        assert done.returncode == 1 and "nothing is left to be tried: left out" in done.stderr, done
        assert not done.stdout and not nothing.exists(), done
    refused(graben, "--log of a machine's log, as `graben commission` writes it", "identify", status=2)


def unwritable(graben):
    with tempfile.TemporaryDirectory() as folder:
        blocked = os.path.join(folder, "file")
        with open(blocked, "w", encoding="ascii") as stream:
            stream.write("kept")
        for command in (("dig",), ("dig", "--task", "flatten"), ("autodig",)):
            refused(graben, "file", *command, "--out", blocked)
        with open(blocked, encoding="ascii") as stream:
            assert stream.read() == "kept"
        below = os.path.join(blocked, "such", "file")
        for command, option in (("dig", "--summary"), ("autodig", "--summary"), ("grade", "--summary"), ("grade", "--log")):
            done = call(graben, command, "--out", folder, option, below)
            assert done.returncode == 1 and blocked in done.stderr and not done.stdout, done


def interrupted(graben):
    """Ctrl-C in a run is told, and leaves nothing that looks like a log."""
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen([graben, "dig", "--loops", "100", "--out", folder], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60.0
        while time.monotonic() < deadline and not os.path.exists(os.path.join(folder, "dig.log.part")):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=1800)
        assert process.returncode == 130 and err == "graben dig: interrupted; nothing was written\n", (out, err)
        assert not os.listdir(folder), os.listdir(folder)


def lost_output(graben):
    with open("/dev/full", "w", encoding="ascii") as full:
        done = subprocess.run([graben, "pose", "--profile", "excavator_22t", "--strokes", "1,1,0.4"],
                              stdout=full, stderr=subprocess.PIPE, text=True, timeout=1800)
    assert done.returncode == 1 and "standard output" in done.stderr, done.stderr
    folder = os.open("/", os.O_RDONLY)
    done = subprocess.run([graben, "solve"], stdin=folder, capture_output=True, text=True, timeout=1800)
    assert done.returncode == 1 and "can't be read" in done.stderr, (done.returncode, done.stderr)


def main():
    graben = sys.argv[1]
    pose_and_back(graben)
    bad_usage(graben)
    bad_tasks(graben)
    uncommissioned(graben)
    bad_grades(graben)
    bad_finds(graben)
    bad_machines(graben)
    no_constant_speed(graben)
    identify_says_what_next(graben)
    unwritable(graben)
    interrupted(graben)
    lost_output(graben)
    print("commands answer as they should")


if __name__ == "__main__":
    main()
