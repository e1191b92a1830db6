# SPDX-License-Identifier: Apache-2.0
"""`graben check`: each slip of a profile that is allowed but implausible is warned of, a shipped profile
has none; the page is whole; the reference of keys is the readers': check_warnings.py GRABEN MACHINES_FOLDER."""

import pathlib
import re
import subprocess
import sys
import tempfile

from profile_edit import replaced

EXCAVATOR, SMALL, DOZER, TILTING = "excavator_22t", "excavator_12t", "dozer_9t", "dozer_9t_tilt"
SIM = ".sim"
# (machine, file, text, text with the slip, key that is warned of)
SLIPS = [
    (EXCAVATOR, SIM, "mass = 2130.0", "mass = 213.0", "boom.mass"),
    (EXCAVATOR, SIM, "inertia = 1290.0", "inertia = 12.9", "arm.inertia"),
    (EXCAVATOR, SIM, "mass_centre = [0.62, 0.25]", "mass_centre = [6.2, 2.5]", "bucket.mass_centre"),
    (EXCAVATOR, SIM, "coulomb = [4000.0", "coulomb = [4.0", "friction.coulomb"),
    (EXCAVATOR, SIM, "viscous = [20000.0", "viscous = [20.0", "friction.viscous"),
    (EXCAVATOR, SIM, "port_relief = 38.0e6", "port_relief = 30.0e6", "pump[0].relief"),
    (EXCAVATOR, SIM, "bulk_modulus = 1.4e9", "bulk_modulus = 1.4e8", "valve.bulk_modulus"),
    (EXCAVATOR, SIM, "deadband = 0.2 ", "deadband = 0.5 ", "valve.spool_to_duty"),
    (EXCAVATOR, SIM, "dead_volume = [2.0e-3", "dead_volume = [2.0e-1", "valve.dead_volume"),
    (EXCAVATOR, SIM, "time_constant = 0.020", "time_constant = 0.040", "safety.settle"),
    (EXCAVATOR, SIM, "time_constant = 0.020", "time_constant = 0.060", "control.response"),
    (EXCAVATOR, "", "servo_frequency = 2.4", "servo_frequency = 4.0", "control.servo_frequency"),
    (EXCAVATOR, "", "settle = 0.10", "settle = 0.03", "safety.settle"),
    (EXCAVATOR, "", "sensor_timeout = 0.045", "sensor_timeout = 0.025", "control.sensor_timeout"),
    (EXCAVATOR, "", "rod = 0.100", "rod = 0.010", "arm.cylinder.rod"),
    (EXCAVATOR, "", "boom = [1.50e-4", "boom = [1.50e-6", "valve.boom"),
    (EXCAVATOR, "", "displacement = 119e-6        #", "displacement = 1190e-6        #",
     "pump[0].displacement"),
    (EXCAVATOR, "", "leak_linear = 4e-12", "leak_linear = 4e-10", "pump[0].leak_linear"),
    (EXCAVATOR, "", "pressure_range = 40e6", "pressure_range = 25e6", "sensors.pressure_range"),
    (EXCAVATOR, "", "idle = 94.0", "idle = 200.0", "safety.idle"),
    (EXCAVATOR, "", "open = 4.5e-6", "open = 4.5e-7", "valve.bypass.closed.boom"),
    (EXCAVATOR, "", "boom_foot = [0.10, 1.75]", "boom_foot = [0.10, 0.175]", "body.boom_foot"),
    (EXCAVATOR, "", "swash = 0.643", "swash = 0.0643", "task.swash"),
    (EXCAVATOR, "", "relief = 35.0e6\n", "relief = 3.5e6\n", "pump[0].relief"),
    (SMALL, "", "displacement = 1.2e-3 ", "displacement = 1.2e-2 ", "swing.displacement"),
    (SMALL, SIM, "inertia = 15000.0", "inertia = 150.0", "swing.inertia"),
    (DOZER, "", "valve_flow_max = 2.0e-3", "valve_flow_max = 2.0e-2", "implement.valve_flow_max"),
    (DOZER, "", "gear_ratio = 70.9", "gear_ratio = 7.09", "hst.gear_ratio"),
    (DOZER, "", "speed_desired = 1.6", "speed_desired = 2.2", "travel.speed_desired"),
    (DOZER, "", "mass = 8900.0", "mass = 890.0", "body.mass"),
    (DOZER, "", "mass_centre_height = 0.85", "mass_centre_height = 0.185", "body.mass_centre_height"),
    (DOZER, "", "idle = 94.25", "idle = 60.0", "safety.idle"),
    (DOZER, "", "rod = 0.060", "rod = 0.010", "blade.cylinder.rod"),
    (DOZER, SIM, "mass = 950.0", "mass = 95.0", "blade.mass"),
    (DOZER, SIM, "reach = 1.45", "reach = 0.145", "blade.reach"),
    (DOZER, "", "pitch_inertia = 12000.0", "pitch_inertia = 1200.0", "body.pitch_inertia"),
    (DOZER, SIM, "coulomb = 2500.0", "coulomb = 25.0", "implement.coulomb"),
    (DOZER, SIM, "relief = 21.0e6", "relief = 2.1e6", "implement.relief"),
    (DOZER, SIM, "charge = 2.5e6", "charge = 10.0e6", "hst.charge"),
    (TILTING, "", "rod = 0.050", "rod = 0.010", "tilt.cylinder.rod"),
    (TILTING, "", "valve_flow_max = 1.0e-3", "valve_flow_max = 1.0e-4", "tilt.cylinder.bore"),
    (TILTING, "", "[[0.0, 200.0]", "[[0.0, 600.0]", "tilt.spool_to_duty"),
]


