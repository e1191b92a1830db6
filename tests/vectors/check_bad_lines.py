# SPDX-License-Identifier: Apache-2.0
"""Bad lines of `graben solve`: each is told with its number and its reason, the rest go on."""

import copy
import json
import subprocess
import sys


def changed(case, change):
    other = copy.deepcopy(case)
    change(other)
    return json.dumps(other)


def bad_lines(case):
    """(line, what its message must contain)"""
    actuator = lambda c: c["machine"]["actuators"][0]
    pump = lambda c: c["machine"]["pumps"][0]
    return [
        ("{not json", "not JSON"),
        ("[1, 2]", "not a JSON object"),
        ('"text"', "not a JSON object"),
        (json.dumps(case)[:200], "not JSON"),
        (changed(case, lambda c: c.pop("machine")), "machine: is missing"),
        (changed(case, lambda c: c["input"].pop("p_cap")), "input.p_cap: is missing"),
        (changed(case, lambda c: c["input"]["velocity"].pop()), "input.velocity: must be an array"),
        (changed(case, lambda c: c["input"]["p_rod"].__setitem__(1, "x")), 'input.p_rod[1]: "x"'),
        (changed(case, lambda c: c["input"]["p_rod"].__setitem__(1, None)), "input.p_rod[1]: null"),
        (changed(case, lambda c: c["input"]["p_cap"].__setitem__(2, -1.0)), "input.p_cap[2]: -1"),
        (changed(case, lambda c: c["input"]["p_rod"].__setitem__(0, -0.5)), "input.p_rod[0]: -0.5"),
        (changed(case, lambda c: actuator(c).update(c_inflow_check=-1.0)), "actuators[0].c_inflow_check"),
        (changed(case, lambda c: actuator(c).update(c_drain=1.0)), "actuators[0].c_drain"),
        (changed(case, lambda c: actuator(c).update(area_cap=-1.0)), "actuators[0].area_cap: -1"),
        (changed(case, lambda c: actuator(c).update(pump=7)), "actuators[0].pump: 7"),
        (changed(case, lambda c: actuator(c).update(regeneration=2)), "actuators[0].regeneration"),
        (changed(case, lambda c: actuator(c).update(bypass_closed=0)), "bypass_closed: 0 must be"),
        (changed(case, lambda c: actuator(c)["c_extend"].reverse()), "c_extend: must start at"),
        (changed(case, lambda c: actuator(c)["c_extend"].__setitem__(3, [0.0025, 1])),
         "c_extend: must be strictly increasing"),
        (changed(case, lambda c: actuator(c).update(c_retract=[[0, 0]])), "c_retract: must be an array"),
        (changed(case, lambda c: pump(c).update(flow=-1e-3)), "pumps[0].flow: -0.001"),
        (changed(case, lambda c: pump(c).update(relief=0)), "pumps[0].relief: 0 must be"),
        (changed(case, lambda c: pump(c).update(leak_linear="none")), "pumps[0].leak_linear"),
        (changed(case, lambda c: c["machine"].update(pumps=[])), "machine.pumps: must be an array of 1 to 3"),
        (changed(case, lambda c: c["machine"].update(
            actuators=c["machine"]["actuators"] * 3)), "machine.actuators: must be an array of 1 to 6"),
        (json.dumps(case).replace('"velocity": [', '"velocity": [1e999, '), "1e999"),
        (changed(case, lambda c: c.update(machine=[])), "machine: is not an object"),
        ('{"id": ' + "[" * 100000 + "]" * 100000 + "}", "levels deep"),
        (changed(case, lambda c: c.update(id={"a": 1})), "id: must be a string or a number"),
        (changed(case, lambda c: actuator(c).update(bypass_open=1e-200)),
         "actuators[0].bypass_open or bypass_closed: out of any usable range"),
        (changed(case, lambda c: pump(c)["bypass_series"].append(1e-200)),
         "pumps[0].bypass_series: out of any usable range"),
        (changed(case, lambda c: actuator(c).update(c_inflow_check=1e-200)),
         "actuators[0].c_inflow_check: out of any usable range"),
        (changed(case, lambda c: pump(c).update(relief_pa=1e7)), "pumps[0].relief_pa: unknown key"),
        (changed(case, lambda c: actuator(c).update(force_ofset=1)), "force_ofset: unknown key"),
        (changed(case, lambda c: c["input"].update(p_tank=[0])), "input.p_tank: unknown key"),
        (changed(case, lambda c: c.update(id=True)), "id: must be a string or a number"),
    ]


def main():
    graben, path = sys.argv[1:]
    with open(path, encoding="utf-8") as stream:
        case = json.loads(stream.readline())
    bad = bad_lines(case)
    lines = []
    for line, _ in bad:
        lines += [json.dumps(case), line]
    lines += ["", json.dumps(case)]
    done = subprocess.run([graben, "solve"], input="\n".join(lines) + "\n", capture_output=True,
                          text=True, timeout=1800)
    results = [json.loads(line) for line in done.stdout.splitlines()]
    errors = done.stderr.splitlines()
    wrong = []
    if done.returncode != 1:
        wrong.append(f"exit status {done.returncode}, wanted 1")
    if len(results) != len(bad) + 1 or any(r["id"] != case["id"] for r in results):
        wrong.append(f"{len(results)} results for {len(bad) + 1} good lines")
    if len(errors) != len(bad):
        wrong.append(f"{len(errors)} errors for {len(bad)} bad lines")
    for i, ((_, reason), error) in enumerate(zip(bad, errors)):
        number = 2 * i + 2
        if f"line {number}:" not in error or reason not in error:
            wrong.append(f"wanted 'line {number}: ... {reason}', got: {error}")
    print("\n".join(wrong) or f"{len(bad)} bad lines told")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
