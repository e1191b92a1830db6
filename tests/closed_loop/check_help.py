# SPDX-License-Identifier: Apache-2.0
"""What `graben` says of itself and of what is wrongly typed, as a new user meets it.

check_help.py GRABEN
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
MACHINES = ROOT / "app" / "machines"
WIDTH = 80
# Of CLI11, the standard library, nlohmann-json and toml++.
LIBRARIES = re.compile(r"Could not convert|not expected|Run with --help|REQUIRED|Value .* not in range|not in \{|"
                       r"filesystem error|json\.exception|stod|Error while parsing|basic_string|what\(\)|[Ee]xcludes|"
                       r"Exactly 1 option|terminate called|\(\{|:\{")

SHIPPED = ["dozer_9t", "dozer_9t_tilt", "excavator_12t", "excavator_12t_ls", "excavator_12t_nfc", "excavator_22t",
           "excavator_22t_ls", "excavator_22t_nfc"]


def shipped_profiles(said):
    found = re.search(r"Shipped profiles: ([^.]*?)(\n\n|$)", said)
    return re.split(r",\s+", found[1].strip()) if found else []


def call(graben, *arguments, text="", folder=None):
    return subprocess.run([graben, *arguments], input=text, capture_output=True, text=True, timeout=1800, cwd=folder)


def refused(graben, needle, *arguments, status=1, text="", folder=None):
    done = call(graben, *arguments, text=text, folder=folder)
    assert done.returncode == status, f"{arguments}: status {done.returncode}: {done.stderr}"
    assert needle in done.stderr, f"{arguments}: {done.stderr}"
    assert not LIBRARIES.search(done.stderr), f"{arguments}: a library speaks: {done.stderr}"


def run_answers_without_a_build():
    """`./run X --help` says what is built, or a few words; it builds nothing."""
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        (root / "app/cli").mkdir(parents=True)
        shutil.copy(ROOT / "app/cli/command_table.hpp", root / "app/cli")
        shutil.copy(ROOT / "run", root)
        for words in (("grade", "--help"), ("-h",), ("campaign", "dig", "--help"), ("--scope", "--help")):
            done = call(root / "run", *words)
            assert done.returncode == 0 and "is not built yet" in done.stdout and " grade " in done.stdout, done
            assert not (root / "build").exists(), words
        built = root / "build/release/app/cli"
        built.mkdir(parents=True)
        for file in ("graben", "graben-grade"):
            (built / file).write_text("#!/bin/sh\necho built: $*\n")
            (built / file).chmod(0o755)
        assert call(root / "run", "grade", "--help").stdout == "built: grade --help\n"
        assert "is not built yet" in call(root / "run", "dig", "--help").stdout
        assert call(root / "run", "none", "-h").stdout == "built: none -h\n"


def commands(graben, *path):
    """Every command that some help lists, with its help."""
    said = call(graben, *path, "--help").stdout
    yield path, said
    listed = re.search(r"^Commands:\n((?: .*\n)+)", said, re.MULTILINE)
    for name in re.findall(r"^  (\S+)", listed[1], re.MULTILINE) if listed else []:
        yield from commands(graben, *path, name)


def helps(graben):
    """80 columns, an example whose options are real and whose values pass, what is shipped."""
    all_commands = list(commands(graben))
    options = {path: set(re.findall(r"--[a-z][a-z-]*", said.split("\nExample")[0])) for path, said in all_commands}
    for path, said in all_commands:
        wide = [line for line in said.splitlines() if len(line) > WIDTH]
        assert not wide, f"{path}: wider than {WIDTH}: {wide}"
        assert not LIBRARIES.search(said), f"{path}: a library speaks: {said}"
        examples = re.findall(r"^  graben (.*)$", said, re.MULTILINE)
        assert examples, f"{path}: no example"
        for example in examples:
            typed = example.split(" < ")[0].split()
            of = max((known for known in options if tuple(typed[:len(known)]) == known), key=len)
            unknown = {word for word in typed if word.startswith("--")} - options[of]
            done = call(graben, *typed, "--help")
            assert not unknown and done.returncode == 0, f"{example}: {unknown} {done.stderr}"
        if "--profile" in options[path] or not path:
            assert shipped_profiles(said) == SHIPPED, path
        if "--task" in options[path] or not path:
            assert re.search(r"Shipped tasks: .*flatten.*trench", said), path
    assert len(all_commands) >= 22, len(all_commands)
    print(f"{len(all_commands)} helps within {WIDTH} columns, each with an example")


def slips(graben):
    refused(graben, "'dgi' is no command; did you mean 'dig'?", "dgi", status=2)
    refused(graben, "'autodgi' is no command; did you mean 'autodig'?", "autodgi", "--task", "flatten", status=2)
    refused(graben, "'mrege' is no command; did you mean 'merge'?", "campaign", "mrege", status=2)
    refused(graben, "--sped is no option; did you mean '--speed'?", "dig", "--sped", "0.5", status=2)
    refused(graben, "did you mean '--strokes'?", "pose", "--profile", "excavator_22t", "--stroks", "1,1,1", status=2)
    refused(graben, "did you mean 'excavator_22t'?", "dig", "--profile", "excavater_22t")
    refused(graben, "did you mean 'flatten'?", "autodig", "--task", "flaten")
    refused(graben, "did you mean 'trench'?", "autodig", "--task", "trnch")
    for needle, typed in (("graben: 'campaing' is no command; did you mean 'campaign'?", "campaing dig"),
                          ("graben: 'help' is no command; did you mean '--help'?", "help dig"),
                          ("graben: 'version' is no command; did you mean '--version'?", "version"),
                          ("graben: --speed is no option here; options come after the command", "--speed 0.5 dig"),
                          ("graben: --versoin is no option; did you mean '--version'?", "--versoin"),
                          ("'sad' is none of sand, loam, clay, stones; did you mean 'sand'?", "grade --soil sad"),
                          ("graben campaign: 'foo' is no command\n", "campaign foo dig --summary x"),
                          ("graben: 'plann' is no command; did you mean 'plan'?", "plann scope")):
        refused(graben, needle, *typed.split(), status=2)
    done = call(graben, "xyzzyplugh")
    assert done.returncode == 2 and "did you mean" not in done.stderr, done.stderr


def own_words(graben, folder):
    """Kinds of bad input; refused() also holds each to words of our own."""
    refused(graben, "which command? check, dig,", status=2)
    refused(graben, "--x: five is not a number", "strokes", "--profile", "excavator_22t", "--x", "five", "--y", "0",
            "--attitude", "1", status=2)
    refused(graben, "3 values are wanted", "pose", "--profile", "excavator_22t", "--strokes", "1,2", status=2)
    refused(graben, "one value is wanted", "plan", "--speed", status=2)
    refused(graben, "'fuzzy' is none of servo, oil, kim", "dig", "--law", "fuzzy", status=2)
    refused(graben, "--task: not with --air", "dig", "--air", "--task", "flatten", status=2)
    refused(graben, "only with --can", "commission", "--keyboard", status=2)
    refused(graben, "only one of these: --soil, --air", "dig", "--soil", "--air", status=2)
    refused(graben, "0 is not a whole number from 1 to 1000", "autodig", "--rounds", "0", status=2)
    refused(graben, "at byte 2", "solve", text="{oops\n")
    (folder / "no.toml").write_text('kind = "excavator"\n[boom\n', encoding="ascii")
    refused(graben, "no.toml: 1 error:\n  line 2, column", "check", "no.toml", folder=folder)
    refused(graben, "can't be read as TOML: [boom", "check", "no.toml", folder=folder)
    (folder / "twice.toml").write_text('kind = "excavator"\nkind = "dozer"\n', encoding="ascii")
    refused(graben, 'is there for the second time: kind = "dozer"', "check", "twice.toml", folder=folder)
    (folder / "a_file").write_text("kept", encoding="ascii")
    for command in (["dig"], ["grade"], ["autodig"], ["plan"], ["check", "excavator_22t"]):
        refused(graben, "a_file", *command, "--out", "a_file/under", folder=folder)
    refused(graben, "there is no such file", "campaign", "merge", "none.csv", "--summary", "all.csv", folder=folder)
    (folder / "a.csv").write_text("a,b\n", encoding="ascii")
    missing_files(graben, folder)
    other_sorts(graben, folder)
    shutil.copy(pathlib.Path(__file__).resolve().parents[2] / "app/machines/excavator_22t.toml", folder / "base.toml")
    (folder / "like.toml").write_text('kind = "excavator"\nlike = "base"\n', encoding="ascii")
    (folder / "other").mkdir()
    refused(graben, "allowed: a folder in which it is the same", "identify", "--out", "other/b.toml", "--log", "a.log",
            "--profile", "like.toml", folder=folder)
    refused(graben, "neither spools nor pressures are measured", "dig", "--without", "spool,pressure", folder=folder)
    refused(graben, "is no campaign", "campaign", "merge", "a.csv", "--summary", "all.csv", folder=folder)


def never_overwritten(graben, folder):
    """Neither log nor report is where the figures go, whatever the name is written like."""
    for command, name in (("dig", "dig"), ("autodig", "autodig"), ("grade", "grade")):
        for end in ("log", "html"):
            path = folder / "kept" / f"{name}.{end}"
            path.parent.mkdir(exist_ok=True)
            path.write_text("kept", encoding="ascii")
            refused(graben, "would overwrite", command, "--out", "kept", "--summary", f"./kept/../kept/{name}.{end}",
                    folder=folder)
            assert path.read_text(encoding="ascii") == "kept", path
    refused(graben, "would overwrite", "grade", "--out", "new", "--log", "new/grade.html", folder=folder)
    for command, name in (("dig --soil", "kim9"), ("grade", "mononen7")):
        refused(graben, "would overwrite", *command.split(), "--figure", name, "--out", "new", "--summary",
                f"new/{name}.svg", folder=folder)
    # Links whose ends are not there yet.
    (folder / "link").symlink_to("new")
    (folder / "figures.json").symlink_to("link/../new/dig.log")
    for options in ("--out new --summary link/dig.log", "--out link --summary new/dig.html",
                    "--out new --summary figures.json"):
        refused(graben, "would overwrite", "dig", *options.split(), folder=folder)
    (folder / "circle").symlink_to("circle")
    refused(graben, "circle", "dig", "--out", "circle", "--summary", "circle", folder=folder)
    assert not (folder / "new").exists(), "a refused command has made a folder"
    (folder / "old.log").write_text("kept", encoding="ascii")
    refused(graben, "old.log: is there already; --force overwrites it", "commission", "--log", "old.log", folder=folder)
    assert (folder / "old.log").read_text(encoding="ascii") == "kept"


def figures_first(graben, folder):
    """A figure of another kind of run is refused before the run, which leaves nothing."""
    for needle, typed in (("--figure kim9: is of a run in soil; add --soil", "dig --figure kim11,kim9 --obstacle"),
                          ("--figure kim14: is of a run that meets", "dig --soil --figure kim14"),
                          ("--figure mononen9: is of a constant speed", "grade --figure mononen7,mononen9"),
                          ("--figure mononen7: is of a bounded speed", "grade --speed-mode constant --figure mononen7")):
        refused(graben, needle.replace("kim9", "kim11"), *typed.split(), "--out", "unmade", folder=folder)
        assert not (folder / "unmade").exists(), f"{typed}: the run was made"


def new_folders(graben, folder):
    """Whatever a command writes, its folder need not be there: the examples of the help hold in an empty one."""
    (folder / "empty").mkdir()
    bare = "--only bucket --no-steps --no-bursts --no-pairs"
    for typed in (f"commission --log a/machine.log {bare}", f"commission --log a/machine.log --force {bare}",
                  "campaign grade --draws 1 --summary b/draws.csv", "campaign merge b/draws.csv --summary c/all.csv",
                  "grade --out d --log e/grade.log --summary f/grade.json", "dig --loops 0.1 --summary g/dig.json",
                  "autodig --task flatten --summary h/autodig.json", "export out/dig.log --mcap i/dig.mcap"):
        done = call(graben, *typed.split(), folder=folder / "empty")
        assert done.returncode == 0, f"{typed}: {done.stderr}"
        for file in re.findall(r"[a-i]/\w+\.\w+", typed):
            assert (folder / "empty" / file).stat().st_size > 0, f"{typed}: no {file}"
    call(graben, "plan", folder=folder / "empty")
    # A machine with IMUs: nothing is left out.
    call(graben, "dig", "--loops", "0.1", "--sensors", "imu", folder=folder / "empty")
    said = call(graben, "export", "out/dig.log", "--mcap", "i/imu.mcap", folder=folder / "empty").stdout
    assert "left out" not in said, said
    for file in ("g/dig.json", "f/grade.json", "h/autodig.json", "out/plan.json", "out/plan.csv"):
        text = (folder / "empty" / file).read_text(encoding="ascii")
        dirty = re.findall(r"-?0\.\d*0000000\d|\d\.\d*9999999\d|\d\.\d{16,}|(?<![\d.e])-0(?:\.0)?(?![\d.])", text)
        assert not dirty, f"{file}: {dirty}"


def profile_slips(graben, folder):
    """Numbers as they were written, a degree given as radian, a key that is nearly one."""
    text = (MACHINES / "excavator_22t.toml").read_text(encoding="utf-8")

    def slip(pattern, to, needle):
        changed, count = re.subn(pattern, to, text, count=1, flags=re.MULTILINE)
        assert count == 1, pattern
        (folder / "slip.toml").write_text(changed, encoding="utf-8")
        refused(graben, needle, "check", "slip.toml", folder=folder)

    slip(r"^attitude_gain = .*", "attitude_gain = 1006.2", "1006.2 is out of range")
    slip(r"^angle = .*", "angle = [-45.0, 71.6]", "in degrees? then it is -0.7854 rad")
    (folder / "turn.toml").write_text(re.sub(r"^range = .*", "range = [-180.0, 180.0]",
                                             (MACHINES / "excavator_12t.toml").read_text(encoding="utf-8"),
                                             flags=re.MULTILINE), encoding="utf-8")
    refused(graben, "turn.toml: 2 errors:", "check", "turn.toml", folder=folder)
    for name in SHIPPED:
        wide = [line for line in call(graben, "check", name, folder=folder).stdout.splitlines() if len(line) > 100]
        assert not wide, f"check {name}: {wide}"
    slip(r"^attitude_gain", "atitude_gain", "unknown key; did you mean 'control.attitude_gain'?")
    machine = ("--profile", "excavator_22t")
    refused(graben, "in degrees? then it is 1.571 rad", "strokes", *machine, "--x", "5", "--y", "0", "--attitude", "90")
    refused(graben, "in degrees? then it is 0.7854 rad", "pose", *machine, "--strokes", "1,1,0.4", "--swing", "45")
    refused(graben, "in degrees? then it is 1.047 rad", "dig", "--start", "5,0,60", folder=folder)
    refused(graben, "in degrees? then it is 1.047 rad", "autodig", "--start", "5,0,0,60", folder=folder)
    refused(graben, "--to: attitude: 60 rad", "plan", "--to", "5,0,0,60", folder=folder)


def missing_files(graben, folder):
    """One wording, whatever reads the file: which it is, what was expected, where that comes from."""
    profile = ("--profile", "excavator_22t")
    for wanted, *command in (("a log (candump -L), such as graben dig", "compare", "NONE", "NONE"),
                             ("a log (candump -L), such as graben dig", "export", "NONE", "--mcap", "a.mcap"),
                             ("a log (candump -L), such as graben dig", "film", "NONE", "--out", "a.webm"),
                             ("a log (candump -L), such as graben dig", "scope", "--log", "NONE"),
                             ("a log (candump -L), such as graben dig", "identify", "--log", "NONE", *profile,
                              "--out", "new.toml"),
                             ("recorded motion, a CSV", "identify", "--csv", "NONE", "--summary", "s.json"),
                             ("a campaign's draws, as graben campaign", "campaign", "merge", "NONE", "--summary", "m"),
                             ("a campaign on a cluster; graben campaign", "campaign", "progress", "NONE"),
                             ("a design: LandXML, DXF, points", "grade", "--design", "NONE"),
                             ("a file or one of dozer_9t", "check", "NONE"),
                             ("a file or one of dozer_9t", "dig", "--profile", "NONE"),
                             ("excavator_22t_found", "dig", "--simulated", "NONE"),
                             ("a file or one of bench", "dig", "--task", "NONE"),
                             ("a file or one of aux_valves", "dig", "--bus", "NONE"),
                             ("a file or one of dozer_9t", "new-machine", "--like", "NONE", "--out", "n.toml")):
        done = call(graben, *("none.x" if word == "NONE" else word for word in command), folder=folder)
        assert done.returncode == 1 and "there is no such file" in done.stderr, (command, done.stderr)
        assert "none.x" in done.stderr and "wanted: " in done.stderr and wanted in done.stderr, (command, done.stderr)
        assert "\n" not in done.stderr.strip(), (command, done.stderr)
        if wanted.startswith(("a log", "recorded", "a campaign's", "a design")):
            folder_told = call(graben, *("." if word == "NONE" else word for word in command), folder=folder)
            assert folder_told.returncode == 1 and f".: is a folder; wanted: {wanted}" in folder_told.stderr, folder_told


def other_sorts(graben, folder):
    """A file of ours in another's place is one error, not one for each key."""
    bus, task = MACHINES / "buses/zx200.toml", MACHINES / "tasks/trench.toml"
    machine, simulation = MACHINES / "excavator_22t.toml", MACHINES / "excavator_22t.sim.toml"
    for option, wanted, files in (("--profile", "a machine's profile", {bus: "a bus profile", task: "a task"}),
                                  ("--bus", "a bus profile", {machine: "a machine's profile", task: "a task",
                                                              simulation: "a simulated machine's file"}),
                                  ("--task", "a task", {machine: "a machine's profile", bus: "a bus profile"})):
        for file, sort in files.items():
            refused(graben, f"{file.name}: 1 error:\n  is {sort}; wanted: {wanted}\n", "dig", option, file, folder=folder)


