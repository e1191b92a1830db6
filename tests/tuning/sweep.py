# SPDX-License-Identifier: Apache-2.0
"""What each judgement of the core moves: every number of a tuning.hpp is made 30 % less and 30 % more, one at a time, and
a campaign that it has part in is made again, with the same draws.

The core is compiled once more beside a build, its judgements read at start from the environment, and linked with the
build's other parts. Counts that size an array stay as they are. A figure is the median of the draws, as found; the
largest error is their 95th percentile.

    sweep.py BUILD                   all of them, to BUILD/sweep/found.csv; goes on where it was stopped
    sweep.py BUILD --only REGEX      those whose room and name are like it
    sweep.py BUILD --table N         the N that moved a figure most, as a table
    sweep.py BUILD --write N         these say in their tuning.hpp what was measured
"""

import argparse
import concurrent.futures
import csv
import json
import os
import pathlib
import re
import shlex
import subprocess
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
FACTORS = (0.7, 1.3)
TOOL = "graben-campaign"
NUMBER = re.compile(r"^inline constexpr double (k\w+) =\s*([^;]+);", re.MULTILINE)
# Which campaigns a room has part in; the first row that fits.
RUNS = {
    "dry": ["dig", "--profile", "excavator_22t", "--draws", "40"],
    "soil": ["dig", "--profile", "excavator_12t", "--soil", "--draws", "20"],
    "trench": ["autodig", "--profile", "excavator_12t", "--task", "trench", "--soil", "loam", "--draws", "3"],
    "grade": ["grade", "--profile", "dozer_9t", "--draws", "20"],
}
ROOMS = (("firmware/dozer", ("grade",)), ("firmware/excavator/motion/dig", ("trench",)),
         ("firmware/excavator/estimation/load", ("soil", "trench")),
         ("firmware/excavator/motion/program", ("trench",)), ("firmware/excavator", ("dry", "soil")),
         ("firmware/mcv", ("dry", "soil")), ("firmware", ("dry", "soil", "grade")))
# Figures of a campaign that are looked at: what shows them in mm, %, s, and the quantile of the draws.
FIGURES = {"max_error_true_m": (1e3, 0.95), "rmse_error_true_m": (1e3, 0.5), "over_cut_max_m": (1e3, 0.95),
           "built_within_ratio": (100.0, 0.5), "task_s": (1.0, 0.5), "loop_s": (1.0, 0.5), "time_s": (1.0, 0.5),
           "tip_jerk_rms_mps3": (1.0, 0.5), "edge_jerk_rms_mps3": (1.0, 0.5)}
# A figure under this moves by rounding: mm, %, s.
NOTHING = 1.0


def judgements():
    """(id, room, name) in a constant order."""
    found = []
    for path in sorted(ROOT.glob("firmware/**/tuning.hpp")):
        for match in NUMBER.finditer(path.read_text()):
            found.append((len(found), str(path.parent.relative_to(ROOT)), match[1]))
    return found


def swept_source(text: str, ids: dict[str, int], is_tuning: bool) -> str:
    def judged(match: re.Match) -> str:
        return f"static const double {match[1]} = graben_swept({ids[match[1]]}) * ({match[2]});"
    if is_tuning:
        text = NUMBER.sub(judged, text)
        text = text.replace("namespace graben {", "double graben_swept(int);\nnamespace graben {", 1)
    number = r"constexpr (double|TimeUs|auto|std::array<double[^>]*>)"
    text = re.sub(rf"\binline {number} (k\w+)", r"static const \1 \2", text)
    text = re.sub(rf"\bstatic {number} (k\w+)", r"static inline const \1 \2", text)
    text = re.sub(rf"\b{number} (k\w+)", r"const \1 \2", text)
    text = re.sub(r"\bconstexpr (double|bool) (\w+)\(", r"inline \1 \2(", text)
    return re.sub(r"static_assert\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\);", "", text)


