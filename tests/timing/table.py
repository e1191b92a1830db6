# SPDX-License-Identifier: Apache-2.0
"""Figures over the cases, and the table of them."""

import math

import verdict

# Heading of a group of columns, heading of a column, how to get it from a row, how to write it.
COLUMNS = [
    ("", "solver", lambda r: r["solver"], str),
    ("time, us", "median", lambda r: r["time_ns"]["median"] / 1e3, lambda v: short(v)),
    ("", "held", lambda r: r["time_ns"]["held"] / 1e3, lambda v: short(v)),
    ("", "p99", lambda r: r["time_ns"]["p99"] / 1e3, lambda v: short(v)),
    ("", "max", lambda r: r["time_ns"]["max"] / 1e3, lambda v: short(v)),
    ("times global", "median", lambda r: r["times_global"]["median"], lambda v: short(v)),
    ("", "held", lambda r: r["times_global"]["held"], lambda v: short(v)),
    ("", "max", lambda r: r["times_global"]["max"], lambda v: short(v)),
    ("instructions", "median", lambda r: r["instructions"]["median"], lambda v: count(v)),
    ("", "held", lambda r: r["instructions"]["held"], lambda v: count(v)),
    ("", "p99", lambda r: r["instructions"]["p99"], lambda v: count(v)),
    ("", "max", lambda r: r["instructions"]["max"], lambda v: count(v)),
    ("error of lambda", "right", lambda r: r["error_where_right"], lambda v: f"{v:.1e}"),
    ("", "worst", lambda r: r["error_worst"], lambda v: f"{v:.1e}"),
    ("cases", "missed", lambda r: r[verdict.MISSED], str),
    ("", "wrong", lambda r: r[verdict.WRONG], str),
    ("", "infeasible", lambda r: r[verdict.INFEASIBLE], str),
]


def short(value: float) -> str:
    return f"{value:.2f}" if value < 99.5 else f"{value:.0f}"


def count(value: int | None) -> str:
    return "-" if value is None else str(value)


def rank(values: list, share: float):
    """Nearest rank: the figure is that of a case, it does not lie between two."""
    return sorted(values)[max(0, math.ceil(share * len(values)) - 1)]


def is_held(expect: dict) -> bool:
    """Something holds lambda below 1; in the other cases one look is enough."""
    return 0.0 < expect["lambda_global"] < 1.0


def over_cases(values: dict, expects: dict) -> dict:
    """Values by case; `held` is the median over those in which something holds lambda."""
    held = [value for line, value in values.items() if is_held(expects[line])]
    every = list(values.values())
    if not every:
        return dict.fromkeys(("median", "held", "p99", "max"))
    return {"median": rank(every, 0.5), "held": rank(held or every, 0.5),
            "p99": rank(every, 0.99), "max": max(every)}


def row_of(solver: str, timings: dict, counts: dict, expects: dict) -> dict:
    """All by the line of the case."""
    verdicts = {n: verdict.verdict_of(t, expects[n]) for n, t in timings.items()}
    errors = {n: verdict.error_of(t, expects[n]) for n, t in timings.items()}
    return {
        "solver": solver,
        "time_ns": over_cases({n: t.time_ns for n, t in timings.items()}, expects),
        "instructions": {**over_cases(counts, expects), "cases": len(counts)},
        "error_where_right": max((errors[n] for n in errors if verdicts[n] == verdict.RIGHT),
                                 default=0.0),
        "error_worst": max(errors.values()),
        **{kind: sum(v == kind for v in verdicts.values())
           for kind in (verdict.MISSED, verdict.WRONG, verdict.INFEASIBLE)},
        "not_largest": sum(v != verdict.RIGHT for v in verdicts.values()),
        "results": [{"line": n, "lambda": t.returned, "lambda_global": expects[n]["lambda_global"],
                     "verdict": verdicts[n], "time_ns": t.time_ns, "instructions": counts.get(n)}
                    for n, t in sorted(timings.items())],
    }


def compare(rows: list[dict]):
    """Adds what each costs as a multiple of the first."""
    base = rows[0]["time_ns"]
    for row in rows:
        row["times_global"] = {key: row["time_ns"][key] / base[key]
                               for key in ("median", "held", "max")}


def lines_of(rows: list[dict]) -> list[str]:
    cells = [[write(get(row)) for _, _, get, write in COLUMNS] for row in rows]
    widths = [max(len(name), *(len(line[i]) for line in cells))
              for i, (_, name, _, _) in enumerate(COLUMNS)]
    first = ""
    for (group, _, _, _), width in zip(COLUMNS, widths):
        # A group's heading stands over its first column and may run on over the next ones.
        first = first.ljust(len(first) if not group else position(widths, group)) + group
    lines = [first, align([name for _, name, _, _ in COLUMNS], widths)]
    return lines + [align(line, widths) for line in cells]


def position(widths: list[int], group: str) -> int:
    index = [name for name, _, _, _ in COLUMNS].index(group)
    return sum(width + 2 for width in widths[:index])


def align(cells: list[str], widths: list[int]) -> str:
    return "  ".join([cells[0].ljust(widths[0]),
                      *(cell.rjust(width) for cell, width in zip(cells[1:], widths[1:]))])
