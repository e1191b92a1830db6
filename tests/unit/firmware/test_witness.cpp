// SPDX-License-Identifier: Apache-2.0
// A joint with two sensors: what counts as a contradiction.

#include "firmware/safety/witness.hpp"

#include <cmath>

#include "firmware/safety/tuning.hpp"
#include "tests/unit/cmocka_cpp.hpp"

/// Sums of powers of two, so that a band's edge is a number.
constexpr WitnessBand kBand{1.0 / 128, 1.0 / 512, 1.0 / 256, 0.0, 0.0, 0.5};
constexpr double kFirst = 1.0;
constexpr double kInstalledMost = kBand.offset + kBand.scale;
constexpr TimeUs kFrame_us = 15'625;  // Of a period of 1 / 64 s.

double above(double value) { return std::nextafter(value, 10.0); }

struct Joint {
  WitnessBand band = kBand;
  WitnessState state;
  bool learns = false;
  TimeUs now_us = kSecondUs;
  TimeUs stamp_us = kSecondUs;

  bool again(double first, double second) {
    return contradicts(band, first, {second, Validity::kValid, stamp_us}, learns, now_us, state);
  }
  /// With the next frame, which comes `late_us` before it is looked at.
  bool frame(double first, double second, TimeUs late_us = 0) {
    now_us += kFrame_us;
    stamp_us = now_us - late_us;
    return again(first, second);
  }
  /// Frames of a joint that stands, until they contradict; -1: never.
  int frames_until(double second) {
    for (int n = 1; n <= 100; ++n) {
      if (frame(kFirst, second)) {
        return n;
      }
    }
    return -1;
  }
};

TEST(two_of_a_kind_do_not_contradict, Joint joint) {
  assert_int_equal(joint.frames_until(kFirst), -1);
}

/// The first frame is not compared, one alone is not enough.
TEST(as_far_apart_as_they_are_installed, Joint joint) {
  for (const double way : {-1.0, 1.0}) {
    joint = {};
    assert_int_equal(joint.frames_until(kFirst + way * kInstalledMost), -1);
    joint = {};
    const double beyond = kFirst + way * kInstalledMost;
    assert_int_equal(joint.frames_until(std::nextafter(beyond, way * 10.0)), 1 + kWitnessApart);
  }
}

TEST(the_band_grows_with_what_is_shown, Joint joint) {
  joint.frame(0.0, above(kBand.offset));
  joint.frame(0.0, above(kBand.offset));
  assert_true(joint.frame(0.0, above(kBand.offset)));
  joint = {};
  joint.frame(-1.0, -1.0 - kInstalledMost);
  joint.frame(-1.0, -1.0 - kInstalledMost);
  assert_false(joint.frame(-1.0, -1.0 - kInstalledMost));
}

TEST(it_lasts_until_a_frame_says_otherwise, Joint joint) {
  joint.frames_until(kFirst + 1.0);
  assert_true(joint.again(kFirst, kFirst));  // Nothing has come.
  assert_true(joint.frame(kFirst, kFirst + 1.0));
  assert_false(joint.frame(kFirst, kFirst));
  // From here on anew.
  assert_false(joint.frame(kFirst, kFirst + 1.0));
  assert_true(joint.frame(kFirst, kFirst + 1.0));
}

TEST(a_frame_that_is_not_newer_is_none, Joint joint) {
  joint.stamp_us = joint.now_us = 0;  // The very first may come at any time.
  assert_false(joint.again(kFirst, kFirst));
  joint.frames_until(kFirst);
  repeat(5, [&] { assert_false(joint.again(kFirst, kFirst + 1.0)); });
  joint.stamp_us -= 1;
  repeat(5, [&] { assert_false(joint.again(kFirst, kFirst + 1.0)); });
  assert_int_equal(joint.frames_until(kFirst + 1.0), kWitnessApart);
  repeat(5, [&] { assert_true(joint.frame(kFirst, kFirst + 1.0)); });
  assert_true(joint.again(kFirst, kFirst));
}

/// What they cannot be installed as is no difference to go by.
TEST(a_lie_is_not_learnt, Joint joint) {
  joint.learns = true;
  joint.frames_until(kFirst);
  joint.frames_until(kFirst + 1.0);
  assert_near(joint.state.difference, 0.0, 0.0);
  joint = {};
  joint.learns = true;
  joint.frames_until(kFirst + 1.0);
  assert_false(joint.state.known);
  assert_false(joint.frame(kFirst, kFirst));
  assert_true(joint.state.known);
}

