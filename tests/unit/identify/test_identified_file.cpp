// SPDX-License-Identifier: Apache-2.0
/// What was identified, in the text of a profile: written and read back, and all else as it was.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "app/identify/file/identified_file.hpp"
#include "app/identify/file/profile_text.hpp"
#include "app/identify/machine/identified_profile.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using namespace graben::identify;

constexpr const char* kFrom = "drive.log sha256 12ab34cd56ef, 2026-11-24";

std::string shipped_text(const std::string& name = "excavator_22t") {
  std::ifstream stream(machines::find_profile(name));
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

machines::ExcavatorMachine load(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / "graben_identified_file.toml";
  std::ofstream(file) << text;
  const machines::ExcavatorMachine machine = machines::load_excavator(file);
  std::filesystem::remove(file);
  return machine;
}

/// Boom's extending side, its zeros and pump 2 were found, nothing else.
JudgedFit fit_of(const ExcavatorProfile& profile) {
  JudgedFit fit;
  fit.machine = estimate_of(DriveModel(profile));
  DriveEstimate& boom = fit.machine.drive[kBoom];
  boom.extend.edge = {0.3, 0.002, true};
  boom.extend.coefficient_factor = {0.9, 0.01, true};
  boom.extend.out_area_factor = {1.1, 0.05, true};
  boom.extend.dead_time_s = {0.12345678, 0.004, true};
  boom.extend.driven_least = 0.33;
  boom.extend.driven_most = 0.95;
  for (std::size_t at = 0; at < kTableOpenings.size(); ++at) {
    boom.extend.duty.push_back(0.3 + 0.7 * kTableOpenings[at] / 1.03);
    boom.extend.duty_deviation.push_back(0.003);
  }
  boom.stroke_zero_m = {0.0071, 0.0003, true};
  boom.cap_zero_pa = {-0.4e6, 0.1e6, true};
  fit.machine.pump_flow_factor[1] = {1.05, 0.01, true};
  fit.profile = identified(profile, fit.machine);
  return fit;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++found;
  }
  return found;
}

bool has(const std::string& text, const std::string& what) { return count(text, what) > 0; }

/// The shipped machine, what was found of it, and the text that says so.
struct Found {
  std::string old_text = shipped_text();
  machines::ExcavatorMachine old = load(old_text);
  JudgedFit fit = fit_of(old.profile);
  std::string text = identified_text(old_text, old, fit, kFrom);
  machines::ExcavatorMachine read = load(text);
};

/// A profile that is like another: the text is of one that is like it, too.
TEST(what_negative_flow_has_of_its_own_is_written) {
  const std::string old_text = shipped_text("excavator_22t_nfc");
  const machines::ExcavatorMachine old = load(old_text);
  JudgedFit fit = fit_of(old.profile);
  fit.machine.bypass_closes_at = {0.21, 0.01, true};
  // The others know of no travel of their own.
  fit.machine.drive[kBoom].extend.bypass_closed_at = 0.3 + 0.7 * 0.12 / 1.03;
  for (RegulatorEstimate& regulator : fit.machine.regulator) {
    regulator.full_swash_pa = {0.9e6, 1e4, true};
    regulator.least_swash_pa = {2.9e6, 1e4, true};
  }
  fit.profile = identified(old.profile, fit.machine);
  const std::string text = identified_text(old_text, old, fit, kFrom);
  assert_true(has(text, "like = \"excavator_22t\""));
  assert_int_equal(count(text, "bypass_closes_at = 0.21\n"), 5);
  assert_near(load(text).profile.valve.spool[kBoom].bypass_closes_at.extend, 0.12, 1e-6);
  assert_near(load(text).profile.valve.spool[kBoom].bypass_closes_at.retract, 0.21, 1e-12);
  assert_int_equal(count(text, "pressure = [900000.0, 2.9e+06], least_swash = 0.15"), 2);
  assert_reads_back(text, "/tmp/graben_like.toml", fit.profile);
  assert_string_equal(first_difference(load(text).profile, fit.profile).c_str(), "");
  fit.profile.valve.spool[kArm].bypass_closes_at.retract = 0.3;
  graben::test::expect_refusal(
      [&] { assert_reads_back(text, "/tmp/graben_like.toml", fit.profile); },
      "valve.answer.arm.retract.bypass_closes_at");
}

/// Pumps that stand in another's file have no place in this one's.
TEST(pumps_of_another_profile_are_not_written) {
  const std::string old_text = "kind = \"excavator\"\nlike = \"excavator_22t\"\n";
  const machines::ExcavatorMachine old = load(old_text);
  const JudgedFit fit = fit_of(old.profile);
  graben::test::expect_refusal(
      [&] { return identified_text(old_text, old, fit, kFrom); },
      "pump[1].displacement: has no place in this profile's text, which is like another");
}

/// Valves that were all measured are learnt slowly at work; where one was not, or a bypass closes
/// over their opening, at the usual pace.
TEST(known_valves_are_learnt_slowly) {
  for (const std::string& name : {std::string("excavator_22t"), std::string("excavator_22t_nfc")}) {
    const std::string old_text = shipped_text(name);
    const machines::ExcavatorMachine old = load(old_text);
    JudgedFit fit = fit_of(old.profile);
    assert_near(fit.profile.control.learn_share, 1.0, 0.0);
    for (std::size_t axis = 0; axis < graben::kAxisCount; ++axis) {
      fit.machine.drive[axis] = fit.machine.drive[graben::kBoom];
      fit.machine.drive[axis].retract = fit.machine.drive[axis].extend;
    }
    fit.profile = identified(old.profile, fit.machine);
    const bool slowly = name == "excavator_22t";
    assert_near(fit.profile.control.learn_share, slowly ? 0.1 : 1.0, 0.0);
    const std::string text = identified_text(old_text, old, fit, kFrom);
    assert_int_equal(has(text, "learn_share = 0.1"), slowly);
    assert_near(load(text).profile.control.learn_share, slowly ? 0.1 : 1.0, 0.0);
  }
}

