# SPDX-License-Identifier: Apache-2.0
"""Proves that the judge of the faults that look healthy can say no: canary_plausible.py OUT takes what
hil_plausible left, as it is, then with one thing of it changed."""

import pathlib
import re
import sys
from collections.abc import Callable

import plausible
from bus_log import ECU_STATUS, SPOOL_COMMAND
from canary_judge import prove
from plausible_cases import CASES

LINE = re.compile(r"^\((\d+\.\d+)\) (\S+) ([0-9A-F]+)#([0-9A-F]*)")


def place_of(row: int, profile: str, judged: str) -> int:
    return next(place for place, case in enumerate(CASES)
                if (case.row, case.machine[0], case.judged) == (row, profile, judged))


FROZEN = place_of(58, "excavator_22t", "stop")
REFUSED = place_of(52, "excavator_22t", "refused")
SLOWED = place_of(60, "dozer_9t", "slow")
SECOND = place_of(56, "excavator_22t", "second")
CRASHED = place_of(63, "excavator_22t", "crash")
REQUESTED = place_of(63, "excavator_22t", "request")
# Boom at half of its speed, enabled; its counter and checksum nobody looks at here.
MOVING = "00107D2E007D007D"


def in_log(place: int, change: Callable[[list[str]], list[str]]):
    def seed(out: pathlib.Path):
        path = out / f"v{place}.log"
        before = path.read_text().splitlines(keepends=True)
        after = change(list(before))
        assert after != before, f"{path.name} is another one: the seed has no effect"
        path.write_text("".join(after))
    return seed


def fault_of(line: str) -> int:
    found = LINE.match(line)
    return int(found[4][8:10], 16) if found and found[3] == ECU_STATUS else 0


def another_fault(lines: list[str]) -> list[str]:
    """What the controller says after the mark is said to be a lost bus."""
    mark = next(place for place, line in enumerate(lines) if " 7F0#" in line)
    return [line[:line.index("#") + 9] + "0E" + line[line.index("#") + 11:]
            if place > mark and fault_of(line) else line for place, line in enumerate(lines)]


def earlier_mark(lines: list[str]) -> list[str]:
    """0.9 s sooner than it was, in motion too."""
    mark = next(place for place, line in enumerate(lines) if " 7F0#" in line)
    stamp = float(LINE.match(lines[mark])[1]) - 3.1
    moved = f"({stamp:.6f}" + lines[mark][lines[mark].index(")"):]
    rest = lines[:mark] + lines[mark + 1:]
    before = next(place for place, line in enumerate(rest) if float(LINE.match(line)[1]) > stamp)
    return rest[:before] + [moved] + rest[before:]


def no_mark(lines: list[str]) -> list[str]:
    return [line for line in lines if " 7F0#" not in line]


def moves_again(lines: list[str]) -> list[str]:
    """One command, half a second after the fault was named, is not neutral."""
    mark = next(place for place, line in enumerate(lines) if " 7F0#" in line)
    named = next(place for place in range(mark, len(lines)) if fault_of(lines[place]))
    commands = [place for place in range(named, len(lines)) if f" {SPOOL_COMMAND}#" in lines[place]]
    lines[commands[50]] = lines[commands[50]].split("#")[0] + f"#{MOVING}\n"
    return lines


def moves_once(lines: list[str]) -> list[str]:
    place = [place for place, line in enumerate(lines) if f" {SPOOL_COMMAND}#" in line][-80]
    lines[place] = lines[place].split("#")[0] + f"#{MOVING}\n"
    return lines


def no_last_word(lines: list[str]) -> list[str]:
    """The last command before the process ended is left out, which is the neutral one."""
    place = [place for place, line in enumerate(lines) if f" {SPOOL_COMMAND}#" in line][-1]
    return lines[:place] + lines[place + 1:]


def killed(out: pathlib.Path):
    (out / f"v{REQUESTED}.status").write_text("129\n")


def wordless(out: pathlib.Path):
    (out / f"v{SECOND}.err").write_text("")


SEEDS = {
    "another fault": (in_log(FROZEN, another_fault), r"58.*faults \['BusDown'\], expected"),
    "late": (in_log(SLOWED, earlier_mark), "60.*(later than 340 ms|not active before)"),
    "never tried": (in_log(FROZEN, no_mark), "58.*not tried"),
    "moves after it": (in_log(FROZEN, moves_again), "58.*not neutral within 20 ms"),
    "not refused": (in_log(REFUSED, moves_once), "52.*it armed"),
    "no word to the second": (wordless, "56.*the second said"),
    "no last word": (in_log(CRASHED, no_last_word), "63.*the last 0CFF3082 is not neutral"),
    "killed": (killed, "63.*another status"),
}


def main() -> int:
    left = pathlib.Path(sys.argv[1])
    return prove("plausible", left, left / "uptime", lambda out: plausible.check(CASES, out), SEEDS)


if __name__ == "__main__":
    sys.exit(main())
