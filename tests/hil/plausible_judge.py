# SPDX-License-Identifier: Apache-2.0
"""What the log of a case of plausible.py says: when the fault was named after the mark, and when all was neutral."""

import dataclasses
import json
import pathlib
import sys

import bus_log
from bus_log import (ACTIVE, ARMED, ECU_STATUS, MARK, NEUTRAL_RAW, PUMP_COMMAND, SPOOL_COMMAND, SWING_COMMAND,
                     SWING_STATE, VALVE_STATE, Frame)
from plausible_cases import LETS_GO_S, STALL_S, Case

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "can_dbc"))
from dbcgen import codes  # noqa: E402  pylint: disable=wrong-import-position

CODES = {fault.name: fault.code for fault in codes.load(ROOT / "firmware/safety").faults}
NAMES = {code: name for name, code in CODES.items()}
OPERATOR, EEC1, TURN_S = "0CFF2781", "0CF00400", 0.07
COMMANDS = (SPOOL_COMMAND, SWING_COMMAND, PUMP_COMMAND)
NO_VALUE = 0xFFFF
PERIOD_S = 0.010
# The mark goes out with the machine's first wrong frame, up to a cycle of the controller's before it is looked
# at; EcuStatus comes every 20 ms. The rows count in simulated time, where all share one clock.
BUS_S = 0.040
# From the fault's first EcuStatus; half a millisecond is the bus.
NEUTRAL_S = 0.0205
TIP_OFF_M = 0.15
# As the fault table's row 62 counts: a step is more than half a dead band within a cycle.
STEP_RAW, FEW_REVERSALS = 0.1 * 1000 / 0.05, 4
REST_S = 0.2
GONE_S, MANY_FRAMES = 0.4, 500
# From the mark until a shell has begun and has sent its signal.
SIGNAL_S = 0.2
# A step of a stroke, and the way of row 80 (rows_machine.cpp).
STROKE_M, MOST_WAY_M = 0.05e-3, 0.12
# Of the platform, as the row takes it for motion.
TURNS_RAW = 2.0 / 0.1


def stands(frame: Frame) -> bool:
    """This command moves nothing."""
    duties = [frame.bits(start, 16) for start in (16, 32, 48)]
    off = frame.name == PUMP_COMMAND or frame.bits(12, 2) == 0
    return off and all(duty in (NEUTRAL_RAW, NO_VALUE) for duty in duties)


@dataclasses.dataclass
class Verdict:
    """A line of the table; times in ms, None where there is none."""
    detected: float | None = None
    named: str = "-"
    neutral: float | None = None
    problems: list[str] = dataclasses.field(default_factory=list)


class Log:
    def __init__(self, case: Case, out: pathlib.Path, interface: str):
        self.case, self.out, self.interface = case, out, interface
        self.all = bus_log.frames(out / f"{interface}.log")
        self.status = [frame for frame in self.all if frame.name == ECU_STATUS]
        self.commands = [frame for frame in self.all if frame.name in COMMANDS]
        self.machine = [frame for frame in self.all if frame.name == bus_log.VALVE_STATE]
        self.mark = next((frame.time for frame in self.all if frame.name == MARK), None)
        # Then the operator lets go.
        self.end = self.machine[-1].time - LETS_GO_S if self.machine else 0.0

    def named(self, since: float, names: tuple[str, ...]) -> Frame | None:
        wanted = {CODES[name] for name in names}
        return next((frame for frame in self.status if frame.time > since and frame.fault in wanted), None)

    def others(self, since: float) -> list[str]:
        return sorted({NAMES.get(frame.fault, str(frame.fault)) for frame in self.status
                       if since < frame.time < self.end and frame.fault})

    def active_before(self, since: float) -> bool:
        before = [frame.mode for frame in self.status if since - 0.2 < frame.time < since]
        return bool(before) and all(mode == ACTIVE for mode in before)

    def last_moving(self, since: float) -> float:
        return max((frame.time for frame in self.commands if frame.time > since and not stands(frame)), default=since)


