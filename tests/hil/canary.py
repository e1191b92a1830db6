# SPDX-License-Identifier: Apache-2.0
"""Proves that the harness can fail: canary.py CASE OUT runs a scenario that must not pass, and looks
at the exit status and at what is said."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
# Case: script, options, CI or None for as it is, wanted status, wanted words.
CASES = {
    "exit": ("echo left >\"$OUT/left\"; exit 3", [], None, 3, "status 3 "),
    "hang": ("echo left >\"$OUT/left\"; sleep 100000", ["--timeout", "5"], None, 124, "timed out"),
    "panic": ("echo c >/proc/sysrq-trigger; sleep 9", ["--where", "vm"], None, 125,
              "Kernel panic - not syncing: sysrq triggered crash"),
    "stuck": ("exit 0", ["--where", "vm", "--patience", "1"], None, 125,
              "the guest was stopped after 1 s of the host's time"),
    "library": ("exit 0", ["--where", "vm", "--binary", "BROKEN"], None, 125, "library not found"),
    "nowhere": ("exit 0", ["--where", "none"], "", 0, "^SKIPPED hil: .*without anything"),
    "nowhere_ci": ("exit 0", ["--where", "none"], "true", 1, "^FAILED hil: .*CI=true.*anything"),
    "no_kernel": ("exit 0", ["--where", "vm", "--cache", "EMPTY"], "true", 1,
                  "^FAILED hil: .*not in a virtual machine: .*(linux-image|missing)"),
}
# What these leave in $OUT must be there although they failed.
BRINGS_BACK = ("exit", "hang")


def broken_program(folder: str) -> pathlib.Path:
    """A program whose library is gone: linked to it, then renamed."""
    library, program = pathlib.Path(folder, "libgone.so"), pathlib.Path(folder, "program")
    source = pathlib.Path(folder, "main.c")
    source.write_text("extern int gone(void); int main(void) { return gone(); }\n")
    subprocess.run(["cc", "-shared", "-o", library, "-xc", "-"], input=b"int gone(void){return 0;}",
                   check=True)
    subprocess.run(["cc", "-o", program, source, library], check=True)
    library.unlink()
    return program


def main() -> int:
    case, out = sys.argv[1], pathlib.Path(sys.argv[2])
    text, options, ci, wanted_status, wanted_words = CASES[case]
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "GRABEN_HIL": ""} if "EMPTY" in options else {**os.environ}
        if ci is not None:
            environment["CI"] = ci
        if "EMPTY" in options:
            # apt without a single list: nothing can be looked up and nothing downloaded.
            pathlib.Path(folder, "apt").mkdir()
            environment["APT_CONFIG"] = f"{folder}/apt.conf"
            pathlib.Path(folder, "apt.conf").write_text(
                f'Dir::State "{folder}/apt";\nDir::Cache "{folder}/apt";\n'
                'Dir::Etc::SourceList "/dev/null";\nDir::Etc::SourceParts "/dev/null";\n'
                'Dir::State::status "/dev/null";\n')
        script = pathlib.Path(folder, "scenario.sh")
        script.write_text(f"{text}\n")
        words = {"EMPTY": f"{folder}/cache"}
        if "BROKEN" in options:
            words["BROKEN"] = str(broken_program(folder))
        done = subprocess.run(
            [sys.executable, "-B", str(HERE / "guest.py"), "--script", str(script), "--out", str(out),
             *(words.get(option, option) for option in options)],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    print(done.stdout)
    if ci is None and done.returncode == 0 and done.stdout.startswith("SKIPPED hil:"):
        return done.returncode
    if done.returncode != wanted_status:
        sys.exit(f"canary {case}: status {done.returncode} instead of {wanted_status}")
    if not re.search(wanted_words, done.stdout, re.MULTILINE):
        sys.exit(f"canary {case}: '{wanted_words}' is not said")
    if case in BRINGS_BACK and (out / "left").read_text() != "left\n":
        sys.exit(f"canary {case}: the result of the scenario did not come back")
    print(f"canary {case}: as expected")
    return 0


if __name__ == "__main__":
    sys.exit(main())
