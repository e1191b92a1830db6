# SPDX-License-Identifier: Apache-2.0
"""Debian's PREEMPT_RT kernel for the guest: which package, where its parts are kept, which modules.

The package is fetched once; after that the cache answers and no network is needed. Delete the
cache's folder to get a newer kernel.
"""

import fcntl
import lzma
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import zlib

METAPACKAGE = "linux-image-rt-amd64"
# The kernel, and the wanted modules, most by folder, with all they depend on: 12 of 390 MB.
WANTED = ["./boot/vmlinuz-*", *(f"./lib/modules/*/kernel/{part}" for part in (
    "net/can/*", "drivers/net/can/*", "net/9p/*", "fs/9p/*", "fs/netfs/*", "fs/fscache/*",
    "drivers/virtio/*", "net/sched/*", "drivers/input/evdev.ko", "drivers/input/misc/uinput.ko",
    "drivers/block/virtio_blk.ko", "fs/ext4/*", "fs/jbd2/*", "fs/mbcache.ko", "lib/crc16.ko", "crypto/crc32c_generic.ko"))]
# In the name of a kernel's folder: one that was unpacked for fewer modules is not taken.
UNPACKED = f"{zlib.crc32(' '.join(WANTED).encode()):08x}"
VERSIONED = re.compile(r"^[ |]*Depends: (linux-image-\d\S*)$", re.MULTILINE)
DEPENDS = re.compile(rb"\0depends=([^\0]*)\0")


class NoKernel(Exception):
    """The kernel cannot be had here; the text says why."""


def versioned_package(listing: str) -> str:
    """The package with the kernel itself, from what `apt-cache depends` says of the metapackage."""
    if not (found := VERSIONED.search(listing)):
        raise NoKernel(f"apt knows no {METAPACKAGE}")
    return found[1]


def module_name(text: str) -> str:
    """can-raw, can_raw and can-raw.ko are one module."""
    return text.removesuffix(".ko").replace("-", "_")


def dependencies(module: bytes) -> list[str]:
    """What a module says of itself; the package has no modules.dep, that is made on installation."""
    found = DEPENDS.search(module)
    return [module_name(name) for name in found[1].decode().split(",") if name] if found else []


def load_order(wanted: list[str], needs: dict[str, list[str]]) -> list[str]:
    """The wanted modules and all they need, each after what it needs itself."""
    order: list[str] = []

    def visit(name: str, above: tuple[str, ...]):
        if name in order:
            return
        if name in above:
            raise NoKernel(f"modules need each other: {' -> '.join((*above, name))}")
        if name not in needs:
            raise NoKernel(f"no module {' -> '.join((*above, name))}")
        for needed in needs[name]:
            visit(needed, (*above, name))
        order.append(name)

    for name in wanted:
        visit(module_name(name), ())
    return order


def unpacked(bzimage: bytes) -> bytes:
    """The ELF kernel in a bzImage. QEMU starts it directly (PVH), 5 s earlier: the guest, emulated,
    would decompress itself far more slowly than we do."""
    setup_sectors = bzimage[0x1F1] or 4
    offset, length = struct.unpack_from("<II", bzimage, 0x248)
    start = (setup_sectors + 1) * 512 + offset
    try:
        elf = lzma.LZMADecompressor(lzma.FORMAT_XZ).decompress(bzimage[start:start + length])
    except lzma.LZMAError as error:
        raise NoKernel(f"the kernel is not packed by xz: {error}") from None
    if elf[:4] != b"\x7fELF":
        raise NoKernel("the kernel's package holds something else than an ELF kernel")
    return elf


def apt(*command: str, folder: pathlib.Path | None = None) -> str:
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False,
                              timeout=300, env={**os.environ, "LC_ALL": "C"})
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoKernel(str(error)) from None
    if done.returncode != 0:
        raise NoKernel(f"{' '.join(command)}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


def download(folder: pathlib.Path) -> pathlib.Path:
    package = versioned_package(apt("apt-cache", "depends", METAPACKAGE))
    apt("apt-get", "-q", "download", package, folder=folder)
    return next(folder.glob(f"{package}_*.deb"))


def download_or_update(folder: pathlib.Path) -> pathlib.Path:
    try:
        return download(folder)
    except NoKernel:
        # No lists yet, or lists that name a version which the server has dropped.
        apt(*([] if os.geteuid() == 0 else ["sudo", "-n"]), "apt-get", "-q", "update")
        return download(folder)


def unpack(package: pathlib.Path, folder: pathlib.Path):
    """vmlinux and the modules, named as they are called, from the package into the folder."""
    tree = folder / "package"
    tree.mkdir()
    with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", str(package)],
                          stdout=subprocess.PIPE) as packed:
        # Python's tarfile takes seconds for the 390 MB around what is wanted.
        taken = subprocess.run(["tar", "-x", "-C", str(tree), "--wildcards", *WANTED],
                               stdin=packed.stdout, stderr=subprocess.PIPE, text=True, check=False)
    if packed.returncode != 0 or taken.returncode != 0:
        raise NoKernel(f"{package.name} cannot be unpacked: {taken.stderr.strip()}")
    image = next(tree.glob("boot/vmlinuz-*"))
    (folder / "vmlinux").write_bytes(unpacked(image.read_bytes()))
    (folder / "modules").mkdir()
    for module in tree.rglob("*.ko"):
        module.rename(folder / "modules" / f"{module_name(module.name)}.ko")
    shutil.rmtree(tree)


class Kernel:
    """A folder of the cache with one kernel's parts."""

    def __init__(self, folder: pathlib.Path):
        self.image = folder / "vmlinux"
        self.modules = {path.stem: path for path in (folder / "modules").glob("*.ko")}

    def load_order(self, wanted: list[str]) -> list[str]:
        needs = {name: dependencies(path.read_bytes()) for name, path in self.modules.items()}
        return load_order(wanted, needs)


def cached(cache: pathlib.Path) -> Kernel | None:
    """The kernel fetched last, if there is one."""
    folders = sorted(cache.glob(f"kernel-*-{UNPACKED}/"), key=lambda folder: folder.stat().st_mtime)
    return Kernel(folders[-1]) if folders else None


def fetch(cache: pathlib.Path) -> Kernel:
    """The kernel from the cache, or else by apt. Two tests at a time fetch it once."""
    cache.mkdir(parents=True, exist_ok=True)
    with open(cache / "lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if kernel := cached(cache):
            return kernel
        with tempfile.TemporaryDirectory(dir=cache) as work:
            package = download_or_update(pathlib.Path(work))
            folder = pathlib.Path(work, "kernel")
            folder.mkdir()
            unpack(package, folder)
            # Last, and at once: what has this name is whole.
            folder.rename(cache / f"kernel-{package.name.split('_')[1]}-{UNPACKED}")
        return cached(cache)