def build(folder: pathlib.Path, home: pathlib.Path) -> None:
    """The core, swept, in home/core.a, and the tools that are linked with it."""
    ids = {name: number for number, _, name in judgements()}
    tree = home / "tree"
    sources = []
    for path in sorted(ROOT.glob("firmware/**/*.[ch]pp")):
        target = tree / path.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        text = swept_source(path.read_text(), ids, path.name == "tuning.hpp")
        if not target.exists() or target.read_text() != text:
            target.write_text(text)
        if path.suffix == ".cpp":
            sources.append(target)
    swept = tree / "swept.cpp"
    swept.write_text('#include <cstdlib>\ndouble graben_swept(int id) {\n  static const char* const at = '
                     'std::getenv("GRABEN_SWEPT");\n  static const char* const by = std::getenv("GRABEN_SWEPT_BY");\n'
                     "  return at != nullptr && std::atoi(at) == id ? std::atof(by) : 1.0;\n}\n")
    flags = ["c++", "-std=c++17", "-O2", "-ffp-contract=off", "-fno-exceptions", "-w", "-fpermissive", f"-I{tree}",
             f"-I{folder / 'generated'}", f"-I{ROOT}", "-isystem", "/usr/include/eigen3", "-DEIGEN_NO_MALLOC",
             "-DEIGEN_DONT_VECTORIZE", "-DEIGEN_NO_DEBUG"]
    objects = []

    def compiled(source: pathlib.Path) -> str:
        target = home / "objects" / (str(source.relative_to(tree)).replace("/", "_") + ".o")
        target.parent.mkdir(exist_ok=True)
        if not target.exists() or target.stat().st_mtime < max(p.stat().st_mtime for p in tree.rglob("*.hpp")) \
                or target.stat().st_mtime < source.stat().st_mtime:
            subprocess.run([*flags, "-c", source, "-o", target], check=True)
        return str(target)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        objects = list(pool.map(compiled, [*sources, swept]))
    core = home / "core.a"
    core.unlink(missing_ok=True)
    subprocess.run(["ar", "rcs", core, *objects], check=True)
    command = subprocess.run(["ninja", "-C", folder, "-t", "commands", f"app/cli/{TOOL}"], check=True, capture_output=True,
                             text=True).stdout.strip().splitlines()[-1]
    command = command.replace("firmware/libgraben_firmware.a", str(core))
    command = re.sub(r"-o \S+", f"-o {shlex.quote(str(home / TOOL))}", command)
    subprocess.run(command, shell=True, cwd=folder, check=True)


def figures_of(home: pathlib.Path, run: str, number: int, factor: float) -> dict[str, float]:
    summary = home / "runs" / f"{run}_{number}_{factor}.csv"
    words = list(RUNS[run])
    machines = ROOT / "app/machines"
    words = [str(machines / f"{word}.toml") if re.match("excavator_|dozer_", word) else word for word in words]
    words = [str(machines / f"tasks/{word}.toml") if word == "trench" else word for word in words]
    environment = {**os.environ, "GRABEN_SWEPT": str(number), "GRABEN_SWEPT_BY": str(factor)}
    summary.unlink(missing_ok=True)
    subprocess.run([home / TOOL, "campaign", *words, "--jobs", "1", "--summary", summary], capture_output=True,
                   env=environment, check=False)
    with open(summary, newline="", encoding="utf-8") as stream:
        draws = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    found = {"ends": float(sum(draw["end"] == "done" for draw in draws))}
    for name, (_, quantile) in FIGURES.items():
        values = sorted(float(draw[name]) for draw in draws if draw.get(name))
        if values:
            found[name] = values[round(quantile * (len(values) - 1))]
    summary.unlink()
    return found


