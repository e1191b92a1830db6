"""Wrong profiles are refused with every error listed: check_profiles.py GRABEN MACHINES_FOLDER."""

import json
import os
import re
import subprocess
import sys
import tempfile


def pose(graben, profile, strokes="1.0,1.1,0.4"):
    return subprocess.run([graben, "pose", "--profile", profile, f"--strokes={strokes}"],
                          capture_output=True, text=True, timeout=60)


def replaced(text, old, new):
    assert text.count(old) >= 1, f"'{old}' is not in the profile"
    return text.replace(old, new, 1)


# (what is wrong, change, what the message must contain: key path, value, unit, allowed range)
CASES = [
    ("out of range", lambda t: replaced(t, "bore = 0.120", "bore = 12.0"),
     ["boom.cylinder.bore", "12", "0.02 .. 1 m", "line "]),
    ("wrong sign", lambda t: replaced(t, "length = 5.70", "length = -5.70"),
     ["boom.length", "-5.7", "0.1 .. 30 m"]),
    ("unit mix-up", lambda t: replaced(t, "relief = 35.0e6", "relief = 350.0"),
     ["pump[0].relief", "350", "1000000 .. 100000000 Pa"]),
    ("not a number", lambda t: replaced(t, "density = 870.0", "density = nan"),
     ["valve.density", "not finite", "kg/m3"]),
    ("infinite", lambda t: replaced(t, "density = 870.0", "density = inf"),
     ["valve.density", "not finite"]),
    ("text", lambda t: replaced(t, "discharge = 0.62", 'discharge = "0.62"'),
     ["valve.discharge", "is not a number"]),
    ("missing key", lambda t: replaced(t, "force_offset = 2000.0", ""),
     ["valve.force_offset: missing"]),
    ("unknown key", lambda t: replaced(t, "force_offset = 2000.0",
                                       "force_offset = 2000.0\nforce_ofset = 1.0"),
     ["valve.force_ofset", "unknown key"]),
    ("unknown section", lambda t: t + "\n[typo]\nx = 1\n", ["typo.x", "unknown key"]),
    ("c_drain above c_check", lambda t: replaced(t, "c_drain = 7.0e-7", "c_drain = 1.2e-6"),
     ["valve.regeneration.arm.c_drain", "less than c_check"]),
    ("c_drain equal to c_check", lambda t: replaced(t, "c_drain = 7.0e-7", "c_drain = 1.1e-6"),
     ["valve.regeneration.arm.c_drain", "less than c_check"]),
    ("unknown policy", lambda t: replaced(t, 'lambda_policy = "global"', 'lambda_policy = "best"'),
     ["control.lambda_policy", "best", "algorithm1, connected, global"]),
    ("no rise", lambda t: replaced(t, "lambda_rise = 6.0", "lambda_rise = 0.0"),
     ["control.lambda_rise", "0.1 .. 100 1/s"]),
    ("reserve below 0", lambda t: replaced(t, "lambda_rise_reserve = 4", "lambda_rise_reserve = -4"),
     ["control.lambda_rise_reserve", "-48000", "0 .. 100000 N"]),
    ("all of the reserve and more", lambda t: replaced(t, "hold_share = 0.75", "hold_share = 1.75"),
     ["control.lambda_hold_share", "1.75", "0 .. 1"]),
    ("servo", lambda t: replaced(replaced(t, "servo_gain = 2.0", "servo_gain = -2.0"),
                                 "servo_least_lambda = 0.2", "servo_least_lambda = 0.0"),
     ["2 errors", "control.servo_gain", "0 .. 20 1/s", "control.servo_least_lambda", "0.01 .. 1"]),
    ("servo's low-pass", lambda t: replaced(replaced(t, "servo_frequency = 2.4",
                                                     "servo_frequency = 0.0"),
                                            "servo_damping = 0.4", "servo_damping = 0.0"),
     ["2 errors", "control.servo_frequency", "0.2 .. 100 Hz", "control.servo_damping",
      "0.1 .. 10"]),
    ("dead time", lambda t: replaced(t, "dead_time = 0.0 ", "dead_time = 0.9 "),
     ["valve.dead_time", "0 .. 0.5 s"]),
    ("soil", lambda t: replaced(t, "sine = 0.20", "sine = 20"),
     ["experiment.soil.sine", "0 .. 1"]),
    ("obstacle", lambda t: replaced(t, "stiffness = 2e7", "stiffness = 2e3"),
     ["experiment.obstacle.stiffness", "N/m"]),
    ("air path out of reach", lambda t: replaced(t, "y = [-1.1, 2.0]", "y = [1.1, 5.0]"),
     ["experiment.air.path", "leaves the work space"]),
    ("in-flow check valve", lambda t: replaced(t, "force_offset = 2000.0",
                                               "force_offset = 2000.0\ninflow_check = { arm = 0.0 }"),
     ["valve.inflow_check.arm", "0"]),
    ("table not increasing", lambda t: replaced(t, "[[0.0, 200.0], [1.0, 1000.0]]",
                                                "[[0.0, 200.0], [1.0, 100.0]]"),
     ["valve.spool_to_duty", "strictly increasing"]),
    ("table not whole", lambda t: replaced(t, "[[0.0, 200.0], [1.0, 1000.0]]",
                                           "[[0.0, 200.0], [0.9, 1000.0]]"),
     ["valve.spool_to_duty", "opening 1"]),
    ("one pump", lambda t: re.sub(r"\[\[pump\]\] +# Pump 2(.|\n)*?\n\n", "", t, count=1),
     ["pump", "must be 2 tables"]),
    ("pin on the wrong side", lambda t: replaced(t, "eye = [2.33, 0.85]", "eye = [2.33, -0.85]"),
     ["boom.angle", "the pins and stroke ends give"]),
    ("path out of reach", lambda t: replaced(replaced(t, "x = [3.5, 6.5]", "x = [7.5, 10.5]"),
                                             "[[3.5, 0.785398], [6.5, 2.094395]]",
                                             "[[7.5, 0.785398], [10.5, 2.094395]]"),
     ["experiment.path", "leaves the work space"]),
    ("rod thicker than bore", lambda t: replaced(t, "rod = 0.085", "rod = 0.125"),
     ["boom.cylinder.rod", "less than the bore"]),
    ("wrong kind", lambda t: replaced(t, 'kind = "excavator"', 'kind = "crane"'),
     ["kind", "crane", "allowed: excavator"]),
    ("broken TOML", lambda t: replaced(t, "[arm]", "[arm"), ["line "]),
    ("two at once", lambda t: replaced(replaced(t, "discharge = 0.62", "discharge = 62"),
                                       "spool_travel = 0.010", "spool_travel = 10"),
     ["2 errors", "valve.discharge", "valve.spool_travel"]),
]


def main():
    graben, folder = sys.argv[1:]
    shipped = [name for name in sorted(os.listdir(folder)) if name.endswith(".toml")]
    wrong = [] if shipped else ["no shipped profile"]
    for name in shipped:
        done = pose(graben, os.path.join(folder, name))
        if done.returncode != 0 or "x_m" not in json.loads(done.stdout):
            wrong.append(f"{name} does not load: {done.stderr}")
    with open(os.path.join(folder, "excavator_22t.toml"), encoding="utf-8") as stream:
        good = stream.read()
    with tempfile.TemporaryDirectory() as scratch:
        path = os.path.join(scratch, "changed.toml")
        for what, change, needles in CASES:
            with open(path, "w", encoding="utf-8") as stream:
                stream.write(change(good))
            done = pose(graben, path)
            missing = [needle for needle in needles if needle not in done.stderr]
            if done.returncode != 1 or done.stdout or missing:
                wrong.append(f"{what}: status {done.returncode}, without {missing}:\n{done.stderr}")
    print("\n".join(wrong) or f"{len(shipped)} shipped, {len(CASES)} wrong profiles told")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
