# SPDX-License-Identifier: Apache-2.0
"""The reference cases as plain words for targets without a JSON reader: plain_cases.py CASES > WORDS.

A case: its id; the numbers of actuators and pumps; each actuator, pump and input in the order in which
print_bits.cpp reads them. Doubles as the 16 hexadecimal digits of their bits, the rest decimal."""

import json
import struct
import sys


def bits(number):
    return struct.pack(">d", number).hex()


def table(points):
    return [str(len(points)), *(bits(number) for point in points for number in point)]


def actuator(a):
    numbers = [a.get(key) or 0.0 for key in ("c_drain", "c_check", "bypass_open", "bypass_closed",
                                             "force_offset", "c_inflow_check")]
    return [bits(a["area_cap"]), bits(a["area_rod"]), str(a["pump"]), str(a["regeneration"]),
            *map(bits, numbers), *table(a["c_extend"]), *table(a["c_retract"])]


def pump(p):
    return [bits(p["flow"]), bits(p["leak_linear"]), bits(p["leak_quadratic"]),
            str(len(p["bypass_series"])), *map(bits, p["bypass_series"]), bits(p.get("relief") or 0.0)]


def words(case):
    machine, given = case["machine"], case["input"]
    found = [case["id"], str(len(machine["actuators"])), str(len(machine["pumps"]))]
    for a in machine["actuators"]:
        found += actuator(a)
    for p in machine["pumps"]:
        found += pump(p)
    for key in ("velocity", "p_cap", "p_rod"):
        found += map(bits, given[key])
    return found


with open(sys.argv[1], encoding="utf-8") as stream:
    for line in stream:
        print(*words(json.loads(line)))
