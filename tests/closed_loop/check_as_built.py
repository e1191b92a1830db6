# SPDX-License-Identifier: Apache-2.0
"""`graben as-built`: ground of a simulated dig against the true one, read back from LandXML, points and grid by
readers of its own; cut and fill against a design; a dozer; what can't be had is refused and nothing is written.

check_as_built.py GRABEN
"""

import csv
import gzip
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

FAR, NEAR, DEPTH = 6.2, 4.8, 0.4
TASK = f'area = {{{{ kind = "trench", far = {FAR}, near = {NEAR}, depth = {DEPTH}, turn = {{turn}} }}}}\n'
GRID = 0.05
PART_S = 31.0  # Of a log: its first dig.
NS = {"l": "http://www.landxml.org/schema/LandXML-1.2"}


class Site:
    def __init__(self, graben, folder):
        self.graben = pathlib.Path(graben).resolve()
        self.folder = pathlib.Path(folder)

    def call(self, *arguments):
        return subprocess.run([self.graben, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=1800)

    def good(self, *arguments):
        done = self.call(*arguments)
        assert done.returncode == 0 and not done.stderr, f"{arguments}: {done.stdout[-500:]}{done.stderr}"
        return done.stdout

    def as_built(self, log, *more, out="b.xml", profile="excavator_12t"):
        return self.good("as-built", "--log", *([log] if isinstance(log, str) else log), "--profile", profile,
                         "--out", out, *more)

    def refused(self, needle, log, *more, status=1, profile="excavator_12t", out="new.xml"):
        before = {file: file.stat().st_mtime_ns for file in self.folder.rglob("*")}
        done = self.call("as-built", "--log", *([log] if isinstance(log, str) else log), "--profile", profile,
                         "--out", out, *more)
        assert done.returncode == status and not done.stdout, f"{log} {more}: {done}"
        assert needle in done.stderr and done.stderr.count("\n") <= 4, f"{log} {more}: '{needle}' not in {done.stderr}"
        after = {file: file.stat().st_mtime_ns for file in self.folder.rglob("*")}
        assert after == before, f"{log} {more}: {set(after) ^ set(before)}"

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="ascii")
        return name

    def text(self, name):
        return (self.folder / name).read_text(encoding="utf-8")


def read_points(text):
    """Cell -> row; the first line says what it is."""
    head, names, *rows = csv.reader(text.splitlines())
    assert head[0].startswith("# "), head
    return " ".join(head), {(round(float(row[0]) / GRID - 0.5), round(float(row[1]) / GRID - 0.5)):
                            dict(zip(names, row)) for row in rows}


def height_at(cells, x, y):
    """Between the centres about it; None where most of the place's own cell is missing."""
    u, v = x / GRID - 0.5, y / GRID - 0.5
    i, j = math.floor(u), math.floor(v)
    total = weight = 0.0
    for a, along in ((0, 1.0 - u + i), (1, u - i)):
        for b, across in ((0, 1.0 - v + j), (1, v - j)):
            if (i + a, j + b) in cells:
                weight += along * across
                total += along * across * float(cells[i + a, j + b]["z"])
    return total / weight if weight >= 0.5 else None


def is_the_true_ground(site, name, most_mm, turn, *errors):
    """Ground that fell in afterwards, loose on what is firm, is left aside and counted."""
    site.write("task.toml", TASK.format(turn=turn))
    site.good("autodig", "--task", "task.toml", "--soil", "loam", *errors, "--out", name, "--summary", f"{name}.json",
              "--store", f"{name}/store")
    said = site.as_built(f"{name}/autodig.log", "--points", f"{name}.csv", "--ascii", f"{name}.asc", "--grid", GRID,
                         out=f"{name}.xml")
    cells = read_points(site.text(f"{name}.csv"))[1]
    truth = json.loads(site.text(f"{name}.json"))["built_map"]
    within = fallen = missing = 0
    for place in truth:
        built = height_at(cells, place["x_m"], place["y_m"])
        if place["off_m"] - place["firm_m"] > 0.01:
            fallen += 1
            continue
        missing += built is None
        within += built is not None and abs(built - (place["firm_m"] - DEPTH)) <= 1e-3 * most_mm
    share = within / (len(truth) - fallen)
    print(f"{name}: {100 * share:.1f} % of {len(truth)} places within {most_mm} mm, {missing} not seen, "
          f"{fallen} fell in")
    assert share >= 0.95 and fallen < 0.1 * len(truth), share
    # In the air, over the heap and on the way there, it makes no ground.
    assert all(float(row["z"]) < 0.02 for row in cells.values())
    assert 0.9 < len(cells) * GRID ** 2 / (FAR - NEAR) < 1.5, len(cells)
    assert "ground made" in said and "the log's stamps are no clock's" in said, said