def first_motion(log: Log, name: str, since: float) -> float | None:
    if name != SWING_STATE:
        return next((frame.time for frame in log.commands
                     if frame.time > since and frame.name == name and not stands(frame)), None)
    angles = [(frame.time, frame.bits(16, 16)) for frame in log.all if frame.name == name]
    return next((time for time, angle in angles if abs(angle - angles[0][1]) > TURNS_RAW), None)


def judge_stop(log: Log, since: float) -> Verdict:
    case, verdict = log.case, Verdict()
    named = log.named(since, case.names)
    if named is None:
        verdict.problems.append(f"faults {log.others(since)}, expected {case.names}")
        return verdict
    verdict.detected, verdict.named = (named.time - since) * 1e3, NAMES[named.fault]
    bound_s = case.within_s + BUS_S
    if named.time - since > bound_s:
        verdict.problems.append(f"later than {bound_s * 1e3:.0f} ms")
    last = log.last_moving(since)
    verdict.neutral = max(0.0, last + PERIOD_S - named.time) * 1e3
    if last + PERIOD_S - named.time > NEUTRAL_S:
        verdict.problems.append("not neutral within 20 ms")
    return verdict


def judge_cut(log: Log, since: float) -> Verdict:
    """Its spool stays open: the cut is asked for, and from the first neutral command on the boom goes only so far."""
    verdict = judge_stop(log, since)
    stop = log.last_moving(since) + PERIOD_S
    cut = next((frame.time for frame in log.commands
                if frame.time > since and frame.name == SPOOL_COMMAND and frame.bits(14, 2) == 1), None)
    way = [frame.bits(16, 16) * STROKE_M for frame in log.all if frame.name == bus_log.BOOM_STROKE
           and frame.time > stop]
    if cut is None:
        verdict.problems.append("no cut of the pilot pressure was asked for")
    else:
        verdict.named += f", cut after {(cut - since) * 1e3:.0f} ms"
    if not way or abs(way[-1] - way[0]) > MOST_WAY_M:
        verdict.problems.append(f"the boom goes on by {abs(way[-1] - way[0]) * 1e3 if way else -1:.0f} mm")
    return verdict


def judge_slow(log: Log, since: float) -> Verdict:
    verdict = judge_stop(log, since)
    # It goes on, slower.
    verdict.problems = [problem for problem in verdict.problems if not problem.startswith("not neutral")]
    verdict.neutral = None
    if any(frame.mode != ACTIVE for frame in log.status if since < frame.time < log.end):
        verdict.problems.append("it does not go on")
    return verdict


def judge_refused(log: Log, since: float) -> Verdict:
    verdict = Verdict()
    if any(frame.mode in (ARMED, ACTIVE) for frame in log.status) or not all(map(stands, log.commands)):
        verdict.problems.append("it armed")
    named = log.named(log.end - 1.0, log.case.names)
    if named is None:
        verdict.problems.append(f"faults {log.others(since)}, expected {log.case.names}")
    else:
        verdict.named = f"{NAMES[named.fault]}, refused"
    return verdict


def judge_replay(log: Log, since: float) -> Verdict:
    name, data = (log.out / f"{log.interface}.again").read_text().strip().split("#")
    spool = [frame for frame in log.all if frame.name == name]
    # Ours can be alike; their counters go up by one, 14 to 0.
    again = next((frame.time for before, frame in zip(spool, spool[1:]) if frame.time > since
                  and frame.data == bytes.fromhex(data)
                  and frame.data[1] % 16 != (before.data[1] % 16 + 1) % 15), None)
    if again is None:
        return Verdict(problems=["no command was repeated"])
    verdict = judge_stop(log, again)
    if log.last_moving(again) + PERIOD_S - again > NEUTRAL_S:
        verdict.problems.append("it moves on for more than 20 ms")
    return verdict


