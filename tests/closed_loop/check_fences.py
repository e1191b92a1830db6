# SPDX-License-Identifier: Apache-2.0
"""Random tasks past random fences: no point of the true machine is beyond one, whatever the end; most tasks
are done; what is held away too far would be no work."""

import csv
import os
import subprocess
import sys
import tempfile

# A draw of a machine with all errors is stopped by a fault that has nothing to do with fences now and then.
# Draws and how many are done at least. Without margins 4 of the 120 are beyond a fence.
DRAWS = {"excavator_12t": (20, 6), "excavator_22t": (120, 90)}


def rows_of(graben, profile, draws, folder):
    file = os.path.join(folder, f"{profile}.csv")
    subprocess.run([graben, "campaign", "fences", "--profile", profile, "--draws", str(draws), "--summary", file,
                    "--jobs", "1"], capture_output=True, check=False)
    with open(file, newline="", encoding="utf-8") as stream:
        assert stream.readline().startswith(f"# fences {profile} ")
        return list(csv.DictReader(stream))


def main():
    graben = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        for profile, (draws, done) in DRAWS.items():
            rows = rows_of(graben, profile, draws, folder)
            assert len(rows) == draws, len(rows)
            beyond = [row for row in rows if float(row["beyond_m"]) > 0.0]
            assert not beyond, beyond
            ended = [row for row in rows if row["end"] == "done"]
            assert len(ended) >= done, [row["end"] for row in rows]
            # They do work near fences.
            left = sorted(float(row["fence_left_m"]) for row in ended)
            assert left[0] < 0.15, left
            print(f"{profile}: {len(ended)} of {draws} done, nearest {1e3 * left[0]:.0f} mm")


if __name__ == "__main__":
    main()
