// SPDX-License-Identifier: Apache-2.0
// What jumps while the dozer moves: blade stroke and the body's coordinates, cycle by cycle.

#include <cmath>

#include "firmware/dozer/safety/dozer_validation.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/plain_dozer.hpp"

constexpr bool kMoving = true;
constexpr TimeUs kNow = 5 * kSecondUs;
constexpr TimeUs kPeriod = 10 * kMillisecondUs;

/// One signal that is followed, its rate, and what it may do.
struct Followed {
  Signal<double>* (*value)(DozerInputs&);
  Signal<double>* (*rate)(DozerInputs&);  ///< nullptr: it has none.
  double (*believed)(const DozerValid&);
  double (*believed_rate)(const DozerValid&);
  double rate_ps;  ///< As measured.
  double most_ps;  ///< What it may change beside.
  double margin;
  Fault jump;
  Fault missing;
};

const Followed kFollowed[] = {
    // Twice 0.5 m/s, which all that the valve lets through gives.
    {[](DozerInputs& in) { return &in.blade_stroke_m; }, nullptr,
     [](const DozerValid& valid) { return valid.drive[0].stroke_m; }, nullptr, 0.0, 1.0,
     kJumpMargin_m, Fault::kStrokeJump, Fault::kStrokeMissing},
    {[](DozerInputs& in) { return &in.body.position_m; },
     [](DozerInputs& in) { return &in.body.velocity_mps; },
     [](const DozerValid& valid) { return valid.position_m; },
     [](const DozerValid& valid) { return valid.velocity_mps; }, 1.5, kRateMargin_ps,
     kPositionMargin_m, Fault::kPoseImplausible, Fault::kPoseMissing},
    {[](DozerInputs& in) { return &in.body.height_m; },
     [](DozerInputs& in) { return &in.body.climb_mps; },
     [](const DozerValid& valid) { return valid.height_m; },
     [](const DozerValid& valid) { return valid.climb_mps; }, -0.75, kRateMargin_ps,
     kHeightMargin_m, Fault::kPoseImplausible, Fault::kPoseMissing},
    {[](DozerInputs& in) { return &in.body.pitch_rad; },
     [](DozerInputs& in) { return &in.body.pitch_rate_radps; },
     [](const DozerValid& valid) { return valid.pitch_rad; },
     [](const DozerValid& valid) { return valid.pitch_rate_radps; }, 0.625, kRateMargin_ps,
     kPitchMargin_rad, Fault::kPoseImplausible, Fault::kPoseMissing},
};
constexpr double kAt = 0.375;

/// A machine in motion; a frame each cycle unless it is lost. All but the followed one stand still.
struct Machine {
  const Followed* followed;
  DozerValidationState state;
  TimeUs now_us = kNow;
  test::ValidatedDozer valid;
  Signal<double> newest;
  double rate_ps;

  explicit Machine(const Followed& one) : followed(&one), rate_ps(one.rate_ps) {
    assert_true(frame(kAt).faults.empty());
  }
  const test::ValidatedDozer& step(bool moving = kMoving) {
    DozerInputs inputs = test::complete_dozer_inputs(now_us);
    inputs.body.velocity_mps.value = 0.0;
    inputs.body.climb_mps.value = 0.0;
    inputs.body.pitch_rate_radps.value = 0.0;
    *followed->value(inputs) = newest;
    if (followed->rate != nullptr) {
      *followed->rate(inputs) = {rate_ps, newest.validity, newest.stamp_us};
    }
    valid = test::validate(inputs, test::plain_dozer(), state, moving, now_us);
    state = valid.state;
    now_us += kPeriod;
    return valid;
  }
  const test::ValidatedDozer& frame(double value, bool moving = kMoving) {
    newest = test::fresh(value, now_us);
    return step(moving);
  }
  const test::ValidatedDozer& lost() { return step(); }
  [[nodiscard]] double believed() const { return followed->believed(valid); }
  /// Further than the signal can get in any of these tests, and within what can be.
  [[nodiscard]] static double far() { return 0.7; }
};

/// Where the rate takes it, and so far beside, is believed; further is not: both ways, and by as
/// much more after a frame was lost.
TEST(a_jump_is_not_believed) {
  for (const Followed& one : kFollowed) {
    for (const double sign : {1.0, -1.0}) {
      for (const int cycles : {1, 2, 3}) {
        const double time_s = 0.01 * cycles;
        const double beside = sign * (one.most_ps * time_s + one.margin);
        for (const bool jumps : {false, true}) {
          Machine machine(one);
          for (int n = 1; n < cycles; ++n) {
            assert_true(machine.lost().faults.empty());
          }
          const double to = kAt + one.rate_ps * time_s + beside + sign * (jumps ? 1e-9 : -1e-9);
          machine.rate_ps = one.rate_ps;
          const test::ValidatedDozer& valid = machine.frame(to);
          assert_int_equal(valid.fault, Fault::kNone);
          assert_int_equal(valid.faults.has(one.jump), jumps);
          assert_int_equal(valid.degraded.has(one.jump), jumps);
          assert_near(machine.believed(), jumps ? kAt : to, 0.0);
        }
      }
    }
  }
}

