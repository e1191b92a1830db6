# SPDX-License-Identifier: Apache-2.0
"""The valve of Kim et al. by plain bisection, for checking `graben solve`: written from the equations
alone, it takes nothing from the core: no Newton, no closed form of (18), one halving at a time."""

import math


def bisect(rises_until, low, high, steps=200):
    """Where `rises_until` turns from True to False."""
    for _ in range(steps):
        middle = 0.5 * (low + high)
        if rises_until(middle):
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def out_pressure(q_out, pump_pressure, actuator):
    """P_out of (17): what is drained and regenerated is what comes out. And whether the valve opens."""
    drain, check = actuator["c_drain"], actuator["c_check"]
    alone = (q_out / drain) ** 2
    if pump_pressure >= alone:
        return alone, False
    root = bisect(lambda y: q_out - drain * y > check * math.sqrt(max(0.0, y * y - pump_pressure)),
                  math.sqrt(pump_pressure), q_out / drain)
    return root * root, True


class Circuit:
    def __init__(self, case, lam):
        self.actuators, self.pumps = case["machine"]["actuators"], case["machine"]["pumps"]
        self.velocity, self.input = case["input"]["velocity"], case["input"]
        self.lam = lam
        both = [(a["area_cap"], a["area_rod"]) for a in self.actuators]
        self.inlet = [(cap if v > 0 else rod) for (cap, rod), v in zip(both, self.velocity)]
        self.outlet = [(rod if v > 0 else cap) for (cap, rod), v in zip(both, self.velocity)]
        self.in_play = [v != 0 and a["regeneration"] == (1 if v > 0 else -1)
                        for a, v in zip(self.actuators, self.velocity)]

    def q_in(self, i):
        return self.inlet[i] * self.lam * abs(self.velocity[i])

    def q_out(self, i):
        return self.outlet[i] * self.lam * abs(self.velocity[i])

    def load(self, i):
        """F_L sgn(x) of (36)."""
        actuator = self.actuators[i]
        load = (actuator["area_cap"] * self.input["p_cap"][i]
                - actuator["area_rod"] * self.input["p_rod"][i])
        return math.copysign(load, load * self.velocity[i])

    def spools_of(self, pump):
        return [i for i, a in enumerate(self.actuators) if a["pump"] == pump]

    def left_over(self, j, pressure):
        """(27), (28): right side less left side."""
        pump = self.pumps[j]
        resistance = sum(1 / c ** 2 for c in pump["bypass_series"])
        left = pump["flow"] - pump["leak_linear"] * pressure - pump["leak_quadratic"] * pressure ** 2
        for i in self.spools_of(j):
            actuator = self.actuators[i]
            closed = self.velocity[i] != 0
            resistance += 1 / actuator["bypass_closed" if closed else "bypass_open"] ** 2
            left -= self.q_in(i)
            if self.in_play[i]:
                drained = actuator["c_drain"] * math.sqrt(out_pressure(self.q_out(i), pressure, actuator)[0])
                left += self.q_out(i) - drained
        return left - math.sqrt(pressure / resistance)

    def pump_pressure(self, j):
        """None where (29), (30) fails."""
        if self.left_over(j, 0.0) < 0:
            return None
        relief = self.pumps[j].get("relief")
        if relief is not None and self.left_over(j, relief) >= 0:
            return relief
        high = 1e5
        while self.left_over(j, high) > 0:
            high *= 4
        return bisect(lambda p: self.left_over(j, p) > 0, 0.0, high, 110)

    def solve(self):
        """(limit, result): the first constraint that fails, or what the circuit does."""
        pressures = [self.pump_pressure(j) for j in range(len(self.pumps))]
        if None in pressures:
            return f"pump_flow[{pressures.index(None)}]", None
        count = len(self.actuators)
        result = {"pump_pressure": pressures, "p_out": [0.0] * count, "spool": [0.0] * count,
                  "regenerating": [False] * count}
        force = [0.0] * count
        for i, actuator in enumerate(self.actuators):
            if self.velocity[i] == 0:
                continue
            pressure = pressures[actuator["pump"]]
            if self.in_play[i]:
                result["p_out"][i], result["regenerating"][i] = \
                    out_pressure(self.q_out(i), pressure, actuator)
            force[i] = (self.inlet[i] * pressure - self.outlet[i] * result["p_out"][i]
                        - self.load(i))
            if force[i] < actuator["force_offset"]:
                return f"back_flow[{i}]", None
        for i, actuator in enumerate(self.actuators):
            if self.velocity[i] == 0:
                continue
            table = actuator["c_extend" if self.velocity[i] > 0 else "c_retract"]
            wanted = self.lam * abs(self.velocity[i]) / math.sqrt(force[i]) if force[i] > 0 else math.inf
            if wanted > table[-1][1]:
                return f"spool_travel[{i}]", None
            for (x0, c0), (x1, c1) in zip(table, table[1:]):
                if wanted <= c1:
                    opening = x0 + (wanted - c0) / (c1 - c0) * (x1 - x0)
                    result["spool"][i] = math.copysign(opening, self.velocity[i])
                    break
        return "", result


def algorithm1(case):
    """(lambda, limit, result), line by line as the paper has it."""
    limit, result = Circuit(case, 1.0).solve()
    if not limit:
        return 1.0, "", result
    lam, step, best, failing = 1.0, 1.0, (0.0, None), limit
    while step > 1e-7:
        step *= 0.5
        lam += -step if limit else step
        limit, result = Circuit(case, lam).solve()
        if limit:
            failing = limit
        else:
            best = (lam, result)
    return best[0], failing, best[1]
