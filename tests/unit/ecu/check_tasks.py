# SPDX-License-Identifier: Apache-2.0
"""What graben-ecu takes as --task, up to the bus, which is not there, the manual's example among it:
check_tasks.py GRABEN_ECU ROOT"""

import pathlib
import re
import subprocess
import sys
import tempfile

NO_BUS = re.compile(r"graben-ecu: (no_can0: .* is the interface there"
                    r"|socket\(AF_CAN\): .*needs a kernel with CAN).*\n")
WRONG, FAILED = 2, 1


def main() -> int:
    ecu, root = sys.argv[1:]
    machines = pathlib.Path(root, "app", "machines")
    manuals = [path for folder in ("", "app", "app/machines", "app/machines/tasks")
               if (path := pathlib.Path(root, folder, "README.md")).exists()]
    example, = [block for path in manuals
                for block in re.findall(r"^```toml\n(.*?)^```", path.read_text(), re.S | re.M)
                if "[[step]]" in block]
    excavator, dozer = (machines / name for name in ("excavator_12t.toml", "dozer_9t.toml"))
    flatten, loading = (machines / "tasks" / name
                        for name in ("flatten.toml", "truck_by_steps.toml"))
    problems = []

    def expect(status, words, profile, *tasks, reaches_bus=False, more=()):
        told = [word for task in tasks for word in ("--task", task)] + list(more)
        done = subprocess.run([ecu, "--can", "no_can0", "--profile", profile, *told, "--no-realtime"],
                              capture_output=True, text=True, timeout=1800, check=False)
        if done.returncode != status or done.stdout or not all(word in done.stderr for word in words):
            problems.append(f"{told}: status {done.returncode}, expected {status} and {words}:\n{done.stderr}")
        if (NO_BUS.fullmatch(done.stderr) is not None) != reaches_bus:
            problems.append(f"{told}: bus and task in the wrong order:\n{done.stderr}")

    with tempfile.TemporaryDirectory() as folder:
        wrong, far = pathlib.Path(folder, "wrong.toml"), pathlib.Path(folder, "far.toml")
        wrong.write_text(flatten.read_text().replace("duration = 18.4", "duration = -1\nsurplus = 2"))
        far.write_text(flatten.read_text().replace("2.244, 3.886", "9.0, 9.0"))
        shown = pathlib.Path(folder, "shown.toml")
        shown.write_text(example)
        expect(FAILED, [], excavator, shown, reaches_bus=True)
        expect(FAILED, [], excavator, reaches_bus=True)
        expect(FAILED, [], excavator, flatten, reaches_bus=True)
        expect(FAILED, [], excavator, *[flatten, loading] * 2, reaches_bus=True)
        # A real machine's file alone: nothing of a simulated one beside it.
        for machine in (excavator, machines / "excavator_22t.toml", dozer):
            alone = pathlib.Path(folder, f"alone_{machine.name}")
            alone.write_text(machine.read_text())
            expect(FAILED, [], alone, reaches_bus=True)
        expect(WRONG, ["--task"], excavator, *[flatten] * 5)
        expect(WRONG, ["dozer_9t.toml", "a dozer has no tasks"], dozer, flatten)
        expect(WRONG, ["'none': there is no such file", "/etc/graben/tasks", "/usr/share/graben/tasks"], excavator, "none")
        expect(WRONG, ["step[0].duration", "surplus"], excavator, wrong)
        # All of them in one go.
        expect(WRONG, ["surplus", "far.toml", "step[0]", "'none': there is no such file"], excavator, flatten, wrong, far, "none")
        # A commissioning that left the swing out: said before the bus, and no reason not to start.
        part = pathlib.Path(folder, "part.toml")
        part.write_text('kind = "excavator"\nlike = "excavator_12t"\n' + "".join(
            f"[valve.answer.{drive}.{side}]\ndriven = [0.3, 0.9]\n" for drive in ("boom", "arm", "bucket")
            for side in ("extend", "retract")))
        needs = "graben-ecu: task 0 needs drives that were not commissioned: swing, left; swing, right: "
        (pathlib.Path(folder) / excavator.name).write_text(excavator.read_text())
        expect(FAILED, [needs + "refused\n"], part, flatten)
        expect(FAILED, [needs + "at 30 % of the speed\n"], part, flatten, more=("--unknown-drives", "slow"))
        expect(FAILED, [], part, reaches_bus=True)
        expect(WRONG, ["--unknown-drives"], part, more=("--unknown-drives", "fast"))
        blade = pathlib.Path(folder, "blade.toml")
        blade.write_text('kind = "dozer"\nlike = "dozer_9t"\n[hst]\ndriven = [0.1, 0.9]\n')
        (pathlib.Path(folder) / dozer.name).write_text(dozer.read_text())
        expect(FAILED, ["graben-ecu: grade needs drives that were not commissioned: blade, extend; blade, retract: refused"], blade)
        # What is to be kept needs a place.
        expect(WRONG, ["--keep-ground: there is no store to keep it in (--store)"], excavator, more=("--keep-ground",))
        expect(FAILED, [], excavator, more=("--keep-ground", "--store", folder), reaches_bus=True)
    print("\n".join([*problems, f"tasks of graben-ecu: {len(problems)} problems"]))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
