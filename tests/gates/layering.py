#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Gate: #include points one way, app -> platform -> hal -> firmware.

Inside app the tool and the scope stand on reports and runs, those on the deployed process, the plant and the
machines' files; no two rooms (app/runs, firmware/mcv) include each other, however far round.

firmware and hal take no header that needs an operating system or a heap, and no third party but
Eigen. The plant, which stands in for the real machine, must not even indirectly see the model
that the controller has of it: otherwise a wrong sign would cancel itself.
"""

import re

import tree
from freestanding import ALLOWED_HEADERS, FREESTANDING
from includes import Includes
from rooms import circle, edges

# Folder: what a file in it must not include.
FORBIDDEN = {
    "firmware/": ("hal/", "platform/", "app/", "can_dbc/", "tests/"),
    "hal/": ("platform/", "app/", "tests/"),
    "can_dbc/": ("platform/", "app/", "tests/"),
    "platform/": ("app/", "tests/"),
    "app/": ("tests/",),
    # The controller's process opens no TCP socket and has no part of a simulation.
    "app/ecu/": ("app/plant/", "app/runs/", "app/reports/", "app/scope/", "app/cli/"),
    "app/plant/": ("app/machines/", "app/ecu/", "app/runs/", "app/reports/", "app/scope/", "app/cli/"),
    "app/machines/": ("app/ecu/", "app/runs/", "app/reports/", "app/scope/", "app/cli/"),
    "app/runs/": ("app/reports/", "app/scope/", "app/cli/"),
    # A station on a bus is no part of a simulation.
    "app/operate/": ("app/plant/", "app/reports/", "app/scope/", "app/cli/"),
    # A report is the scope's page with a log inside.
    "app/reports/": ("app/scope/server/", "app/scope/sim/", "app/cli/"),
    "app/scope/": ("app/cli/",),
    # The example of a machine kind stands in one folder; its parts keep to the layers all the same.
    "tests/example_kind/loader_controller": ("hal/", "platform/", "app/", "can_dbc/"),
    "tests/example_kind/loader_profile": ("hal/", "platform/", "app/", "can_dbc/"),
}
PLANTS = ("app/plant/", "tests/example_kind/loader_plant")
# What runs on a machine never sees what stands in for one.
DEPLOYED = ("app/ecu/", "app/machines/")
SIMULATED = ("app/plant/", "app/machines/simulated/")
# All that the plant may see of the core, through any number of headers in between: what a machine is, and
# the codes and values that are on the bus. Of a kind's wing these two headers.
# Of the mathematics what holds data: the linkages' triangle is a formula.
PLANT_SEES = ("firmware/core/", "firmware/machine/", "firmware/numeric/constants.hpp",
              "firmware/numeric/monotone_table.hpp", "firmware/signals/")
PLANT_SEES_OF_A_WING = ("{0}/{0}_profile.hpp", "{0}/{0}_signals.hpp")

arguments = tree.arguments(__doc__).parse_args()
includes = Includes(arguments.root.resolve(), arguments.generated)

# A folder of the core with a controller is a machine kind's wing. It never sees another one, and what is
# common sees none.
KINDS = sorted({match[1] for name in includes.sources
                if (match := re.fullmatch(r"firmware/(\w+)/\1_controller\.hpp", name))})
WINGS = tuple(f"firmware/{kind}/" for kind in KINDS)
PLANT_SEES += tuple("firmware/" + header.format(kind)
                    for kind in KINDS for header in PLANT_SEES_OF_A_WING)

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
    if name.startswith(DEPLOYED) and not name.startswith(SIMULATED):
        problems += [f"{name} is deployed and must not see {header}: {chain}"
                     for header, chain in includes.reached_from(name).items()
                     if header.startswith(SIMULATED)]
    if plant := next((folder for folder in PLANTS if name.startswith(folder)), ""):
        problems += [f"{plant} must not see {header}: {chain}"
                     for header, chain in includes.reached_from(name).items()
                     if header.startswith("firmware/") and not header.startswith(PLANT_SEES)]
    if name.startswith("firmware/"):
        own = next((wing for wing in WINGS if name.startswith(wing)), "")
        problems += [f"{own or 'a common room'} must not see {header}: {chain}"
                     for header, chain in includes.reached_from(name).items()
                     if header.startswith(WINGS) and not (own and header.startswith(own))]
problems += [f"{name}:{line}: nobody looks into {what}: include a header by its name"
             for name, line, what in includes.hidden()]
between = edges(includes)
if around := circle({name: to for name, to in between.items() if not name.startswith("tests")}):
    problems.append(f"a circle of rooms: {' -> '.join(around)}: " + "; ".join(
        between[here][there] for here, there in zip(around, around[1:])))
tree.report("layering", sorted(set(problems)), sum(map(len, includes.of.values())), "includes")
