# SPDX-License-Identifier: Apache-2.0
"""No healthy machine is stopped: no_false_stop.py GRABEN OUT [--draws 1000] [--jobs N] [--first-seed S]
runs draws of every campaign and task, as designed (what the shipped files do not know of the machine) and
as found (the simulated machine's own file drawn in wider bands), counts how each came to its end, prints
a table and ends with status 1 if any was stopped by a fault, 2 if a run could not be made.

The log of a stopped run stays in OUT; a run that was made is not made again."""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys

MACHINES = pathlib.Path(__file__).resolve().parents[2] / "app/machines"

# Name, share of the draws, profile, command and its options.
KINDS = (
    ("dig", 15, "excavator_22t", ("campaign", "dig")),
    ("dig, soil", 15, "excavator_22t", ("campaign", "dig", "--soil")),
    ("dig, in the air", 10, "excavator_22t", ("campaign", "dig", "--air")),
    ("dig, a rock in the way", 10, "excavator_22t", ("campaign", "dig", "--obstacle")),
    ("dig, 150 ms of dead time", 5, "excavator_22t", ("campaign", "dig", "--dead-time", "0.15", "--speed", "0.5")),
    ("dig, 12 t", 5, "excavator_12t", ("campaign", "dig")),
    ("dig, 12 t, soil", 5, "excavator_12t", ("campaign", "dig", "--soil")),
    ("grade", 15, "dozer_9t", ("campaign", "grade")),
    ("flatten", 10, "excavator_12t", ("autodig", "--task", "flatten")),
    ("truck loading", 10, "excavator_12t", ("autodig", "--task", "truck_by_steps")),
    # Each pump that sets its own swash: fast and light, slow and heavy.
    *((f"dig, {pump}, {where}", 4, f"excavator_{pump}", ("campaign", "dig", *options))
      for pump in ("22t_ls", "12t_ls", "22t_nfc", "12t_nfc")
      for where, options in (("dry", ()), ("soil", ("--soil",)), ("in the air", ("--air",)))),
)

# As found: key of NAME.sim.toml, and by what it is multiplied. The bands are those of machines that were
# measured, not built to a drawing.
BANDS = {
    "mass": (0.85, 1.15), "inertia": (0.85, 1.15), "coulomb": (0.5, 1.5), "viscous": (0.5, 1.5),
    "bulk_modulus": (0.5, 1.14), "deadband": (0.9, 1.1), "time_constant": (0.75, 1.5), "stroke_bias": (5.0, 5.0),
}
NUMBER = re.compile(r"(?<![\w.])\d+\.?\d*(?:e-?\d+)?")
LINE = re.compile(r"^(?P<key>\w+) = (?P<value>[^#\n]*)(?P<rest>.*)$")


def as_found(profile, seed, folder, bands):
    """Copies of the machine's two files, the simulated one drawn from the seed."""
    draw = random.Random(f"{profile} {seed}")
    lines = []
    file = MACHINES / f"{profile}.sim.toml"
    like = re.search(r'^like = "(\w+)"', file.read_text(encoding="ascii"), re.MULTILINE)
    for line in (MACHINES / f"{like[1]}.sim.toml" if like else file).read_text(encoding="ascii").splitlines():
        match = LINE.match(line)
        if match and match["key"] in bands:
            value = NUMBER.sub(lambda number: repr(float(number[0]) * draw.uniform(*bands[match["key"]])),
                               match["value"])
            line = f"{match['key']} = {value}"
        lines.append(line)
    folder.mkdir(parents=True, exist_ok=True)
    copy = folder / f"{profile}.toml"
    copy.write_bytes((MACHINES / f"{profile}.toml").read_bytes())
    (folder / f"{profile}.sim.toml").write_text("\n".join(lines) + "\n", encoding="ascii")
    return str(copy)


def run_campaign(graben, command, profile, seed, folder):
    summary = folder / "campaign.csv"
    done = subprocess.run([graben, *command, "--profile", profile, "--draws", "1", "--jobs", "1", "--seed",
                           str(seed), "--summary", str(summary)], capture_output=True, text=True,
                          check=False)
    if not summary.exists():
        return f"status {done.returncode}: {done.stderr.strip()[-200:]}"
    lines = summary.read_text(encoding="ascii").splitlines()
    return lines[2].split(",")[1]


def run_task(graben, command, profile, seed, folder):
    done = subprocess.run([graben, *command, "--profile", profile, "--errors", "kim", "--seed", str(seed), "--out",
                           str(folder)], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return "done"
    if "not finished in time" in done.stderr:
        return "not-finished"
    return "fault" if "fault" in done.stderr else f"status {done.returncode}: {done.stderr.strip()[-200:]}"


def run(options, kind, found, seed):
    name, _, profile, command = kind
    folder = options.out / re.sub(r"\W+", "_", name) / ("found" if found else "designed") / str(seed)
    result = folder / "end.json"
    if result.exists():
        return json.loads(result.read_text(encoding="utf-8"))
    folder.mkdir(parents=True, exist_ok=True)
    of = as_found(profile, seed, folder, {**BANDS, **dict(options.band)}) if found else profile
    end = (run_campaign if command[0] == "campaign" else run_task)(options.graben, command, of, seed, folder)
    if end == "done":
        for file in folder.iterdir():
            file.unlink()
    result.write_text(json.dumps(end), encoding="utf-8")
    return end


def table(ends):
    print(f"{'draws of':34} {'as':9} {'draws':>6} {'done':>6} {'stopped':>8}  otherwise")
    for (name, found), of in ends.items():
        other = {end: len(seeds) for end, seeds in of.items() if end not in ("done", "fault")}
        print(f"{name:34} {'found' if found else 'designed':9} {sum(map(len, of.values())):6} "
              f"{len(of.get('done', ())):6} {len(of.get('fault', ())):8}  {other or '-'}")
        if of.get("fault"):
            print(f"{'':34} stopped: seeds {', '.join(map(str, of['fault'][:12]))}")


def band(text):
    key, _, bounds = text.partition("=")
    low, high = map(float, bounds.split(","))
    return key, (low, high)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("graben")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--draws", type=int, default=1000, help="as designed, and half as many as found")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--only", default="", help="campaigns whose name has this")
    parser.add_argument("--band", type=band, action="append", default=[], metavar="KEY=LOW,HIGH",
                        help="as found, instead of the band of this key")
    parser.add_argument("--fresh", action="store_true", help="runs that were made are made again")
    options = parser.parse_args()
    if options.fresh and options.out.exists():
        shutil.rmtree(options.out)
    whole = sum(kind[1] for kind in KINDS)
    jobs = [(kind, found, options.first_seed + n)
            for kind in KINDS if options.only in kind[0]
            for found, draws in ((False, options.draws), (True, options.draws // 2))
            for n in range(max(1, round(draws * kind[1] / whole)))]
    ends = collections.OrderedDict()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        results = pool.map(lambda job: run(options, *job), jobs)
        for (kind, found, seed), end in zip(jobs, results):
            ends.setdefault((kind[0], found), {}).setdefault(end, []).append(seed)
    table(ends)
    broken = [end for of in ends.values() for end in of if end.startswith("status")]
    stopped = any("fault" in of for of in ends.values())
    sys.exit(2 if broken else 1 if stopped else 0)


if __name__ == "__main__":
    main()
