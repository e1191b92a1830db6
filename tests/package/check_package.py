#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs the package into a bare Debian 12, tries what is in it, and takes it out again:
check_package.py PACKAGE. No service manager runs there; check_service.py has one."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import debian_root
from debian_root import Nowhere

import guest

PROFILE = "/usr/share/graben/excavator_22t.toml"
SETTINGS = "etc/default/graben-ecu"
WANTS = "etc/systemd/system/multi-user.target.wants/graben-ecu.service"
# dpkg's own book-keeping, and the loader's and the password file's copies.
NOT_OURS = ("var/lib/dpkg/", "var/log/", "var/cache/", "etc/ld.so.cache", "proc/", "dev/", "sys/")
# Of the sources: ./run says it without a build.
VERSION = subprocess.run([pathlib.Path(__file__).resolve().parents[2] / "run", "--version"],
                         stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


class Root:
    """A Debian of its own; what its commands say, and what was not as it should be."""

    def __init__(self, path: pathlib.Path):
        self.path = path
        self.problems: list[str] = []

    def run(self, *command: str) -> tuple[int, str]:
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "LC_ALL": "C", "HOME": "/",
                       "DEBIAN_FRONTEND": "noninteractive"}
        done = subprocess.run(["chroot", str(self.path), *command], env=environment, check=False,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.STDOUT)
        return done.returncode, done.stdout

    def expect(self, status: int, words: list[str], *command: str) -> str:
        found, said = self.run(*command)
        missing = [word for word in words if word not in said]
        if found != status or missing:
            self.problems.append(f"`{' '.join(command)}`: status {found} instead of {status}"
                                 f"{f', {missing} not said' if missing else ''}:\n{said}")
        return said

    def demand(self, good: bool, what: str):
        if not good:
            self.problems.append(what)

    def files(self) -> dict[str, tuple]:
        """Path -> what it is; not times, which dpkg changes in folders."""
        found = {}
        for folder, folders, names in os.walk(self.path):
            for name in [*folders, *names]:
                path = pathlib.Path(folder, name)
                short = str(path.relative_to(self.path))
                if not f"{short}/".startswith(NOT_OURS) and short not in NOT_OURS:
                    about = path.lstat()
                    found[short] = (about.st_mode, about.st_uid, about.st_gid,
                                    0 if path.is_dir() else about.st_size)
        return found


def check_refusals(root: Root):
    """Whatever keeps it from starting is told, with the status that says whether to try again."""
    ecu = "/usr/bin/graben-ecu"
    root.expect(0, [VERSION], ecu, "--version")
    said = root.expect(0, ["--can", "--profile", "SCHED_FIFO"], ecu, "--help")
    page = subprocess.run(["gzip", "-dc"], stdout=subprocess.PIPE, text=True, check=True, stdin=open(
        root.path / "usr/share/man/man8/graben-ecu.8.gz", "rb")).stdout.replace("\\", "")
    for option in {word.strip(",") for word in said.split() if word.startswith("--")}:
        root.demand(option in page, f"{option} is not on the manual page")

    bad = [([], ["--can is required"]), (["--can", "can0"], ["--profile is required"]),
           (["--can", "can0", "--profile", PROFILE, "--fast"], ["--fast"]),
           (["--can", "a/b", "--profile", PROFILE], ["'a/b' is no name of an interface"]),
           (["--can", "can0", "--profile", PROFILE, "--rt-priority", "100"], ["--rt-priority"]),
           (["--can", "can0", "--profile", PROFILE, "--cpu", "-1"], ["--cpu"])]
    for options, words in bad:
        root.expect(2, words, ecu, *options)

    root.expect(2, ["'mine': there is no such file", "/etc/graben", "/usr/share/graben"],
                ecu, "--can", "can0", "--profile", "mine")
    (root.path / "etc/graben/broken.toml").write_text("[machine\n")
    root.expect(2, ["broken.toml", "line 1"], ecu, "--can", "can0", "--profile", "broken")
    check_wrong_profile(root, ecu)
    # By name from /usr/share, by name from /etc, as a file: good up to the bus.
    shutil.copy(root.path / PROFILE[1:], root.path / "etc/graben/mine.toml")
    for name in ("excavator_22t", "excavator_22t.toml", "mine", PROFILE):
        said = root.expect(1, [], ecu, "--can", "no_can0", "--profile", name)
        # The latter on a host whose kernel has no CAN.
        root.demand(bool(re.fullmatch(r"graben-ecu: (no_can0: .* is the interface there|socket\(AF_CAN\): "
                                      r".*needs a kernel with CAN).*\n", said)),
                    f"a missing interface is told otherwise: {said}")
    # A task by name, in the order of the folders.
    excavator = "/usr/share/graben/excavator_12t.toml"
    root.expect(2, ["'none': there is no such file", "/etc/graben/tasks", "/usr/share/graben/tasks"],
                ecu, "--can", "no_can0", "--profile", excavator, "--task", "none")
    root.expect(1, [], ecu, "--can", "no_can0", "--profile", excavator, "--task", "flatten")
    own = root.path / "etc/graben/tasks/flatten.toml"
    own.parent.mkdir()
    own.write_text("surplus = 1\n")
    root.expect(2, ["/etc/graben/tasks/flatten.toml", "surplus"],
                ecu, "--can", "no_can0", "--profile", excavator, "--task", "flatten")
    shutil.rmtree(own.parent)
    for name in ("broken", "wrong", "mine"):
        (root.path / f"etc/graben/{name}.toml").unlink()


