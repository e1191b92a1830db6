# SPDX-License-Identifier: Apache-2.0
"""The harness itself: selftest.py WAKE_LATENCY OUT boots, sends, and reads what came back."""

import pathlib
import re
import sys

import guest
from scenario import Broken, Nowhere, Scenario, tail

HERE = pathlib.Path(__file__).resolve().parent
FRAME = re.compile(r"^\((\d+\.\d+)\) (\S+) ([0-9A-F]+)#([0-9A-F]*)", re.MULTILINE)
# The guest's clock counts instructions, so this does not hang on how busy the host is; on a host's own
# kernel nothing is promised.
MAX_LATE_US = 200.0
# As in selftest.sh.
SENT, WAKES = 20, "100"


def frames(path: pathlib.Path) -> list[tuple[float, str, str]]:
    """(time, id, data) of each line of a candump log."""
    return [(float(time), name, data) for time, _, name, data in FRAME.findall(path.read_text())]


def check_vcan(out: pathlib.Path) -> list[str]:
    problems = []
    seen = frames(out / "vcan0.log")
    cyclic = [(time, data) for time, name, data in seen if name == "18FF0100"]
    if [data for _, data in cyclic] != [f"{number:016X}" for number in range(SENT)]:
        problems.append(f"{SENT} frames sent on vcan0, {len(cyclic)} read, or in another order")
    steps = [later[0] - earlier[0] for earlier, later in zip(cyclic, cyclic[1:])]
    if not steps or min(steps) < 0.010:
        problems.append(f"frames sent 10 ms apart, or more, are stamped {min(steps, default=0)} s apart")
    if not any(name == "20000040" for _, name, _ in seen):
        problems.append("the bus-off error frame was not seen")
    if not any(data == "FE02030405060708" for _, _, data in frames(out / "vcan1.log")):
        problems.append("cangw did not change the byte")
    return problems


def check_machine(out: pathlib.Path) -> list[str]:
    problems = []
    if "PREEMPT_RT" not in (text := (out / "kernel").read_text()):
        problems.append(f"no PREEMPT_RT kernel: {text}")
    for sender, name, listener in (("can0", "18FF0203", "can1"), ("can1", "18FF0302", "can0")):
        if sum(seen == name for _, seen, _ in frames(out / f"{listener}.log")) != 1:
            problems.append(f"the frame from {sender} is not once on {listener}")
    # Sent first without delay, which cangw copies; then delayed by 200 ms.
    # By their name too: what cangen makes up later may have the same data.
    at_once, late = ([time for time, *frame in frames(out / f"{interface}.log")
                      if frame == ["124", mark]]
                     for interface, mark in (("vcan0", "A0"), ("vcan1", "A1")))
    if len(at_once) != 1 or len(late) != 1 or not 0.2 < late[0] - at_once[0] < 0.25:
        problems.append(f"netem's delay of 200 ms: sent {at_once}, arrived {late}")
    return problems


def check_wakes(out: pathlib.Path, where: str) -> list[str]:
    problems = []
    for name in ("wake_idle", "wake_busy"):
        line = (out / name).read_text().strip()
        print(f"{name} ({where}): {line}")
        figures = dict(pair.split("=") for pair in line.split())
        late = float(figures["max_us"]) > MAX_LATE_US or figures["overruns"] != "0"
        if figures["wakes"] != WAKES or (late and where == "vm"):
            problems.append(f"{name}: {line}; {MAX_LATE_US:g} us is the most")
    return problems


def main() -> int:
    program, out = map(pathlib.Path, sys.argv[1:])
    scenario = Scenario(script=HERE / "selftest.sh", programs=[program], controllers=2)
    try:
        try:
            result = guest.run(scenario, out)
        except Nowhere as reason:
            print(f"hil: without controllers, then: {reason}")
            scenario.controllers = 0
            result = guest.run(scenario, out)
    except Nowhere as reason:
        return guest.give_up("self-test", reason)
    except Broken as problem:
        print(f"hil: {problem}")
        return 1
    if result.status != 0:
        print(tail(result.console), f"\nhil: status {result.status}")
        return 1
    problems = [*check_vcan(out), *check_wakes(out, result.where)]
    if result.where == "vm":
        problems += check_machine(out)
    print("\n".join([*problems, f"hil: {len(problems)} problems, {result.where}, "
                                f"{result.wall_s:.1f} s"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
