# SPDX-License-Identifier: Apache-2.0
"""A package that must be refused: canary.py CASE PACKAGE seeds faults into the package and looks at what
the check says of each. The cases nowhere and nowhere_ci: without a mirror, nothing may pass for tried."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable

HERE = pathlib.Path(__file__).resolve().parent


def edit(path: pathlib.Path, change: Callable[[str], str]):
    before = path.read_text()
    path.write_text(change(before))
    assert path.read_text() != before, f"{path.name} is another one: the seed has no effect"


def dependency(tree: pathlib.Path):
    edit(tree / "DEBIAN/control", lambda text: text.replace("Depends: ", "Depends: libfmt9 (>= 9), "))


def library(tree: pathlib.Path):
    (tree / "usr/lib/libgraben.so").write_bytes(b"\x7fELF")


def unstripped(tree: pathlib.Path):
    with open(tree / "usr/bin/graben-ecu", "ab") as program:
        program.write(b"\0.symtab\0")


def builder(tree: pathlib.Path):
    with open(tree / "usr/bin/graben-ecu", "ab") as program:
        program.write(b"\0" + str(HERE.parents[1]).encode() + b"/app/ecu/main.cpp\0")


def enabled(tree: pathlib.Path):
    edit(tree / "DEBIAN/postinst", lambda text: text.replace("update-state", "enable"))


def leftover(tree: pathlib.Path):
    edit(tree / "DEBIAN/postinst", lambda text: f"{text}\necho 1 >/etc/graben-left\n")


def overwrite(tree: pathlib.Path):
    (tree / "DEBIAN/conffiles").unlink()


def nowhere_to_write_to(tree: pathlib.Path):
    edit(tree / "DEBIAN/control", lambda text: re.sub("@.*>", "@localhost>", text))


# Case: the check, and what seeds each fault -> what has to be said of it.
CASES = {
    "contents": (["check_contents.py", "--without-lintian"], {
        dependency: r"depends on \['libc6', 'libfmt9'",
        library: r"\./usr/lib/libgraben\.so does not belong into it",
        unstripped: "the program is not stripped",
        builder: "the program knows a folder of its builder"}),
    "lintian": (["check_contents.py"], {nowhere_to_write_to: "lintian: E: bogus-mail-host"}),
    "install": (["check_package.py"], {
        enabled: "it is enabled by its installation",
        leftover: "left by purge: etc/graben-left",
        overwrite: "it has overwritten the settings"}),
}
# Case: CI, wanted status, what has to be said.
WITHOUT_A_MIRROR = {
    "nowhere": ("", 0, "^SKIPPED package: .*apt knows no mirror"),
    "nowhere_ci": ("true", 1, "^FAILED package: .*CI=true.*apt knows no mirror"),
}


def without_a_mirror(case: str) -> int:
    told, status, words = WITHOUT_A_MIRROR[case]
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "apt.conf").write_text(
            'Dir::Etc::SourceList "/dev/null";\nDir::Etc::SourceParts "/dev/null";\n')
        done = subprocess.run(
            [sys.executable, "-B", str(HERE / "debian_root.py"), f"{folder}/cache"], check=False,
            env={**os.environ, "CI": told, "APT_CONFIG": f"{folder}/apt.conf"},
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != status or not re.search(words, done.stdout):
        sys.exit(f"{done.stdout}\ncanary {case}: status {done.returncode}, '{words}' expected")
    print(f"canary {case}: as expected")
    return 0


def main() -> int:
    case, package = sys.argv[1:]
    if case in WITHOUT_A_MIRROR:
        return without_a_mirror(case)
    (check, *options), faults = CASES[case]
    with tempfile.TemporaryDirectory() as folder:
        tree, seeded = pathlib.Path(folder, "tree"), pathlib.Path(folder, "seeded.deb")
        subprocess.run(["dpkg-deb", "-R", package, str(tree)], check=True)
        for seed in faults:
            seed(tree)
        subprocess.run(["dpkg-deb", "-b", "--root-owner-group", str(tree), str(seeded)], check=True,
                       stdout=subprocess.DEVNULL)
        done = subprocess.run([sys.executable, "-B", str(HERE / check), *options, str(seeded)],
                              check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(done.stdout)
    if done.returncode == 0 and done.stdout.startswith("SKIPPED package:"):
        return 0
    passed = [seed.__name__ for seed, words in faults.items() if not re.search(words, done.stdout)]
    if done.returncode != 1 or passed:
        sys.exit(f"canary {case}: status {done.returncode}, let through: {passed}")
    print(f"canary {case}: {len(faults)} faults refused")
    return 0


if __name__ == "__main__":
    sys.exit(main())
