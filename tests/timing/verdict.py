# SPDX-License-Identifier: Apache-2.0
"""What is to be said about the lambda that a solver returned."""

TOLERANCE = 1e-6
# What rounding may make of a margin, as a share of the numbers it is the difference of.
MARGIN_ROUNDING = 1e-10

RIGHT, MISSED, WRONG, INFEASIBLE = "right", "missed", "wrong", "infeasible"

# Ours, and the expectation in the vectors that each has to meet.
OWN = {"global": "lambda_global", "connected": "lambda_connected",
       "algorithm1": "lambda_algorithm1"}


def holds(margin: float) -> bool:
    return margin >= -MARGIN_ROUNDING


def error_of(timing, expect: dict) -> float:
    """Distance from the largest feasible lambda; 0 for a feasible one that the scan of the vectors
    has missed."""
    wanted = expect["lambda_global"]
    if timing.returned > wanted and holds(timing.margin):
        return 0.0
    return abs(timing.returned - wanted)


def verdict_of(timing, expect: dict) -> str:
    """`missed`: a local maximum, feasible and with nothing feasible just above, but not the
    largest. `infeasible`: not even 1e-6 below. Judged by the plain circuit of tests/fuzz."""
    if timing.returned > 0.0 and not holds(timing.margin) and not holds(timing.margin_below):
        return INFEASIBLE
    if error_of(timing, expect) <= TOLERANCE:
        return RIGHT
    if timing.returned > 0.0 and not holds(timing.margin_above):
        return MISSED
    return WRONG


def own_fault(solver: str, timing, expect: dict) -> str:
    """Empty unless one of ours is not what it has to be."""
    wanted = OWN.get(solver)
    if wanted is None:
        return ""
    verdict = verdict_of(timing, expect)
    if verdict == INFEASIBLE:
        return f"lambda {timing.returned!r} is infeasible"
    met = (verdict == RIGHT if solver == "global"
           else abs(timing.returned - expect[wanted]) <= TOLERANCE)
    return "" if met else f"lambda {timing.returned!r} for {wanted} {expect[wanted]!r}"
