// SPDX-License-Identifier: Apache-2.0
// What the validation stops and what it bridges while the machine moves; the bus.

#include "firmware/excavator/safety/excavator_validation.hpp"

#include <cmath>

#include "firmware/hydraulics/flow.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/inputs.hpp"
#include "tests/unit/firmware/plain_machine.hpp"

using test::complete_inputs;
using test::validate;

constexpr bool kMoving = true;
constexpr TimeUs kNow = 5 * kSecondUs;
constexpr TimeUs kPeriod = 10 * kMillisecondUs;
constexpr TimeUs kStale = kNow - 50 * kMillisecondUs;
/// Both in motion and before it.
constexpr bool kEither[] = {false, true};

const ExcavatorProfile& profile() {
  static const ExcavatorProfile machine = test::plain_machine();
  return machine;
}

test::Validated judged(const ExcavatorInputs& inputs, bool moving) {
  return validate(inputs, profile(), {}, moving, kNow);
}

/// A fault of this kind stops, whether the machine moves or not.
void assert_stops(Fault fault, const ExcavatorInputs& inputs) {
  for (const bool moving : kEither) {
    const test::Validated valid = judged(inputs, moving);
    assert_int_equal(valid.fault, fault);
    assert_true(valid.faults.has(fault));
    assert_true(valid.degraded.empty());
  }
}

/// A fault of this kind only slows in motion; before it, it stops: arming wants everything.
void assert_degrades(Fault fault, const ExcavatorInputs& inputs) {
  const test::Validated before = judged(inputs, !kMoving);
  assert_int_equal(before.fault, fault);
  assert_true(before.degraded.empty());
  const test::Validated moving = judged(inputs, kMoving);
  assert_int_equal(moving.fault, Fault::kNone);
  assert_true(moving.faults.has(fault));
  assert_true(moving.degraded == moving.faults);
}

TEST(a_lost_pressure_slows_and_its_load_is_unknown) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const bool rod : {false, true}) {
      ExcavatorInputs inputs = complete_inputs(kNow);
      (rod ? inputs.axis[axis].rod_pressure_pa : inputs.axis[axis].cap_pressure_pa).stamp_us =
          kStale;
      assert_degrades(Fault::kPressureMissing, inputs);
      for (unsigned i = 0; i < kAxisCount; ++i) {
        assert_int_equal(judged(inputs, kMoving).drive[i].load_known, i != axis);
      }
    }
  }
}

/// Without its speed the engine is reckoned with at its slowest.
TEST(a_lost_engine_speed_slows_to_idle) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  assert_near(judged(inputs, kMoving).engine_radps, 188.5, 0.0);
  inputs.engine_speed_radps.stamp_us = kStale;
  assert_degrades(Fault::kEngineSpeedMissing, inputs);
  for (const bool moving : kEither) {
    assert_near(judged(inputs, moving).engine_radps, 90.0, 0.0);
  }
}

TEST(a_value_out_of_range_slows) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.link.out_of_range = true;
  assert_degrades(Fault::kValueOutOfRange, inputs);
}

TEST(all_else_that_is_lost_stops) {
  using In = ExcavatorInputs;
  const struct {
    void (*lose)(In&);
    Fault fault;
  } rows[] = {{[](In& in) { in.axis[1].stroke_m.stamp_us = kStale; }, Fault::kStrokeMissing},
              {[](In& in) { in.swash_ratio[1].stamp_us = kStale; }, Fault::kSwashMissing},
              {[](In& in) { in.axis[2].spool_ratio.stamp_us = kStale; }, Fault::kSpoolMissing},
              {[](In& in) { in.valve_enabled.stamp_us = kStale; }, Fault::kSpoolMissing},
              {[](In& in) { in.driver.task.stamp_us = kStale; }, Fault::kOperatorMissing},
              {[](In& in) { in.same_machine.value = false; }, Fault::kIdentityMismatch}};
  for (const auto& row : rows) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    row.lose(inputs);
    assert_stops(row.fault, inputs);
  }
}

/// What only slows does not hide what stops, whichever comes first.
TEST(the_first_that_stops_is_named) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.axis[0].cap_pressure_pa.stamp_us = kStale;
  inputs.swash_ratio[0].stamp_us = kStale;
  inputs.link.bus = BusState::kOff;
  inputs.link.out_of_range = true;
  const test::Validated valid = judged(inputs, kMoving);
  assert_int_equal(valid.fault, Fault::kSwashMissing);
  FaultSet slowing;
  slowing.add(Fault::kPressureMissing);
  slowing.add(Fault::kValueOutOfRange);
  assert_true(valid.degraded == slowing);
  assert_true(valid.faults.has(Fault::kBusOff));
  assert_int_equal(judged(inputs, !kMoving).fault, Fault::kPressureMissing);
}

TEST(only_an_active_bus_will_do) {
  struct Row {
    BusState bus;
    Fault fault;
  };
  for (const Row& row :
       {Row{BusState::kPassive, Fault::kBusPassive}, Row{BusState::kOff, Fault::kBusOff},
        Row{BusState::kDown, Fault::kBusDown}}) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    inputs.link.bus = row.bus;
    assert_stops(row.fault, inputs);
    FaultSet only;
    only.add(row.fault);
    assert_true(judged(inputs, kMoving).faults == only);
  }
}

