# SPDX-License-Identifier: Apache-2.0
"""Scripts in, instruction counts out: what check_counts.py, search.py and canary.py share."""

import dataclasses
import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
VECTORS = HERE.parents[1] / "vectors" / "mcv.jsonl"
CASES = {"cycles": HERE / "cases" / "cycles.txt", "solves": HERE / "cases" / "solves.txt"}
OBSERVED = HERE / "observed.json"
WHERE = pathlib.Path("tests", "timing", "counts")


def fail(what: str):
    sys.exit(f"counts: {what}")


@dataclasses.dataclass
class Counted:
    """One script: the counts of its sections, cycles or the one solve."""

    script: str
    counts: list[int]
    other_mode: int = 0  # cycles that ended in another mode than on the host

    @property
    def group(self) -> str:
        return self.script.split()[0]

    @property
    def most(self) -> int:
        return max(self.counts, default=0)

    @property
    def place(self) -> str:
        """Where the most was."""
        at = f"cycle {self.counts.index(self.most)}: " if len(self.counts) > 1 else ""
        return at + self.script


def scripts_of(path: pathlib.Path) -> list[str]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def run(command: list, **options) -> str:
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        fail(f"{' '.join(str(word) for word in command)} ended with status {done.returncode}\n"
             f"{done.stdout[-1000:]}{done.stderr[-1000:]}")
    return done.stdout


class Bench:
    """A build's two counting programs under its emulator, with what the host's build records."""

    def __init__(self, build: pathlib.Path, burn: int = 0):
        about = json.loads((build / WHERE / "target.json").read_text())
        self.target = about["target"]
        self.emulator = about["emulator"]
        self.programs = {"cycles": about["count_cycles"], "solves": about["count_solves"]}
        self.host = pathlib.Path(about["host"]) / WHERE
        self.burn = burn
        if not (self.host / "record_cycles").exists():
            fail(f"nothing has been built in {self.host}: the traces are recorded there "
                 "(cmake --build --preset release)")

    def _record(self, kind: str, scripts: list[str], folder: pathlib.Path):
        listed = folder / "scripts.txt"
        listed.write_text("".join(f"{script}\n" for script in scripts), encoding="utf-8")
        recorded = folder / "recorded"
        if kind == "cycles":
            printed = run([self.host / "record_cycles", listed, recorded])
        else:
            printed = run([self.host / "record_solves", listed, VECTORS, recorded])
        sections = [int(line.split()[0]) for line in printed.splitlines()]
        if len(sections) != len(scripts):
            fail(f"{len(sections)} of {len(scripts)} scripts were recorded")
        return recorded, sections

    def replay(self, kind: str, recorded: pathlib.Path) -> tuple[list[int], list[str]]:
        """Counts of all sections, and what the program printed."""
        counted = recorded.parent / "counts.txt"
        environment = {**os.environ,
                       "QEMU_PLUGIN": f"{self.host / 'libcount_plugin.so'},out={counted}"}
        printed = run([*self.emulator, self.programs[kind], recorded, str(self.burn)],
                      env=environment)
        return [int(line) for line in counted.read_text().split()], printed.splitlines()

    def count(self, kind: str, scripts: list[str], twice: bool = False) -> list[Counted]:
        with tempfile.TemporaryDirectory(prefix="graben-counts-") as name:
            folder = pathlib.Path(name)
            recorded, sections = self._record(kind, scripts, folder)
            counts, printed = self.replay(kind, recorded)
            if len(counts) != sum(sections) or len(printed) != len(scripts):
                fail(f"{self.target}: {len(counts)} sections of {sum(sections)} were counted")
            if twice and self.replay(kind, recorded)[0] != counts:
                fail(f"{self.target}: {kind} do not cost the same in a second run")
        found, at = [], 0
        for script, length, line in zip(scripts, sections, printed):
            other = int(line.split()[1]) if kind == "cycles" else 0
            found.append(Counted(script, counts[at:at + length], other))
            at += length
        return found


def maxima(found: list[Counted]) -> dict[str, Counted]:
    """The dearest script of each group."""
    most: dict[str, Counted] = {}
    for counted in found:
        if counted.group not in most or counted.most > most[counted.group].most:
            most[counted.group] = counted
    return most