/// Though both may be off: what they were apart as the machine stood they stay, but for the play.
TEST(the_difference_stays_what_it_was, Joint joint) {
  const double installed = 1.0 / 256;
  joint.learns = true;
  assert_int_equal(joint.frames_until(kFirst + installed), -1);
  joint.learns = false;
  assert_int_equal(joint.frames_until(kFirst + installed + kBand.play), -1);
  assert_int_equal(joint.frames_until(above(kFirst + installed + kBand.play)), kWitnessApart);
  joint.frame(kFirst, kFirst + installed);
  assert_int_equal(joint.frames_until(kFirst + installed - kBand.play), -1);
  assert_int_equal(joint.frames_until(kFirst + installed - 2.0 * kBand.play), kWitnessApart);
}

TEST(a_way_from_where_it_was_learnt_widens_the_play, Joint joint) {
  joint.band.fastest_ps = 0.0;
  joint.frame(kFirst, kFirst);
  joint.frame(kFirst, kFirst);
  const double at = 0.5;
  const double most = kBand.play + kBand.scale * (kFirst - at);
  joint.frame(at, at + most);
  joint.frame(at, at + most);
  assert_false(joint.frame(at, at + most));
  joint.frame(at, above(at + most));
  assert_true(joint.frame(at, above(at + most)));
}

/// By a share of each frame, where the machine is not in motion.
TEST(the_difference_is_learnt_at_rest, Joint joint) {
  joint.frame(kFirst, kFirst);
  joint.frame(kFirst, kFirst);
  assert_true(joint.state.known);
  assert_near(joint.state.difference, 0.0, 0.0);
  joint.frame(kFirst, kFirst + kBand.play);
  assert_near(joint.state.difference, 0.0, 0.0);
  joint.learns = true;
  joint.frame(2.0, 2.0 + kBand.play);
  joint.frame(2.0, 2.0 + kBand.play);
  assert_near(joint.state.at, 2.0, 0.0);
  assert_true(joint.state.difference > kWitnessLearns * kBand.play);
  assert_true(joint.state.difference < kBand.play);
  // A machine that is moved by hand learns too: what it was is not what it is.
  assert_int_equal(joint.frames_until(kFirst + 0.9 * kInstalledMost), 2);
  repeat(20, [&] { joint.frame(kFirst, kFirst + 0.9 * kInstalledMost); });
  assert_false(joint.again(kFirst, kFirst));
}

/// At speed an old reading is where the first was: 0.25 a second, 1 / 64 s old.
TEST(age_is_taken_off, Joint joint) {
  constexpr double kStep = 1.0 / 256;
  for (const bool is_old : {true, false}) {
    joint = {};
    joint.band.least_age_s = joint.band.most_age_s = 1.0 / 64;
    double first = 0.5;
    bool contradicted = false;
    for (int n = 0; n < 50; ++n) {
      first += kStep;
      contradicted = joint.frame(first, is_old ? first - kStep : first + kStep) || contradicted;
    }
    // Ahead by two steps, 1 / 128: the play, what it may be late by a cycle, and 1 / 256 of way.
    assert_int_equal(contradicted, false);
    assert_near(joint.state.difference, is_old ? 0.0 : 2.0 * kStep, 1e-15);
  }
}

TEST(a_frame_that_waited_is_older, Joint joint) {
  constexpr double kStep = 1.0 / 256;
  double first = 0.5;
  for (int n = 0; n < 20; ++n) {
    first += kStep;
    assert_false(joint.frame(first, first - kStep / 2.0, kFrame_us / 2));
  }
  assert_near(joint.state.difference, 0.0, 1e-6);
}

/// What is not known of the age counts at the joint's speed, which no sensor can exaggerate.
TEST(an_age_that_is_not_known_widens_the_band, Joint joint) {
  joint.band.most_age_s = 1.0 / 32;
  joint.band.fastest_ps = 0.25;
  joint.frame(kFirst, kFirst);
  joint.frame(kFirst, kFirst);
  const double moved = 0.25 * (1.0 / 64 + kWitnessPhase_s);
  const double behind = 0.25 / 64;
  for (const double share : {0.99, 1.01}) {
    Joint shown = joint;
    double first = kFirst;
    bool contradicted = false;
    for (int n = 0; n < 4; ++n) {
      first += 1.0;  // Faster than the joint can.
      const double play = kBand.play + kBand.scale * (first - kFirst);
      contradicted = shown.frame(first, first - behind + share * (play + moved));
    }
    assert_int_equal(contradicted, share > 1.0);
  }
}
