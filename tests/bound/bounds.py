# SPDX-License-Identifier: Apache-2.0
"""bounds.toml: the bounds that were taken over, by target and image, and what of them is whose."""

import json
import pathlib
import tomllib

HERE = pathlib.Path(__file__).parent
BOUNDS = HERE / "bounds.toml"
OBSERVED = HERE.parent / "timing" / "counts" / "observed.json"
DRIFT = 0.02
# Parts of a step that are less than this share of it are not written down.
LEAST_SHARE = 0.001
# Those that are less are not in the table.
PART_SHARE = 0.01


def known():
    return tomllib.loads(BOUNDS.read_text("utf-8")) if BOUNDS.exists() else {}


def judge(name, found, update):
    """`found`: (Summary, stages) by whose bound it is: "any", or a machine's name."""
    target, kind = name.split(".")
    bounds = known()
    now = {whose: summary.bound for whose, (summary, _) in found.items()}
    now["stack"] = max(summary.stack for summary, _ in found.values())
    if update:
        # What a shipped machine's are made of says more than what no machine has at once.
        summary, stages = max(((one, of) for whose, (one, of) in found.items() if whose != "any" or len(found) == 1),
                              key=lambda pair: pair[0].bound)
        parts = {part: bound for part, bound in stages.items() if bound >= LEAST_SHARE * summary.bound}
        seen = bounds.get(target, {}).get(kind, {}).get("seen", {})
        bounds.setdefault(target, {})[kind] = {**now, "of": parts, "seen": seen}
        write(bounds)
    was = bounds.get(target, {}).get(kind, {})
    problems = []
    for figure, is_now in now.items():
        if figure not in was:
            problems.append(f"{kind}: bounds.toml has no {figure} of it (--toml fills it in)")
        elif abs(is_now - was[figure]) > DRIFT * was[figure]:
            problems.append(f"{kind}: {words(figure, is_now)}, it was {was[figure]} (--toml, if it is meant)")
    problems += [f"{kind}: {seen} instructions of {whose} were observed, more than the bound"
                 for whose in found if (seen := observed(target, kind, whose)) > now[whose]]
    return problems


def words(figure, value):
    return f"{value} B of stack" if figure == "stack" else f"{value} instructions of {figure} machine"


def observed(target, kind, whose="any"):
    """The dearest cycle that was counted, of this machine."""
    groups = json.loads(OBSERVED.read_text("utf-8")).get(target, {})
    return max((row["count"] for group, row in groups.items() if not group.startswith("solve") and
                (group.removesuffix("-queue") == whose or
                 whose == "any" and group.startswith("dozer") == (kind == "dozer"))), default=0)


def write(bounds):
    lines = ["# What bound.py --toml has found: instructions of a step at most, of any machine and of some; bytes of stack;",
             "\n# what of the dearest of those machines is whose, and `seen` of those in fuzzed cycles (held_bounds.py).\n"]
    for target in sorted(bounds):
        for kind, row in sorted(bounds[target].items()):
            lines.append(f"\n[{target}.{kind}]\n")
            lines += [f"{figure} = {value}\n" for figure, value in row.items() if figure not in ("of", "seen")]
            for whose in ("of", "seen"):
                if row.get(whose):
                    lines.append(f"\n[{target}.{kind}.{whose}]\n")
                    lines += [f'"{part}" = {count}\n'
                              for part, count in sorted(row[whose].items(), key=lambda pair: -pair[1])]
    BOUNDS.write_text("".join(lines), "utf-8")


def table(bounds):
    rows = ["| Target | Kind | Machine | Bound, instructions | Observed | Bound / observed | Static stack, B |",
            "| --- | --- | --- | ---: | ---: | ---: | ---: |"]
    for target in sorted(bounds):
        for kind, row in sorted(bounds[target].items()):
            for whose, bound in row.items():
                if whose not in ("of", "seen", "stack"):
                    seen = observed(target, kind, whose)
                    ratio = f"{bound / seen:.1f}" if seen else "-"
                    rows.append(f"| {target} | {kind} | {whose} | {bound:,} | {seen:,} | {ratio} | {row['stack']:,} |"
                                .replace(",", " "))
    return rows


def take_over_seen(name, of_step):
    """What the parts of a step took at most, of those that bounds.toml has."""
    target, kind = name.split(".")
    bounds = known()
    row = bounds[target][kind]
    row["seen"] = {part: of_step[part] for part in row["of"] if part in of_step}
    write(bounds)


def parts_table(bounds):
    """Of the images whose parts were counted, those that are a hundredth of the step at least."""
    rows = ["| Target | Kind | Part of the step | Bound, instructions | Fuzzed | Bound / fuzzed |",
            "| --- | --- | --- | ---: | ---: | ---: |"]
    for target in sorted(bounds):
        for kind, row in sorted(bounds[target].items()):
            for part, bound in row["of"].items():
                seen = row.get("seen", {}).get(part, 0)
                if seen and bound >= PART_SHARE * sum(row["of"].values()):
                    rows.append(f"| {target} | {kind} | `{part}` | {bound:,} | {seen:,} | {bound / seen:.1f} |"
                                .replace(",", " "))
    return rows