def judge_second(log: Log, since: float) -> Verdict:
    said = (log.out / f"{log.interface}.err").read_text()
    verdict = Verdict(named="the lock, in words")
    if "another graben-ecu controls this bus" not in said or "second ended with 1" not in said:
        verdict.problems.append(f"the second said: {said}")
    if any(frame.mode != ACTIVE or frame.fault for frame in log.status if since < frame.time < log.end):
        verdict.problems.append("the first was disturbed")
    return verdict


def judge_gone(log: Log, since: float) -> Verdict:
    """Its bus is gone for half a second, and with it whoever could hear that."""
    spool = [frame.time for frame in log.commands if frame.name == SPOOL_COMMAND]
    gap_s, before = max(((after - before, before) for before, after in zip(spool, spool[1:])), default=(0.0, since))
    named = log.named(before, log.case.names)
    if gap_s < GONE_S or named is None:
        return Verdict(problems=[f"its frames ceased for {gap_s:.2f} s, faults {log.others(before)}"])
    verdict = Verdict((named.time - before) * 1e3, NAMES[named.fault], 0.0)
    if any(not stands(frame) for frame in log.commands if frame.time > before + gap_s / 2):
        verdict.problems.append("the bus comes back and it moves")
    return verdict


def judge_beside(log: Log, since: float) -> Verdict:
    foreign = sum(frame.name == "701" and since < frame.time < log.end for frame in log.all)
    verdict = Verdict(named=f"none, {foreign} foreign frames")
    if foreign < MANY_FRAMES:
        verdict.problems.append("nothing was beside it")
    if any(frame.mode != ACTIVE or frame.fault for frame in log.status if since < frame.time < log.end):
        verdict.problems.append(f"it was disturbed: {log.others(since)}")
    return verdict


def judge_harmless(log: Log, since: float) -> Verdict:
    named = next((frame for frame in log.status if since < frame.time < log.end and frame.mode != ACTIVE), None)
    verdict = Verdict(named="none, no harm")
    if named is not None:
        verdict = judge_stop(Log(dataclasses.replace(log.case, names=(NAMES[named.fault],)), log.out, log.interface),
                             since)
    off_m = json.loads((log.out / f"{log.interface}.json").read_text())["max_error_true_m"]
    if off_m > TIP_OFF_M:
        verdict.problems.append(f"the tip came {off_m * 1e3:.0f} mm off its path")
    return verdict


def reversals(log: Log, begin: float, end: float) -> int:
    """Steps up after steps down of what moves the machine, and the other way round: of spools as they are measured,
    because their commands lead them."""
    name = PUMP_COMMAND if log.case.machine[0].startswith("dozer") else VALVE_STATE
    starts = (16,) if name == PUMP_COMMAND else (16, 32, 48)
    efforts = [max(abs(frame.bits(start, 16) - NEUTRAL_RAW) for start in starts)
               for frame in log.all if frame.name == name and begin < frame.time < end]
    steps = [1 if now > before else -1 for before, now in zip(efforts, efforts[1:]) if abs(now - before) > STEP_RAW]
    return sum(one != other for one, other in zip(steps, steps[1:]))


def judge_chatter(log: Log, since: float) -> Verdict:
    good, by_turns = reversals(log, since - 1.5, since), reversals(log, since, since + 1.5)
    verdict = Verdict(named=f"none, {by_turns} reversals, {good} before")
    if by_turns > 2 * FEW_REVERSALS + 2 * good:
        verdict.problems.append("the machine moves by turns")
    engine = [frame.time for frame in log.all if frame.name == EEC1 and frame.time > since]
    if sum(after - before > TURN_S for before, after in zip(engine, engine[1:])) < FEW_REVERSALS:
        verdict.problems.append("the engine's speed did not come by turns")
    return verdict


