# SPDX-License-Identifier: Apache-2.0
"""The commands of a page's walk, as a guest's shell runs them: no sudo, programs on PATH, profiles beside it."""

import pathlib
import re

BLOCK = re.compile(r"^```sh\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# What a guest has already, or ends by itself.
NOT_OF_A_GUEST = re.compile(r"^(sudo modprobe|cmake --build|kill) ")
INSTEAD = (("sudo ", ""), ("./run ", "graben "), ("build/release/app/ecu/", ""), ("app/machines/", ""))


def block_with(page: str, command: str) -> str:
    """The one block that has a line which begins so; ValueError where there is none or another."""
    found = [block for block in BLOCK.findall(page) if re.search(rf"^{re.escape(command)}", block, re.MULTILINE)]
    if len(found) != 1:
        raise ValueError(f"{len(found)} blocks begin a line with '{command}'; wanted: one")
    lines = [line for line in found[0].splitlines() if not NOT_OF_A_GUEST.match(line)]
    text = "\n".join(lines) + "\n"
    for old, new in INSTEAD:
        text = text.replace(old, new)
    return text


def write(page: pathlib.Path, folder: pathlib.Path, wanted: dict[str, str]) -> dict[str, pathlib.Path]:
    """A file for each name, of the block with that command; what a scenario takes along."""
    text = page.read_text()
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for name, command in wanted.items():
        files[name] = folder / name
        files[name].write_text(block_with(text, command))
    return files