def rows_of(path: pathlib.Path) -> list[dict[str, str]]:
    if not path.exists():
        return []
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def sweep(home: pathlib.Path, only: str, jobs: int) -> None:
    found = home / "found.csv"
    done = {(row["name"], row["run"], row["factor"]) for row in rows_of(found)}
    (home / "runs").mkdir(exist_ok=True)
    wanted = [(number, room, name, run, factor) for number, room, name in judgements()
              for run in next(runs for start, runs in ROOMS if room.startswith(start)) for factor in FACTORS
              if re.search(only, f"{room} {name}")]
    wanted = [(-1, "", "as it is", run, 1.0) for run in RUNS] + wanted
    with open(found, "a", newline="", encoding="utf-8") as stream, concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        writer = csv.DictWriter(stream, ["name", "room", "run", "factor", "ends", *FIGURES])
        if not done:
            writer.writeheader()
        todo = [task for task in wanted if (task[2], task[3], str(task[4])) not in done]
        for task, figures in zip(todo, pool.map(lambda t: figures_of(home, t[3], t[0], t[4]), todo)):
            writer.writerow({"name": task[2], "room": task[1], "run": task[3], "factor": task[4], **figures})
            stream.flush()


def moved(home: pathlib.Path) -> list[tuple[float, str, str, str]]:
    """(by how much of itself, name, room, in words), the most first."""
    rows = rows_of(home / "found.csv")
    usual = {row["run"]: row for row in rows if row["name"] == "as it is"}
    by_name: dict[str, list] = {}
    for row in rows:
        if row["name"] != "as it is":
            by_name.setdefault(row["name"], []).append(row)
    found = []
    for name, of_name in by_name.items():
        best = (0.0, "")
        for run in {row["run"] for row in of_name}:
            pair = {row["factor"]: row for row in of_name if row["run"] == run}
            ends = {factor: int(float(row["ends"])) for factor, row in pair.items()}
            usual_ends = int(float(usual[run]["ends"]))
            if min(ends.values()) < usual_ends:
                says = ", ".join(f"x{factor} {count}" for factor, count in ends.items())
                best = max(best, (9.0, f"{run}: draws that end well {usual_ends}; {says}"))
            for figure, (scale, _) in FIGURES.items():
                if usual[run].get(figure):
                    here = scale * float(usual[run][figure])
                    others = {factor: scale * float(row[figure]) for factor, row in pair.items() if row.get(figure)}
                    share = max((abs(other - here) / max(abs(here), NOTHING) for other in others.values()), default=0.0)
                    says = ", ".join(f"x{factor} {other:.3g}" for factor, other in others.items())
                    best = max(best, (share, f"{run}'s {figure} {here:.3g}; {says}"))
        found.append((best[0], name, of_name[0]["room"], best[1]))
    return sorted(found, reverse=True)


def write(rows) -> None:
    """The tag of each in its tuning.hpp says what was measured."""
    for _, name, room, says in rows:
        path = ROOT / room / "tuning.hpp"
        text = path.read_text()
        match = re.search(rf"((?:^///[^\n]*\n)+)(?=inline constexpr double {name} =)", text, re.MULTILINE)
        comment = " ".join(line.removeprefix("///").strip() for line in match[1].splitlines()) if match else ""
        tag = re.search(r"\[([^;\[\]]+); chosen: (.*)\]$", comment)
        if tag:
            tried = re.sub(r";? ?not tried( otherwise)?$", "", tag[2])
            words = f"{comment[:tag.start()]}[{tag[1]}; measured: {tried + '; ' if tried else ''}`sweep.py`: {says}]"
            lines = textwrap.wrap(words, 96, break_long_words=False, break_on_hyphens=False)
            path.write_text(text.replace(match[1], "".join(f"/// {line}\n" for line in lines), 1))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--table", type=int)
    parser.add_argument("--write", type=int)
    arguments = parser.parse_args()
    home = (arguments.build / "sweep").resolve()
    if arguments.table or arguments.write:
        rows = moved(home)[:arguments.table or arguments.write]
        if arguments.write:
            write(rows)
        print("| constant | room | moves |\n|---|---|---|")
        for share, name, room, says in rows:
            print(f"| `{name}` | {room} | {share:.0%}: {says} |")
        return
    home.mkdir(parents=True, exist_ok=True)
    build(arguments.build.resolve(), home)
    sweep(home, arguments.only, arguments.jobs)


if __name__ == "__main__":
    main()