/// With a coordinate its rate is not believed either.
TEST(the_rate_of_a_jump_is_not_believed) {
  for (const Followed& one : kFollowed) {
    if (one.rate == nullptr) {
      continue;
    }
    Machine machine(one);
    machine.rate_ps = 40.0;
    machine.frame(kAt);
    assert_true(machine.valid.degraded.has(one.jump));
    assert_near(machine.believed(), kAt, 0.0);
    assert_near(one.believed_rate(machine.valid), one.rate_ps, 0.0);
    machine.rate_ps = 0.0;
    assert_true(machine.frame(kAt).faults.empty());
    assert_near(one.believed_rate(machine.valid), 0.0, 0.0);
  }
}

/// Back where it was: over, as if nothing had been.
TEST(a_jump_and_back_is_bridged) {
  for (const Followed& one : kFollowed) {
    Machine machine(one);
    repeat(3, [&] { assert_true(machine.frame(Machine::far()).degraded.has(one.jump)); });
    assert_true(machine.frame(kAt + 0.001).faults.empty());
    assert_near(machine.believed(), kAt + 0.001, 0.0);
  }
}

/// It stays: the last that was believed grows old, and the machine stops. Before that the jump is
/// never taken for the truth. Stopped, the operator may begin again from where the sensor says.
TEST(a_jump_that_stays_stops) {
  for (const Followed& one : kFollowed) {
    Machine machine(one);
    for (int n = 1; n <= 4; ++n) {
      assert_int_equal(machine.frame(Machine::far()).fault, Fault::kNone);
      assert_near(machine.believed(), kAt, 0.0);
    }
    const test::ValidatedDozer& valid = machine.frame(Machine::far());
    assert_true(valid.faults.has(one.jump) && valid.faults.has(one.missing));
    assert_true(valid.fault == one.missing || valid.fault == one.jump);
    assert_true(valid.degraded.empty());
    assert_true(machine.frame(Machine::far(), !kMoving).faults.empty());
    assert_near(machine.believed(), Machine::far(), 0.0);
    machine.rate_ps = 0.0;
    assert_true(machine.frame(Machine::far()).faults.empty());
  }
}

/// A sensor that dies after its jump is missing at once.
TEST(a_jump_to_nothing_is_a_loss) {
  for (const Followed& one : kFollowed) {
    Machine machine(one);
    machine.frame(Machine::far());
    machine.newest = {Machine::far(), Validity::kNotAvailable, machine.now_us};
    assert_int_equal(machine.step().fault, one.missing);
  }
}

/// A coordinate whose rate is gone is held against its last value, and the loss stops anyway.
TEST(without_a_rate_nothing_is_expected) {
  for (const Followed& one : kFollowed) {
    if (one.rate == nullptr) {
      continue;
    }
    Machine machine(one);
    DozerInputs inputs = test::complete_dozer_inputs(machine.now_us);
    one.value(inputs)->value = kAt;
    one.rate(inputs)->validity = Validity::kNotAvailable;
    one.rate(inputs)->value = 1e3;
    const test::ValidatedDozer valid =
        test::validate(inputs, test::plain_dozer(), machine.state, kMoving, machine.now_us);
    assert_int_equal(valid.fault, Fault::kPoseMissing);
    assert_near(one.believed(valid), kAt, 0.0);
  }
}

/// One jump that is bridged excuses neither the other nor anything else.
TEST(a_jump_hides_nothing) {
  for (const Followed& one : kFollowed) {
    const Machine before(one);
    DozerInputs inputs = test::complete_dozer_inputs(before.now_us);
    *one.value(inputs) = test::fresh(Machine::far(), before.now_us);
    inputs.link.bus = BusState::kOff;
    const test::ValidatedDozer valid =
        test::validate(inputs, test::plain_dozer(), before.state, kMoving, before.now_us);
    assert_int_equal(valid.fault, Fault::kBusOff);
    assert_true(valid.degraded.has(one.jump));
  }
}

/// On its side it stops, though the way there was a jump.
TEST(a_jump_onto_its_side_is_bridged_only_as_a_jump) {
  Machine machine(kFollowed[3]);
  assert_true(machine.frame(1.0).degraded.has(Fault::kPoseImplausible));
  assert_int_equal(machine.valid.fault, Fault::kNone);
  double pitch_rad = kAt;
  machine.rate_ps = 1.0;
  machine.frame(pitch_rad);
  while (pitch_rad < 0.79) {
    pitch_rad += 0.01;
    assert_true(machine.frame(pitch_rad).faults.empty());
  }
  machine.frame(0.81);
  assert_int_equal(machine.valid.fault, Fault::kPoseImplausible);
  assert_true(machine.valid.degraded.empty());
}

/// Moved by hand, it may be anywhere at any time.
TEST(outside_motion_nothing_jumps) {
  for (const Followed& one : kFollowed) {
    Machine machine(one);
    assert_true(machine.frame(Machine::far(), !kMoving).faults.empty());
    assert_near(machine.believed(), Machine::far(), 0.0);
  }
}
