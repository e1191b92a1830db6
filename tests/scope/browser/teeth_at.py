# SPDX-License-Identifier: Apache-2.0
"""The teeth of the 22 t excavator at a time of a log, ground frame, JSON: teeth_at.py GRABEN LOG TIME.
The strokes by the DBC, read with the tests' own code, the rest as `graben pose` has it."""

import json
import pathlib
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests" / "closed_loop"))
import dbc_log  # noqa: E402  pylint: disable=wrong-import-position

graben, log, time_s = sys.argv[1], sys.argv[2], float(sys.argv[3])
strokes = {}
for at_s, name, values in dbc_log.frames(log, dbc_log.read_dbc(ROOT / "can_dbc" / "excavator.dbc")):
    if at_s > time_s:
        break
    if name in ("BoomStroke", "ArmStroke", "BucketStroke"):
        strokes[name] = values[name] * 1e-3
asked = ",".join(str(strokes[name]) for name in ("BoomStroke", "ArmStroke", "BucketStroke"))
done = subprocess.run([graben, "pose", "--profile", "excavator_22t", "--strokes", asked],
                      capture_output=True, text=True, check=True)
tip = json.loads(done.stdout)
with open(ROOT / "app" / "machines" / "excavator_22t.toml", "rb") as stream:
    forward_m, up_m = tomllib.load(stream)["body"]["boom_foot"]
print(json.dumps([tip["x_m"] + forward_m, 0.0, tip["y_m"] + up_m]))
