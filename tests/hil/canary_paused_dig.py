# SPDX-License-Identifier: Apache-2.0
"""Proves that the judge of a paused dig can say no: canary_paused_dig.py OUT takes what hil_paused_dig left."""

import json
import pathlib
import re
import sys

import bus_log
import paused_dig
from canary_judge import prove

# Of the area without a pause.
DIGS = 3


def rewrite(name: str, change):
    """`change` gets the frame and whether it is of the time after the pause; returns its bytes."""
    def seed(out: pathlib.Path):
        path = out / "vcan0.log"
        again_s = paused_dig.active_spells(bus_log.frames(path))[1][0]

        def changed(found: re.Match) -> str:
            data = bytearray.fromhex(found[4])
            change(data, float(found[1]) >= again_s)
            return f"({found[1]}) {found[2]} {found[3]}#{data.hex().upper()}"
        path.write_text(re.sub(rf"\((\d+\.\d+)\) (\S+) ({name})#([0-9A-F]*)", changed, path.read_text()))
    return seed


def kind_after(was: int, becomes: int):
    def change(data: bytearray, after: bool):
        if after and data[2] & 0xF == was:
            data[2] = data[2] & 0xF0 | becomes
    return rewrite(paused_dig.TASK_STATUS, change)


def never_neutral(data: bytearray, _: bool):
    data[2] = 1


def left(out: pathlib.Path):
    path = out / "summary.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), "built_within_ratio": 0.94}))


CASES = {
    "an approach": (kind_after(paused_dig.DIG, paused_dig.APPROACH), "after the pause the steps are of kinds"),
    "a touch": (kind_after(paused_dig.SWING, paused_dig.RETURN), "the ground is looked for again"),
    "more digs": (kind_after(paused_dig.DUMP, paused_dig.DIG), "7 digs, 3 without a pause"),
    "no end": (kind_after(paused_dig.DONE, paused_dig.DUMP), "the dig does not end"),
    "duties in the pause": (rewrite(bus_log.SPOOL_COMMAND, never_neutral), "commands of the pause are not neutral"),
    "ground that is left": (left, "paused: not dug to its design"),
}


if __name__ == "__main__":
    OUT = pathlib.Path(sys.argv[1])
    sys.exit(prove("paused_dig", OUT, OUT / "summary.json", lambda out: paused_dig.check(DIGS, out), CASES))
