# SPDX-License-Identifier: Apache-2.0
"""The dearest way through a function, by enumerating paths implicitly: how often each edge is taken is a whole
number, what flows into a block flows out of it, a loop goes round as often as it may. GLPK finds the most."""

import functools
import pathlib
import re
import subprocess
import tempfile

from listing import Refusal


def edges_of(graph, leaving):
    """[(from, to)] that can be taken; from nowhere to the entry, from where the function ends to nowhere."""
    edges = [(None, graph.entry)]
    for at in graph.order:
        if at not in leaving:
            continue
        for (to, _, _), state in zip(graph.blocks[at].successors, leaving[at]):
            if state is not None and (at, to) not in edges:
                edges.append((at, to))
        if graph.blocks[at].leaves:
            edges.append((at, None))
    return edges


def constraints(graph, edges, turns, bodies, calls):
    """([(factor by edge, "= 0")], edges into each block). `turns`: how often a loop goes round again at most,
    by header; `bodies`: how often its ends are reached each time; `calls`: how often those of several loops are in all of a call."""
    into, out = {}, {}
    for n, (start, end) in enumerate(edges):
        out.setdefault(start, []).append(n)
        into.setdefault(end, []).append(n)
    rows = [({0: 1}, "= 1")]
    for at in [at for at in graph.order if at in into or at in out]:
        rows.append((balance(into.get(at, ()), out.get(at, ()), 1), "= 0"))
    for header, loop in graph.loops.items():
        entering = [n for n in into.get(header, []) if edges[n][0] not in loop.blocks]
        again = [n for n in into.get(header, []) if edges[n][0] in loop.blocks]
        if header in bodies:
            ends = [n for latch in loop.latches for n in out.get(latch, [])]
            rows.append((balance(ends, entering, bodies[header]), "<= 0"))
        if header in turns:
            rows.append((balance(again, entering, turns[header]), "<= 0"))
    for (_, count), headers in calls.items():
        ends = [n for header in headers for latch in graph.loops[header].latches for n in out.get(latch, [])]
        rows.append((balance(ends, [0], count), "<= 0"))
    return [row for row in rows if any(row[0].values())], into


def balance(these, less, factor):
    row = {}
    for n in these:
        row[n] = row.get(n, 0) + 1
    for n in less:
        row[n] = row.get(n, 0) - factor
    return row


def words(row):
    parts = [f"{'-' if factor < 0 else '+'} {abs(factor)} x{n}" for n, factor in row.items() if factor]
    return "\n ".join(" ".join(parts[n:n + 12]) for n in range(0, len(parts), 12))


def dearest(graph, leaving, turns, bodies, calls, cost):
    """(most, executions by block)"""
    edges = edges_of(graph, leaving)
    if not graph.loops:
        return longest(graph, edges, cost)
    rows, into = constraints(graph, edges, turns, bodies, calls)
    goal = {n: cost[at] for at, numbers in into.items() if at is not None for n in numbers}
    text = f"Maximize\n goal: {words(goal)}\nSubject To\n"
    text += "".join(f" c{n}: {words(row)} {end}\n" for n, (row, end) in enumerate(rows))
    text += "Generals\n" + "".join(f" x{n}\n" for n in range(len(edges))) + "End\n"
    counts, most = solve(text, graph.image.word(graph.entry))
    times = {at: sum(counts.get(n, 0) for n in numbers) for at, numbers in into.items() if at is not None}
    return most, times


def longest(graph, edges, cost):
    """Without loops no program is needed."""
    after = {}
    for start, end in edges:
        after.setdefault(start, []).append(end)
    most = {None: (0, None)}
    for at in reversed(graph.order):
        if at in after:
            best = max(after[at], key=lambda to: most[to][0] if to in most else -1)
            most[at] = (cost[at] + most[best][0], best) if best in most else (cost[at], None)
        else:
            most[at] = (cost[at], None)
    times, at = {}, graph.entry
    while at is not None:
        times[at], at = 1, most[at][1]
    return most[graph.entry][0], times


@functools.lru_cache(maxsize=None)
def solve(text, name):
    """Of one machine many functions cost what they cost of another."""
    with tempfile.TemporaryDirectory(prefix="graben-bound-") as folder:
        problem, answer = pathlib.Path(folder, "problem.lp"), pathlib.Path(folder, "answer.txt")
        problem.write_text(text, "utf-8")
        done = subprocess.run(["glpsol", "--lp", problem, "-w", answer], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode != 0 or not answer.exists():
            raise Refusal(f"glpsol: {done.stdout[-300:]}")
        found = answer.read_text("utf-8")
    status = re.search(r"^s mip \d+ \d+ (\w) (\S+)$", found, re.M)
    if not status or status[1] != "o":
        raise Refusal(f"{name}: no longest path: {done.stdout[-200:]}")
    return columns(text, found), round(float(status[2]))


def columns(text, found):
    order = list(dict.fromkeys(re.findall(r"\bx(\d+)\b", text)))
    values = [float(value) for value in re.findall(r"^j \d+ (\S+)$", found, re.M)]
    return {int(name): round(value) for name, value in zip(order, values)}
