# SPDX-License-Identifier: Apache-2.0
"""What the generator refuses, with file and line; that it finds drift; that it is deterministic.

    test_generate.py PATH/TO/generate.py
"""

import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

GENERATE = pathlib.Path(sys.argv.pop()).resolve()
sys.path.insert(0, str(GENERATE.parent))
import generate  # noqa: E402

GOOD = """\
VERSION "1"

NS_ :
\tCM_
\tBA_

BS_:

BU_: Machine Graben

BO_ 2365530240 Stroke: 8 Machine
 SG_ Crc : 0|8@1+ (1,0) [0|255] "" Graben
 SG_ Counter : 8|4@1+ (1,0) [0|14] "" Graben
 SG_ Position : 16|16@1+ (0.05,0) [0|3200] "mm" Graben

BO_ 2365530496 Other: 8 Machine
 SG_ Crc : 0|8@1+ (1,0) [0|255] "" Graben
 SG_ Counter : 8|4@1+ (1,0) [0|14] "" Graben
 SG_ Angle : 16|16@1+ (0.05,-1600) [-1000|1000] "per mille" Graben

BO_ 2566861186 Status: 8 Graben
 SG_ Mode : 0|4@1+ (1,0) [0|1] "" Machine
 SG_ Number : 8|8@1+ (1,0) [0|250] "" Machine

CM_ "A database.";
CM_ BO_ 2365530240 "A stroke.";
CM_ SG_ 2365530240 Crc "CRC.";
CM_ SG_ 2365530240 Counter "Counter.";
CM_ SG_ 2365530240 Position "Position.";
CM_ BO_ 2365530496 "Another.";
CM_ SG_ 2365530496 Crc "CRC.";
CM_ SG_ 2365530496 Counter "Counter.";
CM_ SG_ 2365530496 Angle "Angle.";
CM_ BO_ 2566861186 "Status.";
CM_ SG_ 2566861186 Mode "Mode.";
CM_ SG_ 2566861186 Number "Number.";
BA_DEF_ "ProtocolType" STRING;
BA_DEF_ "DbcVersion" INT 1 250;
BA_DEF_ BU_ "NmStationAddress" INT 0 254;
BA_DEF_ BO_ "VFrameFormat" ENUM "StandardCAN","ExtendedCAN","reserved","J1939PG";
BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;
BA_DEF_ BO_ "E2EDataId" INT 0 65535;
BA_DEF_ BO_ "E2EMaxDeltaCounter" INT 0 15;
BA_DEF_ SG_ "SigType" ENUM "Default","ASCII","MessageCounter","MessageChecksum";
BA_DEF_ SG_ "GenSigStartValue" INT 0 65535;
BA_DEF_ SG_ "SigErrorRaw" INT -1 65535;
BA_DEF_ SG_ "SigNotAvailableRaw" INT -1 65535;
BA_DEF_DEF_ "ProtocolType" "J1939";
BA_DEF_DEF_ "DbcVersion" 1;
BA_DEF_DEF_ "NmStationAddress" 254;
BA_DEF_DEF_ "VFrameFormat" "J1939PG";
BA_DEF_DEF_ "GenMsgCycleTime" 0;
BA_DEF_DEF_ "E2EDataId" 0;
BA_DEF_DEF_ "E2EMaxDeltaCounter" 0;
BA_DEF_DEF_ "SigType" "Default";
BA_DEF_DEF_ "GenSigStartValue" 0;
BA_DEF_DEF_ "SigErrorRaw" -1;
BA_DEF_DEF_ "SigNotAvailableRaw" -1;
BA_ "ProtocolType" "J1939";
BA_ "DbcVersion" 1;
BA_ "NmStationAddress" BU_ Machine 128;
BA_ "NmStationAddress" BU_ Graben 130;
BA_ "VFrameFormat" BO_ 2365530240 3;
BA_ "GenMsgCycleTime" BO_ 2365530240 10;
BA_ "GenMsgCycleTime" BO_ 2365530496 10;
BA_ "GenMsgCycleTime" BO_ 2566861186 20;
BA_ "E2EDataId" BO_ 2365530240 291;
BA_ "E2EMaxDeltaCounter" BO_ 2365530240 3;
BA_ "E2EDataId" BO_ 2365530496 292;
BA_ "E2EMaxDeltaCounter" BO_ 2365530496 3;
BA_ "SigType" SG_ 2365530240 Crc 3;
BA_ "SigType" SG_ 2365530240 Counter 2;
BA_ "GenSigStartValue" SG_ 2365530240 Position 65535;
BA_ "SigErrorRaw" SG_ 2365530240 Position 65279;
BA_ "SigNotAvailableRaw" SG_ 2365530240 Position 65535;
BA_ "SigType" SG_ 2365530496 Crc 3;
BA_ "SigType" SG_ 2365530496 Counter 2;
BA_ "GenSigStartValue" SG_ 2365530496 Angle 32000;
BA_ "SigErrorRaw" SG_ 2365530496 Angle 65279;
BA_ "SigErrorRaw" SG_ 2566861186 Mode 14;
BA_ "SigNotAvailableRaw" SG_ 2566861186 Mode 15;
VAL_ 2566861186 Mode 0 "Silent" 1 "Ready" 14 "Error" 15 "NotAvailable" ;
"""

