# SPDX-License-Identifier: Apache-2.0
"""Runs a command of rows.toml and reads figures from what it leaves: names, each with a number. As a
program it prints the word for the state of the sources that a figure is remembered with."""

import csv
import datetime
import hashlib
import json
import math
import pathlib
import re
import shlex
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
# What a thorough run writes itself is no other state of the sources.
WRITTEN = ("tests/README.md", "tests/timing/counts/observed.json",
           "tests/memory/observed.toml", "tests/gates/whole_run.toml")


class Failure(Exception):
    """A command failed, or did not leave the figure that was looked for."""


def rank(values: list[float], share: float) -> float:
    """Nearest rank, as `graben campaign` has it: a figure is that of a draw."""
    return sorted(values)[max(0, math.ceil(share * len(values)) - 1)]


def spread(lists: dict[str, list[float]]) -> dict[str, float]:
    return {f"{name}.{word}": figure for name, values in lists.items() if values
            for word, figure in (("median", rank(values, 0.5)), ("p95", rank(values, 0.95)),
                                 ("max", max(values)), ("min", min(values)))}


def flat(value, path: str = "") -> dict[str, float]:
    """Numbers of a JSON document by their path: a/b/0; in a list of solvers by its name."""
    if isinstance(value, dict):
        parts = value.items()
    elif isinstance(value, list):
        parts = [(part.get("solver", at) if isinstance(part, dict) else at, part)
                 for at, part in enumerate(value)]
    else:
        return {path: value} if isinstance(value, (int, float)) else {}
    return {name: figure for key, part in parts
            for name, figure in flat(part, f"{path}/{key}" if path else str(key)).items()}


def of_campaign(path: pathlib.Path) -> dict[str, float]:
    """Median, 95th percentile, largest and least of each column of numbers."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    columns: dict[str, list[float]] = {}
    for row in csv.DictReader(lines):
        for name, text in row.items():
            try:
                columns.setdefault(name, []).append(float(text))
            except ValueError:
                pass
    return spread(columns)


def number(text: str) -> float:
    return float(text.replace(",", ""))


def of_output(patterns: list[str], output: str) -> dict[str, float]:
    found = {}
    output = re.sub(r"^\d+: ", "", output, flags=re.MULTILINE)  # ctest's number of the test
    for pattern in patterns:
        matches = list(re.finditer(pattern, output, re.MULTILINE))
        if not matches:
            raise Failure(f"nothing in the output is like {pattern!r}:\n{output[-2000:]}")
        found.update({name: number(text) for name, text in matches[-1].groupdict().items()})
    return found


def command_of(run: dict, folder: pathlib.Path, build: pathlib.Path, each="") -> list[str]:
    """./run of a table is the tool itself here: nobody wants it to look for something to build."""
    words = [word.replace("{folder}", str(folder)).replace("{each}", str(each)).replace("build/release", str(build))
             for word in shlex.split(run["command"])]
    if words[0] == "./run" and words[1:2] != ["bench"]:
        return [str(build / "app/cli/graben"), *words[1:]]
    return words


def once(run: dict, folder: pathlib.Path, build: pathlib.Path, each="") -> dict[str, float]:
    folder.mkdir(parents=True, exist_ok=True)
    command = command_of(run, folder, build, each)
    try:
        done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, text=True, check=False)
    except OSError as error:
        raise Failure(f"{command[0]}: {error.strerror}") from error
    if done.returncode != run.get("status", 0):
        raise Failure(f"{shlex.join(command)}: exit status {done.returncode}\n{done.stdout[-2000:]}")
    figures = {}
    if (summary := folder / "summary.json").exists():
        figures |= flat(json.loads(summary.read_text()))
    if (table := folder / "campaign.csv").exists():
        figures |= of_campaign(table)
    return figures | of_output(run.get("patterns", []), done.stdout)


def measure(run: dict, folder: pathlib.Path, build: pathlib.Path) -> dict[str, float]:
    """Figures of a run; of several, one for each word of `each`, their spread."""
    if "each" not in run:
        return once(run, folder, build)
    lists: dict[str, list[float]] = {}
    for each in run["each"]:
        for name, figure in once(run, folder / str(each), build, each).items():
            lists.setdefault(name, []).append(figure)
    return spread(lists)


def git(*words: str) -> str:
    done = subprocess.run(["git", "-C", str(ROOT), *words], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else ""


def sources() -> str:
    """Another word for each state of the sources: a figure of another one is not gone on with. Manuals and
    what is written down here are none."""
    tracked = [line for line in git("ls-tree", "-r", "HEAD").splitlines()
               if not line.endswith((".md", *WRITTEN))]
    changed = git("diff", "HEAD", "--", ".", ":!*.md", *(f":!{name}" for name in WRITTEN))
    return hashlib.sha256("\n".join([*tracked, changed]).encode()).hexdigest()[:16]


def today() -> str:
    return datetime.date.today().isoformat()


def remembered(path: pathlib.Path, key: dict) -> dict | None:
    try:
        state = json.loads(path.read_text())
    except (OSError, ValueError):
        return None
    return state if state.get("key") == key else None


def begin(folder: pathlib.Path, key: dict):
    """A campaign goes on with the draws that its file has: only with those of the same sources."""
    begun = folder / "begun.json"
    if remembered(begun, key) is None:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        begun.write_text(json.dumps({"key": key}) + "\n")


def make(name: str, run: dict, state_folder: pathlib.Path, build: pathlib.Path, again: bool) -> dict:
    """The figures of a run and their date, from the state folder if they are there already."""
    key = {"run": run, "sources": sources(), "build": str(build)}
    path = state_folder / f"{name}.json"
    state = None if again else remembered(path, key)
    if state:
        print(f"{name}: already there", flush=True)
        return state
    print(f"{name}: {run['command']}", flush=True)
    begin(state_folder / name, key)
    state = {"key": key, "date": today(), "figures": measure(run, state_folder / name, build)}
    # Whole or not at all: whoever is stopped here begins this one again.
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps(state, indent=1) + "\n")
    partial.replace(path)
    return state


if __name__ == "__main__":
    print(sources())
