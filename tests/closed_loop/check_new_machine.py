# SPDX-License-Identifier: Apache-2.0
"""`graben new-machine`: from answers in workshop units to a profile that `graben check` takes.

check_new_machine.py GRABEN
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

# Of a data sheet, before those of the profile.
SHEET = {"operating_weight", "pump_count", "pump_kind", "swing_pump", "blade_width"}
MACHINES = pathlib.Path(__file__).resolve().parents[2] / "app" / "machines"


def make(graben, folder, like, answers, *options):
    out = [] if "--out" in options else ["--out", "mine.toml"]
    return subprocess.run([graben, "new-machine", "--like", like, *out, *options], cwd=folder,
                          input="\n".join([*answers, "", ""]), capture_output=True, text=True, timeout=1800)


def asked(said):
    """Key, unit and value in brackets of each question."""
    return re.findall(r"^(\S+): [^\n]*?, (\S+) \[([^\]]*)\]: ", said, re.MULTILINE)


def value(profile, key):
    for part in re.findall(r"[^.\[\]]+", key):
        profile = profile[int(part)] if part.isdigit() else profile[part]
    return profile


def flat(number_or_list):
    return number_or_list if isinstance(number_or_list, list) else [number_or_list]


def check(graben, folder):
    return subprocess.run([graben, "check", "mine.toml", "--out", "."], cwd=folder, capture_output=True, text=True,
                          timeout=1800)


def unchanged(graben, folder, like):
    """Empty lines keep everything, in the same sense, and every value has a comment."""
    done = make(graben, folder, like, [], "--force")
    assert done.returncode == 0, done.stderr
    questions = asked(done.stdout)
    assert len(questions) >= 20, done.stdout
    assert {"mm", "bar" if like.startswith("exc") else "mm", "rpm"} <= {unit for _, unit, _ in questions}, questions
    before = tomllib.loads((MACHINES / f"{like}.toml").read_text(encoding="utf-8"))
    text = (folder / "mine.toml").read_text(encoding="utf-8")
    after = tomllib.loads(text)
    for section, content in before.items():
        for key, old in content.items() if isinstance(content, dict) else []:
            if key != "angle":
                assert after[section][key] == old, f"{section}.{key}: {after[section][key]} instead of {old}"
    values = re.findall(r"^\S+ = .*$", text, re.MULTILINE)
    bare = [line for line in values if "  # " not in line]
    assert len(values) > 50 and not bare, bare
    assert check(graben, folder).returncode == 0
    return questions


def scaled(graben, folder, like, questions, ratio, most=None):
    """Every length times the ratio: another machine, told in mm, of the same angles; its path goes with it."""
    answers = []
    for _, unit, old in questions:
        numbers = [float(number) for number in old.split(", ")]
        answers.append(", ".join(f"{number * ratio:.4f}" for number in numbers) if unit == "mm" else "")
    done = make(graben, folder, like, answers, "--force")
    assert done.returncode == 0, done.stdout + done.stderr
    profile = tomllib.loads((folder / "mine.toml").read_text(encoding="utf-8"))
    for (key, unit, old), answer in zip(questions, answers):
        if key in SHEET:
            continue
        wanted = [float(number) / 1e3 for number in answer.split(", ")] if unit == "mm" else None
        found = flat(value(profile, key))
        assert wanted is None or max(abs(a - b) for a, b in zip(found, wanted)) < 1e-6, (key, found, wanted)
    said = check(graben, folder)
    assert said.returncode == 0, said.stderr
    return said.stdout


def like_another(graben, folder):
    """After a profile that is like another: whole, so that it needs no file beside it."""
    done = make(graben, folder, "excavator_12t_ls", [], "--force")
    assert done.returncode == 0, done.stderr
    profile = tomllib.loads((folder / "mine.toml").read_text(encoding="utf-8"))
    assert "like" not in profile and profile["pump"][0]["kind"] == "load_sensing", profile
    said = check(graben, folder)
    assert said.returncode == 0, said.stderr


def units(graben, folder, questions):
    """A relief of 300 bar, 2000 rpm, 30 degrees."""
    told = {"pump[0].relief": ("300", 300e5), "pump[0].speed": ("2000", 209.4395), "pump[0].displacement":
            ("150", 150e-6), "swing.range": ("-90, 90", 1.570796), "sensors.pressure_range": ("500", 500e5),
            "valve.section_flow": ("180", 3e-3)}
    done = make(graben, folder, "excavator_12t", [told[key][0] if key in told else "" for key, _, _ in questions],
                "--force")
    assert done.returncode == 0, done.stderr
    profile = tomllib.loads((folder / "mine.toml").read_text(encoding="utf-8"))
    for key, (_, wanted) in told.items():
        found = flat(value(profile, key))[-1]
        assert abs(found - wanted) <= 1e-6 * wanted, (key, found, wanted)
    assert "# told: 300 bar" in (folder / "mine.toml").read_text(encoding="utf-8")
    assert check(graben, folder).returncode == 0


def from_a_data_sheet(graben, folder):
    """Another weight, pumps and swing that no shipped machine has together, and a simulation of it all."""
    def made(like, sheet):
        done = make(graben, folder, like, list(sheet), "--force")
        assert done.returncode == 0, done.stdout[-500:] + done.stderr
        said = check(graben, folder)
        assert said.returncode == 0, said.stderr
        return (tomllib.loads((folder / "mine.toml").read_text(encoding="utf-8")),
                tomllib.loads((folder / "mine.sim.toml").read_text(encoding="utf-8")), said.stdout)

    profile, simulated, said = made("dozer_9t", ("20", "3200"))
    # What is left of the 9 t machine is counted, and warned of: tracks and pumps.
    said = " ".join(said.split())
    assert re.search(r"of [0-9]+ values [0-9]+ stand as in dozer_9t, [0-9]+ are scaled from its own; told: 1", said), said
    for key in ("body.track_contact", "hst.pump_displacement", "implement.pump.displacement"):
        assert f"warning: {key}: " in said, (key, said)
    assert profile["body"]["mass"] == 20000.0 and simulated["blade"]["width"] == 3.2, profile["body"]
    assert abs(simulated["blade"]["mass"] / 950.0 - 20.0 / 8.9) < 1e-6, simulated["blade"]
    profile, simulated, _ = made("excavator_12t", ("14", "2"))
    assert len(profile["pump"]) == 2 and profile["valve"]["pump"] == {"boom": 2, "arm": 1, "bucket": 2, "swing": 1}
    assert abs(profile["oil"]["mass"][0] / 992.0 - 14.0 / 12.0) < 1e-6, profile["oil"]
    assert abs(simulated["boom"]["mass"] / 992.0 - 14.0 / 12.0) < 1e-6, simulated["boom"]
    profile, _, said = made("excavator_22t", ("", "", "", "1"))
    assert profile["valve"]["pump"]["swing"] == 1 and len(profile["pump"]) == 2 and "no warnings" in said, said
    profile, _, _ = made("excavator_12t", ("", "", "1", "0"))
    assert profile["pump"][0]["kind"] == "load_sensing" and "swing" not in profile["valve"], profile["valve"]


def by_name(graben, folder):
    """Answers by their keys, in any order: a second pump's among them, which an answer before brings."""
    done = make(graben, folder, "dozer_9t", ["hst.gear_ratio = 60"], "--force")
    assert done.returncode == 0 and tomllib.loads((folder / "mine.toml").read_text())["hst"]["gear_ratio"] == 60.0
    told = ["pump[1].relief = 343", "operating_weight = 14", "", "pump_count = 2", "bucket.capacity=0.6"]
    done = make(graben, folder, "excavator_12t", told, "--force")
    assert done.returncode == 0, done.stderr
    profile = tomllib.loads((folder / "mine.toml").read_text(encoding="utf-8"))
    assert profile["pump"][1]["relief"] == 343e5 and profile["bucket"]["capacity"] == 0.6, profile["pump"]
    assert profile["body"]["boom_foot"] == [0.14, 1.424], profile["body"]
    assert "\npump_count: " in done.stdout and "[1]: 2\n" in done.stdout, done.stdout[:500]
    for answers, needle in ((["pump[0].relief = 34.3"], "pump[0].relief: 34.3 bar; in MPa? then it is 343 bar"),
                            (["pump_count = 1", "pump[1].relief = 343"], "pump[1].relief: is not asked of such a machine"),
                            (["pump_count = 1", "343"], "'343': KEY = ANSWER is wanted"),
                            (["pump_count = 1", "pump_count = 2"], "pump_count: is answered twice"),
                            ([*[""] * 300, "7"], "'7', line 301: more answers than questions")):
        done = make(graben, folder, "excavator_12t", answers, "--force")
        assert done.returncode == 1 and needle in done.stderr, done.stderr