POSITION = ' SG_ Position : 16|16@1+ (0.05,0) [0|3200] "mm" Graben'
ANGLE = ' SG_ Angle : 16|16@1+ (0.05,-1600) [-1000|1000] "per mille" Graben'
NUMBER = ' SG_ Number : 8|8@1+ (1,0) [0|250] "" Machine'
STROKE = "BO_ 2365530240 Stroke: 8 Machine"
VALUES = 'VAL_ 2566861186 Mode 0 "Silent" 1 "Ready" 14 "Error" 15 "NotAvailable" ;'
MODE_ERROR = 'BA_ "SigErrorRaw" SG_ 2566861186 Mode 14;'
START = 'BA_ "GenSigStartValue" SG_ 2365530496 Angle 32000;'
DELTA = 'BA_ "E2EMaxDeltaCounter" BO_ 2365530240 3;'

# (what is replaced, by what, part of the message[, text of the line that is pointed at]). Without
# the fourth the line is where the replacement starts.
REFUSED = {
    # Not understood
    "multiplexor": (POSITION, POSITION.replace("Position", "Position M"), "multiplexed"),
    "multiplexed": (POSITION, POSITION.replace("Position", "Position m0"), "multiplexed"),
    "motorola": (POSITION, POSITION.replace("@1+", "@0+"), "Motorola"),
    "signed": (POSITION, POSITION.replace("@1+", "@1-"), "signed"),
    "float": (VALUES, "SIG_VALTYPE_ 2365530240 Position : 1;", "floating-point"),
    "extended multiplexing": (VALUES, "SG_MUL_VAL_ 1 A B 1-1;", "multiplexed"),
    "several senders": (VALUES, "BO_TX_BU_ 2365530240 : Machine,Graben;", "several senders"),
    "signal group": (VALUES, "SIG_GROUP_ 2365530240 G 1 : Position;", "unknown keyword"),
    "named value table": (VALUES, 'VAL_TABLE_ OnOff 0 "Off" 1 "On" ;', "unknown keyword"),
    "environment variable": ('CM_ "A database.";', 'CM_ EV_ X "x";', "not supported here"),
    "unknown keyword": (VALUES, "FOO_ 1;", "unknown keyword"),
    "unknown attribute type": (
        'BA_DEF_ "ProtocolType" STRING;',
        'BA_DEF_ "ProtocolType" BLOB;',
        "unknown type",
    ),
    "bit timing": ("BS_:", "BS_: 500", "bit timing"),
    "odd character": (VALUES, "?", "unexpected"),
    "string without end": (VALUES, 'CM_ "never closed', "without an end"),
    "not ASCII": ('CM_ "A database.";', 'CM_ "\u00b5s";', "ASCII"),
    "missing semicolon": (
        'CM_ BO_ 2566861186 "Status.";',
        'CM_ BO_ 2566861186 "Status."',
        "expected ;",
        "CM_ SG_ 2566861186 Mode",
    ),
    "start bit with fraction": (POSITION, POSITION.replace("16|", "1.5|"), "integer"),
    "signal without message": (
        "BU_: Machine Graben",
        "BU_: Machine Graben\n\n" + POSITION,
        "outside",
        POSITION,
    ),
    # References and duplicates
    "unknown sender": (STROKE, "BO_ 2365530240 Stroke: 8 Nobody", "not in BU_"),
    "unknown receiver": (POSITION, POSITION.replace("Graben", "Graben,Nobody"), "not in BU_"),
    "default receiver": (POSITION, POSITION.replace("Graben", "Vector__XXX"), "not in BU_"),
    "duplicate id": ("BO_ 2365530496 Other", "BO_ 2365530240 Other", "defined twice"),
    "duplicate message": ("BO_ 2365530496 Other", "BO_ 2365530496 Stroke", "defined twice"),
    "duplicate signal": (NUMBER, NUMBER.replace("Number", "Mode"), "defined twice"),
    "duplicate node": ("BU_: Machine Graben", "BU_: Machine Graben Machine", "defined twice"),
    "duplicate attribute": (
        'BA_DEF_ "DbcVersion" INT 1 250;',
        'BA_DEF_ "ProtocolType" INT 1 250;',
        "defined twice",
    ),
    "unknown id": ("CM_ BO_ 2365530496 ", "CM_ BO_ 2365530497 ", "unknown message id"),
    "unknown signal": ("CM_ SG_ 2566861186 Mode", "CM_ SG_ 2566861186 Mood", "has no signal"),
    "unknown node": ("BU_ Machine 128", "BU_ Nobody 128", "unknown node"),
    "second comment": ('CM_ BO_ 2566861186 "Status.";', 'CM_ "Again.";', "second comment"),
    "second value": (
        'BA_ "DbcVersion" 1;',
        'BA_ "DbcVersion" 1;\nBA_ "DbcVersion" 2;',
        "second value",
        'BA_ "DbcVersion" 2',
    ),
    "undefined attribute": (DELTA, 'BA_ "GenMsgSpeed" BO_ 2365530240 3;', "not defined"),
    "attribute of another kind": (DELTA, 'BA_ "SigType" BO_ 2365530240 0;', "another kind"),
    "attribute outside its range": (DELTA, DELTA.replace(" 3;", " 16;"), "outside [0, 15]"),
    "attribute without such a choice": (
        'BA_ "VFrameFormat" BO_ 2365530240 3;',
        'BA_ "VFrameFormat" BO_ 2365530240 4;',
        "no choice",
    ),
    # Messages
    "short message": (STROKE, STROKE.replace("8 M", "7 M"), "8 bytes"),
    "long message": (STROKE, STROKE.replace("8 M", "9 M"), "8 bytes"),
    "lower-case name": (STROKE, STROKE.replace("Stroke", "stroke"), "name in C++"),
    "no cycle time": (
        'BA_ "GenMsgCycleTime" BO_ 2365530240 10;\n', "", "GenMsgCycleTime", STROKE),
    "frame format": (
        'BA_ "VFrameFormat" BO_ 2365530240 3;', 'BA_ "VFrameFormat" BO_ 2365530240 1;', "J1939PG"),
    "protocol": ('BA_ "ProtocolType" "J1939";', 'BA_ "ProtocolType" "CAN";', "not J1939"),
    "no version": ('BA_ "DbcVersion" 1;\n', "", "no DbcVersion", 'VERSION "1"'),
    "message without comment": ('CM_ BO_ 2365530240 "A stroke.";\n', "", "no comment", STROKE),
    "signal without comment": (
        'CM_ SG_ 2365530240 Position "Position.";\n', "", "no comment", POSITION),
    # Signals
    "overlap": (NUMBER, NUMBER.replace("8|8", "3|8"), "overlaps Mode in bit 3"),
    "beyond the message": (POSITION, POSITION.replace("16|16", "49|16"), "lies beyond"),
    "no bits": (POSITION, POSITION.replace("16|16", "16|0"), "0 bits"),
    "too many bits": (POSITION, POSITION.replace("16|16", "16|33"), "33 bits"),
    "unknown unit": (POSITION, POSITION.replace('"mm"', '"furlong"'), "unknown unit 'furlong'"),
    "negative factor": (POSITION, POSITION.replace("0.05", "-0.05"), "not positive"),
    "zero factor": (POSITION, POSITION.replace("0.05", "0"), "not positive"),
    "offset between raw values": (ANGLE, ANGLE.replace("-1600", "-1600.01"), "multiple"),
    "maximum above the valid range": (POSITION, POSITION.replace("3200]", "3212.8]"), "valid are"),
    "minimum below raw 0": (ANGLE, ANGLE.replace("-1000|", "-1600.05|"), "valid are"),
    "minimum above maximum": (POSITION, POSITION.replace("[0|", "[3200.05|"), "valid are"),
    "maximum between raw values": (POSITION, POSITION.replace("3200]", "3199.99]"), "between raw"),
    "start value outside": (START, START.replace("32000", "11999"), "outside [min|max]"),
    "start value that is no special": (START, START.replace("32000", "65535"), "outside [min|max]"),
    "error value that is valid": (MODE_ERROR, MODE_ERROR.replace("14;", "13;"), "not between"),
    "error is not available": (MODE_ERROR, MODE_ERROR.replace("14;", "15;"), "the same"),
    "error beyond the width": (MODE_ERROR, MODE_ERROR.replace("14;", "16;"), "not between"),
    "width without special values": (
        POSITION,
        POSITION.replace("16|16", "16|12").replace("3200]", "200]"),
        "no special values",
        'BA_ "SigErrorRaw" SG_ 2365530240',
    ),
    "signal type": (
        START, 'BA_ "SigType" SG_ 2365530496 Angle 1;', "SigType is not supported"),
    # States
    "state without name": (VALUES, VALUES.replace(' 1 "Ready"', ""), "must name all"),
    "state beyond the range": (VALUES, VALUES.replace("14 ", '2 "Armed" 14 '), "must name all"),
    "state named twice": (VALUES, VALUES.replace("1 ", "0 "), "named twice"),
    "two states of one name": (VALUES, VALUES.replace("Ready", "Silent"), "same name"),
    "state that is no name": (VALUES, VALUES.replace("Ready", "not yet"), "name in C++"),
    # Protection
    "crc elsewhere": (
        ' SG_ Crc : 0|8@1+ (1,0) [0|255] "" Graben\n SG_ Counter : 8|4@1+ (1,0) [0|14] "" Graben\n'
        + ANGLE,
        ' SG_ Crc : 56|8@1+ (1,0) [0|255] "" Graben\n'
        ' SG_ Counter : 8|4@1+ (1,0) [0|14] "" Graben\n' + ANGLE,
        "lies at 0|8",
    ),
    "counter elsewhere": (
        ' SG_ Counter : 8|4@1+ (1,0) [0|14] "" Graben\n' + ANGLE,
        ' SG_ Counter : 12|4@1+ (1,0) [0|14] "" Graben\n' + ANGLE,
        "lies at 8|4",
    ),
    "counter to 15": (
        ' SG_ Counter : 8|4@1+ (1,0) [0|14] "" Graben\n' + ANGLE,
        ' SG_ Counter : 8|4@1+ (1,0) [0|15] "" Graben\n' + ANGLE,
        "plain [0|14]",
    ),
    "no crc": ('BA_ "SigType" SG_ 2365530240 Crc 3;\n', "", "one MessageChecksum", STROKE),
    "no counter": ('BA_ "SigType" SG_ 2365530240 Counter 2;\n', "", "one MessageCounter", STROKE),
    "crc without data id": (
        'BA_ "E2EDataId" BO_ 2365530240 291;\n', "", "without E2EDataId", " SG_ Crc"),
    "no delta": (DELTA + "\n", "", "E2EMaxDeltaCounter 0", STROKE),
    "delta of 15": (DELTA, DELTA.replace(" 3;", " 15;"), "E2EMaxDeltaCounter 15"),
    "delta without protection": (
        DELTA, DELTA + '\nBA_ "E2EMaxDeltaCounter" BO_ 2566861186 1;', "E2EMaxDeltaCounter 1",
        'BA_ "E2EMaxDeltaCounter" BO_ 2566861186'),
    "equal data ids": (
        'BA_ "E2EDataId" BO_ 2365530496 292;', 'BA_ "E2EDataId" BO_ 2365530496 291;', "to the CRC"),
}