def record_of(site, folder, *more, out="r.xml", profile="excavator_12t"):
    return site.good("as-built", "--record", folder, "--profile", profile, "--out", out, *more)


def the_controller_has_the_same(site, name):
    """Its own record against the log of the same run, cell by cell."""
    site.as_built(f"{name}/autodig.log", "--points", "l.csv", out="l.xml")
    said = record_of(site, f"{name}/store", "--points", "r.csv", "--ascii", "r.asc")
    assert "way of the edge" not in said and "the record's stamps are no clock's" in said, said
    log, record = ({(row["x"], row["y"]): row for row in csv.DictReader(site.text(file).splitlines()[1:])}
                   for file in ("l.csv", "r.csv"))
    both = log.keys() & record.keys()
    off = {what: sorted(abs(float(log[at][what]) - float(record[at][what])) for at in both)
           for what in ("lowest", "newest")}
    print(f"{name}: {len(log)} cells by the log, {len(record)} by the controller's record, {len(both)} in both; "
          f"largest difference {1e3 * off['lowest'][-1]:.1f} mm lowest, {1e3 * off['newest'][-1]:.1f} mm newest")
    assert len(both) >= 0.97 * max(len(log), len(record))
    assert off["lowest"][-1] <= 0.01 and off["newest"][int(0.97 * len(both))] <= 0.01
    times = [abs(seconds_of(log[at]["time"]) - seconds_of(record[at]["time"])) for at in both]
    assert sorted(times)[int(0.97 * len(times))] <= 1.1, max(times)
    assert 'surfType="TIN"' in site.text("r.xml") and "MACHINE" in site.text("r.asc.aux.xml")


def seconds_of(time):
    hours, minutes, rest = time.split("T")[1].rstrip("Z").split(":")
    return 3600 * int(hours) + 60 * int(minutes) + float(rest)


def bad_records(site, name):
    store = site.folder / name / "store"
    tiles = sorted(store.glob("ground-*.[ab]"))
    assert tiles and all(file.stat().st_size <= 4096 for file in tiles), tiles
    newest = store / "ground-000.a" if (store / "ground-000.a").exists() else tiles[0]
    for file in store.glob(newest.stem + ".*"):
        data = bytearray(file.read_bytes())
        data[100] ^= 1
        file.write_bytes(data)
    said = record_of(site, f"{name}/store")
    assert f"damaged: {newest.stem}.a" in said and "ground made" in said, said
    (site.folder / "empty").mkdir()
    for words, arguments in (
            ("no ground in it", ["--record", "empty"]), ("No such file", ["--record", "nowhere"]),
            ("is no folder", ["--record", "task.toml"]), ("--grid: of logs", ["--record", f"{name}/store", "--grid", "1"]),
            ("--ground: of logs", ["--record", f"{name}/store", "--ground", "every"])):
        done = site.call("as-built", *arguments, "--profile", "excavator_12t", "--out", "new.xml")
        assert done.returncode == 1 and words in done.stderr and not (site.folder / "new.xml").exists(), done
    done = site.call("as-built", "--record", f"{name}/store", "--profile", "excavator_22t", "--out", "new.xml")
    assert done.returncode == 1 and "its ground is of profile" in done.stderr, done
    record_of(site, f"{name}/store", "--any-machine", profile="excavator_22t")
    for both in (["--record", f"{name}/store", "--log", "a.log"], []):
        done = site.call("as-built", *both, "--profile", "excavator_12t", "--out", "new.xml")
        assert done.returncode not in (0, 1) and done.stderr, done


