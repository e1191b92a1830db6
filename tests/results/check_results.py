# SPDX-License-Identifier: Apache-2.0
"""Canary of results.py, on a little book of its own: tables that were written by hand are found, figures
that changed are found, what is stopped goes on, and what can't be read is an error."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM = pathlib.Path(__file__).with_name("results.py")
ROWS = """
[table.speed]
columns = ["figure", "value"]
[run.first]
command = "sh -c 'echo ran >> {counted}; echo \\"{{\\\\\\"a\\\\\\": {{\\\\\\"b_m\\\\\\": 0.0125}}}}\\" > $0/summary.json; echo speed 3.5' {folder}"
patterns = ['^speed (?P<speed>[\\d.]+)']
quick = true
table = "speed"
rows = [["of a summary and the output", "{place_json} at {place_speed}"]]
[run.draws]
command = "sh -c 'test ! -e {hang} || sleep 60; printf \\"# head\\\\nseed,end,x\\\\n1,done,1\\\\n2,done,5\\\\n3,done,2\\\\n\\" > $0/campaign.csv' {folder}"
minutes = 1
table = "speed"
rows = [["of a campaign", "{place_median} / {place_p95} / {place_max}"], ["again", "{place_spread}"]]
"""
PLACES = {"{place_json}": "{a/b_m|mm|.1f} mm", "{place_speed}": "{speed||.2f}",
          "{place_median}": "{x.median||d}", "{place_p95}": "{x.p95||d}", "{place_max}": "{x.max||d}", "{place_spread}": "{x.spread||.1f}"}
README = "# Results\n\n<!-- table speed (tests) -->\n\n<!-- end of table 0 -->\n"
WANTED = ["| of a summary and the output | 12.5 mm at 3.50 |", "| of a campaign | 2 / 5 / 5 |",
          "| again | 2.0 / 5.0 / 5.0 |"]

folder = tempfile.TemporaryDirectory()
here = pathlib.Path(folder.name)
rows, readme, counted, hang = (here / name for name in ("rows.toml", "README.md", "counted", "hang"))
text = ROWS.replace("{counted}", str(counted)).replace("{hang}", str(hang)).replace("{{", "{").replace("}}", "}")
for place, meant in PLACES.items():
    text = text.replace(place, meant)
words = [sys.executable, "-B", str(PROGRAM), "--rows", str(rows), "--readme", str(readme),
         "--state", str(here / "state"), "--build", str(here)]


def expect(status, *said, action):
    done = subprocess.run([*words, *action.split()], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    assert done.returncode == status, f"{action}: exit status {done.returncode}, not {status}\n{done.stdout}"
    for each in said:
        assert each in done.stdout, f"{action}: '{each}' is not said:\n{done.stdout}"


rows.write_text(text)
readme.write_text(README)
expect(1, "table speed is not what was made", "first: no figure in README.md for 'of a summary and the output'",
       "draws: no figure in README.md for 'again'", "3 rows, 4 problems", action="--check")

# What another state of the sources has left there is not gone on with.
(here / "state/first").mkdir(parents=True)
(here / "state/first/stale").touch()
# Stopped in its middle, it goes on with what is left.
hang.touch()
stopped = subprocess.Popen([*words, "--make"], stdout=subprocess.DEVNULL, start_new_session=True)
for _ in range(300):
    if (here / "state/first.json").exists():
        break
    time.sleep(0.1)
os.killpg(stopped.pid, signal.SIGKILL)
stopped.wait()
hang.unlink()
assert readme.read_text() == README, "results were written though nothing was finished"
expect(0, "first: already there", "draws: sh", "3 rows, 0 problems", action="--make")
assert not (here / "state/first/stale").exists(), "a file of another run is still there"
assert counted.read_text() == "ran\n", "the first run was made twice"
written = readme.read_text()
assert all(line in written for line in WANTED), written
expect(0, action="--check")
expect(0, "3 rows, 0 problems", action="--quick")

expect(0, "first: sh", action="--make --again --part 1/2")
expect(0, "draws: sh", action="--make --again --part 2/2")
assert counted.read_text() == "ran\n" * 3, "the second part is not the second run alone"  # --quick ran it too.
assert readme.read_text() == written

for wrong in (written.replace("12.5", "12.4"), written.replace("| of a campaign", "| a campaign"),
              written.replace("<!-- table speed (tests) -->", "")):
    readme.write_text(wrong)
    expect(1, "README.md: ", action="--check")
line = next(line for line in written.splitlines(keepends=True) if WANTED[1] in line)
readme.write_text(written.replace(line, line + line.replace("of a campaign", "of no row")))
expect(1, "table speed is not what was made", "3 rows, 1 problems", action="--check")
readme.write_text(written.replace(line, ""))
expect(1, "draws: no figure in README.md for 'of a campaign'", action="--check")
readme.write_text(written.replace("12.5 mm", "12.4 mm"))
expect(1, "['of a summary and the output', '12.5 mm at 3.50'] now", action="--quick")
# Words that changed in one file alone lose no figure; in both, they are written with their sum.
rows.write_text(text.replace("of a campaign", "of draws"))
readme.write_text(written)
expect(1, "draws: no figure in README.md for 'of draws'", action="--write")
assert readme.read_text() == written, "a figure was lost"
readme.write_text(written.replace("of a campaign", "of draws"))
expect(1, "table speed is not what was made", action="--check")
expect(0, "3 rows, 0 problems", action="--write")
expect(0, action="--check")
rows.write_text(text)
readme.write_text(written)
rows.write_text(text.replace("{x.median||d}", "{y.median||d}"))
expect(1, "no figure 'y.median'", action="--make --again --only draws")
rows.write_text(text.replace("^speed ", "^pace "))
expect(1, "nothing in the output is like", action="--make --only first")
rows.write_text(text.replace("echo speed 3.5", "exit 3"))
expect(1, "exit status 3", action="--make --only first")
rows.write_text(text.replace("quick = true", ""))
expect(1, "nothing was compared", action="--quick")
print("tables, figures and what was stopped: all found")
