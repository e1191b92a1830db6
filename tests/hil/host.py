# SPDX-License-Identifier: Apache-2.0
"""The host itself, where its kernel has vcan: no emulation, the real clock. The scenario gets a
network and process numbers of its own, so that it neither meets nor disturbs the user's vcan0."""

import os
import pathlib
import subprocess
import tempfile
import time

from machine import HERE, SYSTEM_PATH, TOOLS, which
from scenario import TIMED_OUT, Nowhere, Result, Scenario

OWN_NETWORK = ["unshare", "--net"]
# And processes: what the scenario leaves behind ends with it.
OWN_WORLD = [*OWN_NETWORK, "--pid", "--fork", "--kill-child", "--mount-proc"]


def prepare():
    """Nowhere, with the reason, if this host has no vcan for us."""
    if os.geteuid() != 0:
        raise Nowhere("a vcan of one's own needs root")
    for name in ("unshare", *TOOLS):
        which(name)
    try:
        done = subprocess.run([*OWN_NETWORK, str(which("ip")), "link", "add", "type", "vcan"],
                              capture_output=True, text=True, check=False, timeout=1800)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Nowhere(str(error)) from None
    if done.returncode != 0:
        raise Nowhere(f"its kernel gives no vcan: {done.stderr.strip()}")


def run(scenario: Scenario, out: pathlib.Path) -> Result:
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as work:
        folder, programs = pathlib.Path(work, "hil"), pathlib.Path(work, "bin")
        programs.mkdir()
        for program in scenario.programs:
            (programs / program.name).symlink_to(program.resolve())
        files = {**scenario.files, "scenario": scenario.script, "hil.sh": HERE / "hil.sh"}
        for name, path in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).symlink_to(path.resolve())

        environment = {**os.environ, "OUT": str(out.resolve()), "HIL_WHERE": "host",
                       "PATH": f"{programs}:{os.environ.get('PATH', '')}:{SYSTEM_PATH}"}
        limit = ["timeout", "--signal=KILL", f"{scenario.timeout_s:g}"]
        with open(out / "console.txt", "wb") as stream:
            done = subprocess.run([*limit, *OWN_WORLD, "sh", "./scenario"], cwd=folder, check=False,
                                  env=environment, stdin=subprocess.DEVNULL, stdout=stream,
                                  stderr=subprocess.STDOUT)
    wall_s = time.monotonic() - started
    # A scenario that kills itself with the same signal, in time, is not a timeout.
    late = done.returncode in (-9, 137) and wall_s >= scenario.timeout_s
    console = (out / "console.txt").read_text(encoding="utf-8", errors="replace")
    return Result(TIMED_OUT if late else done.returncode, "host", console, wall_s)
