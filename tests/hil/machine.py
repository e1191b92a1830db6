# SPDX-License-Identifier: Apache-2.0
"""The virtual machine: QEMU with Debian's PREEMPT_RT kernel, without KVM.

Its clock counts instructions (-icount): one takes 4 ns, and while nothing runs, time jumps to the
next event. A busy host makes it slow, but within the guest nothing is ever late for it; the guest
can also be faster than real time. Measured on a host with 3 jobs on 2 processors, 10 ms period,
SCHED_FIFO, guest idle / loaded: latest wake-up 22 / 23 us; with the host's clock instead, 12 / 36 ms.
"""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

import initramfs
import kernel
from scenario import ICOUNT_SHIFT, Broken, Nowhere, Result, Scenario, status_in

HERE = pathlib.Path(__file__).resolve().parent
MODULES = ["can", "can_raw", "can_bcm", "can_gw", "can_isotp", "vcan", "sch_netem",
           "virtio_pci", "9p", "9pnet_virtio"]
CONTROLLER_MODULES = ["kvaser_pci"]
# echo: vcan sends back to local sockets itself, as a controller does, so that what `tc netem` does to
# frames is seen by them.
PARAMETERS = {"vcan": "echo=1"}
TOOLS = ["ip", "tc", "candump", "cansend", "cangen", "canplayer", "cangw", "canfdtest",
         "isotprecv", "isotpsend", "chrt"]

KERNEL_OPTIONS = [
    "console=ttyS0", "quiet", "rdinit=/init",
    # A panic ends QEMU (-no-reboot), and an oops is one.
    "panic=-1", "oops=panic",
    # The same addresses in each run.
    "nokaslr",
    # Half of the boot's instructions: what the kernel tries of its own ciphers, its certificates.
    "cryptomgr.notests", "initcall_blacklist=init_kprobe_trace,load_system_certificate_list",
]
NS_PER_INSTRUCTION = 2**ICOUNT_SHIFT
QEMU_OPTIONS = [
    "-nodefaults", "-no-user-config", "-no-reboot", "-display", "none", "-serial", "stdio",
    # On the older "pc", ACPI's way to an interrupt costs a device a second.
    "-machine", "q35", "-accel", "tcg", "-smp", "1",
    # The wall clock follows the same count and starts at the same moment each time.
    "-rtc", "base=2026-01-01T00:00:00,clock=vm",
    # The seed of the kernel's random numbers, which are in its hash tables and addresses.
    "-seed", "1",
]
MEMORY_MB, MEMORY_WITH_ROOT_MB = 512, 1024
# Where a user's PATH may not lead.
SYSTEM_PATH = "/usr/sbin:/sbin"


def which(*names: str) -> pathlib.Path:
    for name in names:
        if path := shutil.which(name, path=f"{os.environ.get('PATH', '')}:{SYSTEM_PATH}"):
            return pathlib.Path(path)
    raise Nowhere(f"{names[0]} is missing; ./test installs it")


def prepare(cache: pathlib.Path) -> kernel.Kernel:
    """All that has to be there before a machine can start; Nowhere if it cannot be had."""
    if os.uname().machine != "x86_64":
        raise Nowhere(f"the guest is an x86_64, this host an {os.uname().machine}")
    for name in ("qemu-system-x86_64", "busybox", *TOOLS):
        which(name)
    try:
        return kernel.fetch(cache)
    except (kernel.NoKernel, OSError) as error:
        raise Nowhere(str(error)) from None


def own_programs(scenario: Scenario) -> initramfs.Tree:
    """Just what scenarios use; the scenario's programs among them."""
    tree = initramfs.Tree()
    for folder in ("bin", "dev", "mnt", "proc", "run", "sys", "tmp", "usr/sbin"):
        tree.add_folder(folder)
    tree.add_program("bin/busybox", which("busybox"))
    tree.add_program("usr/bin/sh", which("sh").resolve())
    for program in [*(which(tool) for tool in TOOLS), *scenario.programs]:
        tree.add_program(f"usr/bin/{program.name}", program)
    tree.add("init", (HERE / "init.sh").read_bytes(), 0o755)
    return tree