def check(graben, profile, out, *options):
    return subprocess.run([graben, "check", profile, "--out", out, *options], capture_output=True,
                          text=True, timeout=1800)


def slip(graben, folder, scratch, row):
    name, part, old, new, key = row
    for file in ("", SIM):
        text = (folder / f"{name}{file}.toml").read_text(encoding="utf-8")
        (scratch / f"mine{file}.toml").write_text(replaced(text, old, new) if file == part else text,
                                                  encoding="utf-8")
    done = check(graben, scratch / "mine.toml", scratch)
    if done.returncode != 0 or f"warning: {key}: " not in done.stdout:
        yield f"{name}{part}: {new}: status {done.returncode}, no warning of {key}:\n{done.stdout}{done.stderr}"
    elif f"<code>{key}</code>" not in (scratch / "check.html").read_text(encoding="utf-8"):
        yield f"{name}{part}: {new}: the page does not warn of {key}"
    if check(graben, scratch / "mine.toml", scratch, "--strict").returncode != 1:
        yield f"{name}{part}: {new}: --strict passes"


def shipped(graben, folder, scratch, name):
    done = check(graben, name, scratch, "--strict")
    if done.returncode != 0 or "no warnings" not in done.stdout:
        yield f"{name}: status {done.returncode}: {done.stdout}{done.stderr}"
    page = (scratch / "check.html").read_text(encoding="utf-8")
    if re.search(r"(src|href)=|url\(|https?://", page) or "<svg" not in page \
            or re.search(r"\bnan\b", page):
        yield f"{name}: the page needs a network or has no drawing"
    # The same without its simulation: what lacks is said. What it is like has to be beside it.
    text = (folder / f"{name}.toml").read_text(encoding="utf-8")
    (scratch / "alone.toml").write_text(text, encoding="utf-8")
    if like := re.search(r'^like = "(\w+)"$', text, re.MULTILINE):
        (scratch / f"{like[1]}.toml").write_text((folder / f"{like[1]}.toml").read_text(encoding="utf-8"),
                                                 encoding="utf-8")
    done = check(graben, scratch / "alone.toml", scratch, "--strict")
    if done.returncode != 0 or "there is no NAME.sim.toml" not in done.stdout:
        yield f"{name} alone: status {done.returncode}: {done.stdout}{done.stderr}"


