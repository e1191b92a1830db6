// SPDX-License-Identifier: Apache-2.0
// What the operator confirms, and what is kept to go on after a break.

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "app/commission/commission_progress.hpp"
#include "app/commission/commission_windows.hpp"
#include "app/commission/wrong_way.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/operate/folder.hpp"

using namespace graben::commission;
namespace fs = std::filesystem;
using test::Folder;

SequenceOptions whole() { return whole_sequence(test::excavator().profile); }

template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

TEST(windows_of_a_file) {
  const Folder folder;
  SequenceOptions options = whole();
  options.drives = {true, false, false};
  const fs::path good = folder.file("[boom]\nleast = 0.1\nspeed = 0.3\nextended_end_free = true\n");
  read_windows(good, options);
  assert_near(options.window[kBoom].least_m, 0.1, 1e-12);
  assert_near(options.window[kBoom].most_m, options.stroke_m[kBoom], 1e-12);
  assert_near(options.window[kBoom].most_mps, 0.3, 1e-12);
  assert_true(options.touch_extended[kBoom] && !options.touch_retracted[kBoom]);
  const auto bad = [&](const char* text) {
    return refusal([&] { read_windows(folder.file(text), options); });
  };
  assert_true(says(bad("[boom]\nleast = 0.1\nmost = 1.0\n"), "boom.speed"));
  assert_true(says(bad("[boom]\nleast = 0.5\nmost = 0.6\nspeed = 0.3\n"), "at least 0.20 m"));
  assert_true(says(bad("[boom]\nleast = 0.1\nmost = 9.0\nspeed = 0.3\n"), "boom.most"));
  assert_true(says(bad("[boom]\nleast = 0.1\nmost = 1.0\nspeed = 0.3\nfast = 1\n"), "boom.fast"));
  options.drives[kArm] = true;
  assert_true(says(bad("[boom]\nleast = 0.1\nmost = 1.0\nspeed = 0.3\n"), "arm.least"));
}

SequenceOptions whole_12t() { return whole_sequence(test::excavator_12t().profile); }

/// Nobody turns a platform of which no sector was confirmed.
TEST(a_swing_is_tried_where_its_sector_is_confirmed) {
  const Folder folder;
  assert_false(whole().swing || whole().has_swing);
  SequenceOptions options = whole_12t();
  assert_true(options.swing);
  assert_near(options.sector.left_rad, 30.0 * M_PI / 180.0, 1e-9);
  options.drives = {false, false, false};
  read_windows(folder.file("[swing]\nright = -0.3\nleft = 0.4\nspeed = 0.5\n"), options);
  assert_true(options.swing);
  assert_near(options.sector.right_rad, -0.3, 1e-12);
  assert_near(options.sector.most_radps, 0.5, 1e-12);
  const auto bad = [&](const char* text) {
    return refusal([&] { read_windows(folder.file(text), options); });
  };
  assert_true(says(bad("[swing]\nright = -0.3\nleft = 0.4\n"), "swing.speed"));
  assert_true(says(bad("[swing]\nright = 0.1\nleft = 0.4\nspeed = 0.5\n"), "at least 0.6 rad"));
  assert_true(says(bad("[swing]\nright = -4\nleft = 0.4\nspeed = 0.5\n"), "swing.right"));
  read_windows(folder.file("[boom]\nleast = 0.1\nmost = 0.8\nspeed = 0.3\n"), options);
  assert_false(options.swing);
  SequenceOptions without = whole();
  without.drives = {false, false, false};
  const auto none = [&] {
    read_windows(folder.file("[swing]\nright = -0.3\nleft = 0.4\nspeed = 0.5\n"), without);
  };
  assert_true(says(refusal(none), "swing"));
}

TEST(a_sector_by_questions) {
  SequenceOptions options = whole_12t();
  options.drives = {false, false, false};
  const std::vector<std::string> answers = {"-5 5", "", "-25 20", "0.4"};
  std::size_t at = 0;
  assert_true(ask_windows(
      [&](const std::string&) {
        return at < answers.size() ? std::optional<std::string>(answers[at++]) : std::nullopt;
      },
      options));
  assert_near(options.sector.right_rad, -25.0 * M_PI / 180.0, 1e-12);
  assert_near(options.sector.left_rad, 20.0 * M_PI / 180.0, 1e-12);
  assert_near(options.sector.most_radps, 0.4, 1e-12);
}

TEST(windows_by_questions) {
  SequenceOptions options = whole();
  options.drives = {true, false, true};
  // Both ends of the boom are refused, its first window is none; the bucket as it is proposed.
  const std::vector<std::string> answers = {"perhaps", "n", "no", "0.5 0.4", "", "0.2 0.9",
                                            "0.25",    "y", "",   "",        ""};
  std::size_t at = 0;
  const Ask ask = [&](const std::string&) {
    return at < answers.size() ? std::optional<std::string>(answers[at++]) : std::nullopt;
  };
  assert_true(ask_windows(ask, options));
  assert_int_equal(at, answers.size());
  assert_near(options.window[kBoom].least_m, 0.2, 1e-12);
  assert_near(options.window[kBoom].most_m, 0.9, 1e-12);
  assert_near(options.window[kBoom].most_mps, 0.25, 1e-12);
  assert_false(options.touch_retracted[kBoom] || options.touch_extended[kBoom]);
  assert_near(options.window[kBucket].least_m, 0.0, 1e-12);
  assert_near(options.window[kBucket].most_m, 0.95 * options.stroke_m[kBucket], 1e-12);
  assert_true(options.touch_retracted[kBucket] && !options.touch_extended[kBucket]);
  at = answers.size();
  assert_false(ask_windows(ask, options));
}

