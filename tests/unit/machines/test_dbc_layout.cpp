// SPDX-License-Identifier: Apache-2.0
// DBCs as tools and hands leave them, and what of them a bus profile names.

#include "app/machines/dbc_layout.hpp"

#include "app/machines/bus_file.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"
#include "tests/unit/machines/written_bus.hpp"

using test::assert_says;
using test::has;
using test::kHead;
using test::kMessage;
using test::kSignal;
using test::refusal;
using test::refusal_of;
using test::with;
using test::WrittenFile;

/// What is wrong in it, whoever names it.
std::string dbc_refusal(const std::string& text) {
  const WrittenFile file("bus.dbc", text);
  std::string all;
  for (const machines::DbcMessage& message : machines::read_dbc(file.path())) {
    all += message.wrong + "\n";
    for (const machines::DbcSignal& signal : message.signal) {
      all += signal.wrong + "\n";
    }
  }
  return all;
}

TEST(a_dbc_is_read_with_care) {
  const std::string message = "BO_ 2147483749 Angle: 8 Other\n";
  const std::string begin = " SG_ Boom : 0|16@1+ ";
  const std::string signal = begin + "(0.1,0) [0|1] \"\" Other\n";
  const WrittenFile crlf("bus.dbc",
                         "BO_ 2147483749 Angle: 8 Other\r\n" + begin +
                             "(0.1,0) [0|1] \"\" Other\r\nSIG_VALTYPE_ 2147483749 Boom : 1;\r\n");
  const auto read = machines::read_dbc(crlf.path());
  assert_int_equal(read.size(), 1);
  assert_int_equal(read[0].id, 101);
  assert_false(read[0].signal[0].supported);
  const auto assert_refused = [](const std::string& text, const char* why) {
    const std::string error = dbc_refusal(text);
    if (!has(error, why)) {
      fail_msg("no \"%s\" in: %s", why, error.c_str());
    }
  };
  assert_refused(message + signal + signal, ":3: a second signal of this name");
  assert_refused(message + message, ":2: a second message of this name");
  assert_refused("BO_ 2048 Angle: 8 Other\n", "allowed: at most 0x7FF");
  assert_refused("BO_ 3758096384 Angle: 8 Other\n", "allowed: at most 0x1FFFFFFF");
  assert_refused(message + begin + "(0.1x,0) [0|1] \"\" Other\n", "'0.1x' is no finite number");
  assert_refused(message + begin + "(nan,0) [0|1] \"\" Other\n", "'nan' is no finite number");
  assert_refused(message + begin + "(0,0) [0|1] \"\" Other\n", "scale 0");
  assert_refused(message + begin + "(1,0) [0|1] \"" + std::string(80000, 'A') + "\" Other\n",
                 "allowed: at most 4096");
  assert_refused(message + " SG_ Boom 0|16\n", ":2: not as a DBC has it:  SG_ Boom 0|16");
  const std::string folder = refusal_of([] { static_cast<void>(machines::read_dbc(".")); });
  assert_true(has(folder, "is a folder"));
}

const std::string kNamed =
    "bus = \"mine\"\nown_frames = true\ndbc = \"a.dbc\"\n[[receive]]\nmessage = \"EEC1\"\n"
    "period = 0.02\ntimeout = 0.06\nprotection = \"none\"\n[[receive.signal]]\nsignal = "
    "\"EngSpeed\"\n"
    "to = \"engine_speed\"\nscale = 0.10471975511965977\n";
const std::string kEec1 = "BO_ 2364540158 EEC1: 8 Vector__XXX\n";
const std::string kEngineSpeed =
    " SG_ EngSpeed : 24|16@1+ (0.125,0) [0|8031.875] \"rpm\" Vector__XXX\n";
const std::string kOther = "BO_ 2566845182 CI: 8 Vector__XXX\n";

machines::BusFile with_dbc(const std::string& dbc, const std::string& bus = kNamed) {
  const WrittenFile file("bus.toml", bus);
  const WrittenFile layout("a.dbc", dbc);
  return machines::load_bus(file.path());
}

