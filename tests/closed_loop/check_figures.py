# SPDX-License-Identifier: Apache-2.0
"""`graben dig --figure`, `grade --figure`, `plan --figure`: the papers' figures of our runs are SVG with the curves that they should
have, and the numbers beside the paper's are the run's own.

check_figures.py GRABEN
"""

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

SVG = "{http://www.w3.org/2000/svg}"
# Curves of each, in all its panels.
CURVES = {"kim9": 3, "kim10": 2, "kim11": 1, "kim12": 3, "kim13": 6, "kim14": 2, "kim15": 3, "mononen7": 6,
          "mononen8": 2, "mononen9": 6, "zhang5": 2, "zhang6": 4, "zhang7": 1, "zhang8": 4, "zhang9": 4, "zhang10": 4}


def call(graben, *words, status=0):
    done = subprocess.run([graben, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == status, f"{words}: status {done.returncode}: {done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def read(folder, name):
    """Places of each curve on the sheet, the numbers' rows, all words."""
    root = xml.parse(folder / f"{name}.svg").getroot()
    curves = [[tuple(map(float, place)) for place in re.findall(r"[ML]([\d.-]+) ([\d.-]+)", path.get("d"))]
              for path in root.iter(f"{SVG}path") if path.get("class") == "curve" and "h22" not in path.get("d")]
    width, height = float(root.get("width")), float(root.get("height"))
    for curve in curves:
        assert curve, f"{name}: an empty curve"
        assert all(0 <= x <= width and 0 <= y <= height for x, y in curve), f"{name}: a curve leaves the sheet"
    assert len(curves) == CURVES[name], f"{name}: {len(curves)} curves"
    rows = [text.text for group in root.iter(f"{SVG}g") for text in group.iter(f"{SVG}text")]
    numbers = {rows[at]: (rows[at + 1], rows[at + 2]) for at in range(2, len(rows), 3)}
    return curves, numbers, " ".join(text.text or "" for text in root.iter(f"{SVG}text"))


def figures(graben, folder, names, *words):
    summary = folder / "summary.json"
    call(graben, *words, "--out", folder, "--summary", summary, "--figure", ",".join(names))
    found = {name: read(folder, name) for name in names}
    return found, json.loads(summary.read_text())


def planned(graben, folder):
    """Zhang's line: the figures' numbers and curves are plan.csv's."""
    names = [name for name in CURVES if name.startswith("zhang")]
    call(graben, "plan", "--out", folder, "--figure", ",".join(names))
    with open(folder / "plan.csv", encoding="ascii") as stream:
        rows = list(csv.DictReader(stream))
    found = {name: read(folder, name) for name in names}
    numbers = found["zhang5"][1]
    way_mm, time_s = (1e3 * float(rows[-1]["way_m"]), float(rows[-1]["time_s"]))
    for what, paper, ours in (("displacement", 3746.4, way_mm), ("planning time", 18.4, time_s)):
        assert one_in(numbers[what][0]) == paper and abs(one_in(numbers[what][1]) - ours) < 0.06, numbers[what]
        # From J to K it is 3730.4 mm: the paper's own figure is 16 mm more.
        assert abs(ours - paper) < 5e-3 * paper, f"{what}: {ours}, the paper has {paper}"
    # The curve of the boom's velocity rises and falls as the table's does.
    heights = [-y for _, y in found["zhang9"][0][0]]
    table = [float(row["boom_mps"]) for row in rows]
    for ends in (min, max):
        places = [values.index(ends(values)) / len(values) for values in (heights, table)]
        assert abs(places[0] - places[1]) < 0.1, places
    for needle, status, *words in (("is of the paper's line", 1, "--from", "5,0,0,1.2", "--to", "6,0,0,1.2", "--speed", 0.5),
                                   (": not with --", 2, "--task", "flatten"),
                                   ("did you mean 'zhang5'?", 2, "--figure", "zhang50")):
        other = folder / "other"
        said = call(graben, "plan", "--out", other, "--figure", "zhang5", *words, status=status)
        assert needle in said and not other.exists(), said


def one_in(text):
    return float(re.match(r"[-\d.]+", text)[0])


def main():
    graben = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        kim, summary = figures(graben, folder, ["kim9", "kim10", "kim11", "kim12", "kim13"], "dig", "--soil", "--errors",
                               "kim", "--seed", 3)
        paper, ours = kim["kim9"][1]["largest path error"]
        assert paper == "46 mm" and abs(one_in(ours) - 1e3 * summary["max_error_true_m"]) < 0.06, (ours, summary)
        assert abs(one_in(kim["kim11"][1]["least lambda"][1]) - summary["lambda_min"]) < 6e-4, kim["kim11"][1]
        # The tip's way lies on the wanted one, nearly: a map has the same scale on both axes.
        _, wanted, tip = kim["kim9"][0]
        pixels_per_m = (max(x for x, _ in wanted) - min(x for x, _ in wanted)) / 3.0
        off = max(min(((x - a) ** 2 + (y - b) ** 2) ** 0.5 for a, b in wanted) for x, y in tip) / pixels_per_m
        assert 0.8 * summary["max_error_true_m"] < off < 1.2 * summary["max_error_true_m"] + 0.005, off
        rock, summary = figures(graben, folder, ["kim14", "kim15"], "dig", "--obstacle", "--stiff-oil")
        assert one_in(rock["kim15"][1]["lambda while it holds"][1]) < 0.05, rock["kim15"][1]
        grade, summary = figures(graben, folder, ["mononen7", "mononen8"], "grade")
        assert abs(one_in(grade["mononen7"][1]["time"][1]) - summary["time_s"]) < 0.06, grade["mononen7"][1]
        assert abs(one_in(grade["mononen7"][1]["edge off the grade, most"][1]) - summary["max_error_true_m"]) < 6e-5
        figures(graben, folder, ["mononen9"], "grade", "--speed", 0.5)
        for needle, *words in (("add --soil", "dig", "--figure", "kim9"), ("add --obstacle", "dig", "--figure", "kim15"),
                               ("add --speed-mode constant", "grade", "--figure", "mononen7,mononen9")):
            said = call(graben, *words, "--out", folder, status=1)
            assert needle in said, said
        planned(graben, folder)
        said = call(graben, "dig", "--figure", "kim99", status=2)
        assert "did you mean 'kim9'?" in said, said
    print(f"{len(CURVES)} figures with their curves and the run's numbers")


if __name__ == "__main__":
    main()