def reads_back(site, name):
    """The three files are one ground."""
    head, cells = read_points(site.text(f"{name}.csv"))
    root = ElementTree.fromstring(site.text(f"{name}.xml"))
    assert root.tag == "{%s}LandXML" % NS["l"] and root.get("version") == "1.2", root.attrib
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", root.get("date")) and re.fullmatch(r"\d\d:\d\d:\d\d", root.get("time"))
    assert root.find("l:Units/l:Metric", NS).get("linearUnit") == "meter"
    project = root.find("l:Project", NS)
    assert project.get("name") == "autodig.log" and "excavator_12t (profile " in project.get("desc"), project.attrib
    assert root.find("l:Application", NS).get("name") == "graben"
    assert "excavator_12t (profile " in head and "1970-01-01T00:" in head, head
    definition = root.find("l:Surfaces/l:Surface/l:Definition", NS)
    assert definition.get("surfType") == "TIN"
    points = {}
    for point in definition.findall("l:Pnts/l:P", NS):
        north, east, height = map(float, point.text.split())
        points[point.get("id")] = (east, north, height)
    assert len(points) == len(cells)
    for east, north, height in points.values():
        row = cells[round(east / GRID - 0.5), round(north / GRID - 0.5)]
        assert (float(row["x"]), float(row["y"]), float(row["z"])) == (east, north, height), row
        assert float(row["lowest"]) == height <= float(row["newest"]) and int(row["passes"]) >= 1, row
        assert re.fullmatch(r"1970-01-01T00:0\d:\d\d\.\d\dZ", row["time"]), row
    area = 0.0
    for face in definition.findall("l:Faces/l:F", NS):
        a, b, c = (points[corner] for corner in face.text.split())
        twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        assert twice > 0.0, face.text
        area += 0.5 * twice
    assert abs(area - float(definition.get("area2DSurf"))) < 2e-3 and area > 1.0, area
    heights = [height for _, _, height in points.values()]
    assert float(definition.get("elevMin")) == min(heights) and float(definition.get("elevMax")) == max(heights)

    lines = site.text(f"{name}.asc").splitlines()
    header = dict(line.lower().split() for line in lines[:6])
    rows = [line.split() for line in lines[6:]]
    assert len(rows) == int(header["nrows"]) and {len(row) for row in rows} == {int(header["ncols"])}, header
    assert header["cellsize"] == str(GRID) and header["nodata_value"] == "-9999", header
    left, low = (round(float(header[key]) / GRID) for key in ("xllcorner", "yllcorner"))
    grid = {(left + i, low + len(rows) - 1 - j): value for j, row in enumerate(rows) for i, value in enumerate(row)
            if value != "-9999"}
    assert {cell: float(value) for cell, value in grid.items()} == \
        {cell: float(row["z"]) for cell, row in cells.items()}
    beside = {item.get("key"): item.text for item in ElementTree.fromstring(site.text(f"{name}.asc.aux.xml")).iter("MDI")}
    assert beside["MACHINE"].startswith("excavator_12t (profile ") and beside["DATE_UNTIL"].startswith("1970-01-01T")


def design_xml(x0, x1, height, slope=0.0):
    corners = ((x0, -0.6), (x1, -0.6), (x1, 0.6), (x0, 0.6))
    points = "".join(f'<P id="{n}">{y} {x} {height + slope * (x - x0)}</P>' for n, (x, y) in enumerate(corners, 1))
    return (f'<LandXML xmlns="{NS["l"]}" version="1.2"><Units><Metric linearUnit="meter"/></Units><Surfaces><Surface '
            f'name="floor"><Definition surfType="TIN"><Pnts>{points}</Pnts><Faces><F>1 2 3</F><F>1 3 4</F></Faces>'
            "</Definition></Surface></Surfaces></LandXML>")


def against_a_design(site, name):
    """Figures as anybody reckons them from the points; half of the ground lies outside."""
    height, slope, edge = -0.41, 0.05, 5.5
    site.write("site.xml", design_xml(4.0, edge, height, slope))
    said = site.as_built(f"{name}/autodig.log", "--design", "site.xml", "--points", "d.csv", "--grid", GRID,
                         "--tolerance", "0.02", "--html", "d.html", "--project", "Lot 7 <north>", out="d.xml")
    cells = read_points(site.text("d.csv"))[1].values()
    assert 'name="Lot 7 &lt;north&gt;"' in site.text("d.xml")
    off = []
    for row in cells:
        over = float(row["z"]) - height - slope * (float(row["x"]) - 4.0)
        assert (row["off"] == "") == (float(row["x"]) > edge), row
        if row["off"]:
            assert abs(float(row["off"]) - over) < 2e-4, (row, over)
            off.append(over)
    assert 0.3 < len(off) / len(cells) < 0.7
    far = sorted(map(abs, off))
    for words, wanted, within in (
            ("area on the design", len(off) * GRID ** 2, 0.006),
            ("off the design, RMS", 1e3 * math.sqrt(sum(o * o for o in off) / len(off)), 0.1),
            ("  95 % within", 1e3 * far[math.ceil(0.95 * len(far)) - 1], 0.15),
            ("  highest", 1e3 * max(off), 0.15), ("  lowest", 1e3 * min(off), 0.15),
            # A place at the tolerance may count either way: points have four decimals.
            ("  within tolerance", 100 * sum(o <= 0.02 for o in far) / len(far),
             0.1 + 100 * sum(abs(o - 0.02) < 2e-4 for o in far) / len(far)),
            ("over the design, to be cut", GRID ** 2 * sum(max(0.0, o) for o in off), 1e-3),
            ("under the design, to be filled", GRID ** 2 * sum(max(0.0, -o) for o in off), 1e-3)):
        found = re.search(rf"^{re.escape(words)} +([-+.\d]+)", said, re.MULTILINE)
        assert found and abs(float(found[1]) - wanted) <= within, f"{words}: {found and found[1]}, {wanted}"
    page = site.text("d.html")
    colours = set(re.findall(r'fill="(#[0-9a-f]{6})"', page))
    assert len(colours) >= 2 and "Lot 7 &lt;north&gt;" in page and "off the design, RMS" in page, colours
    assert "http" not in re.sub(r"http://www\.w3\.org/\S*", "", page)
    # Its own points are a design too, on which it lies.
    again = site.as_built(f"{name}/autodig.log", "--design", "d.csv", "--grid", GRID, out="again.xml")
    assert re.search(r"off the design, RMS +0\.0 mm", again), again