TEST(what_is_written_reads_back) {
  const auto [old_text, old, fit, text, read] = Found();
  assert_string_equal(first_difference(read.profile, fit.profile).c_str(), "");
  assert_true(!first_difference(old.profile, fit.profile).empty());
  assert_near(read.profile.valve.answer[kBoom].extend.dead_time_s, 0.123457, 1e-9);
  assert_near(read.driven[kBoom].extend.most, 0.95, 1e-9);
  // A boom as late as that is not led by the oil.
  assert_int_equal(old.profile.control.law, ControlLaw::kOil);
  assert_int_equal(read.profile.control.law, ControlLaw::kServo);
  assert_true(read.profile.control.servo_gain_ps < old.profile.control.servo_gain_ps);
  // Not known: as it was.
  assert_int_equal(read.profile.valve.answer[kBoom].retract.spool_to_duty.size(), 0);
  assert_true(read.profile.valve.answer[kBoom].retract.dead_time_s == kUnsaid_s);
  assert_true(read.profile.valve.answer[kBoom].extend.lag_s == kUnsaid_s);
  assert_true(read.profile.pump[0].displacement_m3prev == old.profile.pump[0].displacement_m3prev);
  assert_true(read.profile.valve.spool[kArm].extend_in_m2 ==
              old.profile.valve.spool[kArm].extend_in_m2);
  assert_true(read.profile.valve.spool[kBoom].retract_in_m2 ==
              old.profile.valve.spool[kBoom].retract_in_m2);
}

TEST(where_it_is_from_is_told) {
  const Found found;
  const std::vector<machines::Provenance>& provenance = found.read.provenance;
  assert_true(has(found.text, "# identified: 119e-6 before; deviation 1.2e-06; drive.log sha256"));
  const auto entry = [&](const std::string& key) {
    const auto at = std::find_if(provenance.begin(), provenance.end(),
                                 [&](const machines::Provenance& of) { return of.key == key; });
    assert_true(at != provenance.end());
    return *at;
  };
  assert_near(entry("valve.answer.boom.extend.dead_time").deviation.value_or(-1.0), 0.004, 1e-12);
  assert_near(entry("sensors.cap_zero").deviation.value_or(-1.0), 0.1e6, 1e-6);
  assert_string_equal(entry("pump[1].displacement").from.c_str(), kFrom);
}

TEST(all_else_stays_as_it_was_written) {
  const Found written;
  const std::vector<std::string> before = lines_of(written.old_text);
  const std::vector<std::string> after = lines_of(written.text);
  std::size_t at = 0;
  std::size_t changed = 0;
  for (const std::string& line : before) {
    const auto found =
        std::find(after.begin() + static_cast<std::ptrdiff_t>(at), after.end(), line);
    changed += found == after.end() ? 1 : 0;
    at = found == after.end() ? at : static_cast<std::size_t>(found - after.begin()) + 1;
  }
  // Displacement of pump 2, areas of the boom, law and four values of [control].
  assert_int_equal(changed, 7);
}

TEST(a_second_time_replaces_the_first) {
  const Found once;
  const JudgedFit again = fit_of(once.read.profile);
  const std::string twice = identified_text(once.text, once.read, again, "later.log");
  assert_string_equal(first_difference(load(twice).profile, again.profile).c_str(), "");
  assert_true(count(twice, "# identified:") <= count(once.text, "# identified:"));
  assert_int_equal(count(twice, "[provenance]"), 1);
  assert_true(has(twice, "later.log"));
}

TEST(values_are_found_however_they_are_written) {
  const struct {
    const char *before, *section, *key, *after;
  } rows[] = {
      {"[a]\nx = 1 # kept\ny = 2\n", "a", "x",
       "[a]\n# identified: 1 before; why\nx = 7 # kept\ny = 2\n"},
      {"[a]\nx = 1\n\n[b]\ny = 2\n", "a", "z",
       "[a]\n# identified: why\nz = 7\nx = 1\n\n[b]\ny = 2\n"},
      {"a = { x = 1 } # é\n", "a", "z", "a = { x = 1 , z = 7 } # é\n"},
      {"t = \"é\"\na = { s = \"éé\", x = [1, 2] }", "a", "x",
       "t = \"é\"\n# identified: [1, 2] before; why\na = { s = \"éé\", x = 7 }"},
      {"[a]\nb.x = 1", "a.b", "z", "[a]\n# identified: why\nb.z = 7\nb.x = 1"},
      {"[[p]]\nx = 1\n[[p]]\nx = 2", "p[1]", "x",
       "[[p]]\nx = 1\n[[p]]\n# identified: 2 before; why\nx = 7"},
      {"x = 1", "a.b", "c.d", "x = 1\n\n[a.b]\n# identified: why\n\"c.d\" = 7\n"},
      {"[a]\nx = [\n  1, # one\n  2,\n]\n", "a", "x", "[a]\n# identified: why\nx = 7\n"},
  };
  for (const auto& row : rows) {
    ProfileText profile(row.before);
    profile.set(row.section, row.key, "7", "why");
    assert_string_equal(profile.text().c_str(), row.after);
  }
  assert_string_equal(toml_quoted("a\"b\\c\n").c_str(), "\"a\\\"b\\\\c\\u000A\"");
}

TEST(what_is_no_toml_is_refused) {
  graben::test::expect_refusal([] { return ProfileText("[a\n"); }, "");
}
