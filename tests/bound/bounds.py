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
# What a bound is called, by whose it is.
WORDS = {"any": "instructions", "machine": "instructions_of_its_machine"}


def known():
    return tomllib.loads(BOUNDS.read_text("utf-8")) if BOUNDS.exists() else {}


def judge(name, found, update):
    """`found`: (Summary, stages) by whose bound it is, "any" and "machine"."""
    target, kind = name.split(".")
    bounds = known()
    now = {WORDS[whose]: summary.bound for whose, (summary, _) in found.items()}
    now["stack"] = max(summary.stack for summary, _ in found.values())
    if update:
        summary, stages = found["machine"] if "machine" in found else found["any"]
        parts = {part: bound for part, bound in stages.items() if bound >= LEAST_SHARE * summary.bound}
        bounds.setdefault(target, {})[kind] = {**now, "of": parts}
        write(bounds)
    was = bounds.get(target, {}).get(kind, {})
    problems = []
    for figure, is_now in now.items():
        if figure not in was:
            problems.append(f"{kind}: bounds.toml has no {figure} of it (--toml fills it in)")
        elif abs(is_now - was[figure]) > DRIFT * was[figure]:
            problems.append(f"{kind}: {is_now} {figure}, it was {was[figure]} (--toml, if it is meant)")
    least = min(summary.bound for summary, _ in found.values())
    if observed(target, kind) > least:
        problems.append(f"{kind}: {observed(target, kind)} instructions were observed, more than the bound")
    return problems


def observed(target, kind):
    """The dearest cycle that was counted."""
    groups = json.loads(OBSERVED.read_text("utf-8")).get(target, {})
    return max((row["count"] for group, row in groups.items()
                if not group.startswith("solve") and group.startswith("dozer") == (kind == "dozer")), default=0)


def write(bounds):
    lines = ["# What bound.py --toml has found: instructions of a step at most, bytes of stack, and whose they are.\n"]
    for target in sorted(bounds):
        for kind, row in sorted(bounds[target].items()):
            lines.append(f"\n[{target}.{kind}]\n")
            lines += [f"{figure} = {row[figure]}\n" for figure in (*WORDS.values(), "stack") if figure in row]
            lines.append(f"\n[{target}.{kind}.of]\n")
            lines += [f'"{part}" = {bound}\n' for part, bound in sorted(row["of"].items(), key=lambda pair: -pair[1])]
    BOUNDS.write_text("".join(lines), "utf-8")


def table(bounds):
    rows = ["| Target | Image | Bound of any machine, instructions | Bound of its own | Observed | Bound / observed |"
            " Static stack, B |", "| --- | --- | ---: | ---: | ---: | ---: | ---: |"]
    for target in sorted(bounds):
        for kind, row in sorted(bounds[target].items()):
            own, seen = row.get(WORDS["machine"], row["instructions"]), observed(target, kind)
            rows.append(f"| {target} | {kind} | {row['instructions']:,} | {own:,} | {seen:,} | {own / seen:.1f} | "
                        f"{row['stack']:,} |".replace(",", " "))
    return rows
