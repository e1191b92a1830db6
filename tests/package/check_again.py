# SPDX-License-Identifier: Apache-2.0
"""Packed again, by somebody with another umask and another clock, it is the same package, byte by byte:
check_again.py PACKAGE PACK BUILD."""

import os
import pathlib
import subprocess
import sys
import tempfile

package, pack, build = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    environment = {**os.environ, "TZ": "Pacific/Kiritimati", "LC_ALL": "C"}
    done = subprocess.run([pack, build, folder], umask=0o077, env=environment, check=True,
                          stdout=subprocess.PIPE, text=True)
    same = pathlib.Path(done.stdout.strip()).read_bytes() == pathlib.Path(package).read_bytes()
print("the same bytes" if same else "packed again it has other bytes")
sys.exit(0 if same else 1)
