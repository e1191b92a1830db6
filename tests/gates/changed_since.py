#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What changed since the last whole run of an area: changed_since.py AREA [PATH...].

whole_run.toml beside this has, for each area, the commit on which all of it was tried, and the tools with
which. Where that commit is unknown, the clone shallow, or a tool another one, everything counts as changed.
Exits with 0 where anything below the paths changed, and says what; with 1 where nothing did.

With --record AREA...: the commit of the work tree, which must be clean, becomes that of these areas.
"""

import argparse
import pathlib
import subprocess
import sys
import tomllib

RECORD = "tests/gates/whole_run.toml"
TOOLS = {"mutation": ("g++",), "tidy": ("clang-tidy", "g++"), "readme": ("g++", "node"), "browser": ("chromium", "node")}


def git(root: pathlib.Path, *words: str) -> str:
    return subprocess.run(["git", "-C", str(root), *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                          check=True).stdout


def tools_of(area: str) -> str:
    """Versions of what the area is tried with, as the programs say them."""
    said = []
    for tool in TOOLS[area]:
        try:
            text = subprocess.run([tool, "--version"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                  check=False).stdout
        except OSError:
            text = ""
        lines = [line.strip() for line in text.splitlines() if "version" in line.lower() or any(map(str.isdigit, line))]
        said.append(f"{tool}: {lines[0] if lines else 'none'}")
    return "; ".join(said)


def changed(root: pathlib.Path, area: str) -> tuple[set[str] | None, str]:
    """Names below the root that changed, work tree and untracked files included, and since when; None for
    everything, and why."""
    try:
        row = tomllib.loads((root / RECORD).read_text(encoding="utf-8"))[area]
    except (OSError, KeyError):
        return None, f"no whole run of {area} is recorded"
    if row["tools"] != (here := tools_of(area)):
        return None, f"the whole run had {row['tools']}; here is {here}"
    try:
        if git(root, "rev-parse", "--is-shallow-repository").strip() != "false":
            return None, "the clone is shallow"
        names = git(root, "diff", "--name-only", "--no-renames", row["commit"], "--")
        names += git(root, "ls-files", "--others", "--exclude-standard")
    except subprocess.CalledProcessError:
        return None, f"the commit of the whole run is not known here: {row['commit']}"
    return set(names.splitlines()), f"since {row['commit'][:10]}"


def before(root: pathlib.Path, area: str, name: str) -> str:
    """A file as it was at the last whole run of the area; empty where it was not there."""
    commit = tomllib.loads((root / RECORD).read_text(encoding="utf-8"))[area]["commit"]
    try:
        return git(root, "show", f"{commit}:{name}")
    except subprocess.CalledProcessError:
        return ""


def below(names: set[str], paths: list[str]) -> list[str]:
    return sorted(name for name in names if any(path == "." or name == path or name.startswith(path.rstrip("/") + "/") for path in paths))


def record(root: pathlib.Path, areas: list[str]) -> None:
    # Of the areas before, recorded in the same run.
    if git(root, "status", "--porcelain", "--", ".", f":!{RECORD}").strip():
        sys.exit("changed_since.py: the work tree is not what was committed; nothing is recorded")
    file = root / RECORD
    rows = tomllib.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    commit = git(root, "rev-parse", "HEAD").strip()
    rows |= {area: {"commit": commit, "tools": tools_of(area)} for area in areas}
    file.write_text("# The last commit on which all of an area was tried, and with what (changed_since.py --record).\n" + "".join(
        f'\n[{area}]\ncommit = "{row["commit"]}"\ntools = "{row["tools"]}"\n' for area, row in sorted(rows.items())),
        encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--record", nargs="+", choices=sorted(TOOLS))
    parser.add_argument("area", nargs="?", choices=sorted(TOOLS))
    parser.add_argument("paths", nargs="*")
    options = parser.parse_args()
    if options.record:
        record(options.root, options.record)
        return 0
    if not options.area or not options.paths:
        parser.error("an area and what belongs to it are wanted")
    names, why = changed(options.root, options.area)
    if names is None:
        print(f"{options.area}: everything, as {why}")
        return 0
    found = below(names, options.paths)
    print(f"{options.area}: {len(found)} files changed {why}{': ' + ', '.join(found[:5]) if found else ''}")
    return 0 if found else 1


if __name__ == "__main__":
    sys.exit(main())
