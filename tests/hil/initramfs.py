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
        """The archive. The same tree gives the same bytes: no times, no owners, sorted by path."""
        parts, length = [], 0
        entries = sorted(self.entries.items()) + [("TRAILER!!!", (0, b""))]
        for number, (path, (mode, content)) in enumerate(entries, 1):
            name = path.encode() + b"\0"
            fields = (number, mode, 0, 0, 1, 0, len(content), 0, 0, 0, 0, len(name), 0)
            record = b"070701" + b"".join(b"%08X" % field for field in fields) + name
            record += bytes(-len(record) % 4)
            parts += [record, content, bytes(-len(content) % 4)]
            length += len(record) + len(content) + (-len(content) % 4)
        # The kernel reads whole 512-byte blocks, as cpio writes them.
        parts.append(bytes(-length % 512))
        return b"".join(parts)
