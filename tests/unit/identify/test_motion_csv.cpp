// SPDX-License-Identifier: Apache-2.0
// Recorded motion as spreadsheets leave it.

#include <fmt/format.h>

#include "app/identify/motion_runs.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/design/written_file.hpp"

using test::has;

/// Four joints that move evenly for 4 s; `between` the cells, `end` of the lines.
std::string motion(const std::string& between, const std::string& end) {
  std::string text = "run" + between + "time_s";
  for (const char* joint : {"boom", "arm", "bucket", "swing"}) {
    for (const char* what : {"command_permille_", "angle_rad_", "velocity_radps_"}) {
      text += between + what + joint;
    }
  }
  text += end;
  for (int row = 0; row <= 80; ++row) {
    text += fmt::format("0{}+{:.3f}", between, 0.05 * row);
    for (int joint = 0; joint < 4; ++joint) {
      text += fmt::format("{0}100{0}{1:.6f}{0}+0.1", between, 0.005 * row);
    }
    text += end;
  }
  return text;
}

std::vector<identify::MotionRun> read(const std::string& text) {
  const test::WrittenFile file("motion.csv", text);
  return identify::read_motion_csv(file.path().string());
}

TEST(marks_pluses_ends_and_blank_rows_are_no_motion) {
  for (const std::string& text :
       {motion(",", "\n"), "\xEF\xBB\xBF" + motion(",", "\r\n") + ",,,,\r\n\r\n",
        motion(";", ";;\n"), motion("\t", "\n")}) {
    const auto runs = read(text);
    assert_int_equal(runs.size(), 1);
    assert_int_equal(runs[0].size(), 81);
    assert_near(runs[0].angle_rad[3].back(), 0.4, 1e-9);
    assert_near(runs[0].command[0].front(), 0.1, 1e-9);
  }
}

TEST(what_only_looks_like_a_number_is_named) {
  const std::string comma = test::refusal_of([] {
    std::string text = motion(";", "\n");
    static_cast<void>(read(text.replace(text.rfind("+0.1"), 4, "0,1")));
  });
  assert_true(has(comma, "velocity_radps_swing is \"0,1\", not a number") &&
              has(comma, "a decimal comma"));
  const std::string wide =
      test::refusal_of([] { static_cast<void>(read(std::string("\xFF\xFEr\0u\0n\0", 8))); });
  assert_true(has(wide, "motion.csv: is UTF-16; allowed: UTF-8"));
}
