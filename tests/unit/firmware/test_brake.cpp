// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/dozer_watch.hpp"

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"

constexpr double kPeriod_s = 0.0625;
constexpr BrakeState kReleased{false, 0.0};

DozerValid tracks_at(double left_mps, double right_mps) {
  DozerValid valid;
  valid.automatic = true;
  valid.track_speed_mps = {left_mps, right_mps};
  return valid;
}

bool wanted(const BrakeState& last, EcuMode mode, const DozerValid& valid) {
  return brake(last, {mode, Fault::kNone}, valid, kPeriod_s).wanted;
}

TEST(it_is_on_from_the_start) {
  assert_true(BrakeState{}.wanted);
  assert_true(wanted({}, EcuMode::kSilent, tracks_at(0.0, 0.0)));
}

TEST(motion_releases_it) {
  for (const EcuMode mode : {EcuMode::kArmed, EcuMode::kActive}) {
    assert_false(wanted({}, mode, tracks_at(0.0, 0.0)));
    assert_false(wanted({}, mode, tracks_at(1.0, 1.0)));
  }
}

/// After motion: not before both tracks stand, to the last bit, whichever way they run.
TEST(it_waits_for_both_tracks) {
  for (const EcuMode mode :
       {EcuMode::kSilent, EcuMode::kReady, EcuMode::kStopping, EcuMode::kFault}) {
    for (const double sign : {1.0, -1.0}) {
      const double rest_mps = sign * kTrackAtRest_mps;
      const double runs_mps = std::nextafter(rest_mps, sign * 9.0);
      assert_true(wanted(kReleased, mode, tracks_at(rest_mps, rest_mps)));
      assert_false(wanted(kReleased, mode, tracks_at(runs_mps, rest_mps)));
      assert_false(wanted(kReleased, mode, tracks_at(rest_mps, runs_mps)));
    }
  }
}

/// Dragged downhill it keeps it, but for an operator who drives by hand. One who is not heard does
/// not.
TEST(it_stays_until_the_next_motion) {
  DozerValid dragged = tracks_at(0.5, 0.5);
  assert_true(wanted({true, 0.0}, EcuMode::kReady, dragged));
  dragged.automatic = false;
  assert_false(wanted({true, 0.0}, EcuMode::kReady, dragged));
  dragged.faults.add(Fault::kOperatorMissing);
  assert_true(wanted({true, 0.0}, EcuMode::kSilent, dragged));
  assert_true(wanted({false, 0.0}, EcuMode::kReady, tracks_at(0.0, 0.0)));
}

/// At once, at any speed: while it is there and while it is what stopped the machine.
TEST(a_runaway_is_braked_at_once) {
  DozerValid valid = tracks_at(2.0, 2.0);
  assert_true(
      brake(kReleased, {EcuMode::kFault, Fault::kDisplacementRunaway}, valid, kPeriod_s).wanted);
  for (const Fault other : {Fault::kDisplacementDisagrees, Fault::kTrackSpeedDisagrees}) {
    assert_false(brake(kReleased, {EcuMode::kFault, other}, valid, kPeriod_s).wanted);
  }
  valid.faults.add(Fault::kDisplacementRunaway);
  for (const EcuMode mode : {EcuMode::kSilent, EcuMode::kReady, EcuMode::kActive}) {
    assert_true(wanted(kReleased, mode, valid));
  }
  // Once the operator has it in hand it is his; not while he holds enable.
  valid.automatic = false;
  valid.enable = true;
  assert_true(wanted(kReleased, EcuMode::kFault, valid));
  valid.enable = false;
  assert_false(wanted({true, 0.0}, EcuMode::kFault, valid));
}

/// Without the tracks' speeds it comes a second after the motion; in motion that time is not
/// counted.
TEST(tracks_that_are_not_seen_come_to_rest_in_a_second) {
  DozerValid valid = tracks_at(0.0, 0.0);
  valid.faults.add(Fault::kTransmissionMissing);
  BrakeState state{false, 0.9};
  state = brake(state, {EcuMode::kActive, Fault::kNone}, valid, kPeriod_s);
  for (int n = 1; n <= 16; ++n) {
    state = brake(state, {EcuMode::kFault, Fault::kTransmissionMissing}, valid, kPeriod_s);
    assert_false(state.wanted);
  }
  state = brake(state, {EcuMode::kFault, Fault::kTransmissionMissing}, valid, kPeriod_s);
  assert_true(state.wanted);
  // However long it lasts, it does not count up for ever.
  state = brake(state, {EcuMode::kFault, Fault::kTransmissionMissing}, valid, 1e9);
  assert_near(state.coasting_s, 2.0 * kCoasting_s, 0.0);
}
