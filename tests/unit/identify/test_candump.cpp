// SPDX-License-Identifier: Apache-2.0
// Lines of candump as terminal and page read them, and what a log's clock and losses make of it.

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/identify/machine/candump_line.hpp"
#include "app/identify/machine/candump_reader.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

using test::has;

const char* kind_name(identify::LineKind kind) {
  switch (kind) {
    case identify::LineKind::kFrame:
      return "frame";
    case identify::LineKind::kOther:
      return "other";
    case identify::LineKind::kLost:
      return "lost";
    case identify::LineKind::kBroken:
      break;
  }
  return "broken";
}

std::string hex_of(const identify::CandumpLine& line) {
  std::string text;
  for (unsigned i = 0; i < line.length; ++i) {
    constexpr char kDigits[] = "0123456789ABCDEF";
    text += kDigits[line.data[i] >> 4U];
    text += kDigits[line.data[i] & 15U];
  }
  return text;
}

TEST(each_line_is_what_the_page_takes_it_for) {
  const nlohmann::json cases = nlohmann::json::parse(std::ifstream(CANDUMP_CASES));
  assert_true(cases.size() > 50);
  for (const nlohmann::json& each : cases) {
    const std::string text = each.at("line");
    const std::string is = each.at("is");
    const identify::CandumpLine got = identify::parse_candump(text);
    if (is != kind_name(got.kind)) {
      fail_msg("%s: %s", kind_name(got.kind), text.c_str());
    }
    assert_int_equal(got.lost, each.value("frames", 0));
    if (is == "frame") {
      assert_int_equal(got.id, std::strtoul(each.at("id").get<std::string>().c_str(), nullptr, 16));
      assert_true(got.extended == each.at("extended").get<bool>());
      assert_true(hex_of(got) == each.at("data").get<std::string>());
      assert_true(got.time_s == each.at("time_s").get<double>());
    }
  }
}

struct Heard {
  identify::LogRead read;
  std::vector<identify::LoggedFrame> frames;
};

Heard heard(const std::string& text) {
  const test::WrittenFile file("some.log", text);
  Heard all;
  all.read = identify::read_candump(
      file.path(), [&](const identify::LoggedFrame& frame) { all.frames.push_back(frame); });
  return all;
}

std::string told(const Heard& all) {
  std::string text;
  for (const std::string& note : all.read.notes()) {
    text += note + "\n";
  }
  return text;
}

const std::string kThree = "(10.0) can0 123#01\n(10.1)   can0 123#02\n(10.2) vcan10 123#03\n";

TEST(what_is_whole_is_kept_and_the_rest_is_told) {
  const Heard all = heard("\n" + kThree +
                          "DROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 3)\n"
                          "read: Network is down\r\n(10.3) can0 123##1AABB\n(10.4) can0 123#04\r\n"
                          "(10.5) can0 12");
  assert_int_equal(all.frames.size(), 4);
  assert_int_equal(all.read.other, 1);
  const std::string said = told(all);
  assert_true(has(said, "some.log: 3 frames were lost as it was recorded (DROPCOUNT)"));
  assert_true(has(said, "1 line is none of candump's, left out; the first is line 6"));
  assert_true(has(said, "its last line is cut"));
  assert_true(told(heard(kThree)).empty());
  assert_true(heard("").frames.empty());
}

TEST(what_is_no_log_is_refused_with_its_line) {
  const auto refusal = [](const std::string& text) {
    return test::refusal_of([&] { static_cast<void>(heard(text)); });
  };
  assert_true(has(refusal("not a log\n"), "some.log:1: \"not a log\" is not a line of candump -L"));
  assert_true(has(refusal("a\nb\n(10.0) can0 123#01\n"), "some.log:1: \"a\" is not"));
  assert_true(has(refusal("half"), "\"half\" is not a line"));
}

/// Another priority is the same message; a log's frames are found by the ids of our DBCs.
TEST(a_frame_of_ours_has_the_id_of_our_dbc) {
  const Heard all = heard("(1.0) can0 18FF2080#00\n(1.0) can0 18FF2081#00\n");
  assert_int_equal(all.frames[0].id, 0x0CFF2080);
  assert_int_equal(all.frames[1].id, 0x18FF2081);
}

std::vector<double> times_of(const Heard& all) {
  std::vector<double> times_s;
  for (const identify::LoggedFrame& frame : all.frames) {
    times_s.push_back(frame.time_s);
  }
  return times_s;
}

TEST(a_gap_ends_a_piece) {
  const Heard all = heard(kThree + "(610.2) can0 123#04\n(610.3) can0 123#05\n");
  assert_true(times_of(all) == std::vector<double>({10.0, 10.1, 10.2, 610.2, 610.3}));
  assert_int_equal(all.frames[2].piece, 0);
  assert_int_equal(all.frames[3].piece, 1);
  assert_true(has(told(all), "a gap of 600.00 s before line 4"));
  assert_near(identify::LogClock::counted_s(10.2, 610.2), 0.0, 0.0);
  assert_near(identify::LogClock::counted_s(610.25, 610.5), 0.25, 0.0);
}

TEST(a_clock_that_is_set_back_goes_on) {
  const Heard all =
      heard("(4000.5) a 123#01\n(4000.75) a 123#02\n(400.5) a 123#03\n(400.75) a 123#04\n");
  assert_true(times_of(all) == std::vector<double>({4000.5, 4000.75, 4002.75, 4003.0}));
  assert_int_equal(all.frames[2].piece, 1);
  assert_int_equal(all.frames[2].line, 3);
  assert_true(has(told(all), "its clock goes back by 3600.25 s at line 3"));
  assert_near(identify::LogClock::counted_s(4000.75, 4002.75), 0.0, 0.0);
}

TEST(disorder_and_a_garbled_stamp_are_no_other_clock) {
  const Heard all = heard(
      "(10.0) a 123#01\n(9.9) a 123#02\n(9999999999.0) a 123#03\n(10.2) a 123#04\n"
      "(1.0) a 123#05\n");
  assert_true(times_of(all) == std::vector<double>({10.0, 10.0, 10.2}));
  assert_int_equal(all.read.breaks.size(), 0);
  const std::string said = told(all);
  assert_true(has(said, "1 frame had a stamp before that of the frame before, and has its stamp"));
  assert_true(has(said, "2 frames are left out, whose stamp fits no other"));
}
