# SPDX-License-Identifier: Apache-2.0
"""A cluster of Slurm on this machine, in a folder of its own: munged, slurmctld and one slurmd a node, from
Debian's packages. It touches no daemon and no file of the system, and ends what it started."""

import getpass
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import time

PROGRAMS = {"munged": "munge", "slurmctld": "slurmctld", "slurmd": "slurmd", "sbatch": "slurm-client"}
# Of its nodes. More tasks at a time than processors: they wait for each other anyhow.
NODES = ("one", "two")
SLOTS = 3
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"


def program(name):
    return shutil.which(name, path=PATH)


def skip_without():
    missing = [package for name, package in PROGRAMS.items() if not program(name)]
    if missing:
        print(f"SKIPPED cluster: not there: {' '.join(missing)} (Debian's packages)", flush=True)
        sys.exit(1 if os.environ.get("CI") == "true" else 0)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.daemons = {}
        for name in ("state", *NODES):
            (self.folder / name).mkdir()
        self.folder.chmod(0o755)
        self.socket = self.folder / "munge.socket"
        self.environment = {**os.environ, "PATH": PATH, "SLURM_CONF": str(self.folder / "slurm.conf")}
        for variable in [name for name in self.environment if name.startswith(("SBATCH_", "SLURM_JOB", "SQUEUE_"))]:
            del self.environment[variable]
        self.configure()

    def configure(self):
        host, user = socket.gethostname().split(".")[0], getpass.getuser()
        controller, *ports = free_ports(1 + len(NODES))
        nodes = "\n".join(f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs={SLOTS}"
                          for name, port in zip(NODES, ports))
        (self.folder / "slurm.conf").write_text(f"""ClusterName=graben
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={self.socket},cred_expire=5
CredType=cred/munge
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/%n
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/%n.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/%n.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
SchedulerParameters=sched_min_interval=100000
SlurmdTimeout=10
SlurmctldTimeout=5
MessageTimeout=10
InactiveLimit=0
KillWait=5
MinJobAge=30
ReturnToService=2
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""", encoding="ascii")

    def spawn(self, name, *words):
        with open(self.folder / f"{name}.out", "ab") as out:
            self.daemons[name] = subprocess.Popen([program(words[0]), *words[1:]], stdin=subprocess.DEVNULL,
                                                  stdout=out, stderr=out, env=self.environment,
                                                  start_new_session=True)

    def start(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        self.spawn("munged", "munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.socket}",
                   f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                   f"--seed-file={self.folder}/munged.seed")
        self.wait_for(self.socket.exists, "munged's socket")
        self.start_controller()
        for node in NODES:
            self.start_node(node)
        self.wait_for(lambda: self.call("sinfo", "-h", "-o", "%D %t").stdout.split() == [str(len(NODES)), "idle"],
                      "idle nodes")

    def start_controller(self):
        """Until it answers: what asks it next has one answer only."""
        self.spawn("slurmctld", "slurmctld", "-D", "-f", self.environment["SLURM_CONF"])
        self.wait_for(lambda: self.call("sinfo", "-h").returncode == 0, "controller that answers")

    def start_node(self, node):
        self.spawn(node, "slurmd", "-D", "-N", node, "-f", self.environment["SLURM_CONF"])

    def end(self, name):
        self.daemons[name].terminate()
        self.daemons.pop(name).wait(600)

    def kill(self, name):
        """With SIGKILL, as a machine that loses its power."""
        self.daemons[name].kill()
        self.daemons.pop(name).wait()

    def call(self, *words):
        return subprocess.run([program(words[0]) or words[0], *words[1:]], capture_output=True, text=True,
                              env=self.environment)

    def wait_for(self, is_so, what, most_s=600):
        until = time.monotonic() + most_s
        while not is_so():
            if time.monotonic() > until:
                raise TimeoutError(f"no {what} after {most_s} s; {self.last_words()}")
            time.sleep(0.2)

    def last_words(self):
        return "\n".join(f"{log.name}: {log.read_text(errors='replace')[-400:]}"
                         for log in sorted(self.folder.glob("*.log")))

    def own_processes(self, but=0):
        """Process ids whose command line or environment has this folder: all that it started, wherever they are."""
        found = {}
        for place in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                line = (place / "cmdline").read_bytes()
                if str(self.folder).encode() in line + (place / "environ").read_bytes():
                    found[int(place.name)] = line.replace(b"\0", b" ").decode(errors="replace")
            except OSError:
                pass
        for other in (os.getpid(), but):
            found.pop(other, None)
        return found

    def stop(self, but=0):
        for name in reversed(list(self.daemons)):
            self.daemons[name].terminate()
        until = time.monotonic() + 10
        while self.own_processes(but) and time.monotonic() < until:
            for daemon in self.daemons.values():
                daemon.poll()
            time.sleep(0.2)
        # What a killed node's daemon has left behind; killed is not gone yet.
        self.wait_for(lambda: not self.kill_all(self.own_processes(but)), "end of what was started")
        for daemon in self.daemons.values():
            daemon.wait()
        self.daemons.clear()

    @staticmethod
    def kill_all(processes):
        for process in processes:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        return processes