def judge_change(log: Log, _: float) -> Verdict:
    """From the operator's first frame without a task in motion to the one that begins it again."""
    asked = [frame for frame in log.all if frame.name == OPERATOR]
    none = next((after.time for before, after in zip(asked, asked[1:])
                 if before.bits(24, 8) and not after.bits(24, 8) and after.bits(12, 2) == 1
                 and log.active_before(after.time)), None)
    if none is None:
        return Verdict(problems=["the task was never taken back in motion"])
    left = next((frame.time for frame in log.status if frame.time > none and frame.mode != ACTIVE), None)
    again = next((frame.time for frame in log.status if left and frame.time > left and frame.mode == ACTIVE), None)
    if left is None or again is None:
        return Verdict(problems=["it went on" if left is None else "the task does not begin again"])
    verdict = Verdict((left - none) * 1e3, "none, rest first")
    rest = [frame for frame in log.commands if left < frame.time < again - 2 * PERIOD_S]
    last = max((frame.time for frame in rest if not stands(frame)), default=left)
    verdict.neutral = max(0.0, last - left) * 1e3
    if again - none < REST_S:
        verdict.problems.append("it did not wait for standstill")
    if log.others(none):
        verdict.problems.append(f"faults {log.others(none)}")
    return verdict


def judge_stall(log: Log, since: float) -> Verdict:
    # What has another fault too may say that one; a machine that never begins to move stalls from its task on.
    begins = log.named(since, ("Stalling",)) or next(frame for frame in log.status if frame.mode == ACTIVE)
    verdict = judge_stop(log, begins.time)
    if verdict.detected is not None and verdict.detected < 1e3 * (STALL_S - 2.0) / 2:
        verdict.problems.append("it stops at once")
    return verdict


def judge_end(log: Log, since: float, crash: bool) -> Verdict:
    """The last commands are neutral, whatever ended the process, and come in time."""
    status = int((log.out / f"{log.interface}.status").read_text())
    verdict = Verdict(named=f"ended with {status}")
    if (status != 0) != crash:
        verdict.problems.append("another status was expected")
    if not log.active_before(since):
        verdict.problems.append("it was not active before")
    for name in COMMANDS:
        last = [frame for frame in log.commands if frame.name == name][-1:]
        if last and not stands(last[0]):
            verdict.problems.append(f"the last {name} is not neutral")
    spool = [frame for frame in log.commands if frame.name == SPOOL_COMMAND]
    steps = [(after.bits(8, 4) - before.bits(8, 4)) % 15 for before, after in zip(spool[-8:], spool[-7:])]
    if not set(steps) <= {1, 2}:
        verdict.problems.append("the counter jumps")
    if crash:
        verdict.named += f", {sum(frame.time > log.last_moving(since) for frame in spool)} neutral"
    last = log.last_moving(since)
    after = next((frame.time for frame in spool if frame.time > last), None)
    if after is None:
        verdict.problems.append("no neutral command")
        return verdict
    # From the last one that moves anything.
    verdict.neutral = (after - last) * 1e3
    if after - last > NEUTRAL_S or last - since > SIGNAL_S:
        verdict.problems.append(f"neutral {(after - since) * 1e3:.0f} ms after the mark")
    return verdict


OTHERS = {"slow": judge_slow, "refused": judge_refused, "replay": judge_replay, "second": judge_second,
          "gone": judge_gone, "beside": judge_beside, "harmless": judge_harmless, "chatter": judge_chatter,
          "change": judge_change, "stall": judge_stall, "stop": judge_stop, "cut": judge_cut,
          "request": lambda log, since: judge_end(log, since, False),
          "crash": lambda log, since: judge_end(log, since, True)}
NEVER_MARKED = ("change", "stall", "refused")


def judge(case: Case, out: pathlib.Path, interface: str) -> Verdict:
    log = Log(case, out, interface)
    since = log.mark
    if since is None and case.judged in NEVER_MARKED:
        since = log.all[0].time
    if since is None or not log.machine:
        return Verdict(problems=["not tried"])
    if case.from_motion:
        begin = since
        since = first_motion(log, case.from_motion, begin)
        if since is None:
            return judge_refused(log, begin)
    elif case.at_s > 0.0 and not log.active_before(since):
        return Verdict(problems=[f"it was not active before: {log.others(log.all[0].time)}"])
    return OTHERS[case.judged](log, since)