/// DBCs as Vector's, Kvaser's and other tools and hands leave them.
TEST(of_a_dbc_only_what_is_named_is_judged) {
  const std::string named = kEec1 + kEngineSpeed;
  for (const std::string& dbc :
       {std::string("VERSION \"\"\r\n\r\nNS_ :\r\n\tBO_TX_BU_\r\n\tSG_MUL_VAL_\r\n\r\nBS_:\r\n\r\n"
                    "BU_: ECM\r\nBO_ 2364540158 EEC1: 8 Vector__XXX\r\n SG_ EngSpeed : 24|16@1+ "
                    "(0.125,0) [0|8031.875] \"rpm\" Vector__XXX\r\n"),
        std::string(
            "BO_  2364540158   EEC1 :  8  Vector__XXX\n SG_ EngTorqueMode    :  0|4@1+    (1,0)   "
            "   [0|15]       \"\"     Vector__XXX\n SG_ EngSpeed         : 24|16@1+   (0.125,0)  "
            "[0|8031.875] \"rpm\" Vector__XXX\n"),
        "\xEF\xBB\xBF" + named,
        named + kOther + " SG_ Make : 0|1600@1+ (1,0) [0|4.4E+481] \"\" Vector__XXX\n",
        named + kOther + kEngineSpeed + kEngineSpeed,
        named + kOther + " SG_ Pad : 0|8@1+ (0,0) [0|0] \"\" Vector__XXX\n",
        named + kOther + kOther, "BO_ 5000 Odd: 8 X\n" + named, named + "BO_ what: ever\n",
        "CM_ \"a 5\" pipe\";\n" + named,
        named + "CM_ BO_ 2364540158 \"first\nBO_ 2364540158 EEC1: 8 X\n SG_ EngSpeed : 0|8@1+ "
                "(1,0) [0|1] "
                "\\\"\\\" X\nlast\";\nBA_ \"SPN\" 190;\n",
        named + "BO_ 2364540158 Same: 8 X\n SG_ Temperature : 0|8@1+ (1,-40) [-40|210] \"\xB0"
                "C\" X\n"}) {
    const machines::BusFile bus = with_dbc(dbc);
    assert_int_equal(bus.table.message_count, 1);
    assert_int_equal(bus.table.rule[0].id, 0x0CF004FE);
    assert_int_equal(bus.table.source[0].bits.start_bit, 24);
  }
}

TEST(of_a_dbc_what_is_named_and_wrong_is_told_once) {
  const auto said = [](const std::string& dbc) {
    return refusal_of([&] { static_cast<void>(with_dbc(dbc)); });
  };
  const std::string twice = said(kEec1 + kEngineSpeed + kEngineSpeed);
  assert_true(has(twice, "1 error:") && has(twice, "a.dbc:3: a second signal of this name"));
  const std::string still = said(kEec1 + " SG_ EngSpeed : 24|16@1+ (0,0) [0|1] \"\" X\n");
  assert_true(has(still, "1 error:") && has(still, "a.dbc:2: scale 0"));
  const std::string gone = refusal_of([] {
    const WrittenFile file("bus.toml", kNamed);
    static_cast<void>(machines::load_bus(file.path()));
  });
  assert_true(has(gone, "1 error:") && has(gone, "there is no such file"));
  const std::string wide =
      said(std::string("\xFF\xFE"
                       "B\0O\0",
                       6));
  assert_true(has(wide, "1 error:") && has(wide, "is UTF-16"));
}

/// FE in a DBC is any sender; a profile may name the one.
TEST(the_source_of_a_dbc_may_be_named) {
  const std::string named =
      with(kNamed, "message = \"EEC1\"\n", "message = \"EEC1\"\nid = 0x0CF00400\n");
  assert_int_equal(with_dbc(kEec1 + kEngineSpeed, named).table.rule[0].id, 0x0CF00400);
  const std::string sent =
      "[[send]]\nmessage = \"Levers\"\nid = 0x0CFF64FE\nperiod = 0.02\nprotection = \"none\"\n"
      "[[send.signal]]\nsignal = \"Boom\"\nstart = 0\nwidth = 8\nfrom = \"extend\"\nof = "
      "\"boom\"\nscale = 0.004\n";
  assert_says(kHead + kMessage + kSignal + sent, {"0xCFF64FE", "has source FE, which is nobody's"});
  assert_says(kHead + with(kMessage, "id = 0x123\nextended = false", "id = 0x18F00400") + kSignal +
                  with(with(kMessage, "Engine", "Again"), "id = 0x123\nextended = false",
                       "id = 0x0CF00400") +
                  with(kSignal, "engine_speed\"", "swash\"\nof = \"pump1\""),
              {"its id is that of another message, whatever its priority"});
}
