# SPDX-License-Identifier: Apache-2.0
"""`graben solve --policy global` and `connected` on the reference cases: check_policies.py GRABEN CASES.

What is returned must be feasible by plain_valve, with the same pressures, and what is named as the
limit must be what fails just above it. `global` may not be below the reference's largest feasible
lambda, `connected` must end where the reference's interval does."""

import json
import subprocess
import sys

from plain_valve import Circuit

TOLERANCE = 1e-6
FIELDS = ("pump_pressure", "p_out")


def lambda_difference(policy, case, result):
    """What is wrong with lambda, or ''."""
    wanted = case["expect"][f"lambda_{policy}"]
    below = wanted - result["lambda"]
    if below > TOLERANCE or (policy == "connected" and -below > TOLERANCE):
        return f"lambda {result['lambda']} for {wanted}"
    return ""


def standstill_difference(case, result):
    """(43): whether the actuator named is the one that lacks most, and as much as is said."""
    if result["status"] != "infeasible" or any(result["spool"]):
        return f"status {result['status']} at lambda 0, spools {result['spool']}"
    circuit = Circuit(case, 0.0)
    pressure = [circuit.pump_pressure(j) for j in range(len(circuit.pumps))]
    lacks = {i: actuator["force_offset"] + circuit.load(i) - circuit.inlet[i] * pressure[actuator["pump"]]
             for i, actuator in enumerate(circuit.actuators) if circuit.velocity[i] != 0}
    worst = max(lacks, key=lacks.get)
    said = result["standstill"]
    right = said["actuator"] == worst and abs(said["short_n"] - lacks[worst]) <= 1e-6 * lacks[worst]
    return "" if right else f"standstill {said} for actuator {worst}, {lacks[worst]} N"


def point_differences(case, result):
    limit, wanted = Circuit(case, result["lambda"]).solve()
    if limit:
        return [f"infeasible: {limit} at {result['lambda']}"]
    found = []
    for key in FIELDS:
        for actual, right in zip(result[key], wanted[key]):
            if abs(actual - right) > 1e-6 * max(abs(right), 1.0):
                found.append(f"{key} {actual} for {right}")
    above = result["lambda"] * (1.0 + TOLERANCE)
    if above < 1.0:
        fails = Circuit(case, above).solve()[0]
        if fails != result["limit"]:
            found.append(f"limit '{result['limit']}' for '{fails}'")
    return found


def differences(policy, case, result):
    found = [lambda_difference(policy, case, result)]
    if result["lambda"] == 0.0:
        found.append(standstill_difference(case, result))
    else:
        found += point_differences(case, result)
    return [text for text in found if text]


def solve(policy, graben, cases):
    """(results, what the tool said or its status was)"""
    done = subprocess.run([graben, "solve", "--policy", policy], capture_output=True, text=True,
                          input="".join(json.dumps(case) + "\n" for case in cases), timeout=1800)
    results = [json.loads(line) for line in done.stdout.splitlines()]
    complete = done.returncode == 0 and not done.stderr and len(results) == len(cases) > 0
    said = "" if complete else (f"status {done.returncode}, {len(results)} results for "
                                f"{len(cases)} cases\n{done.stderr}")
    return results, said


def check(policy, graben, cases):
    """Number of wrong cases."""
    results, said = solve(policy, graben, cases)
    wrong = 1 if said else 0
    if said:
        print(said)
    for case, result in zip(cases, results):
        found = differences(policy, case, result)
        if found:
            wrong += 1
            print(f"{policy}, {case['id']}: " + "; ".join(found))
    print(f"{policy}: {len(cases)} cases, {wrong} wrong")
    return wrong


def main():
    graben, path = sys.argv[1:]
    with open(path, encoding="utf-8") as stream:
        cases = [json.loads(line) for line in stream]
    return 1 if check("global", graben, cases) + check("connected", graben, cases) else 0


if __name__ == "__main__":
    sys.exit(main())
