// SPDX-License-Identifier: Apache-2.0
// Recorded motion as spreadsheets leave it.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

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
      text += fmt::format("{0}200{0}{1:.6f}{0}+0.1", between, 0.005 * row);
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
    assert_near(runs[0].command[0].front(), 0.2, 1e-9);
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

/// One run of `seconds` at 100 Hz in which all joints sway; `cells` writes a joint's.
template <class Cells>
std::string swaying(const char* columns, double seconds, double time_unit, const Cells& cells) {
  std::string text = "run,time_s";
  for (const char* joint : {"boom", "arm", "bucket", "swing"}) {
    text += fmt::format(fmt::runtime(columns), joint);
  }
  text += "\n";
  for (int row = 0; row < 100.0 * seconds; ++row) {
    const double time_s = 0.01 * row;
    text += fmt::format("0,{:.6g}", time_s * time_unit);
    for (int joint = 0; joint < 4; ++joint) {
      text += cells(time_s, row);
    }
    text += "\n";
  }
  return text;
}

std::vector<identify::MotionRun> read(const std::string& text, std::vector<std::string>& notes) {
  const test::WrittenFile file("motion.csv", text);
  return identify::read_motion_csv(file.path().string(), &notes);
}

double sway(double time_s) { return 0.3 * std::sin(2.0 * time_s); }

TEST(other_units_are_taken_for_what_they_are_and_said) {
  std::vector<std::string> notes;
  const auto runs =
      read(swaying(",command_permille_{0},angle_rad_{0},velocity_radps_{0}", 5.0, 1e3,
                   [](double time_s, int) {
                     return fmt::format(",{:.3f},{:.5f},{:.5f}", std::sin(time_s),
                                        57.29578 * sway(time_s), 0.6 * std::cos(2.0 * time_s));
                   }),
           notes);
  assert_near(runs[0].time_s.back(), 4.99, 1e-9);
  assert_near(runs[0].command[0][100], std::sin(1.0), 1e-3);
  assert_near(runs[0].angle_rad[3][100], sway(1.0), 1e-4);
  const std::string said = fmt::format("{}", fmt::join(notes, "\n"));
  assert_true(has(said, "it is in ms") && has(said, "they are ratios, not per mille") &&
              has(said, "angle_rad_swing is in degrees"));
}

TEST(per_cent_and_one_ratio_among_per_mille_are_said) {
  for (const auto& [first, others, words] :
       {std::tuple{80.0, 80.0, "they are per cent, not per mille"},
        std::tuple{0.8, 800.0, "command_permille_boom is beyond 0.8: it is a ratio"}}) {
    std::vector<std::string> notes;
    int cell = 0;
    const double one = first;
    const double rest = others;
    const auto runs = read(swaying(",command_permille_{0},angle_rad_{0}", 5.0, 1.0,
                                   [&](double time_s, int row) {
                                     const double full = cell++ % 4 == 0 ? one : rest;
                                     return fmt::format(",{:.3f},{:.6f}", row % 2 == 0 ? full : 0.0,
                                                        sway(time_s));
                                   }),
                           notes);
    assert_near(runs[0].command[0][100], 0.8, 1e-3);
    assert_near(runs[0].command[3][100], 0.8, 1e-3);
    assert_true(notes.size() == 1 && has(notes[0], words));
  }
}

TEST(an_angle_that_wraps_goes_on) {
  std::vector<std::string> notes;
  const auto runs =
      read(swaying(",command_permille_{0},angle_rad_{0}", 9.0, 1.0,
                   [](double time_s, int) {
                     return fmt::format(",200,{:.6f}", std::remainder(time_s, 6.283185307179586));
                   }),
           notes);
  assert_near(runs[0].angle_rad[0].back(), 8.99, 1e-5);
  assert_true(has(notes.at(0), "angle_rad_boom wraps 1 times"));
}

TEST(a_velocity_that_is_missing_or_a_difference_is_the_angles) {
  std::vector<std::string> notes;
  auto runs =
      read(swaying(",command_permille_{0},angle_rad_{0}", 5.0, 1.0,
                   [](double time_s, int) { return fmt::format(",200,{:.6f}", sway(time_s)); }),
           notes);
  assert_true(runs[0].by_angle[2] && notes.empty());
  assert_int_equal(runs[0].since[50], 40);
  assert_near(runs[0].velocity_radps[2][50], (sway(0.5) - sway(0.4)) / 0.1, 1e-4);
  // Noise of the angle, differenced; and of a sensor of its own.
  const auto noise = [](int row) { return 5e-4 * std::sin(1e4 * row * row); };
  for (const bool own : {false, true}) {
    runs = read(swaying(",command_permille_{0},angle_rad_{0},velocity_radps_{0}", 5.0, 1.0,
                        [&](double time_s, int row) {
                          const double angle = sway(time_s) + noise(row);
                          const double before = sway(time_s - 0.02) + noise(row - 2);
                          return fmt::format(",200,{:.8f},{:.8f}", angle,
                                             own ? 0.6 * std::cos(2.0 * time_s) +
                                                       0.01 * std::sin(7e3 * row * row + 1.0)
                                                 : (row < 2 ? 0.0 : (angle - before) / 0.02));
                        }),
                notes);
    assert_true(runs[0].by_angle[1] == !own);
  }
  assert_true(has(notes.front(), "velocity_radps_boom is a difference of the angles"));
}

TEST(few_long_runs_are_cut_and_thinned) {
  std::vector<std::string> notes;
  const auto runs = identify::cut_and_thinned(
      read(swaying(",command_permille_{0},angle_rad_{0}", 100.0, 1.0,
                   [](double time_s, int row) {
                     return fmt::format(",{},{:.6f}", row % 4 == 0 ? 400 : 0, sway(time_s));
                   }),
           notes),
      &notes);
  assert_int_equal(runs.size(), 4);
  assert_near(runs[1].time_s[1] - runs[1].time_s[0], 0.04, 1e-9);
  assert_near(runs[1].command[0][5], 0.1, 1e-9);  // The mean of what it stands for.
  assert_near(runs[1].velocity_radps[0][10],
              (runs[1].angle_rad[0][10] - runs[1].angle_rad[0][runs[1].since[10]]) /
                  (runs[1].time_s[10] - runs[1].time_s[runs[1].since[10]]),
              1e-9);
  const std::string said = fmt::format("{}", fmt::join(notes, "\n"));
  assert_true(has(said, "longer than 60 s") && has(said, "of 10000 rows are fitted to"));
  assert_near(identify::unasked_share(runs, 0), 0.0, 1e-9);
}

TEST(a_way_without_a_command_is_told_by_its_share) {
  std::vector<std::string> notes;
  const auto runs =
      read(swaying(",command_permille_{0},angle_rad_{0}", 10.0, 1.0,
                   [](double time_s, int) {
                     return fmt::format(",{},{:.6f}", time_s < 4.0 ? 500 : 0, 0.1 * time_s);
                   }),
           notes);
  assert_near(identify::unasked_share(runs, 0), 0.5, 0.01);
}
