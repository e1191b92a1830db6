# SPDX-License-Identifier: Apache-2.0
"""Proves that check_solve.py and check_policies.py can fail: canary.py GRABEN CASES. Each changed
expectation, and each changed result, must be told."""

import json
import os
import subprocess
import sys
import tempfile

import check_policies

CHANGES = {
    "lambda": lambda e: e.update(lambda_algorithm1=e["lambda_algorithm1"] - 3e-7),
    "limit": lambda e: e.update(active="pump_flow[1]"),
    "regenerating": lambda e: e["regenerating"].__setitem__(0, not e["regenerating"][0]),
    "spool[0]": lambda e: e["spool"].__setitem__(0, e["spool"][0] + 2e-8),
    "p_out[0]": lambda e: e["p_out"].__setitem__(0, e["p_out"][0] * 1.000002),
    "number of spools": lambda e: e["spool"].pop(),
    "pump_pressure[0]": lambda e: e["pump_pressure"].__setitem__(0, e["pump_pressure"][0] * 1.000002),
}



def faster(share):
    return lambda r: r.update({"lambda": r["lambda"] * share})


# (name, what picks the case, what is done to its result, what must be told)
POLICY_CHANGES = [
    ("global too low", lambda r: 0 < r["lambda"] < 1, faster(0.9999), "lambda"),
    ("global too high", lambda r: 0 < r["lambda"] < 0.9, faster(1.0001), "infeasible"),
    ("limit", lambda r: 0 < r["lambda"] < 1, lambda r: r.update(limit="pump_flow[2]"), "limit"),
    ("pressure", lambda r: r["lambda"] > 0,
     lambda r: r["pump_pressure"].__setitem__(0, 1.1 * r["pump_pressure"][0] + 10), "pump_pressure"),
    ("newtons", lambda r: r["status"] == "infeasible",
     lambda r: r["standstill"].update(short_n=r["standstill"]["short_n"] + 1.0), "standstill"),
    ("actuator", lambda r: r["status"] == "infeasible",
     lambda r: r["standstill"].update(actuator=5), "standstill"),
    ("open at standstill", lambda r: r["status"] == "infeasible",
     lambda r: r["spool"].__setitem__(0, 1e-6), "spools"),
]


def policies_told(graben, path):
    with open(path, encoding="utf-8") as stream:
        cases = [json.loads(line) for line in stream]
    results = check_policies.solve("global", graben, cases)[0]
    status = 0
    for name, picks, change, wanted in POLICY_CHANGES:
        case, result = next((c, r) for c, r in zip(cases, results) if picks(r))
        before = check_policies.differences("global", case, result)
        changed = json.loads(json.dumps(result))
        change(changed)
        found = "; ".join(check_policies.differences("global", case, changed))
        told = not before and wanted in found
        print(f"{name}: {'told' if told else 'NOT TOLD: ' + found}")
        status |= not told
    case, result = cases[0], dict(results[0])
    for share in (0.9999, 1.0001):
        result["lambda"] = share * case["expect"]["lambda_connected"]
        status |= not check_policies.lambda_difference("connected", case, result)
    return status


def main():
    graben, path = sys.argv[1:]
    check = os.path.join(os.path.dirname(os.path.abspath(__file__)), "check_solve.py")
    with open(path, encoding="utf-8") as stream:
        first = stream.readline()
    status = 0
    for name, change in CHANGES.items():
        case = json.loads(first)
        change(case["expect"])
        with tempfile.TemporaryDirectory() as folder:
            changed = os.path.join(folder, "changed.jsonl")
            with open(changed, "w", encoding="utf-8") as stream:
                stream.write(json.dumps(case) + "\n")
            done = subprocess.run([sys.executable, "-B", check, graben, changed],
                                  capture_output=True, text=True, timeout=1800)
        told = done.returncode != 0 and name in done.stdout
        print(f"{name}: {'told' if told else 'NOT TOLD'}")
        status |= not told
    return status | policies_told(graben, path)


if __name__ == "__main__":
    sys.exit(main())