ANSWER = """
[valve.answer.boom.retract]
spool_to_duty = [[0.0, 212.0], [0.5, 500.0], [1.0, 950.0]]
dead_time = 0.18
lag = 0.07
spool_time_constant = 0.09
driven = [0.42, 0.90]
[provenance]
"valve.answer.boom.retract.lag" = { deviation = 0.004, from = "drive.log, 2026-11-24" }
"control.law" = { from = "tried" }
"""


def answers(graben, folder, scratch):
    """What a side says and what it does not, and where that is from."""
    for file in ("", SIM):
        text = (folder / f"{EXCAVATOR}{file}.toml").read_text(encoding="utf-8")
        (scratch / f"told{file}.toml").write_text(text if file else text + ANSWER, encoding="utf-8")
    done = check(graben, scratch / "told.toml", scratch, "--strict")
    for row in ("boom, extend 20.0 60.0 100.0 2 0 53 20 334 -",
                "boom, retract 21.2 50.0 95.0 3 180 70 90 334 42 .. 90",
                "arm, extend 20.0 60.0 100.0 2 0 53 20 100 -",
                "valve.answer.boom.retract.lag 0.004 drive.log, 2026-11-24", "control.law - tried"):
        if done.returncode != 0 or row not in re.sub(r" +", " ", done.stdout):
            yield f"without '{row}': status {done.returncode}: {done.stdout}{done.stderr}"
    rest = "not commissioned: boom, extend; arm, extend; arm, retract; bucket, extend; bucket, retract"
    if rest not in " ".join(done.stdout.split()):
        yield f"without '{rest}': {done.stdout}"
    swinging = " ".join(check(graben, "excavator_12t", scratch).stdout.split())
    if "not commissioned: no side of any drive" not in swinging or "swing, right 20.0" not in swinging:
        yield f"a swing without its sides, or without a word of commissioning: {swinging}"


def tilts(graben, scratch):
    """What the tilt's drive does, of a machine that has one. Speeds are the flow over its areas."""
    tables = ("left end of the edge -0.20 0.20 m", "stroke 0.160 0.000 m; extension lowers the left end",
              "left end up 0.227 0.577 92", "left end down 0.157 0.399 134", "(60.0 L/min with", "tilt 33.0 level on its oil")
    for name, has_tilt in ((TILTING, True), (DOZER, False)):
        said = re.sub(r" +", " ", check(graben, name, scratch, "--strict").stdout)
        page = (scratch / "check.html").read_text(encoding="utf-8")
        for row in tables:
            if (row in said) != has_tilt:
                yield f"{name}: '{row}' {'is not' if has_tilt else 'is'} there:\n{said}"
        if ("left end up" in page) != has_tilt:
            yield f"{name}: the page has {'no' if has_tilt else 'a'} tilt"


def main():
    graben, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    wrong = []
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        names = [file.stem for file in sorted(folder.glob("*.toml"))
                 if "." not in file.stem]
        assert {EXCAVATOR, SMALL, DOZER, TILTING} <= set(names), names
        for name in names:
            wrong += shipped(graben, folder, scratch, name)
        wrong += answers(graben, folder, scratch)
        wrong += tilts(graben, scratch)
        for part in ("", SIM):  # What is like another one has that beside it.
            (scratch / f"{DOZER}{part}.toml").write_text((folder / f"{DOZER}{part}.toml").read_text(encoding="utf-8"),
                                                         encoding="utf-8")
        for row in SLIPS:
            wrong += slip(graben, folder, scratch, row)
        (scratch / "wrong.toml").write_text('kind = "dozer"\n', encoding="utf-8")
        if check(graben, scratch / "wrong.toml", scratch).returncode != 1:
            wrong.append("a wrong profile passes")
    keys = subprocess.run([graben, "check", "--keys"], capture_output=True, text=True, timeout=1800)
    if keys.stdout != (folder / "KEYS.md").read_text(encoding="utf-8"):
        wrong.append("app/machines/KEYS.md is not what `graben check --keys` prints")
    print("\n".join(wrong) or f"{len(SLIPS)} slips are warned of")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
