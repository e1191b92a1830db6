# SPDX-License-Identifier: Apache-2.0
"""The cases of plausible.py: rows 51 to 66 and 78 to 84 of the fault table on a kernel's bus, once for each machine
that can have them, and what else only a kernel can show. The bounds are those of tests/faults/rows_*.cpp; where a row
gives a drive more time than a case lasts, the case's own end is the bound."""

import dataclasses

import run_programs
from bus_log import SPOOL_COMMAND, SWING_STATE

DIG, GRADE = ("excavator_22t", "dig", "-"), ("dozer_9t", "grade", "-")
PROGRAM = ("excavator_12t", "program", "flatten")
# Machines of row 66: a rock that never comes loose, a transmission that gives less than what it takes to roll.
ROCK, HEAVY = ("excavator_rock", "dig", "-"), ("dozer_heavy", "grade", "-")
# Of rows 83 and 84: every joint of a cylinder has a second sensor.
SECONDS = ("excavator_seconds", "dig", "-")
SECOND_KEYS = "\n[second]\nboom = true\narm = true\nbucket = true\n"
# Of rows 78 and 79: a blade that tilts, on a track that banks to both sides by turns. The track is straight: on one
# that curves the simulated machine alone needs more than a processor's time here, so what tells of its course is
# tried by fault_cases only.
BANKED = ("dozer_banked", "grade", "-")
ALONE = (BANKED,)
# x, height, slope across.
TRACK = [(0, 0, 0), (2.5, -0.05, 0), (5, -0.06, 0.045), (10, -0.05, -0.045), (15, -0.06, 0.045), (20, -0.05, -0.045),
         (25, -0.06, 0), (30, -0.06, 0)]
# The machines' files: from which, and what is another there. Both of row 66 stop after the least that a profile
# may have.
STALL_S = 3.0
STALL = (r"(?m)^\[safety\]", f"[safety]\nstall = {STALL_S}")
TRACK_FILE = "banked.txt"


def tilt_of(name: str) -> str:
    """What a profile has beside the one that it is like."""
    text = (run_programs.PROFILES / name).read_text(encoding="utf-8")
    return "\n" + text[text.index("[tilt]"):].replace("\\", r"\\")


MADE = {"excavator_rock.toml": ("excavator_22t.toml", [STALL]),
        "excavator_rock.sim.toml": ("excavator_22t.sim.toml", [(r"share = 0.46", "share = 0.05"),
                                                               (r"hold = 3.0", "hold = 60.0")]),
        "excavator_seconds.toml": ("excavator_22t.toml", [(r"\Z", SECOND_KEYS)]),
        "excavator_seconds.sim.toml": ("excavator_22t.sim.toml", []),
        "dozer_heavy.toml": ("dozer_9t.toml", [STALL]),
        "dozer_banked.toml": ("dozer_9t.toml", [(r"(?m)^profile = .*$", f'design = "{TRACK_FILE}"'),
                                                 (r"\Z", tilt_of("dozer_9t_tilt.toml"))]),
        "dozer_banked.sim.toml": ("dozer_9t.sim.toml", [(r"(?m)^length = .*$", f"length = {float(TRACK[-1][0])}"),
                                                         (r"(?m)^depth_max = .*$", "depth_max = 0.06"),
                                                         (r"\Z", tilt_of("dozer_9t_tilt.sim.toml"))]),
        "dozer_heavy.sim.toml": ("dozer_9t.sim.toml", [(r"relief = 42.0e6", "relief = 3.0e6"),
                                                       (r"rolling_resistance = 0.08", "rolling_resistance = 0.4")])}
# Active from 1.7 s on. The boom is at speed at 3 s, the swing at 4; the dozer comes to its grade at 5, where its
# blade moves, and to a slope at 7.5.
AT_S, SWING_S, BLADE_S, PITCH_S, BANKS_S = 3.0, 4.0, 5.5, 7.5, 7.5
# The machine's last half second is the operator letting go.
LETS_GO_S = 0.6


