# SPDX-License-Identifier: Apache-2.0
"""`graben solve` on pumps that set their own swash, against plain physics: check_pump_kinds.py GRABEN.

Random valves without regeneration, each drive with two metering edges and two chambers. With the spools that
the solution says, bisection finds at which pressure the pump settles and how fast each drive then goes; that
has to be lambda times what was wanted. And lambda is the largest one for which there are such spools, each
found by bisection with the bypass as it is at that spool. Nothing of the core is used: no c_L but as input, no
margin's force, no closed bypass."""

import json
import math
import random
import subprocess
import sys

CASES = 15
TRAVEL = 0.01
RELIEF = 35e6


def bisect(holds, low, high, steps=80):
    """The largest value between the two up to which `holds` is true."""
    for _ in range(steps):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


class Drive:
    """One way through one valve: areas, edges' coefficients at full opening, load against the motion."""

    def __init__(self, draw, wanted, helped):
        self.cap, self.rod = draw.uniform(0.008, 0.025), draw.uniform(0.005, 0.012)
        self.edge = {way: (draw.uniform(1e-6, 5e-6), draw.uniform(1e-6, 5e-6)) for way in (1, -1)}
        self.wanted = wanted * draw.choice((1, -1))
        self.p_cap, self.p_rod = draw.uniform(0, 1e7), draw.uniform(0, 1e7)
        way = 1 if self.wanted > 0 else -1
        a, b = (self.cap, self.rod) if way > 0 else (self.rod, self.cap)
        load = way * (self.cap * self.p_cap - self.rod * self.p_rod)
        if helped != (load < 0):
            self.p_cap, self.p_rod = (0.0, self.p_rod) if (way > 0) == helped else (self.p_cap, 0.0)
            load = way * (self.cap * self.p_cap - self.rod * self.p_rod)
        self.inlet, self.outlet, self.load = a, b, load
        self.k_in, self.k_out = self.edge[way]

    def fast(self, opening, line, margin=math.inf):
        """Speed at a line's pressure; over the metering edge there is at most the margin."""
        let_in = self.k_in * opening * math.sqrt(min(margin, line))

        def pushes(v):
            # More than the edge lets in leaves the chamber dry.
            fed = max(0.0, line - (v * self.inlet / (self.k_in * opening)) ** 2) if v * self.inlet <= let_in else 0.0
            return self.inlet * fed - self.outlet * (v * self.outlet / (self.k_out * opening)) ** 2 > self.load
        return bisect(pushes, 0.0, 20.0)

    def fed(self, opening, v):
        """Pressure that the fed chamber needs."""
        return (self.load + self.outlet * (v * self.outlet / (self.k_out * opening)) ** 2) / self.inlet

    def c_full(self, way):
        a, b = (self.cap, self.rod) if way > 0 else (self.rod, self.cap)
        k_in, k_out = self.edge[way]
        return 1 / math.sqrt(a ** 3 / k_in ** 2 + b ** 3 / k_out ** 2), \
            (b ** 3 / k_out ** 2) / (a ** 3 / k_in ** 2 + b ** 3 / k_out ** 2)

    def json(self, closes_at):
        (extend, share), (retract, other) = self.c_full(1), self.c_full(-1)
        return {"area_cap": self.cap, "area_rod": self.rod, "pump": 0, "regeneration": 0, "bypass_open": 1.5e-6,
                "bypass_closed": 1e-9, "force_offset": 0.0, "outlet_share": [share, other],
                "bypass_closes_at": closes_at, "c_extend": [[0, 0], [TRAVEL, extend]],
                "c_retract": [[0, 0], [TRAVEL, retract]]}


class LoadSensing:
    tolerance = 1e-4

    def __init__(self, draw, compensated):
        self.margin, self.compensated = draw.uniform(1e6, 3e6), compensated

    def json(self):
        return {"load_sensing": {"margin": self.margin, "compensated": int(self.compensated)}}

    def speeds(self, drives, openings, flow):
        """Speeds and the line's pressure with these spools, the pump not at its end."""
        margin = self.margin if self.compensated else math.inf

        def below(line):  # True while the line is less than the margin above the heaviest load
            return line - self.margin < max(max(0.0, d.fed(u, d.fast(u, line, margin))) for d, u in zip(drives, openings))
        line = max(self.margin, bisect(below, self.margin, RELIEF))
        return [d.fast(u, line, margin) for d, u in zip(drives, openings)], line

    def can(self, drives, lam, flow):
        """Spools for lambda times what is wanted, at the least pressure that has them all; None without."""
        margin = self.margin if self.compensated else math.inf
        if lam * sum(d.inlet * abs(d.wanted) for d in drives) > flow:
            return False
        line = RELIEF if all(d.fast(1.0, RELIEF, margin) >= lam * abs(d.wanted) for d in drives) else None
        if line is None:
            return False

        def too_little(pressure):
            for d in drives:
                u = bisect(lambda x, d=d: d.fast(x, pressure, margin) < lam * abs(d.wanted), 0.0, 1.0, 60)
                v = lam * abs(d.wanted)
                if pressure < RELIEF and pressure - self.margin < d.fed(max(u, 1e-9), v) * (1 - 1e-9):
                    return True
            return False
        line = bisect(too_little, self.margin, RELIEF)
        return all(d.fast(1.0, line * (1 + 1e-9), margin) >= lam * abs(d.wanted) * (1 - 1e-7) for d in drives)


