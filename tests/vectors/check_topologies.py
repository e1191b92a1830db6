# SPDX-License-Identifier: Apache-2.0
"""`graben solve --policy algorithm1` on random valves against plain_valve: check_topologies.py GRABEN
[CASES]. 1 to 6 spools on 1 to 3 pumps, regeneration on either side or none, with and without relief."""

import json
import math
import random
import subprocess
import sys

from plain_valve import algorithm1

CASES = 200


def log_uniform(draw, least, most):
    return math.exp(draw.uniform(math.log(least), math.log(most)))


def random_table(draw):
    inner = draw.choice([0, 1, 3, 7, 30])
    columns = [[0.0, *sorted(draw.uniform(0.01, 0.99) for _ in range(inner)), 1.0] for _ in range(2)]
    x_m, c_m = draw.uniform(0.005, 0.02), log_uniform(draw, 3e-4, 5e-3)
    return [[x * x_m, c * c_m] for x, c in zip(*columns)]


def random_case(seed):
    draw = random.Random(seed)
    pumps = draw.randint(1, 3)
    actuators = []
    for _ in range(draw.randint(1, 6)):
        cap = log_uniform(draw, 0.004, 0.03)
        drain = log_uniform(draw, 5e-7, 3e-6)
        actuators.append({
            "area_cap": cap, "area_rod": cap * draw.uniform(0.4, 1.1), "pump": draw.randrange(pumps),
            "regeneration": draw.choice([-1, 0, 1]), "c_drain": drain,
            "c_check": drain * log_uniform(draw, 1.001, 4.0), "bypass_open": log_uniform(draw, 2e-6, 8e-6),
            "bypass_closed": log_uniform(draw, 1e-7, 1e-6), "force_offset": draw.choice([0.0, 500.0, 2000.0]),
            "c_extend": random_table(draw), "c_retract": random_table(draw)})
    lines = []
    for _ in range(pumps):
        lines.append({"flow": draw.choice([0.0] + 9 * [log_uniform(draw, 5e-4, 8e-3)]),
                      "leak_linear": draw.choice([0.0, log_uniform(draw, 1e-13, 1e-11)]),
                      "leak_quadratic": draw.choice([0.0, log_uniform(draw, 1e-21, 1e-18)]),
                      "bypass_series": [log_uniform(draw, 2e-6, 6e-6) for _ in range(draw.randint(1, 3))]})
        if draw.random() < 0.5:
            lines[-1]["relief"] = log_uniform(draw, 5e6, 4e7)
    pressure = lambda: draw.uniform(0.0, 1.2e7) * draw.choice([1.0, 0.2])
    count = range(len(actuators))
    return {"id": seed, "machine": {"actuators": actuators, "pumps": lines},
            "input": {"velocity": [draw.choice([0.0] + 5 * [draw.uniform(-0.5, 0.5)]) for _ in count],
                      "p_cap": [pressure() for _ in count], "p_rod": [pressure() for _ in count]}}


def differences(case, got):
    lam, limit, wanted = algorithm1(case)
    found = []
    if abs(got["lambda"] - lam) > 2e-7:
        found.append(f"lambda {got['lambda']} for {lam}")
    if got["limit"] != limit:
        found.append(f"limit '{got['limit']}' for '{limit}'")
    if wanted is None:
        return found + (["spool"] if any(got["spool"]) else [])
    for i, actuator in enumerate(case["machine"]["actuators"]):
        x_m = actuator["c_extend" if case["input"]["velocity"][i] > 0 else "c_retract"][-1][0]
        if abs(got["spool"][i] - wanted["spool"][i]) > 1e-6 * x_m:
            found.append(f"spool[{i}] {got['spool'][i]} for {wanted['spool'][i]}")
    for key in ("pump_pressure", "p_out"):
        for actual, right in zip(got[key], wanted[key]):
            # Below a pascal the flow balance's own rounding rules.
            if abs(actual - right) > 1e-6 * max(abs(right), 1.0):
                found.append(f"{key} {actual} for {right}")
    return found + (["regenerating"] if got["regenerating"] != wanted["regenerating"] else [])


def main():
    graben = sys.argv[1]
    cases = [random_case(seed) for seed in range(int(sys.argv[2]) if len(sys.argv) > 2 else CASES)]
    done = subprocess.run([graben, "solve", "--policy", "algorithm1"],
                          input="".join(json.dumps(c) + "\n" for c in cases),
                          capture_output=True, text=True, timeout=1800)
    results = [json.loads(line) for line in done.stdout.splitlines()]
    assert done.returncode == 0 and len(results) == len(cases), done.stderr
    wrong = 0
    for case, result in zip(cases, results):
        found = differences(case, result)
        if found:
            wrong += 1
            print(f"seed {case['id']}: " + "; ".join(found))
    held = sum(1 for result in results if result["limit"])
    print(f"{len(cases)} cases, {held} held by a limit, {wrong} wrong")
    # Cases that nothing holds would compare little.
    return 1 if wrong or held < len(cases) // 4 else 0


if __name__ == "__main__":
    sys.exit(main())
