#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: the tests notice when the safety code is changed.

Makes every mutant of a file that changes one comparison, one whole number in a comparison, one
boolean operator or one truth value; the file's test has to fail with it or to loop. A mutant that no
test can tell from the original is listed with its reason in the file of equivalent ones, and then has
to survive.

All mutants of a file are compiled and linked once, before the archive that has the original: the body
of a function that has mutants stands there once for each, and NUMBER in the environment says which one
runs. What lies outside such a body, and what the compiler refuses, is compiled alone.

What loops burns processor time, however loaded the machine is. A test that merely did not end in
time is no verdict, and the gate is red.

Operators are found by the blanks around them, which clang-format puts there and nowhere else."""

import argparse
import concurrent.futures
import dataclasses
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import tomllib

import unchanged

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
NUMBER = "GRABEN_MUTANT"
# What a mutated file begins with.
WHICH = f"""#include <cstdlib>
static int graben_mutant() {{
  static const char* const text = std::getenv("{NUMBER}");
  static const int number = text == nullptr ? 0 : std::atoi(text);
  return number;
}}
#line 1
"""
# Before the brace of what has functions in it, and of what is a function. A constexpr one can't look into
# the environment.
SCOPE = re.compile(r"\b(?:namespace|class|struct|union|enum|extern)\b[^()=]*$")
FUNCTION = re.compile(r"\)(?:\s*(?:const|noexcept|override|final))*\s*(?:->[^=;]*|:[^;]*)?$")
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
    column: int  # Of the change, from 0.
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
                    Mutant(job, number, place, match.start(), line,
                           line[:match.start()] + new + line[match.end():])
                    for new in replacements(match[0])]
    return found


def compiler(arguments, *folders: pathlib.Path) -> list:
    # Checked accesses turn reading past an end into a failure.
    return [arguments.compiler, "-std=c++17", "-O0", "-w", "-D_GLIBCXX_ASSERTIONS",
            *(f"-D{name}" for name in arguments.define), *(f"-I{path}" for path in folders),
            f"-I{arguments.root}", *(f"-isystem{path}" for path in arguments.system)]


def bodies_of(text: str) -> list[tuple[int, int]]:
    """Where the bodies of the functions are, without their braces."""
    code = "\n".join(NO_CODE.sub(lambda match: " " * len(match[0]), line) for line in text.split("\n"))
    found: list[tuple[int, int]] = []
    since = at = 0  # Where what may be a function's head begins.
    while at < len(code):
        if code[at] in ";}":
            since = at + 1
        elif code[at] == "{":
            head = code[since:at]
            if SCOPE.search(head):
                since = at + 1
            else:
                depth, end = 1, at + 1
                while depth and end < len(code):
                    depth += {"{": 1, "}": -1}.get(code[end], 0)
                    end += 1
                # A member's initialiser comes right after its name.
                named = re.search(r"\w$", head) and not re.search(r"\b(?:const|noexcept|override|final)$", head)
                if FUNCTION.search(head) and not named and not re.search(r"\bconstexpr\b", head):
                    found.append((at + 1, end - 1))
                if not named:
                    since = end
                at = end - 1
        at += 1
    return found


class Schema:
    """All of a file's mutants in one program."""

    def __init__(self, arguments, job: Job, folder: pathlib.Path):
        self.arguments, self.job, self.folder = arguments, job, folder
        self.text = (arguments.root / job.mutated).read_text()
        self.mutants = mutants_of(arguments.root, job)
        self.program = folder / "program"
        self.inside: dict[int, list[int]] = {}  # By body: indices of mutants.
        starts = [0]
        for line in self.text.splitlines(keepends=True):
            starts.append(starts[-1] + len(line))
        self.bodies = bodies_of(self.text)
        for index, mutant in enumerate(self.mutants):
            place = starts[mutant.number - 1] + mutant.column
            for body, (begin, end) in enumerate(self.bodies):
                if begin <= place < end:
                    self.inside.setdefault(body, []).append(index)
        # What the compiler refuses among the others is left out, and it is asked again.
        while (refused := self.refused()) is not None:
            self.inside = {body: [index for index in indices if index not in refused]
                           for body, indices in self.inside.items()} if refused else {}

    def mutated(self, index: int) -> str:
        lines = self.text.splitlines()
        lines[self.mutants[index].number - 1] = self.mutants[index].after
        return "\n".join(lines) + "\n"

    def refused(self) -> set[int] | None:
        """Builds the program. None when it was built; else whose lines the compiler names."""
        text, at, owners = "", 0, []
        for body, (begin, end) in enumerate(self.bodies):
            indices = self.inside.get(body)
            if not indices:
                continue
            text += self.text[at:begin] + "\nswitch (graben_mutant()) {\n"
            for index in indices:
                mutant = self.mutants[index]
                longer = len(mutant.after) - len(mutant.before)
                first = text.count("\n") + 1
                text += f"case {index + 1}: {{\n{self.mutated(index)[begin:end + longer]}\n}} break;\n"
                owners.append((first, text.count("\n"), index))
            text += f"default: {{\n{self.text[begin:end]}\n}} }}\n"
            at = end
        errors = built(self.arguments, self.job, WHICH + text + self.text[at:], self.folder)
        if errors is None:
            return None
        if not any(self.inside.values()):
            sys.exit(f"{errors}\nmutation: {self.job.mutated} fails its test unchanged: the gate is dead")
        lines = {int(line) for line in re.findall(rf"{re.escape(self.job.mutated)}:([0-9]+)[:,]", errors)}
        return {index for first, last, index in owners if any(first <= line <= last for line in lines)}

    def outcome(self, index: int) -> str:
        if any(index in indices for indices in self.inside.values()):
            return outcome(self.arguments, self.program, index + 1)
        with tempfile.TemporaryDirectory() as folder:
            errors = built(self.arguments, self.job, self.mutated(index), pathlib.Path(folder))
            if errors is not None:
                if self.arguments.verbose:
                    print(errors)
                return "not compiled"
            return outcome(self.arguments, pathlib.Path(folder) / "program", 0)