def new_folder(graben, folder):
    done = make(graben, folder, "excavator_22t", [], "--out", "a/new/other.toml")
    assert done.returncode == 0 and (folder / "a/new/other.toml").exists(), done.stderr


def refusals(graben, folder):
    kept = (folder / "mine.toml").read_bytes()
    for answers, needle, options in (([], "is there already", []),
                                     (["1,2,3"], "body.boom_foot: 2 numbers are wanted", ["--force"]),
                                     (["0.14, 1.424"], "body.boom_foot: in metres? then it is 140, 1424 mm", ["--force"]),
                                     (["", "4,600"], "boom.length: 1 number is wanted, not 2: a comma", ["--force"]),
                                     (["", "", "105", "120"], "boom.cylinder.rod: 120 mm is no rod in a bore of 105 mm",
                                      ["--force"]),
                                     (["140, five"], "'five' is not a number", ["--force"]),
                                     (["", "4.6"], "allowed: 100 .. 30000 mm", ["--force"])):
        done = make(graben, folder, "excavator_12t", [""] * 4 + answers, *options)
        assert done.returncode == 1 and needle in done.stderr, (answers, done.stderr)
        assert (folder / "mine.toml").read_bytes() == kept, answers
    done = subprocess.run([graben, "new-machine", "--out", "none.toml"], cwd=folder, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=1800)
    assert done.returncode == 1 and "standard input is empty" in done.stderr, (done.returncode, done.stderr)
    assert not (folder / "none.toml").exists()
    # What does not fit together is told with its line, and the file is there to be corrected: a bore that is less than
    # the rod, which then stays.
    done = make(graben, folder, "excavator_12t", [""] * 4 + ["", "", "60"], "--force")
    assert done.returncode == 1 and "boom.cylinder.rod (line " in done.stderr, done.stderr
    assert (folder / "mine.toml").read_bytes() != kept


def main():
    graben = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for like in ("excavator_12t", "excavator_22t", "dozer_9t"):
            questions = unchanged(graben, folder, like)
            print(f"{like}: {len(questions)} questions")
            if like != "dozer_9t":
                small = scaled(graben, folder, like, questions, 0.9)
                reach = float(re.search(r"farthest +([0-9.]+)", small)[1])
                print(f"{like} times 0.9 reaches {reach} m")
        units(graben, folder, unchanged(graben, folder, "excavator_12t"))
        like_another(graben, folder)
        from_a_data_sheet(graben, folder)
        by_name(graben, folder)
        new_folder(graben, folder)
        refusals(graben, folder)
    print("a new machine is asked for and written")


if __name__ == "__main__":
    main()
