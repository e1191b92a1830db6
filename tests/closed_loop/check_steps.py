# SPDX-License-Identifier: Apache-2.0
"""`graben autodig` with tasks whose steps end early, wait for the operator's word, and dig deeper in rounds."""

import sys
import tempfile

from check_autodig import END_MM, MM, Digger, assert_straight

LOADING = """repeat = true
start = {{ position = [7.0, 0.0, {from_z}], attitude = 2.2 }}
{rounds}
[[step]]
do = "dig"
to = {{ position = [4.8, 0.0, {to_z}], attitude = 0.9 }}
speed = 0.4
{until}
[[step]]
do = "lift"
to = {{ position = [4.9, 0.0, 2.4], attitude = 0.3 }}
speed = 0.6
[[step]]
do = "swing"
to = {{ position = [0.0, 4.6, 3.4], attitude = 0.3 }}
pace = 0.6
{wait}
[[step]]
do = "dump"
to = {{ position = [0.0, 5.9, 2.4], attitude = 1.9 }}
pace = 0.7
[[step]]
do = "return"
to = {{ position = [7.0, 0.0, {from_z}], attitude = 2.2 }}
pace = 0.6
[design]
through = [0.0, 0.0, {design_z}]
normal = [0.0, 0.0, 1.0]
clearance = 0.05
"""
WAIT = '[[step]]\ndo = "wait"'


def steps_that_end_early(digger):
    """By depth, plane, force and fill, in soil; the bucket then goes on from where it is. A wait lasts until the
    operator's word."""
    def run(until, *options, from_z=-0.1, to_z=-0.45, wait=""):
        return digger.figures(*digger.task(LOADING.format(
            from_z=from_z, to_z=to_z, rounds="", until=f"until = {{ {until} }}" if until else "", wait=wait,
            design_z=-0.5)), "--soil", "sand", *options)

    whole = run("")
    assert [step["ended_by"] for step in whole["steps"]] == ["end"] * 5, whole["steps"]
    for until, by in (("depth = 0.3", "plane"), ("force = 4e3", "force"), ("full = 0.6", "full"),
                      ("plane = { through = [5.5, 0.0, 0.0], normal = [-1.0, 0.0, 0.0] }", "plane")):
        early = run(until)
        dig, lift = early["steps"][:2]
        assert dig["ended_by"] == by and dig["end_error_true_m"] is None, f"{until}: {dig}"
        assert [step["ended_by"] for step in early["steps"][1:]] == ["end"] * 4, f"{until}: {early['steps']}"
        # The lift begins where the dig has ended: it has no line of its own to be off, and arrives as planned.
        assert not lift["straight"] and lift["end_error_true_m"] < END_MM * MM, f"{until}: {lift}"
        assert 0.0 < early["fill_max_m3"] < whole["fill_max_m3"], f"{until}: {early['fill_max_m3']}"
        assert early["steps_not_arrived"] == 0 and early["over_cut_max_m"] < 5 * MM, until
    for after in (2.0, 6.0):
        waits = run("", "--word-after", str(after), from_z=-0.1, to_z=-0.1, wait=WAIT)["steps"]
        assert [step["kind"] for step in waits] == ["dig", "lift", "swing", "wait", "dump", "return"], waits
        # A second of the step itself, the operator's pause, and standstill before it may go on.
        assert after + 1.4 < waits[3]["until_s"] - waits[3]["from_s"] < after + 2.2, waits[3]


def rounds_dig_deeper(digger):
    """By an offset, and until the design is met: a round whose bucket was full is done again."""
    def run(rounds, until, design_z):
        text = LOADING.format(from_z=-0.1, to_z=-0.1, rounds=f"rounds = {{ {rounds} }}", until=until, wait="",
                              design_z=design_z)
        return digger.figures(*digger.task(text), "--soil", "sand")

    three = run("count = 3, offset = [0.0, 0.0, -0.1]", "", -0.4)
    assert [step["kind"] for step in three["steps"]] == ["dig", "lift", "swing", "dump", "return"] * 3
    assert_straight("rounds", three, 30.0, END_MM)
    met = run("until_design = true, deeper = 0.12", "until = { full = 0.5 }", -0.55)
    digs = [step["ended_by"] for step in met["steps"] if step["kind"] == "dig"]
    # 0.1 to 0.5 m below the ground: five rounds, the first ones more than a bucket.
    assert digs.count("end") == 5 and digs[-1] == "end" and 2 <= digs.count("full") <= 8, digs
    assert met["cut_m3"] > 1.5 * three["cut_m3"] and met["over_cut_max_m"] < 5 * MM, (met["cut_m3"], met)


def main():
    with tempfile.TemporaryDirectory() as folder:
        digger = Digger(sys.argv[1], folder)
        steps_that_end_early(digger)
        rounds_dig_deeper(digger)
    print("steps end where they should")


if __name__ == "__main__":
    main()