class NegativeFlow:
    tolerance = 2e-3
    compensated = False

    def __init__(self, draw):
        self.full, self.least_pa = draw.uniform(0.3e6, 1e6), draw.uniform(2e6, 4e6)
        self.least, self.orifice = draw.uniform(0.05, 0.3), draw.uniform(2.5e-7, 5e-7)
        self.closes_at = draw.uniform(0.2, 0.8)

    def json(self):
        return {"negative_flow": {"pressure": [self.full, self.least_pa], "least_swash": self.least}}

    def left(self, drives, openings, speeds, line, flow):
        resistance = 1 / 4.5e-6 ** 2 + 1 / self.orifice ** 2
        for u in openings:
            share = min(1.0, u / self.closes_at)
            resistance += 1 / (1.5e-6 + share * (1e-9 - 1.5e-6)) ** 2
        past = math.sqrt(line / resistance)
        felt = (past / self.orifice) ** 2
        gone = min(1.0, max(0.0, (felt - self.full) / (self.least_pa - self.full)))
        return flow * (1 - gone * (1 - self.least)) - past - sum(d.inlet * v for d, v in zip(drives, speeds))

    def speeds(self, drives, openings, flow):
        def more(line):
            speeds = [d.fast(u, line) for d, u in zip(drives, openings)]
            return self.left(drives, openings, speeds, line, flow) > 0
        line = bisect(more, 0.0, RELIEF)
        return [d.fast(u, line) for d, u in zip(drives, openings)], line

    def can(self, drives, lam, flow):
        speeds = [lam * abs(d.wanted) for d in drives]

        def openings_at(line):
            return [bisect(lambda x, d=d, v=v: d.fast(x, line) < v, 0.0, 1.0, 60) for d, v in zip(drives, speeds)]

        def enough(line):
            return all(d.fast(1.0, line) >= v for d, v in zip(drives, speeds))
        if not enough(RELIEF):
            return False
        least = bisect(lambda line: not enough(line), 0.0, RELIEF) * (1 + 1e-9)
        return self.left(drives, openings_at(least), speeds, least, flow) >= 0


def cases():
    draw = random.Random(5)
    for n in range(CASES):
        for kind in ("compensated", "plain", "negative"):
            pump = NegativeFlow(draw) if kind == "negative" else LoadSensing(draw, kind == "compensated")
            # A load that helps runs a chamber dry: only where the others do not see its flow.
            drives = [Drive(draw, draw.uniform(0.05, 0.6), kind == "compensated" and n % 3 == 0 and i == 0)
                      for i in range(2)]
            flow = draw.uniform(1e-3, 6e-3)
            closes_at = pump.closes_at if kind == "negative" else 0.5
            machine = {"actuators": [d.json(closes_at) for d in drives],
                       "pumps": [{"flow": flow, "leak_linear": 0.0, "leak_quadratic": 0.0, "relief": RELIEF,
                                  "bypass_series": [4.5e-6, getattr(pump, "orifice", 1.0)], **pump.json()}]}
            if kind != "negative":
                for actuator in machine["actuators"]:
                    actuator["bypass_open"] = actuator["bypass_closed"] = 1e-12
            yield f"{kind} {n}", pump, drives, flow, {
                "id": f"{kind} {n}", "machine": machine,
                "input": {"velocity": [d.wanted for d in drives], "p_cap": [d.p_cap for d in drives],
                          "p_rod": [d.p_rod for d in drives]}}


def problems(pump, drives, flow, result):
    lam = result["lambda"]
    if result["status"] == "infeasible" or lam == 0.0:
        return ["stands, though it can move"] if pump.can(drives, 1e-3, flow) else []
    found = []
    openings = [abs(x) / TRAVEL for x in result["spool"]]
    if lam * sum(d.inlet * abs(d.wanted) for d in drives) > 0.99 * flow:
        speeds, line = [lam * abs(d.wanted) for d in drives], result["pump_pressure"][0]  # A hair decides.
    else:
        speeds, line = pump.speeds(drives, openings, flow)
    for i, (speed, drive) in enumerate(zip(speeds, drives)):
        if not abs(speed / (lam * abs(drive.wanted)) - 1) < 1e-3:
            found.append(f"drive {i} goes {speed:.6f} for {lam * abs(drive.wanted):.6f} m/s")
    if not abs(result["pump_pressure"][0] / line - 1) < 2e-3:
        found.append(f"line at {line:.0f} for {result['pump_pressure'][0]:.0f} Pa")
    if not pump.can(drives, lam * (1 - pump.tolerance), flow):
        found.append(f"lambda {lam} is too much")
    # A load that helps may run its chamber dry and go faster than it is fed: that is not asked for.
    if lam < 1.0 and all(d.load >= 0 for d in drives) and pump.can(drives, min(1.0, lam * (1 + pump.tolerance)), flow):
        found.append(f"lambda {lam} is too little")
    return found


def main():
    graben = sys.argv[1]
    drawn = list(cases())
    text = "\n".join(json.dumps(case) for *_, case in drawn)
    done = subprocess.run([graben, "solve"], input=text, capture_output=True, text=True)
    results = [json.loads(line) for line in done.stdout.splitlines()]
    wrong, moved, held = 0, 0, 0
    if done.returncode != 0 or len(results) != len(drawn):
        print(f"status {done.returncode}, {len(results)} results for {len(drawn)} cases\n{done.stderr}")
        return 1
    for (name, pump, drives, flow, _), result in zip(drawn, results):
        found = problems(pump, drives, flow, result)
        moved += result["lambda"] > 0
        held += 0 < result["lambda"] < 1
        if found:
            wrong += 1
            print(f"{name}, lambda {result['lambda']:.6f}, {result['limit']}: " + "; ".join(found))
    print(f"{len(drawn)} cases, {moved} move, {held} of them slower than wanted, {wrong} wrong")
    return 1 if wrong or held < len(drawn) // 4 else 0


if __name__ == "__main__":
    sys.exit(main())
