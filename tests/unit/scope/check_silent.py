#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What hears a real bus must have no way to speak on it: its objects call nothing that could send,
neither of the system's nor of ours."""

import re
import subprocess
import sys

# As a function of the C library, or as a member of a class of ours.
SPEAKS = re.compile(r"(?:^|::)(?:p?writev?2?|send(?:to|msg|mmsg|file)?|transmit|splice|vmsplice|"
                    r"io_\w+|ioctl|syscall|f?printf|fwrite|fputs|to_socketcan)\b|SocketCanPort")


def main() -> None:
    found, calls = [], 0
    objects = sys.argv[1:]
    if not objects:
        sys.exit("check_silent.py: no objects to look at")
    for name in objects:
        symbols = subprocess.run(["nm", "-C", "-u", name], capture_output=True, text=True,
                                 check=True).stdout.split("\n")
        called = [line.strip().removeprefix("U ").strip() for line in symbols if line.strip()]
        calls += len(called)
        found += [f"{name}: {symbol}" for symbol in called if SPEAKS.search(symbol)]
    if calls == 0:
        sys.exit("check_silent.py: these call nothing at all; the wrong files?")
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