def shifted(text, by_s):
    return re.sub(r"^\((\d+\.\d+)\)", lambda stamp: f"({float(stamp[1]) + by_s:.6f})", text, flags=re.MULTILINE)


def until(log, end_s):
    return "".join(line for line in log.splitlines(keepends=True) if float(line[1:line.index(")")]) < end_s)


def several_logs(site, log, first):
    """One after the other, packed or not, of a clock that was set."""
    monday = site.write("monday.log", shifted(log, 1.75e9))
    with gzip.open(site.folder / "tuesday.log.gz", "wt", 1) as stream:
        stream.write(shifted(first, 1.75e9 + 86400.0))
    said = site.as_built([monday, "tuesday.log.gz"], "--points", "two.csv", "--grid", GRID)
    assert "2025-06-15T" in said and "2025-06-16T" in said and "no clock's" not in said, said
    site.as_built(monday, "--points", "one.csv", "--grid", GRID)
    one, two = (read_points(site.text(name))[1] for name in ("one.csv", "two.csv"))
    assert one.keys() == two.keys() and all(one[cell]["z"] == two[cell]["z"] for cell in one)
    # The second time the edge goes where it has been, but higher: as if soil had come there.
    assert sum(float(row["newest"]) > float(row["lowest"]) + 0.01 for row in two.values()) > 0
    assert re.search(r"newest pass over the lowest +[1-9]", said), said
    newest = site.as_built([monday, "tuesday.log.gz"], "--height", "newest", "--points", "new.csv", "--grid", GRID)
    heights = read_points(site.text("new.csv"))[1]
    assert all(heights[cell]["z"] == two[cell]["newest"] for cell in two) and "2025-06-16T" in newest
    site.refused("monday.log: begins at 2025-06-15T", ["tuesday.log.gz", monday])
    site.refused("begins at 2025-06-15T", [monday, monday])