@dataclasses.dataclass
class Case:
    """A row of the fault table; the machine; its faults, or a command of the shell, `at_s` after the start."""
    row: int
    machine: tuple[str, str, str]
    faults: tuple[str, ...]
    # Of these faults one has to be named, so long after the mark, ...
    names: tuple[str, ...]
    within_s: float
    at_s: float = AT_S
    # By turns: stop, cut, slow, refused, replay, second, gone, beside, harmless, chatter, change, stall, request, crash.
    judged: str = "stop"
    command: str = "-"
    # ... or after the first of these commands that moves anything, or after the first of these angles that is
    # another one than at the start, where the fault was there before.
    from_motion: str = ""
    seconds: float = 0.0
    # Of `graben plant`, instead of the machine's.
    operator: str = ""
    options: str = ""

    @property
    def text(self) -> str:
        told = ", ".join(self.faults) or self.options or self.command.split("# ")[-1]
        told = {"changes": "task changed", "-": "nothing moves it"}.get(self.operator or told, told)
        return f"{told}, from the start" if self.at_s == 0.0 else told

    @property
    def lasts_s(self) -> float:
        return self.seconds or round(self.at_s + min(self.within_s, 2.5) + 0.5 + LETS_GO_S, 1)

    def line(self, lane: int, interface: str) -> str:
        profile, operator, task = self.machine
        faults = " ".join(f"--fault {fault}@{self.at_s}" for fault in self.faults)
        command = f"{self.at_s} {self.command}" if self.command != "-" else "-"
        task = task if task == "-" else f"{task}.toml"
        return (f"{lane}|{interface}|{profile}.toml|{self.operator or operator}|{task}|{self.lasts_s}|"
                f"{faults} {self.options}|{command}\n")


WRONG_WAY = ("WrongDirection", "MotionImplausible", "UncommandedMotion")
FROZEN = ("StrokeStuck", "MotionImplausible")
# Which comes first hangs on the cycle in which the arm first answers the boom's spool.
SWAPPED = ("MotionImplausible", "StrokeStuck", "StrokeImplausible", "PoseUnreachable", *WRONG_WAY)
STOPPED = ("EngineStopped",)
# Or missing: the emulated queue's timer may hand out nothing for 50 ms.
LATE = ("StreamLate", "StrokeMissing", "SpoolMissing", "SwashMissing", "PoseMissing", "TransmissionMissing",
        "EngineSpeedMissing", "OperatorMissing")
POSE = ("PoseDisagrees",)
# All frames, ours too, wait in one queue, and so does what is recorded of them.
SLOW_QUEUE = "tc qdisc add dev $INTERFACE root netem rate {}kbit limit 10000; # queue at {} kbit/s"
LATE_QUEUE = "tc qdisc add dev $INTERFACE root netem delay 200ms limit 10000; # queue of 200 ms"
SECOND = ("graben-ecu --can $INTERFACE --profile $PROFILE; echo second ended with $? >&2; "
          "# a second graben-ecu")
REPLAY = ("grep -F '0CFF3082#' $OUT/$INTERFACE.log | tail -n 20 | head -n 1 | cut -d ' ' -f 3 >$OUT/$INTERFACE.again; "
          "cansend $INTERFACE $(cat $OUT/$INTERFACE.again); # a command again")
GONE = ("ip link delete $INTERFACE; sleep 0.5; ip link add $INTERFACE type vcan; ip link set $INTERFACE up; "
        "candump -D -L $INTERFACE,0:0,#FFFFFFFF >>$OUT/$INTERFACE.log & # interface removed, made again")
# 4000 bytes a time, in 572 frames that the receiver lets come as fast as the kernel makes them.
ISOTP = ("isotprecv -l -s 700 -d 701 $INTERFACE >/dev/null & sleep 0.05; for n in 1 2 3 4 5 6 7 8; do "
         "yes 5A | head -n 4000 | isotpsend -s 701 -d 700 $INTERFACE; sleep 0.1; done; kill $!; "
         "# diagnosis (ISO-TP) beside it")
