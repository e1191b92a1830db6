# SPDX-License-Identifier: Apache-2.0
"""`graben campaign`: shards merge to the same bytes as one run, an interrupted campaign goes on where
it stopped, and what is not a campaign is refused."""

import os
import resource
import signal
import subprocess
import sys
import tempfile
import time

DRAWS = 6


def used_s():
    """The processor's time of all that has ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def start(graben, *arguments):
    return subprocess.Popen([graben, "campaign", *arguments], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def call(graben, *arguments, status=0):
    process = start(graben, *arguments)
    out, err = process.communicate()
    assert process.returncode == status, f"{arguments}: status {process.returncode}: {err}"
    return out, err


class Kind:
    """A kind of campaign, what its file and its table begin with, and options that make it another."""

    def __init__(self, name, profile, words, others):
        self.name, self.profile, self.words, self.others = name, profile, words, others

    def run(self, graben, file, *options, status=0):
        return call(graben, self.name, "--draws", str(DRAWS), "--seed", "11", "--summary", file,
                    *options, status=status)


DIG = Kind("dig", "excavator_22t", "path error of the true tip, max", (("--soil",), ("--soil", "sand"), ("--speed", "0.5")))
GRADE = Kind("grade", "dozer_9t", "true edge over the grade, max",
             (("--speed-mode", "constant"), ("--speed", "0.5"), ("--engine-rpm", "1400")))


def content(file):
    with open(file, "rb") as stream:
        return stream.read()


def shards_merge(graben, folder, kind):
    whole = os.path.join(folder, "whole.csv")
    table, _ = kind.run(graben, whole)
    for word in ("median", "p95", "max", f"{DRAWS} of {DRAWS} draws done", kind.words):
        assert word in table, table
    lines = content(whole).decode().splitlines()
    assert len(lines) == 2 + DRAWS and lines[0].startswith(f"# {kind.name} {kind.profile} "), lines
    assert [line.split(",")[0] for line in lines[2:]] == [str(11 + n) for n in range(DRAWS)]
    assert len({line.split(",", 1)[1] for line in lines[2:]}) == DRAWS, "draws are alike"
    parts = []
    for index in ("1/2", "2/2"):
        parts.append(os.path.join(folder, f"part{index[0]}.csv"))
        kind.run(graben, parts[-1], "--shard", index, "--jobs", "1")
        assert len(content(parts[-1]).splitlines()) == 2 + DRAWS // 2
    merged = os.path.join(folder, "merged.csv")
    again, _ = call(graben, "merge", *reversed(parts), "--summary", merged)
    assert content(merged) == content(whole), "shards give other rows than one run"
    assert again == table, "shards give another table than one run"
    call(graben, "merge", parts[0], parts[0], "--summary", merged, status=1)
    assert content(merged) == content(whole), "a refused merge has changed its file"
    return whole


def goes_on(graben, folder, whole, kind):
    file = os.path.join(folder, "interrupted.csv")
    process = start(graben, kind.name, "--draws", str(DRAWS), "--seed", "11", "--jobs", "1",
                    "--summary", file)
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline:
        if os.path.exists(file) and len(content(file).splitlines()) >= 4:
            break
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=1800)
    rows = content(file).splitlines()[2:]
    assert process.returncode == 130 and "goes on" in err, (process.returncode, err)
    assert 1 < len(rows) < DRAWS, f"{len(rows)} rows after the interruption"
    assert f"interrupted with {len(rows)} of {DRAWS} draws done" in err, err
    assert f", {len(rows)} of {DRAWS} draws done\n" in out, out
    # What a crash in the middle of a line leaves.
    with open(file, "ab") as stream:
        stream.write(content(whole).splitlines()[-1][:20])
    kind.run(graben, file)
    assert content(file) == content(whole), "the rest of the campaign differs from a whole one"
    # A file that is complete is computed from, not computed again.
    fresh = os.path.join(folder, f"fresh_{kind.name}.csv")
    taken_s = []
    for each in (fresh, file):
        began = used_s()
        kind.run(graben, each)
        taken_s.append(used_s() - began)
        assert content(each) == content(whole)
    assert taken_s[1] < 0.5 * taken_s[0], f"{taken_s} s of the processor for a new one, for none"


def failures_are_no_figures(graben, folder):
    file = os.path.join(folder, "failed.csv")
    out, err = call(graben, "dig", "--draws", "1", "--found", "pump_flow=0.1", "--summary",
                    file, status=1)
    row = content(file).decode().splitlines()[2].split(",")
    assert row[1] != "done" and not any(row[2:]), row
    assert "0 of 1 draws done" in out and "did not come to their end" in err, (out, err)


def one_at_a_time(graben, folder):
    file = os.path.join(folder, "busy.csv")
    first = start(graben, "dig", "--draws", "40", "--jobs", "1", "--summary", file)
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline and not os.path.exists(file):
        time.sleep(0.01)
    _, err = call(graben, "dig", "--draws", "40", "--summary", file, status=1)
    assert "another campaign" in err, err
    first.send_signal(signal.SIGTERM)
    first.communicate(timeout=1800)
    assert not os.path.exists(file + ".lock")


def no_cluster(graben, folder):
    """Slurm's programs are there and its controller is not: nothing stays that looks like a campaign."""
    programs = os.path.join(folder, "programs")
    os.mkdir(programs)
    for name in ("sbatch", "squeue", "scontrol"):
        with open(os.path.join(programs, name), "w", encoding="ascii") as stream:
            stream.write(f"#!/bin/sh\n[ {name} = squeue ] || {{ echo '{name}: error: no controller' >&2; exit 1; }}\n")
        os.chmod(os.path.join(programs, name), 0o755)
    summary = os.path.join(folder, "far", "x.csv")
    done = subprocess.run([graben, "campaign", "dig", "--draws", "2", "--slurm", "2", "--summary", summary],
                          capture_output=True, text=True, timeout=1800,
                          env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"})
    assert done.returncode == 1 and "no controller" in done.stderr, done
    assert not os.path.exists(summary + ".slurm"), os.listdir(summary + ".slurm")


def refuses(graben, folder, whole, kind):
    def refused(needle, file, *options):
        before = content(file)
        _, err = kind.run(graben, file, *options, status=1)
        assert needle in err, err
        assert content(file) == before, "a refused campaign has changed its file"

    for other in kind.others:
        refused("holds another campaign", whole, *other)
    for text, needle in (("something else\n", "is no campaign"),
                         (f"# {kind.name}\nseed,other\n", "line 2"),
                         (content(whole).decode() + "1,done\n", f"line {DRAWS + 3}: 2 cells"),
                         (content(whole).decode().replace("11,done", "11,dona"), "line 3"),
                         (content(whole).decode().replace("11,done", "x,done"), "is no seed"),
                         (content(whole).decode().replace("12,done", "11,done"), "second time")):
        file = os.path.join(folder, "bad.csv")
        with open(file, "w", encoding="ascii") as stream:
            stream.write(text)
        refused(needle, file)
    for option, value in (("--shard", "0/2"), ("--shard", "3/2"), ("--shard", "2"),
                          ("--shard", "a/b")):
        _, err = kind.run(graben, os.path.join(folder, "new.csv"), option, value, status=1)
        assert "i/n" in err, err
    for option, value in (("--draws", "0"), ("--draws", "-1"), ("--jobs", "0"),
                          ("--speed", "nan"), ("--errors", "some")):
        call(graben, kind.name, "--summary", os.path.join(folder, "new.csv"), option, value, status=2)
    call(graben, kind.name, "--summary", os.path.join(whole, "x.csv"), status=1)
    call(graben, "merge", os.path.join(folder, "missing.csv"), "--summary", whole, status=1)


def kinds_do_not_mix(graben, folder, dig, grade):
    merged = os.path.join(folder, "mixed.csv")
    for files in ((dig, grade), (grade, dig)):
        _, err = call(graben, "merge", *files, "--summary", merged, status=1)
        assert "other columns" in err, err
    slower = os.path.join(folder, "slower.csv")
    call(graben, "grade", "--draws", "1", "--speed", "1.0", "--summary", slower)
    _, err = call(graben, "merge", grade, slower, "--summary", merged, status=1)
    assert "holds another campaign" in err, err
    unknown = os.path.join(folder, "unknown.csv")
    with open(unknown, "w", encoding="ascii") as stream:
        stream.write("# swim whale\n")
    _, err = call(graben, "merge", unknown, "--summary", merged, status=1)
    assert "campaign of 'swim'" in err, err
    assert not os.path.exists(merged)
    call(graben, "dig", "--summary", os.path.join(folder, "x.csv"), "--soil", "--air", status=2)
    call(graben, "dig", "--summary", os.path.join(folder, "x.csv"), "--dead-time", "nan", status=2)


def main():
    graben = sys.argv[1]
    wholes = []
    with tempfile.TemporaryDirectory() as top:
        for kind in (DIG, GRADE):
            folder = os.path.join(top, kind.name)
            os.mkdir(folder)
            wholes.append(shards_merge(graben, folder, kind))
            goes_on(graben, folder, wholes[-1], kind)
            refuses(graben, folder, wholes[-1], kind)
        kinds_do_not_mix(graben, top, *wholes)
        folder = top
        failures_are_no_figures(graben, folder)
        one_at_a_time(graben, folder)
        no_cluster(graben, folder)
    print(f"{DRAWS} draws: whole, in shards and interrupted, the same rows")


if __name__ == "__main__":
    main()
