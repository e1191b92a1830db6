#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A slow path is followed as well as a fast one: exact machine, dry, largest error of the true tip over a loop.

At first drives stood at each change of sign: 18 mm at 0.3 of the speed, 30 mm at a tenth of it.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

# Of the slowest 6 and 5 mm were wanted: what a stroke's resolution hides is as long there as the way of a second.
SPEEDS = {1.0: 1.0, 0.5: 1.0, 0.3: 1.0, 0.1: 1.0, 0.05: 1.3}
MOST_MM = {"excavator_22t": 6.0, "excavator_12t": 5.5}
# Of a lap, against the full speed's over the share of it.
LONGER = 1.05


def dig(graben: str, folder: str, machine: str, speed: float) -> dict:
    summary = pathlib.Path(folder, "slow.json")
    subprocess.run([graben, "dig", "--profile", machine, "--speed", str(speed), "--summary", summary], check=True,
                   stdout=subprocess.DEVNULL)
    return json.loads(summary.read_text())


def main() -> int:
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for machine, most_mm in MOST_MM.items():
            full_s = 0.0
            for speed, more in SPEEDS.items():
                figures = dig(sys.argv[1], folder, machine, speed)
                full_s = full_s or figures["loop_s"]
                off_mm, share = 1e3 * figures["max_error_true_m"], figures["loop_s"] * speed / full_s
                bad = not 0.0 < off_mm <= more * most_mm or not 0.9 < share <= LONGER
                wrong += bad
                print(f"{machine}, speed {speed:g}: {off_mm:.1f} mm ({more * most_mm:.1f} at most), "
                      f"lap {share:.3f} of the full one's{': too much' if bad else ''}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
