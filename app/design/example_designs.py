#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the example designs banked.xml, curved.xml and crest.xml, LandXML: example_designs.py FOLDER."""

import math
import pathlib
import sys
from typing import NamedTuple

EAST, NORTH, HEIGHT = 100.0, 200.0, 54.3
ACROSS = (2.0, 1.0, 0.0, -1.0, -2.0)
TEXT = """<?xml version="1.0" encoding="UTF-8"?>
<!-- {said} -->
<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2" date="2026-11-27" time="12:00:00">
  <Units>
    <Metric areaUnit="squareMeter" linearUnit="meter" volumeUnit="cubicMeter" temperatureUnit="celsius" pressureUnit="HPA"/>
  </Units>
{alignment}  <Surfaces>
    <Surface name="{name}">
      <Definition surfType="TIN">
        <Pnts>
{points}
        </Pnts>
        <Faces>
{faces}
        </Faces>
      </Definition>
    </Surface>
  </Surfaces>
</LandXML>
"""
ALIGNMENT = """  <Alignments>
    <Alignment name="way" length="{length}" staStart="0.0">
      <CoordGeom>
{pieces}
      </CoordGeom>
    </Alignment>
  </Alignments>
"""


def every_half_metre(first, last):
    return [first + 0.5 * i for i in range(round(2 * (last - first)) + 1)]


class Way(NamedTuple):
    """By the station: the middle's height and the slope across (left side up) as corners, rows of points; the
    plan's pieces as length and radius, m (to the left positive, 0: straight)."""
    said: str
    plan: list
    heights: list
    slopes: list
    stations: list


WAYS = {
    "banked": Way("""A banked way as a surface, 4 m wide, for a blade that tilts: along its middle 0.15 m deep with the left side
     8 % up, then 0.18 m with the right side 8 % up. Its start is at 100 m east and 200 m north.""",
                  [(31.0, 0.0)],
                  [(0, 0), (2, 0), (8, -0.15), (11, -0.15), (21, -0.18), (24, -0.18), (30, 0), (31, 0)],
                  [(0, 0), (2, 0), (8, 0.08), (11, 0.08), (21, -0.08), (24, -0.08), (30, 0), (31, 0)],
                  [0, *every_half_metre(2, 8), *every_half_metre(11, 21), *every_half_metre(24, 30), 31]),
    "curved": Way("""A way that curves in plan as a surface, 4 m wide, with its alignment: 14 m to the left with a radius of 20 m and the
     left side 5 % up, 12 m to the right with a radius of 15 m and the right side 5 % up, in a cut of up to 0.36 m
     that goes up and down on the curves.""",
                  [(8.0, 0.0), (14.0, 20.0), (5.0, 0.0), (12.0, -15.0), (6.0, 0.0)],
                  [(0, 0), (3, 0), (6, -0.18), (14, -0.18), (16, -0.36), (27, -0.36), (29, -0.18), (39, -0.18),
                   (42, 0), (45, 0)],
                  [(0, 0), (6, 0), (10, 0.05), (21, 0.05), (25, 0), (26, 0), (31, -0.05), (38, -0.05), (42, 0), (45, 0)],
                  every_half_metre(0, 45)),
}


def between(corners, x):
    for (x0, y0), (x1, y1) in zip(corners, corners[1:]):
        if x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return corners[-1][1]


def beside(pose, left):
    east, north, heading = pose
    return east - left * math.sin(heading), north + left * math.cos(heading), heading


def on(pose, length, radius):
    east, north, heading = pose
    if not radius:
        return east + length * math.cos(heading), north + length * math.sin(heading), heading
    centre = beside(pose, radius)
    return beside((*centre[:2], heading + length / radius), -radius)


def pose_at(plan, station):
    pose = EAST, NORTH, 0.0
    for length, radius in plan:
        pose = on(pose, min(length, station), radius)
        station -= min(length, station)
    return pose


def alignment(plan):
    pose, lines = (EAST, NORTH, 0.0), []
    for length, radius in plan:
        end = on(pose, length, radius)
        start, middle, last = (f"<{what}>{north:.6f} {east:.6f}</{what}>" for what, (east, north, _) in
                               (("Start", pose), ("Center", beside(pose, radius)), ("End", end)))
        turn = "ccw" if radius > 0 else "cw"
        lines.append(f'        <Curve rot="{turn}" crvType="arc">{start}{middle}{last}</Curve>' if radius else
                     f"        <Line>{start}{last}</Line>")
        pose = end
    return ALIGNMENT.format(length=sum(length for length, _ in plan), pieces="\n".join(lines)) if plan[1:] else ""


def points(way):
    for station in way.stations:
        pose = pose_at(way.plan, station)
        height, slope = HEIGHT + between(way.heights, station), between(way.slopes, station)
        for left in ACROSS:
            east, north, _ = beside(pose, left)
            yield f"{north:.3f} {east:.3f} {height + slope * left:.4f}"


def faces(rows):
    for row in range(rows - 1):
        for a in range(len(ACROSS) * row + 1, len(ACROSS) * (row + 1)):
            b = a + len(ACROSS)
            yield from ((a, a + 1, b), (a + 1, b + 1, b))


# Heights over a machine's ground by the reach, m; the machine stands at the start, turned by TURN.
CREST = [(2.5, -0.5), (4.2, -0.5), (4.7, -0.3), (5.3, -0.6), (9.0, 0.14)]
TURN, SKEW, BESIDE = 0.3, 0.1, (-4.0, -2.0, 0.0, 2.0, 4.0)
CREST_SAID = """Ground with a crest between two hollows, askew to the reach of an excavator at 100 m east and 200 m north that looks
     0.3 rad to the left of east."""


def crest_points():
    for reach, height in CREST:
        for left in BESIDE:
            east, north, _ = beside((*on((EAST, NORTH, TURN), reach + SKEW * left, 0.0)[:2], TURN), left)
            yield f"{north:.4f} {east:.4f} {HEIGHT + height:.4f}"


def write(name, said, track, all_points, rows):
    (pathlib.Path(sys.argv[1]) / f"{name}.xml").write_text(TEXT.format(
        said=said, name=name, alignment=track,
        points="\n".join(f'          <P id="{number}">{point}</P>' for number, point in enumerate(all_points, 1)),
        faces="\n".join(f"          <F>{a} {b} {c}</F>" for a, b, c in faces(rows))), encoding="utf-8")


for title, way in WAYS.items():
    write(title, way.said, alignment(way.plan), points(way), len(way.stations))
write("crest", CREST_SAID, "", crest_points(), len(CREST))