STALLS = ("for n in 1 2 3; do kill -STOP $ECU; sleep 0.035; kill -CONT $ECU; sleep 0.02; done; "
          "# three stalls of 40 ms")

EVERY = [
    Case(66, ROCK, (), ("Stalled",), 2 * STALL_S, judged="stall", options="--obstacle", seconds=16.0, at_s=0.0),
    Case(66, HEAVY, (), ("Stalled",), 2 * STALL_S, judged="stall", seconds=12.0, at_s=0.0),
    Case(25, DIG, (), (), 1.0, judged="beside", command=ISOTP, seconds=8.0),
    Case(28, DIG, (), ("BusDown",), 1.0, judged="gone", command=GONE),
    Case(28, GRADE, (), ("BusDown",), 1.0, judged="gone", command=GONE),
    # The law on its oil swings the spool to both its ends before the direction is clear.
    Case(51, DIG, ("arm:reversed",), (*WRONG_WAY, "SpoolStuck"), 2.0),
    # From the start: in motion the spool itself would jump.
    Case(51, PROGRAM, ("swing:reversed",), WRONG_WAY, 1.0, at_s=0.0, from_motion=SWING_STATE, seconds=5.5),
    Case(51, GRADE, ("blade:reversed",), WRONG_WAY, 2.0, at_s=BLADE_S),
    Case(52, DIG, ("engine:runs=0",), STOPPED, 0.030),
    Case(52, GRADE, ("engine:runs=0.3",), STOPPED, 0.030),
    Case(52, DIG, ("engine:runs=0",), STOPPED, 0.0, at_s=0.0, judged="refused", seconds=3.0),
    Case(53, DIG, (), LATE, 1.5, command=SLOW_QUEUE.format(130, 130)),
    Case(53, GRADE, (), LATE, 0.0, at_s=0.0, judged="refused", seconds=4.0, command=LATE_QUEUE),
    Case(54, GRADE, ("pose:frozen",), POSE, 0.3),
    # It is wrong once the truth has gone on by 0.03 rad, at 80 mrad/s, or by 0.2 m/s, at 0.5 m/s2.
    Case(54, GRADE, ("pitch:frozen",), POSE, 0.3 + 0.4, at_s=PITCH_S),
    Case(54, GRADE, ("velocity:frozen",), POSE, 0.3 + 0.4, at_s=2.0),
    Case(55, DIG, ("boom-arm-strokes:swapped",), SWAPPED, 0.8, at_s=0.0, from_motion=SPOOL_COMMAND, seconds=4.0),
    Case(56, DIG, (), ("SecondController",), 1.0, judged="second", command=SECOND),
    Case(56, DIG, (), ("SecondController",), 0.020, judged="replay", command=REPLAY),
    Case(56, GRADE, (), ("SecondController",), 0.020, judged="replay", command=REPLAY),
    Case(57, GRADE, ("height:drift=0.3", "climb:step=0.3"), ("PathLeft", *POSE), 2.5),
    Case(58, DIG, ("boom-stroke:frozen",), FROZEN, 3.0),
    Case(58, PROGRAM, ("swing-angle:frozen",), FROZEN, 3.0, at_s=SWING_S),
    Case(58, GRADE, ("blade-stroke:frozen",), FROZEN, 3.0, at_s=BLADE_S),
    Case(59, DIG, ("boom-stroke:drift=0.1",), FROZEN, 2.5),
    Case(59, GRADE, ("blade-stroke:drift=0.05",), FROZEN, 2.5, at_s=BLADE_S),
    Case(60, GRADE, ("left-track-speed:reads=0",), ("TrackSpeedDisagrees",), 0.3, judged="slow"),
    Case(61, DIG, (), ("CycleOverrun", "CycleStalled"), 0.3, command=STALLS),
    Case(61, GRADE, (), ("CycleOverrun", "CycleStalled"), 0.3, command=STALLS),
    Case(62, DIG, ("engine-speed:by-turns=0.08",), (), 2.0, at_s=3.5, judged="chatter", seconds=6.2),
    Case(62, GRADE, ("engine-speed:by-turns=0.08",), (), 2.0, at_s=3.5, judged="chatter", seconds=6.2),
    Case(64, DIG, (), (), 2.0, at_s=0.0, judged="change", operator="changes", seconds=5.4),
    Case(64, GRADE, (), (), 2.0, at_s=0.0, judged="change", operator="changes", seconds=5.4),
    Case(65, DIG, ("arm-pressures:swapped",), (), 2.0, judged="harmless", seconds=6.0),
    Case(78, BANKED, ("tilt-stroke:drift=0.05",), FROZEN, 1.0, at_s=BANKS_S),
    Case(78, BANKED, ("tilt-stroke:frozen",), FROZEN, 3.0, at_s=BANKS_S),
    Case(78, BANKED, ("tilt-spool:held=0.6",), ("SpoolStuck",), 0.2, at_s=BANKS_S),
    # A spool that stays open after the stop, as its node falls silent: the pilot pressure has to be cut.
    Case(80, DIG, ("boom-spool:held=0.35", "valve-state:silent"), ("SpoolMissing",), 0.1, judged="cut"),
    Case(82, DIG, ("boom-stroke:noisy=0.0007",), FROZEN, 3.0),
    Case(82, DIG, ("arm-stroke:noisy=0.0007",), FROZEN, 3.0),
    Case(83, SECONDS, ("boom-stroke:frozen",), ("WitnessDisagrees",), 1.0),
    Case(83, SECONDS, ("arm-stroke:gain=0.8",), ("WitnessDisagrees",), 2.0),
    Case(83, SECONDS, ("boom-second:drift=0.03",), ("WitnessDisagrees",), 1.0),
    Case(84, SECONDS, ("second-sensors:silent",), ("WitnessMissing",), 0.3, judged="slow"),
    Case(79, BANKED, ("roll:drift=0.1",), POSE, 0.4, at_s=BANKS_S),
    # A frozen angle or rate is wrong once the truth has gone on.
    Case(79, BANKED, ("roll:frozen",), POSE, 2.5, at_s=BANKS_S),
    Case(79, BANKED, ("roll-rate:frozen",), POSE, 2.5, at_s=BANKS_S),
]
# Row 63. What asks for the end is answered in the next cycle; a crash at once.
EVERY += [Case(63, machine, (), (), 0.020, at_s=2.1, judged=judged, seconds=2.9,
               command=f"kill -{name} $ECU; # SIG{name}")
          for machine, judged, names in (
              (DIG, "request", ("HUP", "INT", "QUIT", "TERM", "USR1", "USR2", "PIPE", "ALRM", "VTALRM", "PROF", "IO")),
              (DIG, "crash", ("ABRT", "SEGV", "BUS", "FPE", "ILL", "SYS", "TRAP", "XCPU")),
              (GRADE, "request", ("TERM",)), (GRADE, "crash", ("SEGV",)))
          for name in names]
# For each day: of each row and way to judge the first, where only a kernel can show it, and two that it need not.
# The other rows are tried without a kernel by fault_cases; what runs alone needs the processor for itself.
TOO = (("boom-stroke:frozen",), ("left-track-speed:reads=0",))


def needs_kernel(case: Case) -> bool:
    return case.command != "-" or case.judged in ("refused", "change", "chatter")


CASES = list({(case.row, case.judged): case for case in reversed(EVERY)
              if case.machine not in ALONE and (needs_kernel(case) or case.faults in TOO)}.values())[::-1]


def lanes(cases: list[Case], count: int) -> list[int]:
    """In which of so many lanes, that run beside each other, each case comes: the longest first. In lane 0, after
    them, what runs alone."""
    ends = [0.0] * count
    lane_of = [0] * len(cases)
    for place in sorted(range(len(cases)), key=lambda place: -cases[place].lasts_s):
        if cases[place].machine in ALONE:
            continue
        shortest = ends.index(min(ends))
        lane_of[place] = shortest + 1
        # A case begins and ends with processes that come and go.
        ends[shortest] += cases[place].lasts_s + 0.5
    return lane_of
