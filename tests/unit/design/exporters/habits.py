# SPDX-License-Identifier: Apache-2.0
"""What each exporter does that others do not: 25 documents of each, drawn from its habits."""

import random
from dataclasses import replace

from documents import BREAKLINE, FEATURE, SECOND, Habit
from ground import drawn

EMPTY = '<Surface name="empty"><Definition surfType="TIN"><Pnts></Pnts><Faces></Faces></Definition></Surface>'
NO_DEFINITION = '<Surface name="raw"><SourceData><DataPoints><PntList3D>1 2 3</PntList3D></DataPoints></SourceData></Surface>'
GROUP = f'<Surfaces name="existing">{SECOND}</Surfaces>'
ALIGNMENT = ('<Alignments name=""><Alignment name="CL" length="30" staStart="100"><CoordGeom><Spiral length="30"/></CoordGeom>'
             '<StaEquation staAhead="0" staBack="110" staInternal="110"/></Alignment></Alignments>')
COMMENT = "<!-- <P id='1'>9 9 9</P> exported & checked -->"


def civil_3d(noise):
    return Habit(version=noise.choice(("1.0", "1.1", "1.2")), unit=noise.choice(("foot", "USSurveyFoot", "meter")),
                 digits=noise.choice((8, 12)), neighbours=True, lines="\n      ", attributes='desc="Finished grade"',
                 source=noise.choice(("", BREAKLINE)), feature=noise.choice(("", FEATURE.replace("{code}", "C3D"))),
                 orphans=noise.random() < 0.3, hide_with="1", groups=noise.choice(("", ALIGNMENT)))


def business_center(noise):
    return Habit(version="1.2", unit=noise.choice(("meter", "USSurveyFoot", "foot")), digits=6, crlf=True, lines="\r\n",
                 mark=noise.random() < 0.5, point=noise.choice(("", 'state="proposed"', 'code="GS" state="existing"')),
                 source=BREAKLINE, attributes='state="proposed"', other=noise.choice(("", NO_DEFINITION)),
                 split=noise.random() < 0.3)


def model_12d(noise):
    return Habit(version=noise.choice(("1.0", "1.2", "2.0")), digits=noise.choice((4, 5)), gap=noise.choice(("  ", "\t", " ")),
                 pad=noise.choice((" ", "\n  ")), twice=noise.random() < 0.3, comment=noise.choice(("", COMMENT)),
                 point='desc="tin &gt; 5"', before_id=True, attributes='desc=""', orphans=True,
                 encoding=noise.choice(("UTF-8", "ISO-8859-1")), groups=noise.choice(("", GROUP)))


def infinity(noise):
    return Habit(version=noise.choice(("1.1", "1.2")), unit=noise.choice(("meter", "millimeter", "foot")), digits=7,
                 exponent=noise.random() < 0.4, prefix=noise.choice(("", "lx")), plus=noise.random() < 0.3,
                 cdata=noise.random() < 0.3, point='name="T 1" role="measured"', lines="",
                 other=noise.choice(("", EMPTY)), cg_points=noise.random() < 0.2)


def open_roads(noise):
    return Habit(version="1.2", unit=noise.choice(("meter", "USSurveyFoot", "foot")), digits=15 if noise.random() < 0.3 else 9,
                 feature=FEATURE.replace("{code}", "Bentley") * 2, neighbours=noise.random() < 0.5,
                 hide_with=noise.choice(("1", "true")), source=noise.choice(("", BREAKLINE)), lines="\n\t\t",
                 other=noise.choice(("", SECOND)), groups=noise.choice(("", ALIGNMENT, GROUP)),
                 head='<CoordinateSystem name="NAD83" epsgCode="26910" ogcWktCode=\'AXIS["E",EAST],AXIS["N",NORTH]\'/>\n')


EXPORTERS = (civil_3d, business_center, model_12d, infinity, open_roads)
EACH = 25


def documents():
    """Name, habit, ground. A third of those with two surfaces says nothing of which, and has to be refused."""
    for exporter in EXPORTERS:
        for n in range(EACH):
            noise = random.Random(f"{exporter.__name__} {n}")
            habit, ground = exporter(noise), drawn(noise)
            ground.first_id, ground.id_step = noise.choice(((1, 1), (0, 1), (40001, 7), (3000000000, 1)))
            ground.hidden = noise.choice((0, 0, 1))
            if habit.other or habit.groups in (GROUP,):
                choose = noise.choice(("FG", "#1", ""))
                habit = replace(habit, choose=choose, refused="" if choose else "<Surfaces>")
            if habit.cg_points and not habit.refused:
                habit = replace(habit, refused="<P ")
            yield f"{exporter.__name__}_{n}", habit, ground
