#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Man pages and the bash completion of `graben`, of what it says of itself: pages.py GRABEN CHANGELOG OUT.

Writes OUT/man/graben.1.gz and one for each command (graben-dig.1.gz, graben-campaign-dig.1.gz ...),
OUT/completion, and OUT/changelog.gz. The same program and changelog give the same bytes.
"""

import gzip
import json
import pathlib
import re
import subprocess
import sys

HEADER = """# Completion of graben, made of its help by app/cli/package/pages.py.
_graben() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} path=graben word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$path $word" in
"""
WORDS = """    esac
  done
  local words= files=
  case "$path $prev" in
"""
OPTIONS = """    *)
      case "$path" in
"""
FOOTER = """      esac
      ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
  if [ -n "$files" ]; then
    compopt -o filenames 2>/dev/null
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$cur")
  fi
}
complete -o bashdefault -o default -F _graben graben
"""


def commands(command: dict, path: tuple[str, ...] = ()) -> list[tuple[tuple[str, ...], dict]]:
    """Every command with the words that call it, the program first."""
    here = (*path, command["name"])
    return [(here, command), *(found for below in command["commands"] for found in commands(below, here))]


def roff(text: str) -> str:
    """Plain text in a roff file: no line of it is an order."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.MULTILINE)


def sentence(text: str) -> str:
    return text if text.endswith(".") else text + "."


def page(path: tuple[str, ...], command: dict, version: str, date: str) -> str:
    name = "-".join(path)
    first = re.split(r"[.:;] ", command["help"])[0]
    lines = [f'.TH {name.upper()} 1 {date} "Graben {version}" "User Commands"', ".SH NAME",
             f"{roff(name)} \\- {roff(first[0].lower() + first[1:])}", ".SH SYNOPSIS",
             f".B {roff(' '.join(path))}", roff("COMMAND [options]" if command["commands"] else "[options]"),
             ".SH DESCRIPTION", roff(sentence(command["help"]))]
    if command["commands"]:
        lines.append(".SH COMMANDS")
        for below in command["commands"]:
            lines += [".TP", f".B {roff(below['name'])}", roff(sentence(below["help"]))]
    lines.append(".SH OPTIONS")
    for option in command["options"]:
        lines += [".TP", f".B {roff(option['names'].replace(',', ', ') + option['argument'])}",
                  roff(sentence(option["help"]))]
    examples = re.findall(r"^  (graben .*)$", command["footer"], re.MULTILINE)
    if examples:
        lines += [".SH EXAMPLES", ".nf", *map(roff, examples), ".fi"]
    lines += [".SH FILES", ".TP", roff("/usr/share/graben/machines"), "Profiles and tasks that are found by name.",
              ".SH EXIT STATUS",
              "0 done; 1 the input or the result is at fault; 2 wrong usage."]
    others = [*path[:-1]] and ["-".join(path[:-1])] or [f"graben-{below['name']}" for below in command["commands"]]
    lines += [".SH SEE ALSO", ", ".join(f"{roff(other)}(1)" for other in others)]
    return "\n".join(lines) + "\n"


def offered(option: dict) -> str:
    """An option's own words; or files, and beside them what of ours goes by name."""
    words = option["words"] or option["shipped"]
    return f'words="{" ".join(words)}"' + ("" if option["words"] else " files=1")


def completion(all_commands: list[tuple[tuple[str, ...], dict]]) -> str:
    text = HEADER
    for path, _ in all_commands[1:]:
        text += f'      "{" ".join(path)}") path="{" ".join(path)}" ;;\n'
    text += WORDS
    for path, command in all_commands:
        for option in command["options"]:
            name = option["names"].split(",")[-1]
            if name.startswith("--") and option["argument"]:
                text += f'    "{" ".join(path)} {name}") {offered(option)} ;;\n'
    text += OPTIONS
    for path, command in all_commands:
        words = [below["name"] for below in command["commands"]]
        words += [name for option in command["options"] for name in option["names"].split(",")
                  if name.startswith("--")]
        named = f'words="{" ".join(words)}"'
        files = [option for option in command["options"] if not option["names"].startswith("-")]
        # What stands alone is a file; a dash asks for options.
        if files:
            named = f'case "$cur" in -*) {named} ;; *) {offered(files[0])} ;; esac'
        text += f'        "{" ".join(path)}") {named} ;;\n'
    return text + FOOTER


def pack(to: pathlib.Path, text: str):
    """Without a time or a name in it."""
    to.write_bytes(gzip.compress(text.encode(), 9, mtime=0))


def main():
    graben, changelog, out = sys.argv[1:]
    log = pathlib.Path(changelog).read_text(encoding="utf-8")
    version = re.match(r"graben \(([^)]+)\)", log)[1]
    date = re.search(r"^ -- .*>  (.*)$", log, re.MULTILINE)[1]
    told = json.loads(subprocess.run([graben, "--describe"], check=True, capture_output=True, text=True).stdout)
    folder = pathlib.Path(out)
    (folder / "man").mkdir(parents=True, exist_ok=True)
    for old in (folder / "man").iterdir():
        old.unlink()
    all_commands = commands(told)
    for path, command in all_commands:
        pack(folder / "man" / f"{'-'.join(path)}.1.gz", page(path, command, version, " ".join(date.split()[1:4])
                                                           .join('""')))
    (folder / "completion").write_text(completion(all_commands), encoding="utf-8")
    pack(folder / "changelog.gz", log)


if __name__ == "__main__":
    main()