def installed(graben, folder):
    """As in /usr: it finds what lies beside it, and knows nothing of where it was built."""
    root = folder / "installed"
    (root / "usr/bin").mkdir(parents=True)
    moved = root / "usr/bin/graben"
    shutil.copy(graben, moved)
    refused(moved, "graben-machine: not built; `./run pose` builds it", "pose", folder=folder)
    (root / "usr/libexec/graben").mkdir(parents=True)
    shutil.copy(pathlib.Path(graben).parent / "graben-machine", root / "usr/libexec/graben")
    pose = ("pose", "--profile", "excavator_22t", "--strokes", "1.0,1.1,0.4")
    refused(moved, "there is no such file", *pose, folder=folder)
    shutil.copytree(MACHINES, root / "usr/share/graben/machines")
    done = call(moved, *pose, folder=folder)
    assert done.returncode == 0 and '"x_m"' in done.stdout, done.stderr
    assert shipped_profiles(call(moved, "--help", folder=folder).stdout) == SHIPPED
    for place in (str(ROOT), os.path.expanduser("~")):
        if place != "/":
            program = moved.read_bytes()
            at = program.find(place.encode())
            assert at < 0, f"the program knows a folder of its builder: {program[at:at + 80]!r}"


def main():
    graben = pathlib.Path(sys.argv[1]).resolve()
    run_answers_without_a_build()
    helps(graben)
    slips(graben)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        own_words(graben, folder)
        never_overwritten(graben, folder)
        figures_first(graben, folder)
        new_folders(graben, folder)
        profile_slips(graben, folder)
        installed(graben, folder)
    print("help and slips are answered as they should")


if __name__ == "__main__":
    main()
