#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The package of graben, the engineer's tool: check_tool.py [--without-lintian|--install] PACKAGE. Its files
and no others, none that graben-ecu has, nothing of the folder that it was built in, and what lintian says.
With --install: in a bare Debian 12, with Debian's own libraries, it digs, finds its profiles, shows a man
page and completes, and goes without a trace. That needs the mirror."""

import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

import check_contents
from check_contents import ROOT

MACHINES = ROOT / "app/machines"
TAG = re.compile(r"^([EW]): graben: (\S+)(.*)$", re.MULTILINE)
# Debian's, and none of the tree's own.
LIBRARIES = re.compile(r"^(lib[a-z0-9.+-]+|zlib1g)$")


def programs() -> set[str]:
    """Programs behind graben, from its table: {"dig", "dig", ...}, command and program."""
    table = (ROOT / "app/cli/command_table.hpp").read_text(encoding="utf-8")
    return set(re.findall(r'^    \{"[a-z-]+", "([a-z]+)",', table, re.MULTILINE))


def wanted_files(commands: set[str]) -> dict[str, int]:
    shipped = [f"machines/{path.relative_to(MACHINES)}" for kind in ("*.toml", "*.xml") for path in MACHINES.rglob(kind)]
    shipped += ["designs/banked.xml", "designs/crest.xml", "designs/curved.xml"]
    return {name: 0o755 if name.startswith(("./usr/bin/", "./usr/libexec/")) else 0o644 for name in (
        "./usr/bin/graben", *(f"./usr/libexec/graben/graben-{name}" for name in programs()),
        *(f"./usr/share/graben/{name}" for name in shipped),
        *(f"./usr/share/man/man1/{name}.1.gz" for name in commands),
        "./usr/share/bash-completion/completions/graben",
        *(f"./usr/share/doc/graben/{name}" for name in ("README", "changelog.gz", "copyright")))}


def commands_of(program: pathlib.Path, *path: str) -> set[str]:
    """A man page for each command that a help lists."""
    said = subprocess.run([program, *path, "--help"], check=True, capture_output=True, text=True).stdout
    listed = re.search(r"^Commands:\n((?: .*\n)+)", said, re.MULTILINE)
    names = {"-".join(("graben", *path))}
    for name in re.findall(r"^  (\S+)", listed[1], re.MULTILINE) if listed else []:
        names |= commands_of(program, *path, name)
    return names


def check_unpacked(package: str, folder: pathlib.Path) -> list[str]:
    subprocess.run(["dpkg-deb", "-x", package, folder], check=True)
    found = {f"./{path.relative_to(folder)}": path for path in folder.rglob("*") if not path.is_dir()}
    wanted = wanted_files(commands_of(folder / "usr/bin/graben"))
    problems = [f"{name} is missing" for name in sorted(wanted.keys() - found.keys())]
    problems += [f"{name} does not belong into it" for name in sorted(found.keys() - wanted.keys())]
    problems += [f"{name} has the mode {path.lstat().st_mode & 0o7777:o}" for name, path in found.items()
                 if name in wanted and (path.is_symlink() or path.stat().st_mode & 0o7777 != wanted[name])]
    problems += [f"{name} is graben-ecu's" for name in sorted(found.keys() & check_contents.FILES.keys())]
    for file in (folder / "usr/bin/graben", *(folder / "usr/libexec/graben").iterdir()):
        problems += check_contents.check_program(file.name, file.read_bytes())
    for name in ("usr/share/man/man1/graben-dig.1.gz", "usr/share/man/man1/graben.1.gz"):
        page = subprocess.run(["gzip", "-dc", folder / name], check=True, capture_output=True, text=True).stdout
        problems += [f"{name} has no {part}" for part in (".SH NAME", ".SH OPTIONS", ".SH EXAMPLES") if part not in page]
    problems += check_completion(folder / "usr/share/bash-completion/completions/graben")
    return problems


def check_completion(script: pathlib.Path) -> list[str]:
    """As bash asks for it: the words typed, the last one begun."""
    problems = []
    for typed, wanted in (("graben gr", {"grade"}), ("graben campaign mer", {"merge"}), ("graben dig --la", {"--law"}),
                          ("graben dig --law k", {"kim"}), ("graben dig --soil s", {"sand", "stones"}),
                          ("graben campaign dig --dra", {"--draws"}), ("graben grade --soil l", {"loam"}),
                          ("graben dig --profile excavator_12t_", {"excavator_12t_ls", "excavator_12t_nfc"}),
                          ("graben autodig --task fl", {"flatten"}), ("graben dig --bus z", {"zx200"}),
                          ("graben dig --simulated excavator_22t_f", {"excavator_22t_found"}),
                          ("graben dig --simulated dozer", {"dozer_9t", "dozer_9t_tilt"}),
                          ("graben check doz", {"dozer_9t", "dozer_9t_tilt"}),
                          ("graben check --str", {"--strict"}), ("graben check READ", {"README.md"}),
                          ("graben dig --out app", {"app"}), ("graben export READ", {"README.md"})):
        words = typed.split(" ")
        code = (f"source '{script}'; COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; _graben; "
                'printf "%s\\n" "${COMPREPLY[@]}"')
        said = subprocess.run(["bash", "-c", code], check=False, capture_output=True, text=True, cwd=ROOT)
        if set(said.stdout.split()) != wanted or said.stderr:
            problems.append(f"'{typed}' is completed to {said.stdout.split()} {said.stderr}")
    return problems


def check_control(package: str) -> list[str]:
    depends = check_contents.run("dpkg-deb", "-f", package, "Depends")
    print(f"{pathlib.Path(package).name}: {pathlib.Path(package).stat().st_size} bytes; {depends.strip()}")
    names = [entry.split()[0] for entry in depends.split(",")]
    problems = [f"depends on {name}" for name in names if not LIBRARIES.match(name)]
    problems += [f"{field} is set" for field in ("Pre-Depends", "Provides", "Conflicts")
                 if check_contents.run("dpkg-deb", "-f", package, field).strip()]
    with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", package], stdout=subprocess.PIPE) as unpacked:
        with tarfile.open(fileobj=unpacked.stdout, mode="r|") as tar:
            members = list(tar)
    if any((member.uid, member.gid) != (0, 0) for member in members) or len({m.mtime for m in members}) != 1:
        problems.append("owners or times are not one")
    return problems


def check_lintian(package: str) -> list[str]:
    if not shutil.which("lintian"):
        return check_contents.check_lintian(package)
    done = subprocess.run(["lintian", package], check=False, stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.DEVNULL)
    return [f"lintian: {kind}: {tag}{rest}" for kind, tag, rest in TAG.findall(done.stdout)]


def check_install(package: str) -> list[str]:
    import debian_root
    import check_package
    with debian_root.unpacked(debian_root.fetch() / "bare.tar") as path:
        root = check_package.Root(path)
        shutil.copy("/etc/resolv.conf", path / "etc/resolv.conf")
        shutil.copy(package, path / "tmp/graben.deb")
        root.expect(0, [], "apt-get", "-q", "update")
        root.expect(0, [], "apt-get", "-q", "install", "-y", "--no-install-recommends", "/tmp/graben.deb")
        root.expect(0, ["install ok installed"], "dpkg", "-s", "graben")
        root.expect(0, [check_package.VERSION], "graben", "--version")
        root.expect(0, ["path error", "/tmp/out/dig.html"], "graben", "dig", "--out", "/tmp/out")
        root.expect(0, ["excavator_12t"], "graben", "check", "excavator_12t", "--out", "/tmp/out")
        root.expect(1, ["/usr/share/graben/machines"], "graben", "check", "none")
        root.expect(0, [], "dpkg", "-P", "graben")
        root.demand(not (path / "usr/share/graben").exists(), "purged, its profiles are still there")
    return root.problems


def main() -> int:
    import tempfile
    *options, package = sys.argv[1:]
    if "--install" in options:
        import debian_root  # First: it knows where the other two are.
        import guest
        from scenario import Nowhere
        try:
            problems = check_install(package)
        except Nowhere as reason:
            return guest.give_up("installation of graben", reason, "package")
    else:
        problems = check_control(package)
        with tempfile.TemporaryDirectory() as folder:
            problems += check_unpacked(package, pathlib.Path(folder))
        if "--without-lintian" not in options:
            problems += check_lintian(package)
    print("\n".join([*problems, f"graben's package: {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
