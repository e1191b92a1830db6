# SPDX-License-Identifier: Apache-2.0
"""That what is generated from the code tables and the frames' sources drifts unseen nowhere, and what is refused.

    test_codes.py ROOT_OF_THE_TREE
"""

import contextlib
import io
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop()).resolve()
sys.path.insert(0, str(ROOT / "can_dbc"))
import generate  # noqa: E402
import generate_all  # noqa: E402
from dbcgen import codes  # noqa: E402

COMMITTED = ("firmware/safety/README.md", "can_dbc/excavator.dbc", "can_dbc/dozer.dbc", "can_dbc/j1939.dbc",
             "can_dbc/zx200.dbc")
BUILT = ("firmware/core/generated/codes.hpp", "firmware/safety/generated/fault_rows.hpp",
         "app/runs/generated/code_texts.hpp", "app/scope/page/src/model/generated/limits.ts",
         "can_dbc/generated/common_dbc.hpp", "can_dbc/generated/excavator_dbc.hpp", "can_dbc/generated/dozer_dbc.hpp",
         "can_dbc/generated/j1939_dbc.hpp", "can_dbc/generated/zx200_dbc.hpp")
OUTPUTS = COMMITTED + BUILT
INPUTS = ("firmware/safety/faults.toml", "firmware/safety/limits.toml", "can_dbc/common.dbc.in",
          "can_dbc/excavator.dbc.in", "can_dbc/dozer.dbc.in", "can_dbc/j1939.dbc.in",
          "can_dbc/zx200.dbc.in")

# What is broken: file, what stands there, what takes its place, what is said.
REFUSED = {
    "a number twice": ("faults.toml", "code = 3\n", "code = 2\n", "[SwashMissing] has number 2 and not 3"),
    "a gap": ("faults.toml", "code = 46\n", "code = 47\n", "[Stalled] has number 47 and not 46"),
    "no text": ("faults.toml", 'text = "bus-off"\n', "", "[BusOff]: text is missing"),
    "an empty help": ("faults.toml", 'help = "Check the CAN interface of the ECU."', 'help = " "', "help is empty"),
    "a text twice": ("faults.toml", 'text = "bus-off"', 'text = "the bus is down"', "has the text of another"),
    "a key too many": ("faults.toml", "code = 12\n", "code = 12\nspn = 1\n", "[BusOff]: unknown key spn"),
    "an unknown reason": ("faults.toml", 'blocks = "Cycle"', 'blocks = "Cycles"', "blocks 'Cycles' is none of"),
    "an unknown reaction": ("faults.toml", 'reaction = "degrade"', 'reaction = "slow"', "reaction 'slow' is none of"),
    "an unknown failure mode": ("faults.toml", "fmi = 14", "fmi = 13", "fmi 13 is none of"),
    "a kind that is none": ("faults.toml", 'kinds = ["dozer"]', 'kinds = ["loader"]', "kinds are some of"),
    "a cut that goes on": ("faults.toml", 'blocks = "EngineSpeed"}', 'blocks = "EngineSpeed", cuts = "pilot"}',
                           "what cuts the pilot pressure stops"),
    "no word of the pilot pressure": ("faults.toml", 'reaction = "stop", pilot = "later"', 'reaction = "stop"',
                                      "pilot is missing"),
    "a pilot pressure that is none": ("faults.toml", 'pilot = "at once"', 'pilot = "soon"', "pilot 'soon' is none of"),
    "a stop with its pressure": ("faults.toml", 'pilot = "later"', 'pilot = "stays"', "goes after every stop"),
    "a cut that is not kept": ("faults.toml", '"kept", lamp = "red", fmi = 7', '"later", lamp = "red", fmi = 7',
                               "keeps the pilot pressure cut"),
    "no TOML": ("faults.toml", "[BusOff]", "[BusOff", "faults.toml: "),
    "a bit too far": ("limits.toml", "bit = 22", "bit = 32", "[Task] has number 32 and not 22"),
    "an unknown owner": ("limits.toml", 'of = "track"', 'of = "wheel"', "of 'wheel' is none of"),
    "a section too many": ("limits.toml", "[arm.Stroke]", "[more.Stroke]", "unknown section more"),
    "a line of no kind": ("common.dbc.in", "NODE Engine 0", "NODES Engine 0", "common.dbc.in:6: not understood"),
    "a signal twice": ("dozer.dbc.in", "SG_ Height ", "SG_ Position ", "signal Position is defined twice"),
    "an unknown unit": ("dozer.dbc.in", '"mm"', '"inch"', "unknown unit 'inch'"),
    "a range and names": ("common.dbc.in", "SG_ RealTime 36|2 {", "SG_ RealTime 36|2 [0|1] {", "either a range or"),
    "a start that is none": ("common.dbc.in", "[0|4294967295] plain\n", "[0|4294967295] plain start na\n",
                             "has no 'not available'"),
    "an id that is taken": ("dozer.dbc.in", "BO_ 0CFF5882", "BO_ 0CFF3082", "is defined twice"),
    "no such file": ("dozer.dbc.in", "INCLUDE common.dbc.in", "INCLUDE other.dbc.in", "other.dbc.in is not found"),
}

LIMITS = 29


