"""`graben solve` on random valves against plain bisection: check_topologies.py GRABEN [CASES].

1 to 6 spools on 1 to 3 pumps, regeneration on either side or none, with and without relief valve. The
reference below is written from the equations of Kim et al. alone and takes nothing from the core: no
Newton, no closed form of (18), one halving at a time."""

import json
import math
import random
import subprocess
import sys

CASES = 200


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
            load = actuator["area_cap"] * self.input["p_cap"][i] - actuator["area_rod"] * self.input["p_rod"][i]
            force[i] = (self.inlet[i] * pressure - self.outlet[i] * result["p_out"][i]
                        - math.copysign(load, load * self.velocity[i]))
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


def log_uniform(draw, least, most):
    return math.exp(draw.uniform(math.log(least), math.log(most)))


def random_table(draw):
    inner = draw.choice([0, 1, 3, 7, 30])
    columns = [[0.0, *sorted(draw.uniform(0.01, 0.99) for _ in range(inner)), 1.0] for _ in range(2)]
    x_m, c_m = draw.uniform(0.005, 0.02), log_uniform(draw, 3e-4, 5e-3)
    return [[x * x_m, c * c_m] for x, c in zip(*columns)]


def random_case(seed):
    draw = random.Random(seed)
    pumps = draw.randint(1, 3)
    actuators = []
    for _ in range(draw.randint(1, 6)):
        cap = log_uniform(draw, 0.004, 0.03)
        drain = log_uniform(draw, 5e-7, 3e-6)
        actuators.append({
            "area_cap": cap, "area_rod": cap * draw.uniform(0.4, 1.1), "pump": draw.randrange(pumps),
            "regeneration": draw.choice([-1, 0, 1]), "c_drain": drain,
            "c_check": drain * log_uniform(draw, 1.001, 4.0), "bypass_open": log_uniform(draw, 2e-6, 8e-6),
            "bypass_closed": log_uniform(draw, 1e-7, 1e-6), "force_offset": draw.choice([0.0, 500.0, 2000.0]),
            "c_extend": random_table(draw), "c_retract": random_table(draw)})
    lines = []
    for _ in range(pumps):
        lines.append({"flow": draw.choice([0.0] + 9 * [log_uniform(draw, 5e-4, 8e-3)]),
                      "leak_linear": draw.choice([0.0, log_uniform(draw, 1e-13, 1e-11)]),
                      "leak_quadratic": draw.choice([0.0, log_uniform(draw, 1e-21, 1e-18)]),
                      "bypass_series": [log_uniform(draw, 2e-6, 6e-6) for _ in range(draw.randint(1, 3))]})
        if draw.random() < 0.5:
            lines[-1]["relief"] = log_uniform(draw, 5e6, 4e7)
    pressure = lambda: draw.uniform(0.0, 1.2e7) * draw.choice([1.0, 0.2])
    count = range(len(actuators))
    return {"id": seed, "machine": {"actuators": actuators, "pumps": lines},
            "input": {"velocity": [draw.choice([0.0] + 5 * [draw.uniform(-0.5, 0.5)]) for _ in count],
                      "p_cap": [pressure() for _ in count], "p_rod": [pressure() for _ in count]}}


def differences(case, got):
    lam, limit, wanted = algorithm1(case)
    found = []
    if abs(got["lambda"] - lam) > 2e-7:
        found.append(f"lambda {got['lambda']} for {lam}")
    if got["limit"] != limit:
        found.append(f"limit '{got['limit']}' for '{limit}'")
    if wanted is None:
        return found + (["spool"] if any(got["spool"]) else [])
    for i, actuator in enumerate(case["machine"]["actuators"]):
        x_m = actuator["c_extend" if case["input"]["velocity"][i] > 0 else "c_retract"][-1][0]
        if abs(got["spool"][i] - wanted["spool"][i]) > 1e-6 * x_m:
            found.append(f"spool[{i}] {got['spool'][i]} for {wanted['spool'][i]}")
    for key in ("pump_pressure", "p_out"):
        for actual, right in zip(got[key], wanted[key]):
            # Below a pascal the flow balance's own rounding rules.
            if abs(actual - right) > 1e-6 * max(abs(right), 1.0):
                found.append(f"{key} {actual} for {right}")
    return found + (["regenerating"] if got["regenerating"] != wanted["regenerating"] else [])


def main():
    graben = sys.argv[1]
    cases = [random_case(seed) for seed in range(int(sys.argv[2]) if len(sys.argv) > 2 else CASES)]
    done = subprocess.run([graben, "solve", "--policy", "algorithm1"], input="".join(json.dumps(c) + "\n" for c in cases),
                          capture_output=True, text=True, timeout=120)
    results = [json.loads(line) for line in done.stdout.splitlines()]
    assert done.returncode == 0 and len(results) == len(cases), done.stderr
    wrong = 0
    for case, result in zip(cases, results):
        found = differences(case, result)
        if found:
            wrong += 1
            print(f"seed {case['id']}: " + "; ".join(found))
    held = sum(1 for result in results if result["limit"])
    print(f"{len(cases)} cases, {held} held by a limit, {wrong} wrong")
    # Cases that nothing holds would compare little.
    return 1 if wrong or held < len(cases) // 4 else 0


if __name__ == "__main__":
    sys.exit(main())
