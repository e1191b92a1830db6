# SPDX-License-Identifier: Apache-2.0
"""Machines of other sizes, from a shipped excavator's two files: what a machine of the same make and
another mass would have, to a tenth or two of what is on the market.

With r the ratio of the masses: lengths r^(1/3), as bodies of one shape; cylinder areas r, since all
work at the same pressures and have to carry a weight of r on arms of one shape; flows r^0.85, as the
classes from 2 to 60 t have them. The rest follows: volumes of oil are areas times lengths, inertias
masses times lengths squared; a link on its oil then swings r^(1/6) more slowly, and with it stands what the controller
has to know of that. What is of the electronics, the oil or the rest of the controller stays."""

import tomllib

LENGTH, AREA, FLOW, MASS = 1 / 3, 1.0, 0.85, 1.0
DIAMETER, VOLUME, INERTIA = AREA / 2, AREA + LENGTH, MASS + 2 * LENGTH
# A larger platform turns and starts more slowly, a smaller one no faster.
CALM, STARTS = -0.25, -LENGTH
PERIOD = (MASS - AREA + LENGTH) / 2

# The last parts of a key's path, the longest that fits; numbers below it are scaled by the power.
RULES = {
    "body.boom_foot": LENGTH, "counterweight.radius": LENGTH, "counterweight.width": LENGTH,
    "counterweight.corner": LENGTH, "counterweight.height": LENGTH,
    "length": LENGTH, "width": LENGTH, "bend": LENGTH, "radius": LENGTH, "floor": LENGTH, "capacity": MASS,
    "cylinder.bore": DIAMETER, "cylinder.rod": DIAMETER, "closed_length": LENGTH, "stroke": LENGTH,
    "cylinder.AB": LENGTH, "cylinder.BC": LENGTH, "cylinder.base": LENGTH, "cylinder.eye": LENGTH,
    "rocker_pivot": LENGTH, "rocker": LENGTH, "coupler": LENGTH, "lug": LENGTH,
    "swing.speed_max": CALM, "swing.acceleration_max": STARTS, "swing.displacement": VOLUME,
    "swing.inertia": INERTIA, "swing.lever": LENGTH, "swing.coulomb": VOLUME, "swing.viscous": VOLUME,
    "swing.dead_volume": VOLUME, "swing.leak": FLOW,
    "pump.displacement": FLOW, "pump.leak_linear": FLOW, "pump.leak_quadratic": FLOW, "bypass_series": FLOW,
    "valve.section_flow": FLOW, "valve.boom": FLOW, "valve.arm": FLOW, "valve.bucket": FLOW,
    "valve.swing": FLOW, "bypass.open": FLOW, "bypass.closed": FLOW, "c_drain": FLOW, "c_check": FLOW,
    "valve.force_offset": AREA, "valve.dead_volume": VOLUME, "valve.line_volume": VOLUME,
    "control.convergence_length": LENGTH, "control.swing_lead": PERIOD, "control.swing_servo_gain": -PERIOD,
    "control.servo_frequency": -PERIOD, "line.move_slow_error": LENGTH, "control.lambda_rise_reserve": AREA,
    "oil.dead_volume": VOLUME, "mass": MASS, "inertia": INERTIA, "mass_centre": LENGTH,
    "friction.coulomb": AREA, "friction.viscous": AREA + LENGTH,
    "path.x": LENGTH, "path.y": LENGTH, "path.corner_radius": LENGTH, "task.pump_power": FLOW,
    "position": LENGTH, "soil.ground": LENGTH, "soil.bias": 2 * LENGTH, "obstacle.stiffness": AREA,
    "obstacle.size": LENGTH, "air.payload": MASS, "air.payload_centre": LENGTH,
}
# A smaller machine has the valve and the lags of the larger one, and is led no faster.
OF_LARGER_ONES = {"swing.speed_max", "swing.acceleration_max", "control.swing_lead", "control.swing_servo_gain",
                  "control.servo_frequency"}


def power_of(path):
    for first in range(len(path)):
        rule = RULES.get(".".join(path[first:]))
        if rule is not None:
            return rule
    return None


def scaled(value, ratio, path=()):
    if isinstance(value, dict):
        return {key: scaled(part, ratio, path + (key,)) for key, part in value.items()}
    # x, y of the plane of the links and an attitude; and the attitudes of a path over its x.
    if path[-2:] == ("air", "start"):
        return [value[0] * ratio ** LENGTH, value[1] * ratio ** LENGTH, value[2]]
    if path[-2:] == ("path", "attitude"):
        return [[x * ratio ** LENGTH, angle] for x, angle in value]
    if isinstance(value, list):
        return [scaled(part, ratio, path) for part in value]
    power = next((power for end in range(len(path), 0, -1) if (power := power_of(path[:end])) is not None), None)
    if power is None or isinstance(value, (str, bool)):
        return value
    return value if ratio < 1.0 and ".".join(path[-2:]) in OF_LARGER_ONES else value * ratio ** power


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(part)}" for key, part in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else repr(value)


def put(document, target):
    with open(target, "w", encoding="utf-8") as stream:
        # What has no section of its own stands before them.
        plain = {key: value for key, value in document.items() if key in ("kind", "repeat", "start")}
        stream.write("".join(f"{key} = {toml(value)}\n" for key, value in plain.items()))
        for key, value in document.items():
            header = f"[[{key}]]" if isinstance(value, list) else f"[{key}]"
            for table in value if isinstance(value, list) else [] if key in plain else [value]:
                stream.write(f"{header}\n" + "".join(f"{k} = {toml(v)}\n" for k, v in table.items()))


def write(source, ratio, target):
    """`target` is `source`, a TOML file, of a machine of `ratio` times the mass."""
    with open(source, "rb") as stream:
        put(scaled(tomllib.load(stream), ratio), target)


def task(source, ratio, target, slower=1.0):
    """A task of places that scale with the machine; its speeds and paces times `slower`."""
    with open(source, "rb") as stream:
        document = tomllib.load(stream)
    def of(value, key=""):
        if isinstance(value, dict):
            return {name: of(part, name) for name, part in value.items()}
        if isinstance(value, list):
            return [of(part, key) for part in value]
        if key in ("position", "through", "height", "clearance"):
            return value * ratio ** LENGTH if key != "clearance" else max(0.03, value * ratio ** LENGTH)
        return value * slower if key in ("speed", "pace") else value
    put(of(document), target)
