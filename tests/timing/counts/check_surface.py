# SPDX-License-Identifier: Apache-2.0
"""A cycle on a design of a surface of triangles costs hardly more instructions than on a list of corners.

  check_surface.py BUILD

The surface is the shipped design again, as the most heights that an application may hand over: more
than 100 000 triangles give. How many triangles there were the controller can't see.
"""

import pathlib
import statistics
import sys

import counting

MORE = 1.10
SEEDS = (1, 2)


def main() -> int:
    bench = counting.Bench(pathlib.Path(sys.argv[1]))
    scripts = [f"dozer {setup} seed={seed} cycles=3500" for setup in ("dozer", "surface") for seed in SEEDS]
    found = bench.count("cycles", scripts)
    corners, surface = ([count for counted in half for count in counted.counts]
                        for half in (found[:len(SEEDS)], found[len(SEEDS):]))
    problems = []
    for what, of in (("median", statistics.median), ("max", max)):
        share = of(surface) / of(corners)
        print(f"{bench.target} {what}: {of(corners):.0f} with corners, {of(surface):.0f} with heights, {share:.3f}")
        if not 0.5 < share <= MORE:
            problems.append(f"{what}: {share:.3f} of what corners cost, at most {MORE} are allowed")
    print("\n".join(problems))
    return 1 if problems or len(corners) != len(surface) else 0


if __name__ == "__main__":
    sys.exit(main())
