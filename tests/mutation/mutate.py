#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: the tests notice when the safety code is changed.

Makes every mutant of a file that changes one comparison, one whole number in a comparison, one
boolean operator or one truth value; compiles it, links it before the archive that has the original,
and runs the test, which has to fail or to loop. A mutant that no test can tell from the original is
listed with its reason in the file of equivalent ones, and then has to survive.

What loops burns processor time, however loaded the machine is. A test that merely did not end in
time is no verdict, and the gate is red.

Operators are found by the blanks around them, which clang-format puts there and nowhere else."""

import argparse
import concurrent.futures
import dataclasses
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import tomllib

# Each to its neighbours and to its negation; between them they tell <, == and > apart.
COMPARISONS = {"<": ("<=", "!=", ">="), "<=": ("<", "==", ">"), ">": (">=", "!=", "<="),
               ">=": (">", "==", "<"), "==": ("!=", "<=", ">="), "!=": ("==", "<", ">")}
OTHERS = {"&&": ("||",), "||": ("&&",), "true": ("false",), "false": ("true",)}


def beside(number: str) -> list[str]:
    value = int(number.rstrip("UL"))
    suffix = number.lstrip("0123456789")
    return [f"{n}{suffix}" for n in (value - 1, value + 1) if n >= 0]


RULES = (
    (re.compile(r"(?<= )(?:<=|>=|==|!=|<|>)(?= |$)"), lambda token: COMPARISONS[token]),
    (re.compile(r"(?<= )(?:&&|\|\|)(?= |$)|\b(?:true|false)\b"), lambda token: OTHERS[token]),
    (re.compile(r"!(?=[\w(:])"), lambda token: ("",)),
    # A whole number that something is compared with: one less, one more.
    (re.compile(r"(?:(?<= [<>] )|(?<= [<>=!]= ))[0-9]+(?:U|L|UL)?(?![\w.'])"), beside),
)
# What is no code: comments, literals, the preprocessor, and claims that only the compiler checks.
NO_CODE = re.compile(r'//.*|^\s*#.*|^\s*static_assert.*|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'')
INCLUDE = re.compile(r"^#include .*$", re.MULTILINE)
# Of processor time. The tests themselves take hundredths of a second and get TEST_S at most.
TEST_S = 1
LOOP_S = 3

OUTCOMES = ("killed", "looped", "not compiled", "no verdict", "survived")


@dataclasses.dataclass(frozen=True)
class Job:
    """What is mutated, what has to be compiled for it, what that is linked with."""
    mutated: str
    compiled: str
    linked: tuple[str, ...]


@dataclasses.dataclass(frozen=True)
class Mutant:
    job: Job
    number: int  # Of its line, from 1.
    place: int  # How many such lines there have been in the file, with this one.
    before: str
    after: str

    def key(self):
        return self.job.mutated, self.before.strip(), self.after.strip(), self.place

    def __str__(self):
        return f"{self.job.mutated}:{self.number}: {self.before.strip()}  ->  {self.after.strip()}"


def mutants_of(root: pathlib.Path, job: Job) -> list[Mutant]:
    found = []
    lines = (root / job.mutated).read_text().splitlines()
    for number, line in enumerate(lines, 1):
        place = [other.strip() for other in lines[:number]].count(line.strip())
        code = NO_CODE.sub(lambda match: "~" * len(match[0]), line)
        for pattern, replacements in RULES:
            for match in pattern.finditer(code):
                found += [
                    Mutant(job, number, place, line, line[:match.start()] + new + line[match.end():])
                    for new in replacements(match[0])]
    return found


def compiler(arguments, *folders: pathlib.Path) -> list:
    # Checked accesses turn reading past an end into a failure.
    return [arguments.compiler, "-std=c++17", "-O0", "-w", "-D_GLIBCXX_ASSERTIONS",
            *(f"-D{name}" for name in arguments.define), *(f"-I{path}" for path in folders),
            f"-I{arguments.root}", *(f"-isystem{path}" for path in arguments.system)]


def headers_of(arguments, job: Job, folder: pathlib.Path) -> list:
    """What a source reads takes longer to compile than itself, and is the same for each of its mutants:
    compiled once. Of a header that is mutated itself, nothing is."""
    if job.compiled != job.mutated:
        return []
    headers = folder / "headers.hpp"
    headers.write_text("\n".join(INCLUDE.findall((arguments.root / job.mutated).read_text())) + "\n")
    subprocess.run([*compiler(arguments), "-x", "c++-header", headers, "-o", f"{headers}.gch"],
                   check=True)
    return ["-include", headers]


def outcome(arguments, job: Job, text: str, headers: list, limit_s: int = LOOP_S) -> str:
    """Of one version of the file: one of OUTCOMES."""
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / job.mutated
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(text)
        source = copy if job.compiled == job.mutated else arguments.root / job.compiled
        program = pathlib.Path(folder) / "program"
        made = subprocess.run(
            [*compiler(arguments, folder), *headers, source, *job.linked, "-lcmocka", "-o", program],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if made.returncode != 0:
            if arguments.verbose:
                print(made.stderr)
            return "not compiled"
        try:
            test = subprocess.run(
                ["sh", "-c", f'ulimit -c 0; ulimit -St {limit_s}; exec "$0"', program],
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=arguments.timeout)
        except subprocess.TimeoutExpired:
            return "no verdict"
        if test.returncode == -signal.SIGXCPU:
            return "looped"
        return "survived" if test.returncode == 0 else "killed"


def outcomes_of(arguments, job: Job, mutants: list[Mutant], pool) -> list[str]:
    unchanged = (arguments.root / job.mutated).read_text()

    def outcome_of(mutant: Mutant) -> str:
        lines = unchanged.splitlines()
        lines[mutant.number - 1] = mutant.after
        return outcome(arguments, job, "\n".join(lines) + "\n", headers)

    with tempfile.TemporaryDirectory() as folder:
        headers = headers_of(arguments, job, pathlib.Path(folder))
        if outcome(arguments, job, unchanged, headers, TEST_S) != "survived":
            sys.exit(f"mutation: {job.mutated} fails its test unchanged: the gate is dead")
        return list(pool.map(outcome_of, mutants))


def job(text: str) -> Job:
    mutated, compiled, *linked = text.split(",")
    return Job(mutated, compiled, tuple(linked))


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--root", required=True, type=pathlib.Path)
parser.add_argument("--equivalent", required=True, type=pathlib.Path)
parser.add_argument("--compiler", default="g++")
parser.add_argument("--define", action="append", default=[], help="as what it is linked with has it")
parser.add_argument("--system", action="append", default=[], help="a folder of others' headers")
parser.add_argument("--jobs", type=int, default=2, help="at once")
parser.add_argument("--timeout", type=float, default=60.0, help="of each test, in seconds")
parser.add_argument("--verbose", action="store_true", help="says why a mutant did not compile")
parser.add_argument("job", nargs="+", type=job,
                    help="MUTATED,COMPILED[,LINKED...]: paths below the root; objects, archives")
arguments = parser.parse_args()
arguments.root = arguments.root.resolve()

entries = tomllib.loads(arguments.equivalent.read_text()).get("equivalent", [])
equivalent = {(entry["file"], entry["line"], entry["mutant"], entry.get("place", 1)):
              entry["reason"] for entry in entries}
mutated = {job.mutated for job in arguments.job}
problems = [f"{key[0]}: listed as equivalent, but is not mutated: {key[1]}"
            for key in equivalent if key[0] not in mutated]
print(f"{'':46} {'mutants':>8} {'killed':>8} {'looped':>8} {'not C++':>8} {'equivalent':>11} "
      f"{'survived':>9}")
with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
    for job in arguments.job:
        mutants = mutants_of(arguments.root, job)
        if not mutants:
            problems.append(f"{job.mutated}: nothing to change: the gate is dead")
        outcomes = outcomes_of(arguments, job, mutants, pool)
        same = 0
        for mutant, result in zip(mutants, outcomes):
            listed = equivalent.get(mutant.key())
            same += listed is not None and result == "survived"
            if listed is None and result in ("survived", "no verdict"):
                problems.append(f"{mutant}: {result}")
            elif listed is not None and result != "survived":
                problems.append(f"{mutant}: {result}, though listed as equivalent")
        keys = {mutant.key() for mutant in mutants}
        problems += [f"{key[0]}: listed as equivalent, but not to be found: {key[1]}  ->  {key[2]}"
                     for key in equivalent if key[0] == job.mutated and key not in keys]
        counts = {name: outcomes.count(name) for name in OUTCOMES}
        print(f"{job.mutated:46} {len(mutants):8} {counts['killed']:8} {counts['looped']:8} "
              f"{counts['not compiled']:8} {same:11} {counts['survived'] - same:9}")
for problem in problems:
    print(problem)
print(f"mutation: {len(arguments.job)} files, {len(problems)} problems")
sys.exit(1 if problems else 0)
