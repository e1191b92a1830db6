#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: every shell command of the tree's Markdown files works, run in the repository's root.

A block is run as one script, so that a `cd` or a variable holds until its end; one that stands in two
files is run once. A block behind <!-- not run: reason --> is left out, loudly. ./test, which runs this
gate, is only looked at. With --build, so is a command that is word by word a test of that build, or a
ctest that names some: ./test runs it anyway.
"""

import functools
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys

import changed_since
import tree

FENCE = re.compile(r"^```(\w*)\s*$")
NOT_RUN = re.compile(r"^<!--\s*not run:\s*(.+?)\s*-->$")
OWN_CTEST = re.compile(r"^ctest --test-dir build/release -R (\S+)(?: --verbose)?$")
CHECKS_ONLY = re.compile(r"^(\./test|\.ci/run)(\s|$)")


def blocks(text: str):
    """(first line number, lines, reason not to run or None) of each ```sh block."""
    reason, inside, start, body = None, None, 0, []
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if inside is not None:
            if fence:
                if inside == "sh":
                    yield start, body, reason
                inside, reason = None, None
            else:
                body.append(line)
        elif fence:
            inside, start, body = fence[1], number + 1, []
        elif match := NOT_RUN.match(line.strip()):
            reason = match[1]
        elif line.strip():
            reason = None


def commands(start: int, lines: list[str]):
    """(line number, command): lines belong together until bash takes them as complete."""
    pending, first = [], start
    for number, line in enumerate(lines, start):
        if not pending:
            first = number
            if not line.strip() or line.lstrip().startswith("#"):
                continue
        pending.append(line)
        command = "\n".join(pending)
        parsed = subprocess.run(["bash", "-n", "-c", command], stderr=subprocess.PIPE, check=False)
        # A here-document that has not ended is only a warning.
        if parsed.returncode == 0 and not parsed.stderr and not line.endswith("\\"):
            yield first, command
            pending = []
    if pending:
        yield first, "\n".join(pending)


def own_tests() -> dict[tuple[str, ...], str]:
    """The command of each test of the build, and its name."""
    if arguments.build is None:
        return {}
    listed = subprocess.run(["ctest", "--test-dir", arguments.build, "--show-only=json-v1"],
                            stdout=subprocess.PIPE, check=True).stdout
    return {words_of(without_time(test["command"])): test["name"]
            for test in json.loads(listed)["tests"] if "command" in test}


def without_time(command: list[str]) -> list[str]:
    """A test's command stands behind GNU time and its five options (tests/cost/cost.cmake)."""
    return command[7:] if os.path.basename(command[0]) == "time" else command


def is_file_of(word: str) -> bool:
    """Of the repository; a canary's pattern may be longer than a name can be."""
    try:
        return (root / word).exists()
    except OSError:
        return False


def words_of(command: list[str]) -> tuple[str, ...]:
    """To be compared: whichever the interpreter, and from wherever a file is named."""
    words = [str(root / word) if is_file_of(word) else word for word in command]
    if words and re.fullmatch(r"python3(\.\d+)?", os.path.basename(words[0])):
        words = ["python3"] + [word for word in words[1:] if word != "-B"]
    elif words:
        words[0] = shutil.which(words[0]) or words[0]
    return tuple(words)


def run_by(command: str, where: str) -> str:
    """Names of the tests that run the command; nothing if none does."""
    try:
        words = shlex.split(command)
    except ValueError:
        return ""
    if arguments.build is not None and (own := OWN_CTEST.match(command)):
        named = [name for name in tests.values() if re.search(shlex.split(own[1])[0], name)]
        if not named:
            problems.append(f"{where}: no test is called {own[1]}")
            return "one that is not there"
        return ", ".join(named)
    return tests.get(words_of(words), "")


def script_of(name: str, start: int, lines: list[str]) -> tuple[str, int]:
    script, count = ["set -o pipefail"], 0
    for number, command in commands(start, lines):
        count += 1
        where = f"{name}:{number}"
        if own := CHECKS_ONLY.match(command):
            program = root / own[1]
            if not (program.is_file() and os.access(program, os.X_OK)):
                problems.append(f"{where}: {own[1]} is not there or not executable")
            print(f"{where}: {own[1]} runs this gate; only looked at")
            continue
        if test := run_by(command, where):
            print(f"{where}: {command}: ./test runs it as {test}; only looked at")
            continue
        shown = shlex.quote(f"{where}: {command}")
        script += [f"echo {shown}", command,
                   f"status=$?; if [ $status -ne 0 ]; then echo {shown} failed with status $status;"
                   " exit 1; fi"]
    return "\n".join(script), count


def run(where: str, script: str):
    process = subprocess.Popen(
        ["bash", "-c", script], cwd=root, start_new_session=True, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
        env={**os.environ, "GRABEN_README_GATE": "1"})
    try:
        output, _ = process.communicate(timeout=arguments.limit)
    except subprocess.TimeoutExpired:
        # The whole session: a command may have left something in the background.
        os.killpg(process.pid, signal.SIGKILL)
        output, _ = process.communicate()
        problems.append(f"{where}: block took longer than {arguments.limit:g} s")
    print(output, end="")
    if process.returncode > 0:
        problems.append(f"{where}: block failed")


@functools.cache
def bodies_before(name: str) -> frozenset[str]:
    """The blocks of a document as they were at the last whole run: words around a block change no command."""
    text = changed_since.before(root, "readme", name)
    return frozenset("\n".join(lines) for _, lines, reason in blocks(text) if not reason)


def is_changed(name: str, body: str) -> bool:
    """Whether a block changed, or a file that it names, or what it calls through ./run or a preset."""
    if name in names and body not in bodies_before(name):
        return True
    files = [word for word in re.findall(r"[\w./-]+", body) if is_file_of(word)]
    called = ["run", "toolchain", "app/cli", "app/machines", "CMakeLists.txt", "CMakePresets.json"]
    # What a document says of profiles and programs changes none of them.
    programs = {changed for changed in names if not changed.endswith(".md")}
    named = [word.removeprefix("./").rstrip("/") for word in files]
    return bool(changed_since.below(names, named) or changed_since.below(programs, called))


parser = tree.arguments(__doc__)
parser.add_argument("--limit", type=float, default=3000, help="seconds that a block may take")
parser.add_argument("--changed", action="store_true",
                    help="only blocks that changed since the last whole run, or whose commands did; the others are counted")
parser.add_argument("--build", type=pathlib.Path, help="the build whose tests need not run again")
arguments = parser.parse_args()
root = arguments.root.resolve()
sys.stdout.reconfigure(line_buffering=True)
problems, total, done = [], 0, {}
tests = own_tests()
names, since = changed_since.changed(root, "readme") if arguments.changed else (None, "asked for")
print(f"readme: {'everything, as ' if names is None else 'what changed '}{since}")
unchanged = 0
for name in sorted((n for n in tree.files(root) if n.endswith(".md")), key=lambda n: (n.count("/"), n)):
    for start, lines, reason in blocks((root / name).read_text()):
        where, body = f"{name}:{start}", "\n".join(lines)
        if reason:
            print(f"SKIPPED {where}: not run: {reason}")
            continue
        if body in done:
            print(f"{where}: the same as {done[body]}")
            continue
        done[body] = where
        if names is not None and not is_changed(name, body):
            unchanged += 1
            continue
        script, count = script_of(name, start, lines)
        total += count
        run(where, script)
if unchanged:
    print(f"readme: {unchanged} blocks and what they call are as they were {since} and are NOT run")
tree.report("readme", problems, total + unchanged, "commands")
