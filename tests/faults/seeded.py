# SPDX-License-Identifier: Apache-2.0
"""Faults seeded into the safety code must turn fault_cases red: seeded.py BUILD OUT [--seeds N] [--only NAME]
makes each fault of seeded.toml in a copy of its file, compiles that, links it before the archives that have
the original, and runs the row that has to fail. Nothing in the tree is changed."""

import argparse
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TARGET = "tests/faults/fault_cases"


def compiler_call(build, file):
    """The call that compiles `file` in this build, in its folder."""
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        if pathlib.Path(entry["directory"], entry["file"]).resolve() == (ROOT / file).resolve():
            return shlex.split(entry["command"]), entry["directory"]
    raise SystemExit(f"seeded: {build} does not compile {file}")


def link_call(build):
    said = subprocess.run(["ninja", "-C", str(build), "-t", "commands", "-s", TARGET], check=True,
                          capture_output=True, text=True).stdout
    line = [line for line in said.splitlines() if f"-o {TARGET}" in line][-1]
    return re.sub(r"^: && | && :$", "", line)


def seeded_program(build, out, name, seed):
    source = (ROOT / seed["file"]).read_text(encoding="utf-8")
    if source.count(seed["text"]) != 1:
        raise SystemExit(f"seeded: [{name}]: {seed['file']} has its text {source.count(seed['text'])} times")
    copy = out / f"{name}.cpp"
    copy.write_text(source.replace(seed["text"], seed["instead"]), encoding="utf-8")
    command, folder = compiler_call(build, seed["file"])
    # A check that is gone leaves what it alone used.
    flags = [word for word in command[:command.index("-o")] if word not in ("-Werror", "-MD")]
    folder_of_source = str((ROOT / seed["file"]).parent)
    subprocess.run([*flags, f"-I{folder_of_source}", "-w", "-o", str(out / f"{name}.o"), "-c", str(copy)],
                   cwd=folder, check=True)
    program = out / name
    call = link_call(build).replace(f"-o {TARGET}", f"-o {shlex.quote(str(program))} {shlex.quote(str(out / name))}.o", 1)
    subprocess.run(call, shell=True, cwd=build, check=True)
    return program


def turns_red(program, row, machine, seeds):
    done = subprocess.run([str(program), "--machine", machine, "--row", str(row), "--seeds", str(seeds)],
                          capture_output=True, text=True, check=False)
    return done.returncode != 0 and f"FAILED row {row}," in done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    options.out = options.out.resolve()
    options.out.mkdir(parents=True, exist_ok=True)
    seeds = tomllib.loads((HERE / "seeded.toml").read_text(encoding="ascii"))
    missed = []
    for name, seed in seeds.items():
        if options.only not in name:
            continue
        program = seeded_program(options.build.resolve(), options.out, name, seed)
        machines = [seed["machine"]] if "machine" in seed else ["excavator", "dozer"]
        red = [machine for machine in machines if turns_red(program, seed["row"], machine, options.seeds)]
        program.unlink()
        print(f"{name:22} row {seed['row']:3}: red on {', '.join(red) or 'NONE'}", flush=True)
        if not red:
            missed.append(name)
    if missed:
        sys.exit(f"seeded: not noticed: {', '.join(missed)}")


if __name__ == "__main__":
    main()
