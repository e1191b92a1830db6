"""Proves that check_solve.py can fail: canary.py GRABEN CASES. Each changed expectation must be told."""

import json
import os
import subprocess
import sys
import tempfile

CHANGES = {
    "lambda": lambda e: e.update(lambda_algorithm1=e["lambda_algorithm1"] - 3e-7),
    "limit": lambda e: e.update(active="pump_flow[1]"),
    "regenerating": lambda e: e["regenerating"].__setitem__(0, not e["regenerating"][0]),
    "spool[0]": lambda e: e["spool"].__setitem__(0, e["spool"][0] + 2e-8),
    "p_out[0]": lambda e: e["p_out"].__setitem__(0, e["p_out"][0] * 1.000002),
    "number of spools": lambda e: e["spool"].pop(),
    "pump_pressure[0]": lambda e: e["pump_pressure"].__setitem__(0, e["pump_pressure"][0] * 1.000002),
}


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
                                  capture_output=True, text=True, timeout=60)
        told = done.returncode != 0 and name in done.stdout
        print(f"{name}: {'told' if told else 'NOT TOLD'}")
        status |= not told
    return status


if __name__ == "__main__":
    sys.exit(main())