def bad_logs(site, log):
    lines = log.splitlines(keepends=True)
    site.refused("none.log: there is no such file", "none.log")
    site.refused("is empty", site.write("empty.log", ""))
    site.refused("words.log", site.write("words.log", "some words\n" * 20))
    site.refused("is of another machine than excavator_22t", "a.log", profile="excavator_22t")
    site.refused("of excavator_12t; with --any-machine", "a.log", profile="dozer_9t_tilt")
    said = site.as_built("a.log", "--any-machine", profile="excavator_12t_ls", out="other.xml")
    assert "excavator_12t_ls (profile " in said, said
    # Up to when it begins to move.
    site.refused("is without motion: the edge went ", site.write("still.log", "".join(
        line for line in lines if float(line[1:line.index(")")]) < 1.3 and "SwingState" not in line)))
    site.refused("no frame says which profile", site.write("nobody.log", "".join(
        line for line in lines if "18FF3482#" not in line and "0CFF2880#" not in line)))
    site.refused("nowhere is all known that says, by this profile, where the edge of an excavator is: its strokes", site.write(
        "blind.log", "".join(line for line in lines if "0CFF2180#" not in line)))
    site.refused("nothing in it says when the edge was at the ground", site.write("deaf.log", "".join(
        line for line in lines if "18FF3A82#" not in line)))
    every = site.as_built("deaf.log", "--ground", "every", out="every.xml")
    cells = [int(re.search(r"(\d+) cells of", said)[1]) for said in (every, site.as_built("a.log", out="load.xml"))]
    assert cells[0] > 1.2 * cells[1], cells
    # The second half says another profile; then two of one profile at once.
    half = len(lines) // 2
    other = "".join(lines[half:]).replace("18FF3482#", "18FF3482#DEADBEEF", 1)
    other = re.sub(r"18FF3482#DEADBEEF.{8}", "18FF3482#DEADBEEF", other)
    site.refused("two machines in one log: profile efbeadde, before ", site.write("two.log", "".join(lines[:half]) + other))
    both = [line for n, line in enumerate(lines) if n >= 3000
            for line in (line, line[:line.index(")")] + lines[n - 3000][lines[n - 3000].index(")"):])]
    site.refused("two machines on one bus", site.write("both.log", "".join(both)))
    # A log that was being written counts as far as it goes; one that was packed and is cut does not.
    cut = site.as_built(site.write("cut.log", log[:-8]), out="cut.xml")
    assert "cut.log: its last line is cut, and left out" in cut, cut
    packed = gzip.compress(log.encode(), 1)
    (site.folder / "cut.log.gz").write_bytes(packed[:len(packed) // 2])
    site.refused("cut.log.gz", "cut.log.gz")
    air = "".join(line for line in lines if "18FF3A82#" not in line or float(line[1:line.index(")")]) < 4.0)
    site.refused("0.0 m of it at work, and over no cell", site.write("air.log", air))


def bad_rest(site):
    log = "a.log"
    site.write("far.xml", design_xml(54.0, 56.0, -0.4))
    site.refused("far.xml: the design does not lie under the machine: it reaches from x = 54.0", log, "--design", "far.xml")
    site.refused("none.xml", log, "--design", "none.xml")
    site.refused("is no surface", log, "--design", site.write("line.txt", "0 0\n5 0\n"))
    site.refused("broken.xml", log, "--design", site.write("broken.xml", "<LandXML>"))
    site.refused("--surface, --columns and --units are of a --design", log, "--units", "ft")
    site.refused("--width 1: the profile says 1 m", log, "--width", "1")
    site.refused("--bus dozer_bus", log, "--bus", "dozer_bus", profile="dozer_9t")
    # No output over an input, nor over another one.
    for out, more, needle in ((log, (), "would overwrite"), ("site.xml", ("--design", "site.xml"), "would overwrite"),
                              ("n.xml", ("--points", "n.xml"), "would overwrite"),
                              ("n.asc.aux.xml", ("--ascii", "n.asc"), "would overwrite"),
                              ("n.xml", ("--html", log), "would overwrite"), ("a", (), "can't be written")):
        site.refused(needle, log, *more, out=out)
    site.refused("6 is not a number from 0.02 to 2", log, "--grid", "6", status=2)
    site.refused("'most' is none of lowest, newest", log, "--height", "most", status=2)
    coarse = site.call("as-built", "--log", log, "--profile", "excavator_12t", "--out", "n.xml", "--grid", "2")
    assert coarse.returncode == 1 and "a smaller --grid" in coarse.stderr, coarse


def dozer(site):
    """Its edge leaves the design that it was given, as well as it keeps it."""
    site.write("ramp.csv", "x,y,z\n" + "".join(f"{x},{y},{z}\n" for x, z in ((0, 0.0), (4, -0.1), (14, -0.1), (18, 0.0))
                                               for y in (-2, 2)))
    site.good("grade", "--design", "ramp.csv", "--out", "g")
    site.refused("is of another machine than dozer_9t", "g/grade.log", "--width", "2.5", profile="dozer_9t")
    site.refused("does not say how wide the edge is (tilt.edge_width): --width", "g/grade.log", "--any-machine",
                 profile="dozer_9t")
    said = site.as_built("g/grade.log", "--width", "2.0", "--any-machine", "--design", "ramp.csv", "--tolerance", "0.02",
                         profile="dozer_9t", out="g.xml")
    share, area = (float(re.search(rf"{words} +([\d.]+)", said)[1]) for words in ("within tolerance", "area on the design"))
    assert share > 95.0 and 24.0 < area <= 36.0, said


def main():
    graben, = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        site = Site(graben, folder)
        is_the_true_ground(site, "a", 10, 0.0)
        is_the_true_ground(site, "found", 25, 0.6, "--errors", "all", "--seed", "2")
        for name in ("a", "found"):
            the_controller_has_the_same(site, name)
        bad_records(site, "found")
        reads_back(site, "found")
        against_a_design(site, "a")
        # Of what follows a part is enough.
        log = until(site.text("a/autodig.log"), 2.0 * PART_S)
        first = until(log, PART_S)
        site.write("a.log", first)
        several_logs(site, log, first)
        bad_logs(site, first)
        bad_rest(site)
        dozer(site)


if __name__ == "__main__":
    main()
