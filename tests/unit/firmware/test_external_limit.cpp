// SPDX-License-Identifier: Apache-2.0
// A limit from outside: what is capped, what stops, what a word that is late or wrong does.

#include "firmware/safety/external_limit.hpp"

#include <limits>

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kCycle_s = 0.0078125;  // A power of two: ratios are exact.
constexpr TimeUs kCycle_us = 7812;
constexpr std::uint8_t kSource = 7;

/// A machine in motion at full speed, unless a test says otherwise, and its source.
struct Limited {
  ExternalWord said{ExternalLevel::kFree, false, kSource, 1.0, 0.25};
  Signal<ExternalWord> heard;
  ExternalState state;
  TimeUs now_us = kSecondUs;
  bool moving = true;
  double asked = 1.0;

  CommonValid silent() {
    now_us += kCycle_us;
    CommonValid valid;
    valid.speed_override_ratio = asked;
    tell_external(heard, moving, now_us, kCycle_s, state, valid);
    return valid;
  }
  CommonValid hears(Validity validity = Validity::kValid) {
    heard = {said, validity, now_us + kCycle_us};
    return silent();
  }
  CommonValid slowed_to(double ratio) {
    said.level = ExternalLevel::kSlow;
    said.speed_ratio = ratio;
    return hears();
  }
  CommonValid stopped(bool resumes) {
    said.level = ExternalLevel::kStop;
    said.resumes = resumes;
    return hears();
  }
};

void assert_free(const CommonValid& valid, double speed_ratio) {
  assert_true(valid.faults.empty());
  assert_int_equal(valid.fault, Fault::kNone);
  assert_near(valid.speed_override_ratio, speed_ratio, 0.0);
  assert_false(valid.external.holds);
  assert_int_equal(valid.external.limit().kind, LimitKind::kNone);
}

void assert_held(const CommonValid& valid, double speed_ratio) {
  assert_true(valid.faults.empty());
  assert_near(valid.speed_override_ratio, speed_ratio, 0.0);
  assert_near(valid.external.speed_ratio, speed_ratio, 0.0);
  assert_true(valid.external.holds);
  assert_int_equal(valid.external.limit().kind, LimitKind::kExternalLimit);
  assert_int_equal(valid.external.limit().index, kSource);
}

void assert_stops(const CommonValid& valid, Fault fault) {
  assert_int_equal(valid.fault, fault);
  assert_true(valid.faults.has(fault));
  assert_int_equal(valid.faults.count(), 1);
  assert_true(valid.external.stops());
  assert_near(valid.speed_override_ratio, 0.0, 0.0);
}

TEST(a_machine_without_a_source_is_as_it_was, Limited limited) {
  for (const Validity never : {Validity::kNotReceived, Validity::kNotAvailable}) {
    limited.asked = 0.75;
    assert_free(limited.hears(never), 0.75);
  }
  limited.now_us += 100 * kSecondUs;
  assert_free(limited.silent(), 0.75);
}

TEST(a_source_that_lets_go_holds_nothing, Limited limited) {
  limited.said.speed_ratio = 0.0;
  assert_free(limited.hears(), 1.0);
}

TEST(it_slows_at_once_and_names_its_source, Limited limited) {
  assert_free(limited.hears(), 1.0);
  assert_held(limited.slowed_to(0.25), 0.25);
  limited.asked = 0.5;
  assert_held(limited.hears(), 0.25);
}

TEST(it_never_makes_anything_faster, Limited limited) {
  limited.asked = 0.125;
  assert_free(limited.slowed_to(0.25), 0.125);
  assert_free(limited.slowed_to(7.0), 0.125);
  limited.asked = 0.0;
  assert_free(limited.slowed_to(0.25), 0.0);
}

TEST(a_share_of_nothing_stops, Limited limited) {
  for (const double ratio : {0.0, -1.0}) {
    const CommonValid valid = limited.slowed_to(ratio);
    assert_held(valid, 0.0);
    assert_true(valid.external.stops());
  }
}

/// 1/s from where it was; out of motion at once.
TEST(the_speed_comes_back_at_its_rate, Limited limited) {
  limited.slowed_to(0.25);
  limited.said.level = ExternalLevel::kFree;
  for (int n = 1; n < 96; ++n) {
    assert_held(limited.hears(), 0.25 + n * kCycle_s);
  }
  assert_free(limited.hears(), 1.0);
  limited.slowed_to(0.25);
  limited.said.level = ExternalLevel::kFree;
  limited.moving = false;
  assert_free(limited.hears(), 1.0);
}

