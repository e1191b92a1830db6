# SPDX-License-Identifier: Apache-2.0
"""The parts of the harness that need no machine."""

import pathlib
import shutil
import stat
import struct
import subprocess
import tempfile
import unittest

import host
import initramfs
import kernel
import scenario

DEPENDS = """linux-image-rt-amd64
  Depends: linux-image-6.1.0-56-rt-amd64
  Conflicts: <linux-latest-modules-6.1.0-56-rt-amd64>
"""
LDD = """\tlinux-vdso.so.1 (0x00007ffd)
\tlibm.so.6 => /lib/x86_64-linux-gnu/libm.so.6 (0x00007f51)
\tlibc.so.6 => /lib/x86_64-linux-gnu/libc.so.6 (0x00007f50)
\t/lib64/ld-linux-x86-64.so.2 (0x00007f52)
"""


class Package(unittest.TestCase):
    def test_the_versioned_package_is_what_the_metapackage_depends_on(self):
        self.assertEqual(kernel.versioned_package(DEPENDS), "linux-image-6.1.0-56-rt-amd64")

    def test_no_package_is_no_kernel(self):
        for listing in ("", "linux-image-rt-amd64\n  Depends: linux-base\n"):
            with self.assertRaises(kernel.NoKernel):
                kernel.versioned_package(listing)

    def test_what_is_no_kernel_is_refused(self):
        image = bytearray(4096)
        struct.pack_into("<II", image, 0x248, 0, 100)
        with self.assertRaises(kernel.NoKernel):
            kernel.unpacked(bytes(image))


class Modules(unittest.TestCase):
    def test_a_module_says_what_it_needs(self):
        module = b"\x7fELF..\0license=GPL\0depends=sja1000,can-dev\0name=kvaser_pci\0"
        self.assertEqual(kernel.dependencies(module), ["sja1000", "can_dev"])
        self.assertEqual(kernel.dependencies(b"\0depends=\0"), [])
        self.assertEqual(kernel.dependencies(b"nothing"), [])

    def test_each_comes_after_what_it_needs_and_once(self):
        needs = {"kvaser_pci": ["sja1000"], "sja1000": ["can_dev"], "can_dev": [],
                 "vcan": ["can_dev"], "other": []}
        self.assertEqual(kernel.load_order(["vcan", "kvaser-pci", "vcan"], needs),
                         ["can_dev", "vcan", "sja1000", "kvaser_pci"])

    def test_a_missing_one_is_told_with_who_wanted_it(self):
        with self.assertRaisesRegex(kernel.NoKernel, "no module vcan -> can_dev"):
            kernel.load_order(["vcan"], {"vcan": ["can_dev"]})

    def test_a_circle_ends(self):
        with self.assertRaisesRegex(kernel.NoKernel, "a -> b -> a"):
            kernel.load_order(["a"], {"a": ["b"], "b": ["a"]})


class Archive(unittest.TestCase):
    def test_libraries_are_those_with_a_path(self):
        self.assertEqual(initramfs.libraries_in(LDD),
                         ["/lib/x86_64-linux-gnu/libm.so.6", "/lib/x86_64-linux-gnu/libc.so.6",
                          "/lib64/ld-linux-x86-64.so.2"])

    def test_a_library_that_is_gone_is_told(self):
        with self.assertRaisesRegex(initramfs.MissingLibrary, "libgone.so"):
            initramfs.libraries_in("\tlibgone.so => not found\n")

    def test_newc(self):
        tree = initramfs.Tree()
        tree.add("/hil/a", b"12345", 0o600)
        packed = tree.pack()
        self.assertEqual(len(packed) % 512, 0)
        folder, file = packed[:116], packed[116:]
        self.assertEqual(folder[:6] + folder[110:114], b"070701hil\0")
        self.assertEqual(int(folder[14:22], 16), stat.S_IFDIR | 0o755)
        self.assertEqual(int(file[14:22], 16), stat.S_IFREG | 0o600)
        self.assertEqual(int(file[54:62], 16), 5)
        # 110 bytes of header and "hil/a" with its end make 116; then the content, filled up to 8.
        self.assertEqual(file[110:124], b"hil/a\0" + b"12345\0\0\0")
        self.assertIn(b"TRAILER!!!", file)

    def test_a_program_brings_its_libraries(self):
        tree = initramfs.Tree()
        tree.add_program("usr/bin/sh", pathlib.Path("/bin/sh").resolve())
        self.assertTrue(any(path.endswith("libc.so.6") for path in tree.entries))
        with tempfile.NamedTemporaryFile("w") as script:
            script.write("#!/bin/sh\n")
            script.flush()
            self.assertEqual(initramfs.libraries_of(pathlib.Path(script.name)), [])


class Verdict(unittest.TestCase):
    def test_status(self):
        self.assertEqual(scenario.status_in("exit 0\n", ""), 0)
        self.assertEqual(scenario.status_in("exit 3\n", ""), 3)
        self.assertEqual(scenario.status_in("timeout\n", ""), scenario.TIMED_OUT)

    def test_anything_else_is_no_success(self):
        for verdict in ("", "exit \n", "results lost\n", "exit 0\nexit 1\n"):
            with self.assertRaises(scenario.Broken):
                scenario.status_in(verdict, "")

    def test_a_panic_is_named(self):
        with self.assertRaisesRegex(scenario.Broken, "not syncing: Attempted to kill init"):
            scenario.status_in(None, "[ 1.0] Kernel panic - not syncing: Attempted to kill init!\n")
        with self.assertRaisesRegex(scenario.Broken, "without a result"):
            scenario.status_in(None, "graben-hil: begin\n")


def may_unshare() -> bool:
    return shutil.which("unshare") is not None and subprocess.run(
        [*host.OWN_WORLD, "true"], capture_output=True, check=False).returncode == 0


@unittest.skipUnless(may_unshare(), "no network and processes of one's own here")
class OnTheHost(unittest.TestCase):
    """Only how a script is run and ends: whether the host has vcan does not matter."""

    def run_script(self, text: str, timeout_s: float = 30.0) -> tuple[scenario.Result, str]:
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder, "script")
            script.write_text(text)
            out = pathlib.Path(folder, "out")
            out.mkdir()
            result = host.run(scenario.Scenario(script, programs=[pathlib.Path("/bin/true")],
                                                files={"a/b": script}, timeout_s=timeout_s), out)
            left = out / "left"
            return result, left.read_text() if left.exists() else ""

    def test_status_results_files_and_an_empty_network(self):
        result, left = self.run_script(
            '. ./hil.sh; test -e a/b || exit 9; true; echo $HIL_WHERE '
            '>"$OUT/left"; ip -o link | wc -l; exit 3')
        self.assertEqual((result.status, result.where, left), (3, "host", "host\n"))
        self.assertEqual(result.console.split()[-1], "1")

    def test_one_that_hangs_is_stopped_with_all_it_has_started(self):
        result, _ = self.run_script("sleep 1234.5 & sleep 1000", timeout_s=0.5)
        self.assertEqual(result.status, scenario.TIMED_OUT)
        listing = subprocess.run(["ps", "-e", "-o", "args"], capture_output=True, text=True)
        self.assertNotIn("sleep 1234.5", listing.stdout)


if __name__ == "__main__":
    unittest.main()
