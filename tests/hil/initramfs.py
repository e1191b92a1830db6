# SPDX-License-Identifier: Apache-2.0
"""The guest's file tree, packed as the kernel's initramfs: a cpio archive of the newc kind.

Written here because the format is thirty lines, and Debian's cpio would be one package more.
"""

import os
import pathlib
import re
import stat
import subprocess

REGULAR, FOLDER, LINK = stat.S_IFREG, stat.S_IFDIR, stat.S_IFLNK
# "libc.so.6 => /lib/.../libc.so.6 (0x...)" and "/lib64/ld-linux-x86-64.so.2 (0x...)".
LIBRARY = re.compile(r"^\s*(?:(\S+) => )?(not found|/\S+)", re.MULTILINE)


def record(number: int, path: str, mode: int, content: bytes, owner: tuple[int, int] = (0, 0),
           device: tuple[int, int] = (0, 0)) -> bytes:
    """One entry of a newc archive. No times: the same tree gives the same bytes."""
    name = path.encode() + b"\0"
    fields = (number, mode, *owner, 1, 0, len(content), 0, 0, *device, len(name), 0)
    head = b"070701" + b"".join(b"%08X" % field for field in fields) + name
    return b"".join((head, bytes(-len(head) % 4), content, bytes(-len(content) % 4)))


def end(length: int) -> bytes:
    """What closes an archive of so many bytes. The kernel reads whole 512-byte blocks."""
    last = record(0, "TRAILER!!!", 0, b"")
    return last + bytes(-(length + len(last)) % 512)


class MissingLibrary(Exception):
    """A program for the guest needs a library that the host has not got."""


def libraries_in(listing: str) -> list[str]:
    """Paths of the shared libraries, the loader among them, in the output of ldd."""
    found = []
    for name, path in LIBRARY.findall(listing):
        if path == "not found":
            raise MissingLibrary(name)
        found.append(path)
    return found


def libraries_of(program: pathlib.Path) -> list[str]:
    done = subprocess.run(["ldd", str(program)], capture_output=True, text=True, check=False,
                          env={**os.environ, "LC_ALL": "C"})
    try:
        # A static program, or a script: ldd says so and fails.
        return libraries_in(done.stdout) if done.returncode == 0 else []
    except MissingLibrary as missing:
        raise MissingLibrary(f"{program} needs {missing}") from None


class Tree:
    """What will be in the archive: path without leading slash -> (mode, content)."""

    def __init__(self):
        self.entries: dict[str, tuple[int, bytes]] = {}

    def add_folder(self, path: str):
        path = path.strip("/")
        if path and path not in self.entries:
            self.add_folder(os.path.dirname(path))
            self.entries[path] = (FOLDER | 0o755, b"")

    def add(self, path: str, content: bytes, mode: int = 0o644):
        self.add_folder(os.path.dirname(path))
        self.entries[path.strip("/")] = (REGULAR | mode, content)

    def add_link(self, path: str, target: str):
        self.add_folder(os.path.dirname(path))
        self.entries[path.strip("/")] = (LINK | 0o777, target.encode())

    def add_program(self, path: str, program: pathlib.Path):
        """The program, and every library it needs under the very path that the loader looks at."""
        self.add(path, program.read_bytes(), 0o755)
        for library in libraries_of(program):
            self.add(library, pathlib.Path(library).read_bytes(), 0o755)

    def pack(self) -> bytes:
        """The archive, sorted by path."""
        packed = b"".join(record(number, path, mode, content) for number, (path, (mode, content))
                          in enumerate(sorted(self.entries.items()), 1))
        return packed + end(len(packed))
