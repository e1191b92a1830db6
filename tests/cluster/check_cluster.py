# SPDX-License-Identifier: Apache-2.0
"""A campaign on Slurm beside the same in one process: with tasks killed, a node drained, a node lost and the
controller restarted, no row is lost, none is doubled, and the merged bytes are the single run's.

check_cluster.py GRABEN [--draws N] [--shards N] [--kills N] [--crash]
"""

import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import cluster

# The cheapest draw that there is.
TASK = """start = { position = [0.0, 6.866, 0.0], attitude = 2.268928 }

[[step]]
do = "dig"
to = { position = [0.0, 6.816, 0.0], attitude = 2.268928 }
duration = 0.5
"""


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("graben")
    parser.add_argument("--draws", type=int, default=300)
    parser.add_argument("--shards", type=int, default=8)
    parser.add_argument("--kills", type=int, default=5)
    parser.add_argument("--crash", action="store_true", help="kill the controller too, which then forgets jobs")
    parser.add_argument("--campaign", default="autodig --task {folder}/short.toml --errors stroke-bias",
                        help="kind and options; {folder} has a task of a second")
    return parser.parse_args()


def rows_of(file):
    return len(file.read_bytes().splitlines()) - 2 if file.exists() else 0


class Trial:
    def __init__(self, options, slurm, folder):
        self.options, self.slurm, self.folder = options, slurm, folder
        self.summary = folder / "all.csv"
        self.shards = folder / "all.csv.slurm"
        self.command = [options.graben, "campaign", *options.campaign, "--draws", str(options.draws), "--seed", "5"]
        self.done = []

    def graben(self, *words, status=0):
        done = self.slurm.call(*words)
        assert done.returncode == status, f"{words}: status {done.returncode}: {done.stdout}{done.stderr}"
        return done.stdout + done.stderr

    def submit(self, *words, status=0):
        return self.graben(*self.command, "--slurm", str(self.options.shards), "--summary", str(self.summary), *words,
                           status=status)

    def rows(self):
        return sum(rows_of(file) for file in self.shards.glob("shard-*.csv"))

    def tasks(self, of):
        """Processes of tasks at work: graben's own, or the shell's that started it."""
        sign = {"graben": " --shard ", "shell": "slurm_script"}[of]
        return [process for process, line in self.slurm.own_processes().items() if sign in line]

    def wait_for_rows(self, more):
        want = min(self.rows() + more, self.options.draws)
        self.slurm.wait_for(lambda: self.rows() >= want or self.summary.exists(), f"{want} rows", 600)

    def kill_any(self, of):
        """A task that has ended since it was seen is passed over."""
        tasks = self.tasks(of)
        for process in random.sample(tasks, len(tasks)):
            try:
                os.kill(process, signal.SIGKILL)
                self.done.append(f"{of} killed")
                return True
            except ProcessLookupError:
                pass
        return False

    def kill_one(self, of):
        self.slurm.wait_for(lambda: self.kill_any(of) or self.summary.exists(), "task at work", 600)

    def kills(self):
        return sum(event in ("graben killed", "shell killed") for event in self.done)

    def restart_controller(self):
        self.slurm.end("slurmctld")
        # Without a controller none follows that has ended: it is not waited for.
        self.kill_any("graben")
        self.slurm.start_controller()
        self.done.append("controller restarted")

    def lose_controller(self):
        """It forgets what it has not saved: jobs, and which task had which id."""
        self.slurm.kill("slurmctld")
        self.slurm.start_controller()
        self.done.append("controller killed")

    def drain_node(self):
        self.graben("scontrol", "update", "NodeName=one", "State=DRAIN", "Reason=tried")
        self.wait_for_rows(2)
        # A controller that was restarted may have done so already.
        self.slurm.call("scontrol", "update", "NodeName=one", "State=RESUME")
        self.slurm.wait_for(lambda: "dr" not in self.slurm.call("sinfo", "-h", "-n", "one", "-o", "%t").stdout,
                            "node at work again", 600)
        self.done.append("node drained")

    def lose_node(self):
        """Its daemon is gone, its tasks go on: Slurm gives them to the other node meanwhile."""
        self.slurm.kill("two")
        self.slurm.wait_for(lambda: "down" in self.slurm.call("sinfo", "-h", "-n", "two", "-o", "%t").stdout or
                            self.summary.exists(), "lost node", 600)
        self.slurm.start_node("two")
        self.done.append("node lost")

    def trouble(self):
        events = {0: self.restart_controller, 1: self.drain_node, self.options.kills - 1: self.lose_node}
        if self.options.crash:
            events[2] = self.lose_controller
        share = self.options.draws // (self.options.kills + 2)
        for kill in range(3 * self.options.kills):
            # All of the events too: the controller's restart kills one more than it counts here.
            if self.summary.exists() or min(kill, self.kills()) >= self.options.kills:
                break
            self.wait_for_rows(share // 2)
            self.kill_one("shell" if kill % 3 == 2 else "graben")
            events.get(kill, lambda: None)()
        print(f"{self.rows()} rows when the last was killed: {', '.join(self.done)}", flush=True)


def refusals(trial):
    """Wrong campaigns are refused before anything is submitted or left."""
    for words, needle in ((("--profile", "excavater_12t"), "did you mean 'excavator_12t'"),
                          (("--shard", "1/2"), "not with --s"), (("--sbatch=--partition=none",), "partition")):
        done = trial.slurm.call(*trial.command, "--slurm", "2", "--summary", str(trial.folder / "bad.csv"),
                                *words)
        assert done.returncode != 0 and needle in done.stderr, f"{words}: {done.stderr}"
    shutil.rmtree(trial.folder / "bad.csv.slurm", ignore_errors=True)
    said = trial.graben(trial.options.graben, "campaign", "progress", str(trial.folder / "bad.csv"), status=1)
    assert "there is no such file" in said, said
    without = subprocess.run([*trial.command, "--slurm", "2", "--summary", str(trial.folder / "bad.csv")],
                             capture_output=True, text=True, env={**trial.slurm.environment, "PATH": "/nowhere"})
    assert without.returncode == 1 and "slurm-client" in without.stderr, without.stderr


def same_bytes(trial, single):
    merged, alone = trial.summary.read_bytes(), single.read_bytes()
    seeds = [line.split(b",")[0] for line in merged.splitlines()[2:]]
    assert len(set(seeds)) == len(seeds) == trial.options.draws, f"{len(seeds)} rows, {len(set(seeds))} seeds"
    assert merged == alone, "the merged file is not the single run's"


def main():
    options = parse()
    options.graben = str(pathlib.Path(options.graben).resolve())
    cluster.skip_without()
    random.seed(1)
    with tempfile.TemporaryDirectory(prefix="graben_cluster_") as name:
        folder = pathlib.Path(name)
        (folder / "short.toml").write_text(TASK, encoding="ascii")
        options.campaign = options.campaign.format(folder=folder).split()
        single = folder / "single.csv"
        slurm = cluster.Cluster(folder)
        trial = Trial(options, slurm, folder)
        alone = subprocess.Popen([*trial.command, "--jobs", "1", "--summary", str(single)], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True)
        try:
            slurm.start()
            refusals(trial)
            began = time.monotonic()
            print(trial.submit(), end="", flush=True)
            said = trial.submit(status=1)
            assert "in the queue already" in said, said
            trial.trouble()
            said = trial.graben(options.graben, "campaign", "progress", str(trial.summary), "--wait")
            assert f"{options.draws} of {options.draws} draws (100.0 %)" in said and "merged" in said, said
            print(f"{said.strip()} after {time.monotonic() - began:.0f} s", flush=True)
            killed = trial.kills()
            assert killed >= options.kills, f"only {killed} kills: {trial.done}"
            assert "is there already" in trial.submit(status=1)
        except BaseException:
            print(slurm.last_words(), flush=True)
            for file in sorted(folder.glob("all.csv.slurm/*.txt")):
                print(file.name, file.read_text(errors="replace")[-600:], flush=True)
            raise
        finally:
            slurm.stop(but=alone.pid)
            if sys.exc_info()[0]:
                alone.kill()
        out, err = alone.communicate()
        assert alone.returncode == 0, err
        print(f"{out.splitlines()[0]}: in one process", flush=True)
        same_bytes(trial, single)
    print(f"{options.draws} draws in {options.shards} shards, {killed} kills: the bytes of one process")


if __name__ == "__main__":
    main()