TEST(one_dropped_command_is_borne) {
  ExcavatorInputs inputs = complete_inputs(kNow);
  for (const int dropped : {0, 1}) {
    inputs.link.dropped_cycles = dropped;
    for (const bool moving : kEither) {
      assert_true(judged(inputs, moving).faults.empty());
    }
  }
  for (const int dropped : {2, 3, 1000}) {
    inputs.link.dropped_cycles = dropped;
    assert_stops(Fault::kTransmitFailed, inputs);
  }
}

TEST(faults_of_messages_stop) {
  for (const Fault fault :
       {Fault::kMessageCorrupt, Fault::kMessageSequence, Fault::kMessageMasquerade}) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    inputs.link.message_faults.add(fault);
    assert_stops(fault, inputs);
  }
}

/// 'Error' is named beside the loss; 'not available' is a loss only.
TEST(a_sensors_own_error_is_named) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    inputs.axis[axis].stroke_m.validity = Validity::kError;
    assert_stops(Fault::kStrokeMissing, inputs);
    assert_true(judged(inputs, kMoving).faults.has(Fault::kSensorError));
    inputs.axis[axis].stroke_m.validity = Validity::kNotAvailable;
    assert_false(judged(inputs, kMoving).faults.has(Fault::kSensorError));
  }
}

TEST(the_other_sensors_own_errors_are_named_too) {
  struct Row {
    Signal<double>* (*signal)(ExcavatorInputs&);
    Fault wrong;
  };
  const Row rows[] = {
      {[](ExcavatorInputs& in) { return &in.axis[1].cap_pressure_pa; },
       Fault::kPressureImplausible},
      {[](ExcavatorInputs& in) { return &in.axis[2].rod_pressure_pa; },
       Fault::kPressureImplausible},
      {[](ExcavatorInputs& in) { return &in.axis[0].spool_ratio; }, Fault::kSensorError},
      {[](ExcavatorInputs& in) { return &in.swash_ratio[1]; }, Fault::kSensorError},
      {[](ExcavatorInputs& in) { return &in.engine_speed_radps; }, Fault::kEngineSpeedMissing},
  };
  for (const Row& row : rows) {
    ExcavatorInputs inputs = complete_inputs(kNow);
    row.signal(inputs)->validity = Validity::kError;
    assert_true(judged(inputs, kMoving).faults.has(row.wrong));
    // A pressure that calls itself wrong still only slows.
    assert_int_equal(judged(inputs, kMoving).fault == Fault::kNone,
                     row.wrong != Fault::kSensorError);
  }
}

/// An engine beyond any speed of its own is none: its pumps' flow would lift lambda.
TEST(an_engine_too_fast_is_not_believed) {
  const double most_radps = 1.2 * profile().pump[0].rated_speed_radps;
  ExcavatorInputs inputs = complete_inputs(kNow);
  inputs.engine_speed_radps.value = most_radps;
  assert_true(judged(inputs, kMoving).faults.empty());
  assert_near(judged(inputs, kMoving).engine_radps, most_radps, 0.0);
  inputs.engine_speed_radps.value = std::nextafter(most_radps, 1e9);
  assert_degrades(Fault::kEngineSpeedMissing, inputs);
  assert_near(judged(inputs, kMoving).engine_radps, profile().safety.idle_radps, 0.0);
}

TEST(no_pump_gives_more_than_at_full_swash) {
  const PumpProfile& pump = profile().pump[0];
  const double full_m3ps = pump_flow_m3ps(pump, 100.0, 1.0);
  assert_true(full_m3ps > 0.0);
  assert_near(pump_flow_m3ps(pump, 100.0, 1.2), full_m3ps, 0.0);
  assert_near(pump_flow_m3ps(pump, 100.0, 0.5), 0.5 * full_m3ps, 1e-18);
}

/// A cylinder in motion, cycle by cycle; a frame each cycle unless it is lost.
struct Stroke {
  unsigned axis = kBoom;
  test::StrokesAccepted state;
  TimeUs now_us = kNow;
  test::Validated valid;
  Signal<double> newest;

  const test::Validated& step(bool moving = kMoving) {
    ExcavatorInputs inputs = complete_inputs(now_us);
    inputs.axis[axis].stroke_m = newest;
    valid = validate(inputs, profile(), state, moving, now_us);
    state = valid.state;
    now_us += kPeriod;
    return valid;
  }
  const test::Validated& frame(double stroke_m, bool moving = kMoving) {
    newest = test::fresh(stroke_m, now_us);
    return step(moving);
  }
  const test::Validated& lost() { return step(); }
};

Stroke at_half(unsigned axis) {
  Stroke stroke;
  stroke.axis = axis;
  assert_int_equal(stroke.frame(0.5).fault, Fault::kNone);
  return stroke;
}

