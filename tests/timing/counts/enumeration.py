# SPDX-License-Identifier: Apache-2.0
"""The scripts that nobody had to look for: boundaries of every signal, every fault row, whole
tasks, floods; of solves the corners of velocities, pressures and flows."""

import itertools
import pathlib
import random
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "can_dbc"))
sys.dont_write_bytecode = True
from dbcgen import derive, parse  # noqa: E402  pylint: disable=wrong-import-position

DBC = {"22t": "excavator", "12t": "excavator", "dozer": "dozer", "bumps": "dozer"}
# Those that run a controller, whose frames are all that it differs in: 48 flips bits of its memory,
# 49 has a profile of its own.
UNTRIED = {"22t": {23, 39, 40, 45, 48, 49}, "dozer": {5, 23, 37, 45, 48, 49}}
FAULT_ROWS = {setup: [row for row in range(1, 51) if row not in untried]
              for setup, untried in UNTRIED.items()}
# When the controller is Active on its task.
ACTIVE = {"22t": 60, "12t": 60, "dozer": 90, "bumps": 90}
QUEUE = 384  # frames that a cycle reads at most


def group(setup: str) -> str:
    return "dozer" if setup == "bumps" else setup


def messages(setup: str) -> dict[str, dict[str, list[int]]]:
    """What the controller receives: message, field, raw values at the boundaries."""
    database = parse.parse((ROOT / "can_dbc" / f"{DBC[setup]}.dbc").read_bytes())
    found = {}
    for message in database.messages:
        swings = message.name.startswith("Swing")
        if message.sender == "Graben" or (swings and setup == "22t"):
            continue
        fields = {}
        for signal in message.signals:
            if derive.carries_value(database, signal):
                low, high = (int(raw) for raw in derive.raw_range(signal))
                top = (1 << signal.width) - 1
                specials = [raw for raw in derive.special_raws(database, signal) if raw >= 0]
                raws = {low, min(low + 1, top), high, min(high + 1, top), top, (low + high) // 2}
                fields[signal.name] = sorted(raws | set(specials))
        found[message.name] = fields
    return found


def boundaries(setup: str) -> list[str]:
    found = []
    start = ACTIVE[setup]
    head = f"{group(setup)} {setup} seed=1 cycles={start + 8} | @{start}"
    for message, fields in messages(setup).items():
        for field, raws in fields.items():
            for raw in raws:
                found += [f"{head}+{cycles} raw {message}.{field} {raw}" for cycles in (1, 8)]
        for what in (f"+8 mute {message}", f"+3 wrong {message}", f"+3 length {message} 7",
                     f"+3 odd {message} 1", f"+3 odd {message} 2", f"+3 odd {message} 4",
                     f" good {message} 60"):
            found.append(head + what)
        found.append(f"{group(setup)}-queue {setup} seed=1 cycles={start + 3} "
                     f"| @{start} flood {message} {QUEUE} 0x0123456789abcdef")
    for what in (" late 20", " late 200", "+3 port 2", "+3 port 3", "+3 port 4", "+3 refuse",
                 "+4 hold 0", "+4 hold 1", "+4 speed 0", " flood foreign 60", " flood error 60"):
        found.append(head + what)
    return found


def fault_rows(setup: str) -> list[str]:
    return [f"{setup} {setup} row={row} seed={seed} cycles=4000"
            for row in FAULT_ROWS[setup] for seed in (2, 4)]


def tasks() -> list[str]:
    return [*[f"22t 22t seed={seed} cycles=2500{soil}" for seed in range(1, 4)
              for soil in ("", " soil")],
            *[f"12t 12t seed={seed} task={task} cycles=3500" for seed in (1, 2) for task in (0, 1)],
            *[f"dozer {setup} seed={seed} cycles=3500"
              for setup in ("dozer", "bumps") for seed in (1, 2)]]


def valve_corners(setup: str, count: int) -> list[str]:
    """Corners first, then draws between them, always the same ones."""
    drives, pumps = (4, 1) if setup == "12t" else (3, 2)
    draw = random.Random(f"{setup} corners")
    speeds, loads = (-0.8, -0.3, -1e-3, 0.0, 1e-3, 0.3, 0.8), (0.0, 1e5, 2e6, 1e7, 3.4e7, 6.4e7)
    found = []
    for speed, flow, last in itertools.product((-0.8, 0.8), (0.0, 2.3e-3, 6e-3), (0.0, 0.9)):
        for cap, rod in itertools.product(loads, loads):
            found.append(solve_line(setup, [speed] * drives, [cap] * drives, [rod] * drives,
                                    [flow] * pumps, last))
    while len(found) < count:
        found.append(solve_line(
            setup, [draw.choice(speeds) for _ in range(drives)],
            [draw.choice(loads) * draw.random() for _ in range(drives)],
            [draw.choice(loads) * draw.random() for _ in range(drives)],
            [draw.choice((0.0, 1e-3, 2.3e-3, 6e-3)) for _ in range(pumps)],
            draw.random()))
    return found


def solve_line(setup: str, v, cap, rod, flow, last) -> str:
    def text(numbers):
        return ",".join(f"{number:.9g}" for number in numbers)
    return (f"solve {setup} v={text(v)} cap={text(cap)} rod={text(rod)} flow={text(flow)} "
            f"last={last:.9g}")


def scripts(kind: str) -> list[str]:
    if kind == "solves":
        return [*valve_corners("22t", 2000), *valve_corners("12t", 2000),
                *[f"solve-any vector {line}" for line in range(1, 307)],
                *[f"solve-any random {seed}" for seed in range(6000)]]
    return [line for setup in ("22t", "12t", "dozer") for line in boundaries(setup)] + [
        *fault_rows("22t"), *fault_rows("dozer"), *tasks()]
