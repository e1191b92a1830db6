# SPDX-License-Identifier: Apache-2.0
"""Compares `graben solve --policy algorithm1` with the reference cases: check_solve.py GRABEN CASES."""

import json
import subprocess
import sys

LAMBDA_TOLERANCE = 2e-7
SPOOL_TOLERANCE = 1e-6  # of x_m
PRESSURE_TOLERANCE = 1e-6  # relative


def solve(graben, text):
    done = subprocess.run([graben, "solve", "--policy", "algorithm1"], input=text,
                          capture_output=True, text=True, timeout=1800)
    return done.returncode, [json.loads(line) for line in done.stdout.splitlines()], done.stderr


def relative(actual, wanted):
    return abs(actual - wanted) / max(abs(wanted), 1e-12)


def spool_limits(case):
    """x_m of the side that each spool is on."""
    return [(a["c_extend"] if v >= 0 else a["c_retract"])[-1][0]
            for a, v in zip(case["machine"]["actuators"], case["input"]["velocity"])]


def differences(case, result):
    expect = case["expect"]
    found = []
    if result["id"] != case["id"]:
        found.append(f"id {result['id']}")
    if not abs(result["lambda"] - expect["lambda_algorithm1"]) <= LAMBDA_TOLERANCE:
        found.append(f"lambda {result['lambda']} for {expect['lambda_algorithm1']}")
    if result["limit"] != expect["active"]:
        found.append(f"limit '{result['limit']}' for '{expect['active']}'")
    if result["regenerating"] != expect["regenerating"]:
        found.append("regenerating")
    if len(result["spool"]) != len(expect["spool"]):
        found.append("number of spools")
    for i, (spool, wanted, x_m) in enumerate(
            zip(result["spool"], expect["spool"], spool_limits(case))):
        if not abs(spool - wanted) <= SPOOL_TOLERANCE * x_m:
            found.append(f"spool[{i}] {spool} for {wanted}")
    for key in ("pump_pressure", "p_out"):
        for i, (actual, wanted) in enumerate(zip(result[key], expect.get(key, []))):
            if not relative(actual, wanted) <= PRESSURE_TOLERANCE:
                found.append(f"{key}[{i}] {actual} for {wanted}")
    return found


def main():
    graben, path = sys.argv[1:]
    with open(path, encoding="utf-8") as stream:
        text = stream.read()
    cases = [json.loads(line) for line in text.splitlines()]
    status, results, errors = solve(graben, text)
    wrong = 0
    if status != 0 or errors or len(results) != len(cases) or not cases:
        print(f"status {status}, {len(results)} results for {len(cases)} cases\n{errors}")
        wrong += 1
    for case, result in zip(cases, results):
        found = differences(case, result)
        if found:
            wrong += 1
            print(f"{case['id']}: " + "; ".join(found))
    print(f"{len(cases)} cases, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