def built(arguments, job: Job, text: str, folder: pathlib.Path) -> str | None:
    """Compiles and links one version of the file; what the compiler has against it."""
    copy = folder / job.mutated
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_text(text)
    source = copy if job.compiled == job.mutated else arguments.root / job.compiled
    made = subprocess.run(
        [*compiler(arguments, folder), source, *job.linked, "-lcmocka", "-o", folder / "program"],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    return None if made.returncode == 0 else made.stderr


def outcome(arguments, program: pathlib.Path, number: int, limit_s: int = LOOP_S) -> str:
    """Of the test with this mutant, or with none for 0; it ends at the first that fails: one of OUTCOMES."""
    try:
        test = subprocess.run(
            ["sh", "-c", f'ulimit -c 0; ulimit -St {limit_s}; exec "$0"', program],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=arguments.timeout,
            env={**os.environ, NUMBER: str(number), "CMOCKA_TEST_ABORT": "1"})
    except subprocess.TimeoutExpired:
        return "no verdict"
    if test.returncode == -signal.SIGXCPU:
        return "looped"
    return "survived" if test.returncode == 0 else "killed"


def job(text: str) -> Job:
    mutated, compiled, *linked = text.split(",")
    return Job(mutated, compiled, tuple(linked))


parser = argparse.ArgumentParser(description=__doc__, fromfile_prefix_chars="@")
parser.add_argument("--root", required=True, type=pathlib.Path)
parser.add_argument("--equivalent", required=True, type=pathlib.Path)
parser.add_argument("--compiler", default="g++")
parser.add_argument("--define", action="append", default=[], help="as what it is linked with has it")
parser.add_argument("--system", action="append", default=[], help="a folder of others' headers")
parser.add_argument("--jobs", type=int, default=2, help="at once")
parser.add_argument("--timeout", type=float, default=300.0,
                    help="of each test, in seconds: what waits, or what a busy machine starves")
parser.add_argument("--only", action="append", default=[], metavar="FILE", help="of those that are mutated")
parser.add_argument("--changed", action="store_true", help="not those that are as when all were last tried")
parser.add_argument("--verbose", action="store_true", help="says each verdict, and why a mutant did not compile")
parser.add_argument("job", nargs="+", type=job,
                    help="MUTATED,COMPILED[,LINKED...]: paths below the root; objects, archives")
arguments = parser.parse_args()
arguments.root = arguments.root.resolve()

entries = tomllib.loads(arguments.equivalent.read_text()).get("equivalent", [])
equivalent = {(entry["file"], entry["line"], entry["mutant"], entry.get("place", 1)):
              entry["reason"] for entry in entries}
mutated = {job.mutated for job in arguments.job}
if arguments.only:
    if not mutated >= set(arguments.only):
        parser.error(f"not mutated: {', '.join(set(arguments.only) - mutated)}")
    mutated = set(arguments.only)
    arguments.job = [job for job in arguments.job if job.mutated in mutated]
    equivalent = {key: reason for key, reason in equivalent.items() if key[0] in mutated}
same_as_before, since = unchanged.as_before(arguments.root, arguments.job) if arguments.changed else ([], "")
arguments.job = [job for job in arguments.job if job not in same_as_before]
problems = [f"{key[0]}: listed as equivalent, but is not mutated: {key[1]}"
            for key in equivalent if key[0] not in mutated]
print(f"{'':46} {'mutants':>8} {'killed':>8} {'looped':>8} {'not C++':>8} {'equivalent':>11} "
      f"{'survived':>9} {'alone':>6}")
with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool, \
        tempfile.TemporaryDirectory() as folder:
    schemas = pool.map(lambda job: Schema(arguments, job, pathlib.Path(folder) / str(id(job))), arguments.job)
    for schema in list(schemas):
        job, mutants = schema.job, schema.mutants
        if not mutants:
            problems.append(f"{job.mutated}: nothing to change: the gate is dead")
        if outcome(arguments, schema.program, 0, TEST_S) != "survived":
            sys.exit(f"mutation: {job.mutated} fails its test unchanged: the gate is dead")
        outcomes = list(pool.map(schema.outcome, range(len(mutants))))
        alone = len(mutants) - sum(map(len, schema.inside.values()))
        if arguments.verbose:
            print("".join(f"{result}: {mutant}\n" for mutant, result in zip(mutants, outcomes)), end="")
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
              f"{counts['not compiled']:8} {same:11} {counts['survived'] - same:9} {alone:6}")
for problem in problems:
    print(problem)
if arguments.changed:
    print(f"mutation: {len(same_as_before)} files are as they were {since} and are NOT tried")
print(f"mutation: {len(arguments.job)} files, {len(problems)} problems")
sys.exit(1 if problems else 0)
