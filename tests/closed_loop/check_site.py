# SPDX-License-Identifier: Apache-2.0
"""`graben surface` and `graben site`: heights of a LandXML surface against its triangles, read here by readers of their
own, 100 000 triangles in 2 s; a site's frame from touched points and from a log; a task on both; refusals.

check_site.py GRABEN
"""

import math
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

NS = {"l": "http://www.landxml.org/schema/LandXML-1.2"}
SIDE = 225  # Points a side: 2 * 224 * 224 triangles are 100 352.
MOST_S = 2.0
HEADING, BENCHMARK = 0.7, (4321.5, 8765.25, 54.3)


class Site:
    def __init__(self, graben, folder):
        self.graben = pathlib.Path(graben).resolve()
        self.folder = pathlib.Path(folder)

    def call(self, *arguments):
        return subprocess.run([self.graben, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=600)

    def good(self, *arguments):
        done = self.call(*arguments)
        assert done.returncode == 0 and not done.stderr, f"{arguments}: {done.stdout[-500:]}{done.stderr}"
        return done.stdout

    def refused(self, needle, *arguments):
        done = self.call(*arguments)
        assert done.returncode == 1 and not done.stdout, f"{arguments}: {done}"
        assert needle in done.stderr, f"{arguments}: '{needle}' not in {done.stderr}"


def triangles(path):
    surface = ElementTree.parse(path).find(".//l:Definition", NS)
    points = {point.get("id"): tuple(map(float, point.text.split())) for point in surface.findall("l:Pnts/l:P", NS)}
    return [[points[name] for name in face.text.split()] for face in surface.findall("l:Faces/l:F", NS)]


def height(faces, east, north):
    for a, b, c in faces:
        (n0, e0, z0), (n1, e1, z1), (n2, e2, z2) = a, b, c
        area = (e1 - e0) * (n2 - n0) - (e2 - e0) * (n1 - n0)
        of_b = ((east - e0) * (n2 - n0) - (e2 - e0) * (north - n0)) / area
        of_c = ((e1 - e0) * (north - n0) - (east - e0) * (n1 - n0)) / area
        if min(of_b, of_c, 1 - of_b - of_c) >= -1e-9:
            return z0 + of_b * (z1 - z0) + of_c * (z2 - z0)
    return None


def read_grid(text):
    """(east, north) -> height."""
    words = text.split()
    head = {words[i].lower(): float(words[i + 1]) for i in range(0, 12, 2)}
    columns, rows, step = int(head["ncols"]), int(head["nrows"]), head["cellsize"]
    values = list(map(float, words[12:]))
    assert len(values) == columns * rows
    return {(head["xllcenter"] + step * i, head["yllcenter"] + step * (rows - 1 - j)): values[j * columns + i]
            for j in range(rows) for i in range(columns) if values[j * columns + i] != head["nodata_value"]}


def check_heights(site):
    site.good("surface", "--design", "crest.xml", "--step", 0.2, "--out", "crest.asc")
    design = next(iter(site.graben.parent.parent.parent.glob("share/graben/designs/crest.xml")))
    faces = triangles(design)
    grid = read_grid((site.folder / "crest.asc").read_text())
    assert len(grid) > 1000, len(grid)
    for (east, north), z in grid.items():
        true = height(faces, east, north)
        assert true is not None and abs(true - z) < 1e-4, (east, north, z, true)
    site.refused("nothing of the surface is there", "surface", "--design", "crest.xml", "--around", "0,0", "--out", "n")
    site.refused("wanted: a design: LandXML", "surface", "--design", "none.xml", "--out", "n.asc")


def check_large(site):
    points = "".join(f'<P id="{row * SIDE + column + 1}">{0.5 * row:.3f} {0.5 * column:.3f} '
                     f'{50 + math.sin(0.3 * column) + 0.1 * row:.4f}</P>' for row in range(SIDE) for column in range(SIDE))
    faces = "".join(f"<F>{a} {a + 1} {a + SIDE}</F><F>{a + 1} {a + SIDE + 1} {a + SIDE}</F>"
                    for a in (row * SIDE + column + 1 for row in range(SIDE - 1) for column in range(SIDE - 1)))
    (site.folder / "large.xml").write_text(
        '<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2"><Units><Metric linearUnit="meter"/>'
        f'</Units><Surfaces><Surface name="s"><Definition surfType="TIN"><Pnts>{points}</Pnts><Faces>{faces}</Faces>'
        '</Definition></Surface></Surfaces></LandXML>')
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = site.good("surface", "--design", "large.xml", "--around", "50,60", "--out", "large.asc")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    took = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    assert "100352" in said and took < MOST_S, (said, took)
    print(f"100 352 triangles, {len((site.folder / 'large.asc').read_text().split()) - 12} heights: {took:.2f} CPU s")


def to_site(place):
    c, s = math.cos(HEADING), math.sin(HEADING)
    return (BENCHMARK[0] + c * place[0] - s * place[1], BENCHMARK[1] + s * place[0] + c * place[1],
            BENCHMARK[2] + place[2])


def words(place):
    return ",".join(f"{value:.4f}" for value in place)


def frame_of(text):
    return [float(number) for number in re.findall(r"-?\d+\.\d+", text.split("[site]")[1])]


def check_frame(site):
    here = [(5.2, 0.4, 0.12), (1.0, 6.1, -0.2), (3.0, -5.0, 0.3)]
    told = [f"{words(to_site(place))}={words(place)}" for place in here]
    frame = frame_of(site.good("site", "--touched", *told))
    assert abs(frame[-1] - HEADING) < 1e-4, frame
    site.refused("2.00 m apart", "site", "--touched", "0,0,0=5,0,0", "2,0,0=7,0,0")
    site.refused("1 touched points", "site", "--touched", told[0])
    off = (here[2][0], here[2][1], here[2][2] + 0.1)
    site.refused("touched point 3: 0.000 m in plan and +0.100 m", "site", "--touched", *told[:2],
                 f"{words(to_site(here[2]))}={words(off)}")
    site.refused("allowed: east,north,height", "site", "--touched", "0,0,x=1,2,3", "0,0,1=1,2,3")
    site.refused("3 and 2 numbers", "site", "--touched", "0,0,0=1,2", "0,0,1=1,2,3")


def check_log(site):
    """The flattening begins and ends at rest, at places that are known."""
    site.good("autodig", "--duration", 9, "--out", "dig")
    begin, end = (0.0, 6.866, 0.0), (2.244, 3.886, 0.0)
    log = ("site", "--log", "dig/autodig.log", "--profile", "excavator_12t", "--touched")
    stamps = [float(line.split("(")[1].split(")")[0]) for line in (site.folder / "dig/autodig.log").read_text().splitlines()
              if line.startswith("(")]
    last = stamps[-1] - stamps[0] - 0.5
    frame = frame_of(site.good(*log, f"{words(to_site(begin))}@0.6", f"{words(to_site(end))}@{last:.2f}"))
    assert abs(frame[-1] - HEADING) < 0.005, frame
    assert math.dist(frame[3:6], begin) < 0.015, frame
    site.refused("the edge moves", *log, f"{words(to_site(begin))}@0.6", f"{words(to_site(end))}@{last / 2:.2f}")
    site.refused("is not known", *log, f"{words(to_site(begin))}@0.6", f"{words(to_site(end))}@900")
    site.refused("needs --log", "site", "--touched", "0,0,0@1", "5,0,0@2")


def check_task(site):
    """A dig over the crest of the site is planned, one through it refused."""
    for deep, fits in ((-0.15, True), (-0.45, False)):
        task = site.folder / "over.toml"
        task.write_text(f"""start = {{ position = [6.5, 0.0, {deep}], attitude = 1.9 }}
[[step]]
do = "dig"
to = {{ position = [4.5, 0.0, {deep}], attitude = 1.5 }}
speed = 0.3
[design]
file = "crest.asc"
[site]
benchmark = [100.0, 200.0, 54.3]
touched = [0.0, 0.0, 0.0]
heading = 0.3
""")
        plan = ("plan", "--task", "over.toml", "--out", "plan")
        if fits:
            site.good(*plan)
        else:
            site.refused("the design surface", *plan)
    (site.folder / "only.toml").write_text("[design]\nthrough = [5.0, 0.0, -0.3]\nslope = 0.1\n")
    for command in ("plan", "autodig"):
        site.refused("has a design and no steps", command, "--task", "only.toml", "--out", "plan")


def main():
    with tempfile.TemporaryDirectory() as folder:
        site = Site(sys.argv[1], folder)
        check_heights(site)
        check_large(site)
        check_frame(site)
        check_log(site)
        check_task(site)


main()