def beside_a_root() -> initramfs.Tree:
    """What a whole Debian lacks as a guest of ours."""
    tree = initramfs.Tree()
    tree.add_program("hil/busybox", which("busybox"))
    tree.add("init", (HERE / "init_systemd.sh").read_bytes(), 0o755)
    tree.add("hil/systemd.sh", (HERE / "systemd.sh").read_bytes())
    return tree


def guest_tree(guest_kernel: kernel.Kernel, scenario: Scenario) -> initramfs.Tree:
    tree = beside_a_root() if scenario.root else own_programs(scenario)
    wanted = [*MODULES, *(CONTROLLER_MODULES if scenario.controllers else []), *scenario.modules]
    order = guest_kernel.load_order(wanted)
    for name in order:
        tree.add(f"modules/{name}.ko", guest_kernel.modules[name].read_bytes())
    lines = [f"{name}.ko {PARAMETERS.get(name, '')}".rstrip() for name in order]
    tree.add("modules/order", "".join(f"{line}\n" for line in lines).encode())

    tree.add("hil/settings", f"limit_s={scenario.timeout_s:g}\n".encode())
    tree.add("hil/hil.sh", (HERE / "hil.sh").read_bytes())
    tree.add("hil/scenario", scenario.script.read_bytes())
    for name, path in scenario.files.items():
        tree.add(f"hil/{name}", path.read_bytes(), path.stat().st_mode & 0o777)
    return tree


def command(image: pathlib.Path, ramdisk: str, scenario: Scenario, out: pathlib.Path) -> list[str]:
    # QEMU reads a comma as the end of a value, two as one comma.
    shared = str(out.resolve()).replace(",", ",,")
    controllers = ["-device", "kvaser_pci,canbus=bus"] * scenario.controllers
    if controllers:
        controllers = ["-object", "can-bus,id=bus", *controllers]
    # timeout, so that no machine is left over where this process is killed.
    return ["timeout", "--signal=KILL", f"{scenario.patience_s:g}",
            str(which("qemu-system-x86_64")), *QEMU_OPTIONS, *controllers,
            "-icount", f"shift={scenario.icount_shift},sleep=off",
            "-m", str(MEMORY_WITH_ROOT_MB if scenario.root else MEMORY_MB),
            "-kernel", str(image), "-initrd", ramdisk, "-append", " ".join(KERNEL_OPTIONS),
            "-virtfs", f"local,path={shared},mount_tag=share,security_model=none"]


def boot(arguments: list[str], console: pathlib.Path) -> int:
    """Runs QEMU to its end; its exit status."""
    with open(console, "wb") as stream:
        process = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=stream,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        try:
            return process.wait()
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()


def run(guest_kernel: kernel.Kernel, scenario: Scenario, out: pathlib.Path) -> Result:
    started = time.monotonic()
    with tempfile.NamedTemporaryFile(suffix=".cpio") as ramdisk:
        if scenario.root:
            # One archive after the other: the kernel unpacks both.
            with open(scenario.root, "rb") as root:
                shutil.copyfileobj(root, ramdisk)
        try:
            ramdisk.write(guest_tree(guest_kernel, scenario).pack())
        except initramfs.MissingLibrary as error:
            raise Broken(f"library not found: {error}") from None
        ramdisk.flush()
        status = boot(command(guest_kernel.image, ramdisk.name, scenario, out), out / "console.txt")
    wall_s = time.monotonic() - started

    console = (out / "console.txt").read_text(encoding="utf-8", errors="replace")
    verdict = out / "guest-status"
    # timeout ends itself by the signal it sends.
    if status in (-signal.SIGKILL, 128 + signal.SIGKILL):
        raise Broken(f"the guest was stopped after {scenario.patience_s:g} s of the host's time")
    if status != 0:
        raise Broken(f"QEMU ended with status {status}")
    ended = status_in(verdict.read_text(encoding="ascii") if verdict.exists() else None, console)
    return Result(ended, "vm", console, wall_s)