/// Boom and bucket can do 1 m/s, the arm with its larger pump 2: so far in a cycle, and the margin.
double reach_m(unsigned axis, int cycles) {
  return (axis == kArm ? 0.02 : 0.01) * cycles + kJumpMargin_m;
}

/// As fast as the cylinder can is believed, faster is not: each axis, both ways, and by as much
/// more after a frame was lost.
TEST(a_jump_is_not_believed) {
  for (unsigned axis = 0; axis < kAxisCount; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      for (const int cycles : {1, 2, 3}) {
        const double change_m = reach_m(axis, cycles);
        for (const bool jumps : {false, true}) {
          Stroke stroke = at_half(axis);
          for (int n = 1; n < cycles; ++n) {
            assert_true(stroke.lost().faults.empty());
          }
          const double to_m = 0.5 + sign * (change_m + (jumps ? 1e-9 : -1e-9));
          const test::Validated& valid = stroke.frame(to_m);
          assert_int_equal(valid.fault, Fault::kNone);
          assert_int_equal(valid.faults.has(Fault::kStrokeJump), jumps);
          assert_int_equal(valid.degraded.has(Fault::kStrokeJump), jumps);
          assert_near(valid.drive[axis].stroke_m, jumps ? 0.5 : to_m, 0.0);
        }
      }
    }
  }
}

/// The margin itself is believed, the next number is not: two values of one instant, which no speed
/// explains. And without one that was ever believed there is nothing to jump from.
TEST(the_margin_is_a_sharp_edge) {
  for (const bool jumps : {false, true}) {
    Stroke stroke;
    assert_true(stroke.frame(0.0).faults.empty());
    stroke.newest.value = jumps ? std::nextafter(kJumpMargin_m, 1.0) : kJumpMargin_m;
    assert_int_equal(stroke.step().faults.has(Fault::kStrokeJump), jumps);
  }
  assert_true(validate(complete_inputs(0), profile(), {}, kMoving, 0).faults.empty());
}

/// Back where it was: over, as if nothing had been.
TEST(a_jump_and_back_is_bridged) {
  Stroke stroke = at_half(kBoom);
  repeat(3, [&] { assert_true(stroke.frame(0.75).degraded.has(Fault::kStrokeJump)); });
  assert_true(stroke.frame(0.505).faults.empty());
  assert_near(stroke.valid.drive[kBoom].stroke_m, 0.505, 0.0);
  assert_true(stroke.frame(0.51).faults.empty());
}

/// It stays: the last that was believed grows old, and the machine stops. Before that the jump is
/// never taken for the truth.
TEST(a_jump_that_stays_stops) {
  Stroke stroke = at_half(kBoom);
  for (int n = 1; n <= 4; ++n) {
    assert_int_equal(stroke.frame(0.75).fault, Fault::kNone);
    assert_near(stroke.valid.drive[kBoom].stroke_m, 0.5, 0.0);
  }
  stroke.frame(0.75);  // 50 ms
  assert_int_equal(stroke.valid.fault, Fault::kStrokeMissing);
  assert_true(stroke.valid.faults.has(Fault::kStrokeJump));
  assert_false(stroke.valid.degraded.has(Fault::kStrokeJump));
  // Stopped, the operator may begin again from where the sensor says.
  assert_true(stroke.frame(0.75, !kMoving).faults.empty());
  assert_near(stroke.valid.drive[kBoom].stroke_m, 0.75, 0.0);
  assert_true(stroke.frame(0.76).faults.empty());
}

/// A sensor that dies after its jump, or jumps to no number, is missing at once.
TEST(a_jump_to_nothing_is_a_loss) {
  Stroke failing = at_half(kBoom);
  failing.frame(0.75);
  failing.newest = {0.75, Validity::kNotAvailable, failing.now_us};
  assert_int_equal(failing.step().fault, Fault::kStrokeMissing);
  Stroke mad = at_half(kBoom);
  assert_int_equal(mad.frame(std::nan("")).fault, Fault::kStrokeMissing);
  Stroke silent = at_half(kBoom);
  silent.frame(0.75);
  repeat(3, [&] { assert_int_equal(silent.lost().fault, Fault::kNone); });
  assert_int_equal(silent.lost().fault, Fault::kStrokeMissing);
}

/// A jump that is bridged excuses nothing else.
TEST(a_jump_hides_nothing) {
  const Stroke before = at_half(kBoom);
  ExcavatorInputs inputs = complete_inputs(before.now_us);
  inputs.axis[kBoom].stroke_m.value = 0.75;
  inputs.link.bus = BusState::kOff;
  const test::Validated valid = validate(inputs, profile(), before.state, kMoving, before.now_us);
  assert_int_equal(valid.fault, Fault::kBusOff);
  assert_true(valid.degraded.has(Fault::kStrokeJump));
  assert_false(valid.degraded.has(Fault::kBusOff));
}

/// Moved by hand, a stroke may be anywhere at any time.
TEST(outside_motion_nothing_jumps) {
  Stroke stroke = at_half(kBoom);
  assert_true(stroke.frame(1.0, !kMoving).faults.empty());
  assert_near(stroke.valid.drive[kBoom].stroke_m, 1.0, 0.0);
}