def more(row, head, number):
    """The row again, under another name, number and text."""
    row = re.sub(r"^\[.*\]", f"[{head}More{number}]", row)
    row = re.sub(r"code = \d+", f"code = {number}", row)
    return "\n" + re.sub(r'text = "', f'text = "more {number}: ', row)


class Tree(unittest.TestCase):
    """A copy of what is read and written."""

    @classmethod
    def setUpClass(cls):
        cls.whole = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.whole.cleanup)
        root = pathlib.Path(cls.whole.name)
        for name in (*INPUTS, *COMMITTED):
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, root / name)
        assert generate_all.main(["--built", str(root)]) == 0

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        shutil.copytree(self.whole.name, self.root, dirs_exist_ok=True)

    def build(self, *options):
        return self.run_all("--built", str(self.root), *options)

    def run_all(self, *options):
        out, err = io.StringIO(), io.StringIO()
        here = generate.CODES
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = generate_all.main(["--root", str(self.root), *options])
        generate.CODES = here
        return code, out.getvalue(), err.getvalue()

    def edit(self, name, old, new):
        file = self.root / name
        text = file.read_text(encoding="utf-8")
        self.assertTrue(old in text, f"{name} has no {old!r}")
        file.write_text(text.replace(old, new, 1), encoding="utf-8")

    def test_nothing_has_drifted(self):
        self.assertEqual(self.run_all("--check"), (0, "", ""))

    def test_what_is_the_same_keeps_its_time(self):
        before = {name: (self.root / name).stat().st_mtime_ns for name in BUILT}
        self.assertEqual(self.build()[0], 0)
        self.assertEqual({name: (self.root / name).stat().st_mtime_ns for name in BUILT}, before)

    def test_every_output_is_compared(self):
        for name in OUTPUTS:
            with self.subTest(name):
                written = (self.root / name).read_text(encoding="utf-8")
                # Within the part that is made: a README has others before it.
                at = written.rfind("StrokeMissing") if "StrokeMissing" in written else written.find("pump flow")
                at = at if at >= 0 else len(written) // 2
                (self.root / name).write_text(written[:at] + "?" + written[at + 1:], encoding="utf-8")
                made_by = self.build if name in BUILT else self.run_all
                code, out, _ = made_by("--check")
                self.assertEqual(code, 1)
                self.assertIn(f"{self.root / name} does not match", out)
                self.assertEqual(made_by()[0], 0)
                self.assertEqual((self.root / name).read_text(encoding="utf-8"), written)

    def test_a_row_reaches_all(self):
        self.edit(INPUTS[0], "[BusOff]\n", "[BusGone]\n")
        self.edit(INPUTS[0], 'text = "bus-off"', 'text = "the bus is gone"')
        self.edit(INPUTS[1], 'text = "pump flow"', 'text = "flow of the pump"')
        self.assertEqual(self.run_all()[0], 0)
        self.assertEqual(self.build()[0], 0)
        self.assertEqual({name for name in OUTPUTS if self.has(name, "BusGone")},
                         {name for name in OUTPUTS if not re.search(r"dbc\.hpp|texts|\.ts$|j1939|zx200", name)}
                         | {"can_dbc/generated/common_dbc.hpp"})
        self.assertTrue(self.has("app/runs/generated/code_texts.hpp", "the bus is gone"))
        self.assertEqual({name for name in OUTPUTS if self.has(name, "flow of the pump")},
                         {*BUILT[2:4], COMMITTED[0]})

    def has(self, name, text):
        return text in (self.root / name).read_text(encoding="utf-8")

    def test_refused(self):
        for what, (name, old, new, said) in REFUSED.items():
            with self.subTest(what):
                self.setUp()
                folder = "can_dbc" if name.endswith(".in") else "firmware/safety"
                self.edit(f"{folder}/{name}", old, new)
                code, _, err = self.build("--check")
                self.assertEqual(code, 2, err)
                self.assertIn(said, err)

    def test_as_many_as_the_bus_can_say(self):
        """Faults up to the last number of a FaultSet; one more is refused."""
        for name, head, most, said in (("faults.toml", "", 127, "128 is more than the bus can say, 127"),
                                       ("limits.toml", "limit.", LIMITS, f"{LIMITS + 1} is more than the bus can say")):
            with self.subTest(name):
                self.setUp()
                file = self.root / "firmware/safety" / name
                text = file.read_text(encoding="ascii")
                row = text[text.rindex(f"\n[{head}") + 1:]
                first = int(re.search(r"code = (\d+)", row)[1]) + 1
                for number in range(first, most + 1):
                    text += more(row, head, number)
                file.write_text(text, encoding="ascii")
                found = codes.load(file.parent)
                self.assertEqual(most, len(found.limits if head else found.faults))
                file.write_text(text + more(row, head, most + 1), encoding="ascii")
                with self.assertRaisesRegex(codes.CodeError, said):
                    codes.load(file.parent)

    def test_blames_the_line_of_the_source(self):
        self.edit("can_dbc/dozer.dbc.in", "SG_ Height ", "SG_ Position ")
        line = 1 + next(i for i, text in enumerate((self.root / "can_dbc/dozer.dbc.in").read_text().splitlines())
                        if "SG_ Position 48|16" in text)
        self.assertIn(f"can_dbc/dozer.dbc.in:{line}: ", self.run_all("--check")[2])


if __name__ == "__main__":
    unittest.main()