def check_wrong_profile(root: Root, ecu: str):
    """Several faults at once, each told with its line."""
    lines = (root.path / PROFILE[1:]).read_text().splitlines()
    numbers = [number for number, line in enumerate(lines)
               if line.split("=")[0].strip() in ("relief", "speed_max", "density", "attitude_gain")]
    for number in numbers:
        lines[number] = f"{lines[number].split('=')[0]}= -1"
    (root.path / "etc/graben/wrong.toml").write_text("\n".join([*lines, "[surplus]", "key = 1", ""]))
    root.demand(len(numbers) >= 2, "the profile has other keys than this test: nothing wrong was tried")
    root.expect(2, ["wrong.toml", "surplus", *(f"line {number + 1}" for number in numbers)],
                ecu, "--can", "can0", "--profile", "wrong")


def check_life(root: Root, package: str):
    """In, out, and nothing left."""
    before = root.files()
    shutil.copy(package, root.path / "tmp/graben-ecu.deb")
    before_deb = time.monotonic()
    said = root.expect(0, [], "dpkg", "-i", "/tmp/graben-ecu.deb")
    print(f"dpkg -i: {time.monotonic() - before_deb:.1f} s")
    for word in ("warning", "error", "not found", "Failed"):
        root.demand(word not in said, f"dpkg -i says '{word}':\n{said}")
    root.expect(0, ["install ok installed"], "dpkg", "-s", "graben-ecu")
    root.expect(0, [], "dpkg", "--verify", "graben-ecu")
    root.demand(not os.path.lexists(root.path / WANTS), "it is enabled by its installation")
    check_refusals(root)

    settings = root.path / SETTINGS
    shipped, changed = settings.read_text(), "GRABEN_CAN=can1\nGRABEN_PROFILE=mine\nGRABEN_OPTIONS=\n"
    settings.write_text(changed)
    root.expect(0, [], "dpkg", "-i", "/tmp/graben-ecu.deb")
    root.demand(settings.read_text() == changed, "installed again, it has overwritten the settings")
    # As `systemctl enable` does where no manager runs.
    (root.path / WANTS).parent.mkdir(parents=True, exist_ok=True)
    (root.path / WANTS).unlink(missing_ok=True)
    (root.path / WANTS).symlink_to("/usr/lib/systemd/system/graben-ecu.service")
    root.expect(0, [], "dpkg", "-i", "/tmp/graben-ecu.deb")
    root.demand(os.path.lexists(root.path / WANTS), "installed again, it is no longer enabled")
    # What systemd makes of StateDirectory=, and the process puts there.
    stored = root.path / "var/lib/private/graben-ecu/faults.a"
    stored.parent.mkdir(parents=True)
    stored.write_bytes(b"GRBR")
    (root.path / "var/lib/graben-ecu").symlink_to("private/graben-ecu")
    root.expect(0, [], "dpkg", "-r", "graben-ecu")
    root.demand(stored.exists(), "remove has taken what was stored")
    root.demand(settings.exists() and settings.read_text() == changed, "remove has taken the settings")
    root.demand(not os.path.lexists(root.path / WANTS), "removed, it is still enabled")
    root.demand(not (root.path / "usr/bin/graben-ecu").exists(), "removed, the program is still there")
    root.expect(0, [], "dpkg", "-i", "/tmp/graben-ecu.deb")
    root.demand(settings.read_text() == changed, "installed after a remove, it has lost the settings")
    root.demand(not os.path.lexists(root.path / WANTS), "installed after a remove, it is enabled")

    own = root.path / "etc/graben/own.toml"
    own.write_text("# the administrator's\n")
    root.expect(0, [], "dpkg", "-P", "graben-ecu")
    root.demand(not stored.parent.exists() and not os.path.lexists(root.path / "var/lib/graben-ecu"),
                "purge has left what was stored")
    stored.parents[1].rmdir()
    root.demand(own.exists(), "purge has taken the administrator's profile")
    own.unlink()
    own.parent.rmdir()
    root.expect(0, [], "dpkg", "-i", "/tmp/graben-ecu.deb")
    root.demand(settings.read_text() == shipped, "installed after a purge, the settings are not the shipped")
    root.expect(0, [], "dpkg", "-P", "graben-ecu")
    (root.path / "tmp/graben-ecu.deb").unlink()
    after = root.files()
    for name in sorted(before.keys() | after.keys()):
        root.demand(before.get(name) == after.get(name), f"left by purge: {name}: "
                    f"{before.get(name)} before, {after.get(name)} after")


def main() -> int:
    started = time.monotonic()
    package = sys.argv[1]
    try:
        with debian_root.unpacked(debian_root.fetch() / "bare.tar") as path:
            root = Root(path)
            check_life(root, package)
    except Nowhere as reason:
        return guest.give_up("installation", reason, "package")
    print("\n".join([*root.problems, f"package: {len(root.problems)} problems, "
                                     f"{time.monotonic() - started:.1f} s"]))
    return 1 if root.problems else 0


if __name__ == "__main__":
    sys.exit(main())
