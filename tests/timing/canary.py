# SPDX-License-Identifier: Apache-2.0
"""Proves that ./run bench can fail: canary.py BENCH CASES. With the first cases as they are it has
to end well; with one expectation of ours raised, it has to say which and end with status 1."""

import json
import pathlib
import subprocess
import sys
import tempfile

CASES, CHANGED = 10, 8
KEYS = {"global": "lambda_global", "connected": "lambda_connected",
        "algorithm1": "lambda_algorithm1"}


def bench(program: str, cases: list[dict], folder: str):
    path = pathlib.Path(folder, "cases.jsonl")
    path.write_text("".join(json.dumps(case) + "\n" for case in cases))
    return subprocess.run([sys.executable, "-B", program, "--quick", "--cases", str(path)],
                          capture_output=True, text=True, check=False)


def main() -> int:
    program, path = sys.argv[1:]
    text = pathlib.Path(path).read_text(encoding="utf-8")
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        cases = [json.loads(line) for line in text.splitlines()[:CASES]]
        done = bench(program, cases, folder)
        if done.returncode != 0:
            problems.append(f"status {done.returncode} for cases that are right\n{done.stderr}")
        for key in KEYS.values():
            cases[CHANGED - 1]["expect"][key] += 2e-6
        done = bench(program, cases, folder)
        if done.returncode != 1:
            problems.append(f"status {done.returncode} for cases that are wrong")
        problems += [f"{solver} not told" for solver in KEYS
                     if f"WRONG: {solver}, line {CHANGED}: lambda " not in done.stderr]
    print("\n".join([*problems, f"canary: {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