commission::Progress some() {
  commission::Progress progress;
  progress.profile_hash = 0x1234;
  progress.options = whole();
  progress.options.drives = {false, true, false};
  progress.options.bursts = false;
  progress.options.window[kArm] = {0.1, 1.2, 0.4};
  progress.options.touch_extended[kArm] = false;
  progress.results = {{StepEnd::kDone, 0.41, 0.06, 7.0}, {StepEnd::kAtWindow, 0.5, 0.2, 3.0}};
  return progress;
}

TEST(progress_comes_back) {
  const Folder folder;
  const fs::path file = progress_file(folder.path / "drive.log");
  assert_string_equal(file.filename().c_str(), "drive.log.progress.json");
  const commission::Progress before = some();
  write_progress(file, before);
  const commission::Progress after = read_progress(file, 0x1234, whole());
  assert_int_equal(planned_steps(after.options).size(), planned_steps(before.options).size());
  assert_int_equal(after.results.size(), 2);
  assert_int_equal(after.results[1].end, StepEnd::kAtWindow);
  assert_near(after.results[0].duty, 0.41, 0.0);
  assert_near(after.results[1].speed_mps, 0.2, 0.0);
  require_same_windows(before.options, after.options);
}

TEST(progress_keeps_the_sector) {
  const Folder folder;
  const fs::path file = folder.path / "progress";
  commission::Progress before;
  before.profile_hash = 0x1234;
  before.options = whole_12t();
  before.options.drives = {false, false, false};
  before.options.sector = {-0.4, 0.5, 0.45};
  before.results = {{StepEnd::kDone, 0.0, 0.0, 9.0}, {StepEnd::kOutside, 0.0, 0.0, 1.0}};
  write_progress(file, before);
  const commission::Progress after = read_progress(file, 0x1234, whole_12t());
  assert_true(after.options.swing);
  assert_near(after.options.sector.left_rad, 0.5, 1e-9);
  assert_int_equal(after.results[1].end, StepEnd::kOutside);
  require_same_windows(before.options, after.options);
  SequenceOptions wider = after.options;
  wider.sector.left_rad = 0.6;
  assert_true(says(refusal([&] { require_same_windows(after.options, wider); }), "another sector"));
  wider.swing = false;
  assert_true(says(refusal([&] { require_same_windows(after.options, wider); }), "another sector"));
  // One from before the swing was led.
  before.options.has_swing = false;
  before.options.swing = false;
  before.results.clear();
  write_progress(file, before);
  assert_false(read_progress(file, 0x1234, whole_12t()).options.swing);
}

TEST(progress_of_something_else_is_refused) {
  const Folder folder;
  const fs::path file = folder.path / "progress";
  const auto read = [&] {
    return refusal([&] { static_cast<void>(read_progress(file, 0x1234, whole())); });
  };
  assert_true(says(read(), "there is no such file; wanted: the progress of a commissioning"));
  write_progress(file, some());
  assert_true(read().empty());
  commission::Progress other = some();
  other.profile_hash = 0x99;
  write_progress(file, other);
  assert_true(says(read(), "another profile"));
  std::ofstream(file) << "{\"profile_hash\": 1";
  assert_false(read().empty());
  SequenceOptions moved = some().options;
  moved.window[kArm].most_m = 1.3;
  const auto same = [&] { require_same_windows(some().options, moved); };
  assert_true(says(refusal(same), "another window"));
  moved.window[kArm].most_m = 1.2;
  moved.window[kBoom].most_m = 0.5;  // Not tried.
  assert_true(refusal(same).empty());
}

TEST(what_goes_wrong_has_a_word) {
  const SequenceStep ramp = {commission::StepKind::kRamp, kBoom, 1};
  const std::array<double, kAxisCount> begin = {0.7, 0.7, 0.5};
  assert_false(look_for_wrong_way(ramp, begin, {0.75, 0.705, 0.5}, {0.1, 0.02, 0.0}).has_value());
  // It creeps, or has rocked.
  assert_false(look_for_wrong_way(ramp, begin, {0.68, 0.7, 0.5}, {-0.004, 0.0, 0.0}).has_value());
  assert_false(look_for_wrong_way(ramp, begin, {0.695, 0.7, 0.5}, {-0.05, 0.0, 0.0}).has_value());
  const auto falls = look_for_wrong_way(ramp, begin, {0.688, 0.7, 0.5}, {-0.05, 0.0, 0.0});
  assert_true(falls.has_value());
  assert_string_equal(
      wrong_text(*falls).c_str(),
      "the boom's stroke falls while it is told to extend: sensor or valve reversed");
  const auto other = look_for_wrong_way(ramp, begin, {0.7, 0.68, 0.5}, {0.0, -0.05, 0.0});
  assert_true(other && other->seen == kArm);
}
