# SPDX-License-Identifier: Apache-2.0
"""LandXML documents in the manner of five exporters, written after what their public files look like.

Each is a bag of habits: namespace, order of attributes, what stands beside the faces, how numbers and lines are
written. What a document says is the ground's, so that the right answer is known without a reader.
"""

import codecs
from dataclasses import dataclass

from ground import METRES

SECOND = ('<Surface name="EG" desc="existing"><Definition surfType="TIN"><Pnts><P id="1">0 0 0</P><P id="2">0 9 0</P>'
          '<P id="3">9 0 0</P></Pnts><Faces><F>1 2 3</F></Faces></Definition></Surface>')
BREAKLINE = ('<SourceData><Breaklines><Breakline name="kerb &amp; gutter" brkType="standard" state="proposed">'
             '<PntList3D>{n0} {e0} {z0} {n1} {e1} {z1}</PntList3D></Breakline></Breaklines>'
             '<Boundaries><Boundary bndType="outer" edgeTrim="true" area="12.5"><PntList3D>{n0} {e0} {z0} {n1} {e1} {z1}'
             '</PntList3D></Boundary></Boundaries><DataPoints><PntList3D>1 2 3 4 5 6</PntList3D></DataPoints></SourceData>')
FEATURE = '<Feature code="{code}" source="x"><Property label="style" value="&lt;none&gt; 5%"/></Feature>'


@dataclass
class Habit:
    """Of one document. What `refused` names is the element that it has to be refused with."""
    version: str = "1.2"
    unit: str = "meter"
    digits: int = 6
    exponent: bool = False
    prefix: str = ""
    crlf: bool = False
    mark: bool = False
    encoding: str = "UTF-8"
    lines: str = "\n"
    point: str = ""           # More attributes of a point.
    before_id: bool = False   # They stand before its id.
    neighbours: bool = False  # n="" of a face.
    hide_with: str = "1"
    attributes: str = ""      # More of <Surface>.
    source: str = ""
    feature: str = ""
    comment: str = ""
    other: str = ""           # Another surface, in the same group.
    groups: str = ""          # Another group.
    cdata: bool = False
    gap: str = " "
    pad: str = ""
    plus: bool = False
    choose: str = ""
    split: bool = False       # Points and faces in two lists each.
    orphans: bool = False     # Points of no face, far away.
    twice: bool = False       # Points that are there twice, in the same place.
    head: str = ""
    cg_points: bool = False   # Points by reference to <CgPoints>.
    refused: str = ""


def number(habit, value_m):
    value = value_m / METRES[habit.unit]
    text = f"{value:.12e}" if habit.exponent else f"{value:.{habit.digits}f}"
    return "+" + text if habit.plus and value >= 0 else text


def point_text(habit, ground, words):
    name, x, y, z = words
    own = f'id="{name}"'
    attributes = " ".join(filter(None, (habit.point, own) if habit.before_id else (own, habit.point)))
    if habit.cg_points:
        return f'<P {attributes} pntRef="{name}"/>'
    text = habit.pad + habit.gap.join(number(habit, v) for v in (y, x, z)) + habit.pad
    return f"<P {attributes}>" + (f"<![CDATA[{text}]]>" if habit.cdata else text) + "</P>"


def face_text(habit, ground, face, shown):
    attributes = "" if shown else f' i="{habit.hide_with}"'
    if habit.neighbours:
        attributes += ' n="' + " ".join(str(ground.noise.randint(0, 9)) for _ in range(3)) + '"'
    return f"<F{attributes}>" + habit.pad + habit.gap.join(map(str, face)) + habit.pad + "</F>"


def lists(tag, rows, habit):
    parts = (rows[:len(rows) // 2], rows[len(rows) // 2:]) if habit.split else (rows,)
    return "".join(f"<{tag}>{habit.comment}{habit.lines}" + habit.lines.join(part) + f"{habit.lines}</{tag}>"
                   for part in parts)


def surface_text(habit, ground):
    points = list(ground.points())
    rows = [point_text(habit, ground, words) for words in points]
    if habit.orphans:
        rows += [f'<P id="{points[-1][0] + 1000}">0 0 -9999</P>', f'<P id="{points[-1][0] + 2000}"></P>']
    if habit.twice:
        rows.append(rows[0])
    faces = [face_text(habit, ground, *each) for each in ground.faces()]
    first, last = points[0], points[-1]
    known = dict(n0=number(habit, first[2]), e0=number(habit, first[1]), z0=number(habit, first[3]),
                 n1=number(habit, last[2]), e1=number(habit, last[1]), z1=number(habit, last[3]))
    attributes = f'name="FG" {habit.attributes}'.strip()
    return (f"<Surface {attributes}>{habit.feature}{habit.source.format(**known)}"
            f'<Definition surfType="TIN" area2DSurf="{ground.area():.3f}" elevMax="99.5" elevMin="1">'
            + lists("Pnts", rows, habit) + lists("Faces", faces, habit) + f"{habit.feature}</Definition></Surface>")


def units_text(habit):
    system = "Metric" if habit.unit.endswith("meter") else "Imperial"
    return (f'<Units><{system} areaUnit="squareMeter" linearUnit="{habit.unit}" volumeUnit="cubicMeter" '
            f'temperatureUnit="celsius" pressureUnit="HPA" angularUnit="decimal degrees" '
            f'directionUnit="decimal degrees"></{system}></Units>')


def document(habit, ground):
    space = f"http://www.landxml.org/schema/LandXML-{habit.version}"
    name = "xmlns" + (":" + habit.prefix if habit.prefix else "")
    body = (f'<?xml version="1.0" encoding="{habit.encoding}" standalone="no"?>\n{habit.comment}\n'
            f'<LandXML {name}="{space}" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
            f'xsi:schemaLocation="{space} {space}/LandXML-{habit.version}.xsd" date="2024-05-06" time="07:08:09" '
            f'version="{habit.version}" language="English" readOnly="false">\n{units_text(habit)}\n{habit.head}'
            f'<Project name="C:\\Jobs\\17 &quot;Süd&quot;.dwg"/>\n<Application name="x" version="1"/>\n')
    if habit.cg_points:
        body += "<CgPoints>" + "".join(
            f'<CgPoint name="{n}">{number(habit, y)} {number(habit, x)} {number(habit, z)}</CgPoint>'
            for n, x, y, z in ground.points()) + "</CgPoints>\n"
    body += f"<Surfaces>{habit.feature}{surface_text(habit, ground)}{habit.other}</Surfaces>{habit.groups}\n</LandXML>\n"
    if habit.prefix:
        body = prefixed(body, habit.prefix)
    if habit.crlf:
        body = body.replace("\n", "\r\n")
    return (codecs.BOM_UTF8 if habit.mark else b"") + body.encode(habit.encoding)


def prefixed(text, prefix):
    """Every element's name, but that of comments, CDATA and the head."""
    for mark in ("</", "<"):
        parts = text.split(mark)
        text = parts[0] + "".join(
            mark + (prefix + ":" if part[:1].isalpha() else "") + part for part in parts[1:])
    return text
