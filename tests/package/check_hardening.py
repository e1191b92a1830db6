#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What systemd's own tools say of the unit, installed in a Debian with systemd that does not run:
check_hardening.py PACKAGE."""

import os
import re
import shutil
import sys
import time

import debian_root
from debian_root import Nowhere

import guest
from check_package import WANTS, Root

UNIT = "graben-ecu.service"
MOST_EXPOSED = 3.0
SCORE = re.compile(r"Overall exposure level for \S+: ([\d.]+) ")


def check(root: Root, package: str):
    shutil.copy(package, root.path / "tmp/graben-ecu.deb")
    root.expect(0, [], "dpkg", "-i", "/tmp/graben-ecu.deb")
    said = root.expect(0, [], "systemd-analyze", "verify", f"/usr/lib/systemd/system/{UNIT}")
    root.demand("graben" not in said, f"systemd-analyze verify:\n{said}")
    said = root.expect(0, [], "systemd-analyze", "security", "--offline=yes", "--no-pager",
                       f"/usr/lib/systemd/system/{UNIT}")
    found = SCORE.search(said)
    print(found[0] if found else said)
    root.demand(bool(found) and float(found[1]) < MOST_EXPOSED, f"more exposed than {MOST_EXPOSED}")
    # At an image's first boot systemd goes through the presets.
    root.expect(0, [], "systemctl", "preset-all", "--preset-mode=enable-only")
    root.demand(not os.path.lexists(root.path / WANTS), "a preset enables it")
    root.expect(0, [], "systemctl", "enable", UNIT)
    root.demand(os.path.lexists(root.path / WANTS), "`systemctl enable` does not enable it")
    root.expect(0, [], "dpkg", "-r", "graben-ecu")
    root.demand(not os.path.lexists(root.path / WANTS), "removed, it is still enabled")


def main() -> int:
    started = time.monotonic()
    try:
        with debian_root.unpacked(debian_root.fetch() / "service.tar") as path:
            root = Root(path)
            check(root, sys.argv[1])
    except Nowhere as reason:
        return guest.give_up("hardening", reason, "package")
    print("\n".join([*root.problems, f"hardening: {len(root.problems)} problems, "
                                     f"{time.monotonic() - started:.1f} s"]))
    return 1 if root.problems else 0


if __name__ == "__main__":
    sys.exit(main())
