#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What is in the package of graben-ecu: check_contents.py [--without-lintian] PACKAGE. Its files and no
others, no library beyond the C library, no symbols, nothing of the folder that it was built in, and what
lintian says."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARIES = {"libc6"}
DOCUMENTS = "./usr/share/doc/graben-ecu"
FILES = {
    "./etc/default/graben-ecu": 0o644,
    "./usr/bin/graben-ecu": 0o755,
    "./usr/lib/systemd/network/80-graben-can.network": 0o644,
    "./usr/lib/systemd/system-preset/80-graben-ecu.preset": 0o644,
    "./usr/lib/systemd/system/graben-ecu.service": 0o644,
    "./usr/share/graben/dozer.dbc": 0o644,
    "./usr/share/graben/dozer_9t.toml": 0o644,
    "./usr/share/graben/excavator.dbc": 0o644,
    "./usr/share/graben/excavator_12t.toml": 0o644,
    "./usr/share/graben/excavator_22t.toml": 0o644,
    "./usr/share/graben/j1939.dbc": 0o644,
    "./usr/share/graben/buses/aux_valves.toml": 0o644,
    "./usr/share/graben/buses/encoders.toml": 0o644,
    "./usr/share/graben/buses/inclinometers.toml": 0o644,
    "./usr/share/graben/buses/retrofit.toml": 0o644,
    "./usr/share/graben/buses/slopes.toml": 0o644,
    "./usr/share/graben/buses/valve_driver.toml": 0o644,
    "./usr/share/graben/buses/zx200.toml": 0o644,
    "./usr/share/graben/tasks/bench.toml": 0o644,
    "./usr/share/graben/tasks/flatten.toml": 0o644,
    "./usr/share/graben/tasks/level.toml": 0o644,
    "./usr/share/graben/tasks/slope.toml": 0o644,
    "./usr/share/graben/tasks/trench.toml": 0o644,
    "./usr/share/graben/tasks/truck_by_steps.toml": 0o644,
    "./usr/share/graben/tasks/truck_loading.toml": 0o644,
    "./usr/share/man/man8/graben-ecu.8.gz": 0o644,
    **{f"{DOCUMENTS}/{name}": 0o644 for name in ("README", "changelog.gz", "copyright")},
}
EMPTY_FOLDERS = {"./etc/graben"}
TAG = re.compile(r"^([EW]): graben-ecu: (\S+)(.*)$", re.MULTILINE)


def run(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def check_control(package: str) -> list[str]:
    problems = []
    depends = run("dpkg-deb", "-f", package, "Depends")
    print(f"{pathlib.Path(package).name}: {pathlib.Path(package).stat().st_size} bytes; {depends.strip()}")
    names = {entry.split()[0] for entry in re.split(r"[,|]", depends)}
    if names != LIBRARIES:
        problems.append(f"depends on {sorted(names)} instead of {sorted(LIBRARIES)}")
    for field in ("Pre-Depends", "Provides", "Conflicts"):
        if run("dpkg-deb", "-f", package, field).strip():
            problems.append(f"{field} is set")
    return problems


def check_members(members: list[tarfile.TarInfo]) -> list[str]:
    problems = []
    found = {member.name: member for member in members if not member.isdir()}
    problems += [f"{name} is missing" for name in sorted(FILES.keys() - found.keys())]
    problems += [f"{name} does not belong into it" for name in sorted(found.keys() - FILES.keys())]
    for name, member in found.items():
        if name in FILES and (not member.isfile() or member.mode != FILES[name]):
            problems.append(f"{name} has the mode {member.mode:o}")
    parents = {f"./{parent}" for name in [*FILES, *(f"{folder}/x" for folder in EMPTY_FOLDERS)]
               for parent in pathlib.PurePosixPath(name).parents}
    for member in members:
        if member.isdir() and member.name.rstrip("/") not in parents | {"."}:
            problems.append(f"the folder {member.name} does not belong into it")
        if (member.uid, member.gid) != (0, 0) or (member.isdir() and member.mode != 0o755):
            problems.append(f"{member.name} is {member.uid}:{member.gid}, {member.mode:o}")
    if len({member.mtime for member in members}) != 1:
        problems.append("the files have several times: another day gives other bytes")
    return problems


def check_program(name: str, program: bytes) -> list[str]:
    problems = []
    print(f"{name}: {len(program)} bytes")
    for place in {str(ROOT), str(pathlib.Path.home())} - {"/"}:
        if (at := program.find(place.encode())) >= 0:
            problems.append(f"the program knows a folder of its builder: {program[at:at + 80]!r}")
    if b".debug_info" in program or b".symtab" in program:
        problems.append("the program is not stripped")
    return problems


def check_lintian(package: str) -> list[str]:
    if not shutil.which("lintian"):
        print("lintian is missing: its opinion is NOT asked")
        return ["and CI=true"] if os.environ.get("CI", "").lower() in ("true", "1") else []
    done = subprocess.run(["lintian", package], check=False, stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.DEVNULL)
    return [f"lintian: {kind}: {tag}{rest}" for kind, tag, rest in TAG.findall(done.stdout)]


def main() -> int:
    *options, package = sys.argv[1:]
    problems = check_control(package)
    with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", package], stdout=subprocess.PIPE) as unpacked:
        with tarfile.open(fileobj=unpacked.stdout, mode="r|") as tar:
            members = []
            for member in tar:
                members.append(member)
                if member.name == "./usr/bin/graben-ecu":
                    problems += check_program(member.name, tar.extractfile(member).read())
    problems += check_members(members)
    if not options:
        problems += check_lintian(package)
    print("\n".join([*problems, f"contents: {len(members)} entries, {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
