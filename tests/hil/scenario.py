# SPDX-License-Identifier: Apache-2.0
"""What is to be run, how it ended, and why it could not be: shared by the host and the machine."""

import dataclasses
import pathlib
import re

TIMED_OUT = 124
# In the virtual machine an instruction takes 2^ICOUNT_SHIFT ns.
ICOUNT_SHIFT = 2
VERDICT = re.compile(r"(?:exit (\d{1,3})|(timeout))\n?")


class Nowhere(Exception):
    """Neither this host nor a virtual machine on it can run the scenario; the text says why."""


class Broken(Exception):
    """The machine or the harness failed, so that nothing is known of what the scenario tests."""


@dataclasses.dataclass
class Scenario:
    """A POSIX shell script and what it needs. It finds itself in a network of its own, in the
    folder with the files, the programs on PATH, and leaves results in the folder $OUT."""
    script: pathlib.Path
    programs: list[pathlib.Path] = dataclasses.field(default_factory=list)
    # Name in the scenario's folder -> where it is.
    files: dict[str, pathlib.Path] = dataclasses.field(default_factory=dict)
    # SJA1000 controllers on one bus, can0 and on; only in a virtual machine.
    controllers: int = 0
    # Modules of the kernel that only this scenario loads; only in a virtual machine.
    modules: tuple[str, ...] = ()
    # A whole Debian, as cpio, that is the guest then: its own systemd runs the script as a service,
    # with its own programs. Only in a virtual machine.
    root: pathlib.Path | None = None
    # Of the scenario's own clock, which in the virtual machine is not the host's.
    timeout_s: float = 60.0
    # Less for what the usual one is too slow for.
    icount_shift: int = ICOUNT_SHIFT
    # For all of it, on the host's clock: long, because a busy host is no fault of the scenario's.
    patience_s: float = 600.0


@dataclasses.dataclass
class Result:
    """How a scenario ended."""
    # The script's exit status; TIMED_OUT when it had to be stopped.
    status: int
    where: str
    console: str
    wall_s: float


def status_in(verdict: str | None, console: str) -> int:
    """The exit status, from what the guest has left; Broken, with the reason, if that is nothing."""
    if verdict is not None and (found := VERDICT.fullmatch(verdict)):
        return TIMED_OUT if found[2] else int(found[1])
    if verdict is not None:
        raise Broken(f"the guest says '{verdict.strip()}'")
    if panic := re.search(r"Kernel panic - not syncing.*", console):
        raise Broken(panic[0].strip())
    raise Broken("the guest ended without a result")


def tail(console: str, lines: int = 40) -> str:
    return "\n".join(console.splitlines()[-lines:])
