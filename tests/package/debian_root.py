# SPDX-License-Identifier: Apache-2.0
"""Roots of Debian 12 to install into, made once by debootstrap and kept: a bare one (minbase), and the
same with systemd, udev, iproute2 and can-utils as an initramfs for a virtual machine.

The mirror is the one that this host's apt uses. Delete the cache's folder to get newer packages.
"""

import contextlib
import fcntl
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tarfile
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "hil"))

import initramfs  # noqa: E402
from scenario import Nowhere  # noqa: E402

CACHE = HERE.parents[1] / "build" / "package"
SUITE = "bookworm"
SERVICE_PACKAGES = ["systemd-sysv", "udev", "iproute2", "can-utils"]
# Of no use to a package that is installed, and a third of the root.
NEEDLESS = ["var/cache/apt/*.bin", "var/cache/apt/archives/*.deb", "var/lib/apt/lists/*"]
NEEDLESS_IN_A_MACHINE = ["usr/share/doc/*", "usr/share/man/*", "usr/share/locale/*", "usr/share/info/*",
                         "usr/share/zoneinfo/*", "var/log/*.log", "var/log/apt/*",
                         "var/lib/dpkg/*-old", "usr/lib/udev/hwdb.*", "usr/lib/systemd/catalog/*"]


def run(*command: str, limit_s: float = 900.0) -> str:
    """What the command says; Nowhere, with its last words, if it fails."""
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
                              stderr=subprocess.STDOUT, check=False, timeout=limit_s, errors="replace",
                              env={**os.environ, "LC_ALL": "C", "DEBIAN_FRONTEND": "noninteractive"})
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Nowhere(str(error)) from None
    if done.returncode != 0:
        last = " / ".join(done.stdout.strip().splitlines()[-3:])
        raise Nowhere(f"{pathlib.Path(command[0]).name}: status {done.returncode}: {last}")
    return done.stdout


def mirror() -> str:
    listing = run("apt-get", "indextargets", "--format", "$(RELEASE) $(REPO_URI)",
                  "Created-By: Packages", "Component: main")
    for line in listing.splitlines():
        suite, _, uri = line.partition(" ")
        if suite == SUITE:
            return uri
    raise Nowhere(f"this host's apt knows no mirror of {SUITE}")


def drop(root: pathlib.Path, patterns: list[str]):
    for pattern in patterns:
        for path in root.glob(pattern):
            if path.is_dir() and not path.is_symlink():
                shutil.rmtree(path)
            else:
                path.unlink()


def pack_tar(root: pathlib.Path, to: pathlib.Path):
    run("tar", "-c", "--one-file-system", "--numeric-owner", "--sort=name", "-C", str(root), "-f", str(to),
        ".")


def cpio_from_tar(tar: pathlib.Path, to: pathlib.Path):
    """The kernel's format, with owners and modes as in the root."""
    with tarfile.open(tar) as source, open(to, "wb") as sink:
        for number, member in enumerate(source, 1):
            kind = (stat.S_IFDIR if member.isdir() else stat.S_IFLNK if member.issym() else
                    stat.S_IFCHR if member.ischr() else stat.S_IFREG)
            name = member.name.removeprefix("./")
            if name in ("", ".") or (kind == stat.S_IFREG and not (member.isfile() or member.islnk())):
                continue
            # A second name of a file comes as a copy.
            content = member.linkname.encode() if kind == stat.S_IFLNK else b""
            if kind == stat.S_IFREG:
                content = source.extractfile(member).read()
            device = (member.devmajor, member.devminor) if member.ischr() else (0, 0)
            sink.write(initramfs.record(number, name, kind | member.mode, content,
                                        (member.uid, member.gid), device))
        sink.write(initramfs.end(sink.tell()))


def make(cache: pathlib.Path):
    """Both roots, under their names only when they are whole."""
    for name in ("debootstrap", "tar", "chroot"):
        if not shutil.which(name, path=f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin"):
            raise Nowhere(f"{name} is missing; ./test installs it")
    source = mirror()
    with tempfile.TemporaryDirectory(dir=cache) as work:
        root, tar = pathlib.Path(work, "root"), pathlib.Path(work, "root.tar")
        run("debootstrap", "--variant=minbase", SUITE, str(root), source, limit_s=1800.0)
        run("chroot", str(root), "apt-get", "clean")
        drop(root, NEEDLESS)
        pack_tar(root, tar)
        tar.rename(cache / "bare.tar")
        run("chroot", str(root), "apt-get", "-q", "update")
        run("chroot", str(root), "apt-get", "-q", "install", "-y", "--no-install-recommends",
            *SERVICE_PACKAGES, limit_s=1800.0)
        drop(root, NEEDLESS + NEEDLESS_IN_A_MACHINE)
        pack_tar(root, tar)
        cpio_from_tar(tar, pathlib.Path(work, "service.cpio"))
        pathlib.Path(work, "service.cpio").rename(cache / "service.cpio")
        tar.rename(cache / "service.tar")


def fetch(cache: pathlib.Path = CACHE) -> pathlib.Path:
    """The folder with bare.tar, service.tar and service.cpio; Nowhere if they cannot be had."""
    cache.mkdir(parents=True, exist_ok=True)
    with open(cache / "lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not (cache / "service.tar").exists():
            if os.geteuid() != 0:
                raise Nowhere("debootstrap and chroot need root")
            make(cache)
    return cache


@contextlib.contextmanager
def unpacked(tar: pathlib.Path):
    """A root of one's own, gone at the end."""
    if os.geteuid() != 0:
        raise Nowhere("chroot needs root")
    with tempfile.TemporaryDirectory(dir=tar.parent) as work:
        run("tar", "-x", "-p", "--numeric-owner", "-C", work, "-f", str(tar))
        # mkdtemp's 0700 would keep all but root out of it.
        os.chmod(work, 0o755)
        yield pathlib.Path(work)


def main() -> int:
    """Makes them; in the folder that is told, or else in the cache."""
    import guest
    try:
        fetch(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else CACHE)
    except Nowhere as reason:
        return guest.give_up("no Debian root", reason, "package")
    return 0


if __name__ == "__main__":
    sys.exit(main())
