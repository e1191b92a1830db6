# SPDX-License-Identifier: Apache-2.0
"""Proves that check_counts.py can fail: canary.py BUILD. Against what it has just counted itself,
9.9 % of wasted instructions in each cycle have to pass and 10.1 % to fail, with --strict 1.9 % and 2.1 %; a target of which nothing is committed has to fail, too."""

import json
import pathlib
import subprocess
import sys
import tempfile

GROUP = "22t"
CHECK = pathlib.Path(__file__).with_name("check_counts.py")


def check(build: str, observed: pathlib.Path, *words) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, "-B", str(CHECK), build, "--observed", str(observed),
                           "--only", GROUP, *words],
                          capture_output=True, text=True, check=False)


def main() -> int:
    build = sys.argv[1]
    problems = []
    with tempfile.TemporaryDirectory(prefix="graben-counts-") as folder:
        observed = pathlib.Path(folder, "observed.json")
        done = check(build, observed)
        if done.returncode != 1 or "nothing is committed" not in done.stdout:
            problems.append(f"status {done.returncode} where nothing is committed\n{done.stdout}")
        done = check(build, observed, "--update")
        if done.returncode != 0:
            sys.exit(f"canary: nothing to begin with\n{done.stdout}{done.stderr}")
        (target, groups), = json.loads(observed.read_text()).items()
        most = groups[GROUP]["count"]
        for share, status, *strict in ((0.099, 0), (0.101, 1), (0.019, 0, "--strict"), (0.021, 1, "--strict")):
            done = check(build, observed, "--burn", str(round(share * most)), *strict)
            told = "above the committed" in done.stdout
            if done.returncode != status or told != bool(status):
                problems.append(f"{target}: status {done.returncode} with {100.0 * share:.1f} % "
                                f"more\n{done.stdout}{done.stderr}")
    print("\n".join([*problems, f"canary: {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