TEST(a_stop_that_ends_by_itself_is_a_cap, Limited limited) {
  limited.hears();
  const CommonValid valid = limited.stopped(true);
  assert_held(valid, 0.0);
  assert_true(valid.external.stops());
  limited.said.level = ExternalLevel::kFree;
  assert_held(limited.hears(), kCycle_s);
}

TEST(another_stop_needs_the_operator, Limited limited) {
  assert_stops(limited.stopped(false), Fault::kExternalStop);
  limited.moving = false;
  assert_stops(limited.stopped(false), Fault::kExternalStop);
  // Out of motion there is nothing that could go on by itself.
  assert_stops(limited.stopped(true), Fault::kExternalStop);
  limited.said.level = ExternalLevel::kFree;
  assert_free(limited.hears(), 1.0);
}

TEST(a_level_that_is_not_known_stops, Limited limited) {
  limited.said.level = static_cast<ExternalLevel>(3);
  assert_stops(limited.hears(), Fault::kExternalStop);
}

/// A quarter of a second: 32 cycles of 7.8 ms hold.
TEST(silence_of_a_source_that_was_there_stops, Limited limited) {
  limited.hears();
  for (int n = 1; n <= 32; ++n) {
    assert_free(limited.silent(), 1.0);
  }
  assert_stops(limited.silent(), Fault::kExternalSilent);
  limited.moving = false;
  assert_stops(limited.silent(), Fault::kExternalSilent);
  assert_free(limited.hears(), 1.0);
}

TEST(the_source_says_for_how_long_its_word_holds, Limited limited) {
  const struct {
    double deadline_s;
    int cycles;
  } cases[] = {{0.125, 16},
               {1.0, 128},
               {60.0, 128},
               {std::numeric_limits<double>::infinity(), 128},
               {std::numeric_limits<double>::quiet_NaN(), 128}};
  for (const auto& each : cases) {
    limited.said.deadline_s = each.deadline_s;
    limited.hears();
    for (int n = 1; n <= each.cycles; ++n) {
      assert_free(limited.silent(), 1.0);
    }
    assert_stops(limited.silent(), Fault::kExternalSilent);
    limited.moving = false;
    assert_free(limited.hears(), 1.0);
    limited.moving = true;
  }
  limited.said.deadline_s = -1.0;
  assert_stops(limited.hears(), Fault::kExternalSilent);
}

TEST(a_word_from_the_future_is_none, Limited limited) {
  limited.hears();
  limited.heard.stamp_us = limited.now_us + kSecondUs;
  assert_stops(limited.silent(), Fault::kExternalSilent);
}

TEST(a_value_that_is_none_is_silence, Limited limited) {
  limited.hears();
  for (const Validity lost : {Validity::kNotAvailable, Validity::kError, Validity::kOutOfRange}) {
    assert_stops(limited.hears(lost), Fault::kExternalSilent);
    limited.moving = false;
    assert_free(limited.hears(), 1.0);
    limited.moving = true;
  }
  for (const double no_number :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    assert_stops(limited.slowed_to(no_number), Fault::kExternalSilent);
  }
}

/// An error is the word of a source that is there.
TEST(a_source_that_begins_with_an_error_is_one, Limited limited) {
  assert_stops(limited.hears(Validity::kError), Fault::kExternalSilent);
}

TEST(what_stopped_first_stays_the_first, Limited limited) {
  limited.said.level = ExternalLevel::kStop;
  limited.heard = {limited.said, Validity::kValid, limited.now_us};
  CommonValid valid;
  valid.fault = Fault::kStrokeMissing;
  tell_external(limited.heard, true, limited.now_us, kCycle_s, limited.state, valid);
  assert_int_equal(valid.fault, Fault::kStrokeMissing);
  assert_true(valid.faults.has(Fault::kExternalStop));
}

/// What is no word names nobody: the source is who gave the last one.
TEST(an_error_names_no_other_source, Limited limited) {
  static_cast<void>(limited.slowed_to(0.5));
  limited.said.source = kSource + 1;
  static_cast<void>(limited.hears(Validity::kError));
  assert_int_equal(limited.state.source, kSource);
  static_cast<void>(limited.hears());
  assert_int_equal(limited.state.source, kSource + 1);
}
