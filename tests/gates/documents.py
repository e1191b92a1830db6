#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: what the Markdown files point at is there, and the front README fits.

Links to files of the tree and to headings, files named in `code` (a word that begins with a folder of
the tree's root, or, in CONTRIBUTING.md, has a slash), the length of README.md, and that every section of
CONTRIBUTING.md that is a recipe names files. In such a name * and a word in capitals (NAME, KIND) stand
for anything, {a,b} for both: a recipe's new file is then shown by those that are there. What a build
makes (build/, out/) is not looked for.
"""

import os
import pathlib
import re

import tree

MAX_README_LINES = 200
FENCED = re.compile(r"^(```|~~~).*?^\1[ \t]*$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^\[[^\]]+\]:\s*<?(\S+?)>?\s*$", re.MULTILINE)
CODE = re.compile(r"(`+)(.+?)\1", re.DOTALL)
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$", re.MULTILINE)
NAMED = re.compile(r"[\w.*{},+/-]+")
PLACEHOLDER = re.compile(r"(?<![a-z0-9])[A-Z]{3,}(?![a-z0-9])")
RECIPE = re.compile(r"^(#{2,3}) (?:Recipe|\d+\.)[^\n]*\n(.*?)(?=^\1 |^## |\Z)", re.MULTILINE | re.DOTALL)
MADE = ("build/", "out/")


def blanked(match: re.Match) -> str:
    """Out of the way, and every line keeps its number."""
    return re.sub(r"[^\n]", " ", match[0])


def anchors(text: str) -> set[str]:
    """As the forges make them of headings, and those that are written out."""
    found = set(re.findall(r'<a id="([^"]+)">', text))
    for match in HEADING.finditer(FENCED.sub(blanked, text)):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", match[1])
        slug = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        number, candidate = 0, slug
        while candidate in found:
            number += 1
            candidate = f"{slug}-{number}"
        found.add(candidate)
    return found


def broken_link(name: str, target: str) -> str:
    if re.match(r"[a-z][a-z0-9+.-]*:", target):
        return ""
    path, _, anchor = target.partition("#")
    at = os.path.normpath(os.path.join(os.path.dirname(name), path)) if path else name
    if at not in known:
        return f"link to {target}: there is no {at}"
    if anchor and at.endswith(".md") and anchor not in anchors((root / at).read_text()):
        return f"link to {target}: {at} has no such heading"
    return ""


def alternatives(word: str) -> list[str]:
    match = re.search(r"\{([^{}]*)\}", word)
    if not match:
        return [word]
    return [each for part in match[1].split(",")
            for each in alternatives(word[:match.start()] + part + word[match.end():])]


def is_there(name: str, word: str) -> bool:
    """From the root, or from the file's own folder."""
    for folder in ("", os.path.dirname(name)):
        path = os.path.normpath(os.path.join(folder, word))
        pattern = re.escape(PLACEHOLDER.sub("*", path)).replace(r"\*", "[^/]*")
        if path in known or any(re.fullmatch(pattern, each) for each in known):
            return True
    return False


def files_named(name: str, text: str):
    """(offset, file or folder) of each that is named in `code`."""
    for match in CODE.finditer(text):
        word = match[2].strip()
        if not NAMED.fullmatch(word) or word.startswith(("/", *MADE)) or "/" not in word:
            continue
        if word.split("/")[0] in top or name == "CONTRIBUTING.md":
            yield match.start(), word


def check(name: str):
    global looked_at
    text = FENCED.sub(blanked, (root / name).read_text())

    def line(offset: int) -> int:
        return text.count("\n", 0, offset) + 1

    for offset, word in files_named(name, text):
        looked_at += 1
        problems.extend(f"{name}:{line(offset)}: `{word}`: there is no {each}"
                        for each in alternatives(word) if not is_there(name, each))
    prose = CODE.sub(blanked, text)
    for expression in (LINK, REFERENCE):
        # In the text as it was: a link's words may be code.
        for match in expression.finditer(text):
            if prose[match.start()] == " " and text[match.start()] != " ":
                continue  # within code
            looked_at += 1
            if wrong := broken_link(name, match[1]):
                problems.append(f"{name}:{line(match.start())}: {wrong}")
    if name == "CONTRIBUTING.md":
        recipes = list(RECIPE.finditer(text))
        problems.extend(f"{name}:{line(each.start())}: this recipe names no file" for each in recipes
                        if not list(files_named(name, each[2])))
        if not recipes:
            problems.append(f"{name}: no recipe (a section 'Recipe ...' or '1. ...')")


root = tree.arguments(__doc__).parse_args().root.resolve()
names = tree.files(root)
every = tree.files(root, seeds=True)
known = set(every) | {parent.as_posix() for name in every for parent in pathlib.PurePosixPath(name).parents}
top = {name.split("/")[0] for name in names if "/" in name}
problems, looked_at = [], 0
documents = [name for name in names if name.endswith(".md")]
for document in documents:
    check(document)
if "README.md" in names:
    count = len((root / "README.md").read_text().splitlines())
    if count > MAX_README_LINES:
        problems.append(f"README.md: {count} lines; {MAX_README_LINES} is the most")
if looked_at == 0:
    problems.append("no link and no file name to look at: the gate is dead")
print(f"{looked_at} links and names of files")
tree.report("documents", problems, len(documents))