# As above, but every occurrence is replaced, as the renaming of an id or a signal needs.
RENAMED = {
    "11-bit id": ("2566861186", "386", "11-bit", "BO_ 386 "),
    "30-bit id": ("2566861186", "3103732098", "29 bits", "BO_ 3103732098 "),
    "wrong source address": ("2566861186", "2566861187", "source address", "BO_ 2566861187 "),
    "keyword as name": ("Position", "Double", "name in C++", " SG_ Double"),
    "name of the generated code": ("Position", "Length", "name in C++", " SG_ Length"),
    "names equal in C++": (" Position", " CRC", "two signals become crc", " SG_ Crc"),
}


class Generator(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.dbc = pathlib.Path(folder.name, "machine.dbc")
        self.hpp = pathlib.Path(folder.name, "machine_dbc.hpp")

    def generate(self, text, *options):
        """(exit code, standard output, standard error)"""
        self.dbc.write_text(text, encoding="utf-8")
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = generate.main([*options, str(self.dbc), str(self.hpp)])
        return code, out.getvalue(), err.getvalue()

    def test_good(self):
        self.assertEqual(self.generate(GOOD), (0, "", ""))
        text = self.hpp.read_text()
        self.assertIn("namespace graben::dbc::machine {", text)
        self.assertIn("Physical position_m{0.0, RawState::kNotAvailable};", text)
        self.assertIn("Physical angle_ratio{physical_of(kAngle, 32000U), RawState::kValid};", text)
        self.assertIn("Coded<Mode> mode{Mode::kSilent, RawState::kValid};", text)
        self.assertNotIn("crc", text.split("struct Stroke")[1].split("};")[0])

    def assert_refused(self, text, at, message):
        line = text.count("\n", 0, at) + 1
        code, _, err = self.generate(text)
        self.assertEqual(code, 2, err)
        self.assertIn(message, err)
        self.assertTrue(err.startswith(f"{self.dbc}:{line}: "), f"expected line {line}: {err}")
        self.assertFalse(self.hpp.exists())

    def test_refused(self):
        for name, (old, new, message, *pointed) in REFUSED.items():
            with self.subTest(name):
                self.assertIn(old, GOOD)
                text = GOOD.replace(old, new, 1)
                at = text.index(pointed[0]) if pointed else GOOD.index(old)
                self.assert_refused(text, at, message)

    def test_renamed(self):
        for name, (old, new, message, pointed) in RENAMED.items():
            with self.subTest(name):
                text = GOOD.replace(old, new)
                self.assert_refused(text, text.index(pointed), message)

    def test_attribute_needs_default(self):
        for line in GOOD.splitlines(keepends=True):
            if line.startswith("BA_DEF_DEF_"):
                with self.subTest(line):
                    code, _, err = self.generate(GOOD.replace(line, ""))
                    self.assertEqual(code, 2)
                    self.assertIn("has no default", err)

    def test_drift(self):
        self.generate(GOOD)
        written = self.hpp.read_bytes()
        self.assertEqual(self.generate(GOOD, "--check"), (0, "", ""))
        code, out, _ = self.generate(GOOD.replace("[0|3200]", "[0|3100]"), "--check")
        self.assertEqual(code, 1)
        self.assertIn("64000U", out)
        self.assertIn("62000U", out)
        self.assertEqual(self.hpp.read_bytes(), written)

    def test_as_a_process(self):
        command = [sys.executable, "-B", GENERATE, self.dbc, self.hpp]
        missing = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(missing.returncode, 2)
        self.assertIn(f"{self.dbc}: ", missing.stderr)
        self.dbc.write_text(GOOD)
        self.assertEqual(subprocess.run(command, check=False).returncode, 0)
        first = self.hpp.read_bytes()
        self.assertEqual(subprocess.run(command, check=False).returncode, 0)
        self.assertEqual(self.hpp.read_bytes(), first)  # same input, same output


if __name__ == "__main__":
    unittest.main()
