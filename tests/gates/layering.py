#!/usr/bin/env python3
"""Gate: #include points one way, app -> platform -> hal -> firmware.

firmware and hal take no header that needs an operating system or a heap, and no third party but
Eigen. The plant, which stands in for the real machine, must not even indirectly see the model
that the controller has of it: otherwise a wrong sign would cancel itself.
"""

import tree
from freestanding import ALLOWED_HEADERS, FREESTANDING
from includes import Includes

# Folder: what a file in it must not include.
FORBIDDEN = {
    "firmware/": ("hal/", "platform/", "app/", "can_dbc/", "tests/"),
    "hal/": ("platform/", "app/", "tests/"),
    "can_dbc/": ("platform/", "app/", "tests/"),
    "platform/": ("app/", "tests/"),
    "app/": ("tests/",),
    # The controller's process opens no TCP socket.
    "app/ecu/": ("app/scope/", "app/cli/"),
}
# The same through any number of headers in between.
FORBIDDEN_INDIRECTLY = {
    "app/plant/": tuple(f"firmware/{part}/" for part in (
        "hydraulics", "mcv", "kinematics", "motion", "travel", "safety")),
}


root = tree.arguments(__doc__).parse_args().root.resolve()
includes = Includes(root)

problems = []
for name, found in includes.of.items():
    for folder, forbidden in FORBIDDEN.items():
        problems += [f"{name}:{line}: {folder} must not include {header}"
                     for line, header, _ in found
                     if name.startswith(folder) and header.startswith(forbidden)]
    if name.startswith(FREESTANDING):
        problems += [f"{name}:{line}: <{header}> is not on the list of freestanding headers"
                     for line, header, quoted in found
                     if header not in ALLOWED_HEADERS and header not in includes.sources
                     and (quoted or not header.startswith("Eigen/"))]
    for folder, forbidden in FORBIDDEN_INDIRECTLY.items():
        if name.startswith(folder):
            problems += [f"{folder} must not see {header}: {chain}"
                         for header, chain in includes.reached_from(name).items()
                         if header.startswith(forbidden)]
tree.report("layering", sorted(set(problems)), sum(map(len, includes.of.values())), "includes")
