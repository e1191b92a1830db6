// SPDX-License-Identifier: Apache-2.0
// One step, from end to end, while something fails in motion.

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "tests/unit/firmware/flip_bit.hpp"
#include "tests/unit/firmware/memory_access.hpp"
#include "tests/unit/firmware/running.hpp"

using test::assert_neutral;
using test::fresh;
using Memory = ControllerMemoryAccess;

/// In motion, with cylinders that go as the solution has them and pressures that live.
struct Digging : test::Running {
  std::array<double, kAxisCount> stroke_m{};
  int cycles = 0;

  Digging() {
    const ExcavatorInputs start = test::complete_inputs(0);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      stroke_m[i] = start.axis[i].stroke_m.value;
    }
    run(40);
    assert_int_equal(outputs.status.mode, EcuMode::kActive);
    assert_true(outputs.status.faults.empty());
  }
  /// What the machine says now.
  ExcavatorInputs next() {
    ++cycles;
    ExcavatorInputs inputs = this->inputs();
    for (unsigned i = 0; i < kAxisCount; ++i) {
      stroke_m[i] += outputs.status.lambda * outputs.status.wanted_velocity_mps[i] * 0.01;
      inputs.axis[i].stroke_m.value = stroke_m[i];
      inputs.axis[i].cap_pressure_pa.value += cycles % 5;
      inputs.axis[i].rod_pressure_pa.value += cycles % 5;
    }
    return inputs;
  }
  void run(int count) {
    repeat(count, [&] { step(next()); });
  }
  [[nodiscard]] double wanted_mps() const {
    double most = 0.0;
    for (const double velocity : outputs.status.wanted_velocity_mps) {
      most = std::max(most, std::abs(velocity));
    }
    return most;
  }
  /// Released at rest, then given afresh.
  void rearm() {
    step(at_rest(false));
    step(at_rest(false));
    step(at_rest(true));
  }
};

FaultSet set_of(std::initializer_list<Fault> faults) {
  FaultSet set;
  for (const Fault fault : faults) {
    set.add(fault);
  }
  return set;
}

void assert_stopped_by(Fault fault, const ExcavatorOutputs& outputs) {
  assert_neutral(outputs);
  assert_int_equal(outputs.status.mode, EcuMode::kFault);
  assert_int_equal(outputs.status.fault, fault);
  assert_true(outputs.status.faults.has(fault));
  assert_true(outputs.status.why_not_armed >> static_cast<unsigned>(ArmBlock::kFaultLatched) & 1U);
}

/// Stopped, and still so with everything well again; released and given afresh it goes on.
void assert_latched(Fault fault, Digging& digging) {
  assert_stopped_by(fault, digging.outputs);
  for (int n = 0; n < 5; ++n) {
    digging.step(digging.inputs());
    assert_stopped_by(fault, digging.outputs);
    assert_true(digging.outputs.status.faults == set_of({fault}));
  }
  digging.rearm();
  assert_int_equal(digging.outputs.status.mode, EcuMode::kArmed);
  assert_int_equal(digging.outputs.status.fault, Fault::kNone);
  assert_true(digging.outputs.status.faults.empty());
}

/// Cycles come `late_us` after their time, each as many times as stands here.
ExcavatorOutputs after_late(Digging& digging, std::initializer_list<bool> late, TimeUs late_us) {
  for (const bool is_late : late) {
    digging.now_us += is_late ? late_us : 0;
    digging.step(digging.next());
  }
  return digging.outputs;
}

TEST(one_late_cycle_is_borne) {
  constexpr TimeUs kLate = 5 * kMillisecondUs + 1;
  Digging digging;
  assert_true(after_late(digging, {true}, kLate).enable);
  assert_true(after_late(digging, {false, true, false, true, false}, kLate).enable);
  assert_true(digging.outputs.status.faults.empty());
  assert_true(after_late(digging, {true, true, true}, kLate - 1).enable);  // 15 ms: in time.
}

TEST(the_second_late_cycle_in_a_row_stops, Digging digging) {
  after_late(digging, {true, true}, 5 * kMillisecondUs + 1);
  assert_latched(Fault::kCycleOverrun, digging);
  Digging ever_late;
  after_late(ever_late, {true, true, true, true, true}, 10 * kMillisecondUs);
  assert_stopped_by(Fault::kCycleOverrun, ever_late.outputs);
  assert_true(ever_late.outputs.status.why_not_armed >> static_cast<unsigned>(ArmBlock::kCycle) &
              1U);
}

TEST(told_to_end_is_neutral_for_good, Digging digging) {
  ExcavatorInputs last = digging.next();
  last.link.stop_requested = true;
  assert_neutral(digging.step(last));
  assert_int_equal(digging.outputs.status.mode, EcuMode::kStopping);
  assert_int_equal(digging.outputs.status.fault, Fault::kNone);
  digging.rearm();
  assert_neutral(digging.step(digging.inputs()));
  assert_int_equal(digging.outputs.status.mode, EcuMode::kStopping);
  assert_true(digging.outputs.status.why_not_armed >> static_cast<unsigned>(ArmBlock::kStopping) &
              1U);
}

/// Loses a signal in motion: on it goes, at the profile's share of the speed and named as degraded;
/// back to the whole of it a second after the signal is back.
template <class Lose>
void assert_goes_on_slower(Fault fault, Lose lose) {
  const double share = test::excavator().profile.safety.degraded_speed_ratio;
  Digging digging;
  const double whole_mps = digging.wanted_mps();
  const double swash_ratio = digging.outputs.swash_ratio[0];
  for (int n = 0; n < 60; ++n) {
    ExcavatorInputs inputs = digging.next();
    lose(inputs);
    const ExcavatorOutputs outputs = digging.step(inputs);
    assert_true(outputs.enable);
    assert_int_equal(outputs.status.mode, EcuMode::kActive);
    assert_int_equal(outputs.status.fault, fault);
    assert_true(outputs.status.faults == set_of({fault}));
    assert_int_equal(outputs.status.why_not_armed, 0);
    assert_true(digging.wanted_mps() < 1.5 * share * whole_mps);
    assert_true(digging.wanted_mps() > 0.5 * share * whole_mps);
  }
  if (fault == Fault::kEngineSpeedMissing) {
    // At idle, which is assumed, a pump turns half as fast: its swash makes up for it.
    assert_true(digging.outputs.swash_ratio[0] > 1.05 * swash_ratio);
  }
  assert_near(digging.outputs.status.lambda, 1.0, 0.0);
  assert_int_equal(digging.outputs.status.limit.kind, LimitKind::kDegraded);
  assert_int_equal(digging.outputs.status.limit.index, fault);
  digging.run(99);
  assert_int_equal(digging.outputs.status.fault, fault);  // Slows on, though it is back.
  assert_true(digging.outputs.status.faults.empty());
  digging.run(2);
  assert_int_equal(digging.outputs.status.fault, Fault::kNone);
  assert_true(digging.wanted_mps() > 2.0 * share * whole_mps);
}

TEST(a_lost_pressure_slows) {
  assert_goes_on_slower(Fault::kPressureMissing, [](ExcavatorInputs& inputs) {
    inputs.axis[kArm].cap_pressure_pa.stamp_us -= 60 * kMillisecondUs;
  });
}

TEST(a_lost_engine_speed_slows) {
  assert_goes_on_slower(Fault::kEngineSpeedMissing, [](ExcavatorInputs& inputs) {
    inputs.engine_speed_radps.validity = Validity::kNotAvailable;
  });
}

/// A spool that stays open against its command. The pilot pressure stays cut until the operator has
/// armed again: with the deadman released the spool must not get it back.
TEST(a_stuck_spool_cuts_the_pilot_until_rearmed, Digging digging) {
  int cycles = 0;
  while (digging.outputs.status.mode == EcuMode::kActive) {
    assert_false(digging.outputs.pilot_cut);
    ExcavatorInputs inputs = digging.next();
    inputs.axis[kBucket].spool_ratio.value = -0.9;
    digging.step(inputs);
    assert_true(++cycles <= kSpoolWrongCycles);
  }
  assert_true(digging.outputs.pilot_cut);
  assert_stopped_by(Fault::kSpoolStuck, digging.outputs);
  for (int n = 0; n < 3; ++n) {
    digging.step(digging.inputs());
    assert_stopped_by(Fault::kSpoolStuck, digging.outputs);
    assert_true(digging.outputs.pilot_cut);
  }
  repeat(100, [&] { assert_true(digging.step(digging.at_rest(false)).pilot_cut); });
  assert_int_equal(digging.outputs.status.mode, EcuMode::kReady);
  assert_false(digging.step(digging.at_rest(true)).pilot_cut);
  assert_int_equal(digging.outputs.status.mode, EcuMode::kArmed);
  assert_false(digging.step(digging.at_rest(false)).pilot_cut);
}

/// Whatever stopped the machine first: a spool that then does not close loses its pilot pressure.
TEST(another_fault_does_not_hide_a_stuck_spool) {
  for (const bool held : {true, false}) {
    Digging digging;
    ExcavatorInputs inputs = digging.next();
    inputs.link.bus = BusState::kOff;
    digging.step(inputs);
    assert_stopped_by(Fault::kBusOff, digging.outputs);
    for (int n = 0; n < 40; ++n) {
      inputs = held ? digging.inputs() : digging.at_rest(false);
      inputs.link.bus = BusState::kOff;
      inputs.axis[kBoom].spool_ratio.value = 0.5;
      digging.step(inputs);
    }
    assert_int_equal(digging.outputs.status.fault, Fault::kBusOff);
    assert_true(digging.outputs.pilot_cut);
  }
}

/// Nor does it outside motion, and the cut stays when the spool is back.
TEST(a_spool_left_open_stays_without_pilot, Digging digging) {
  for (int n = 0; n < 40; ++n) {
    ExcavatorInputs inputs = digging.at_rest(false);
    inputs.axis[kArm].cap_pressure_pa.validity = Validity::kNotAvailable;
    inputs.axis[kBoom].spool_ratio.value = 0.5;
    digging.step(inputs);
  }
  assert_true(digging.outputs.pilot_cut);
  assert_true(digging.step(digging.at_rest(false)).pilot_cut);
  assert_true(digging.step(digging.at_rest(false)).pilot_cut);
}

/// Until it has armed or asked for a cut a process does not know what one before it has asked for.
TEST(a_start_leaves_the_pilot_as_it_is) {
  const ExcavatorSetup setup(test::excavator().profile);
  ExcavatorController controller(setup);
  assert_false(controller.step({}, 0).pilot_known);
  Digging digging;
  assert_true(digging.outputs.pilot_known);
  assert_true(digging.step(digging.at_rest(false)).pilot_known);
}

/// Enable that is given and not confirmed.
TEST(a_deaf_valve_cuts_the_pilot, Digging digging) {
  for (int n = 0; n < kEchoCycles; ++n) {
    assert_int_equal(digging.outputs.status.mode, EcuMode::kActive);
    ExcavatorInputs inputs = digging.next();
    inputs.valve_enabled.value = false;
    digging.step(inputs);
  }
  assert_stopped_by(Fault::kValveNotFollowing, digging.outputs);
  assert_true(digging.outputs.pilot_cut);
  assert_latched(Fault::kValveNotFollowing, digging);
}

/// Enable that is confirmed without having been given: cut while it is so, and no longer, because
/// nobody was in motion.
TEST(a_valve_that_enables_itself_cuts_the_pilot, Digging digging) {
  digging.step(digging.at_rest(false));
  for (int n = 0; n < kEchoCycles; ++n) {
    assert_false(digging.outputs.pilot_cut);
    ExcavatorInputs inputs = digging.at_rest(false);
    inputs.valve_enabled.value = true;
    digging.step(inputs);
  }
  assert_true(digging.outputs.pilot_cut);
  assert_int_equal(digging.outputs.status.mode, EcuMode::kSilent);
  assert_int_equal(digging.outputs.status.fault, Fault::kValveNotFollowing);
  assert_false(digging.step(digging.at_rest(false)).pilot_cut);
}

/// What stops for other reasons leaves the pilot alone.
TEST(other_faults_leave_the_pilot, Digging digging) {
  ExcavatorInputs inputs = digging.next();
  inputs.link.bus = BusState::kOff;
  assert_false(digging.step(inputs).pilot_cut);
  assert_latched(Fault::kBusOff, digging);
}

TEST(every_bit_of_the_memory_is_sealed, Digging digging) {
  test::assert_every_bit_is_sealed(Memory::memory(digging.controller));
}

/// One of each byte: neutral in this cycle, latched; nothing of what it has become counts.
TEST(a_flipped_bit_stops, Digging before) {
  for (std::size_t byte = 0; byte < sizeof Memory::memory(before.controller); ++byte) {
    Digging digging = before;
    test::flip_bit_at(&Memory::memory(digging.controller), 8 * byte + byte % 8);
    digging.step(digging.next());
    assert_stopped_by(Fault::kMemoryCorrupt, digging.outputs);
  }
}

/// The operator arms again, and the pilot pressure comes back with it.
TEST(after_a_flipped_bit_the_operator_begins_anew, Digging before) {
  Digging digging = before;
  test::flip_bit_at(&Memory::memory(digging.controller), 0);
  digging.step(digging.next());
  assert_true(digging.outputs.pilot_cut);
  assert_latched(Fault::kMemoryCorrupt, digging);
  assert_false(digging.outputs.pilot_cut);
  // With the deadman released as well: named before it is left.
  test::flip_bit_at(&Memory::memory(before.controller), 0);
  assert_stopped_by(Fault::kMemoryCorrupt, before.step(before.at_rest(false)));
  before.step(before.at_rest(false));
  assert_int_equal(before.outputs.status.mode, EcuMode::kReady);
}

/// All that are there are in the set; the first that stopped is the fault.
TEST(the_status_names_all_faults, Digging digging) {
  ExcavatorInputs inputs = digging.next();
  inputs.link.bus = BusState::kPassive;
  inputs.link.out_of_range = true;
  inputs.swash_ratio[1].validity = Validity::kNotAvailable;
  digging.step(inputs);
  assert_stopped_by(Fault::kSwashMissing, digging.outputs);
  assert_true(digging.outputs.status.faults ==
              set_of({Fault::kSwashMissing, Fault::kBusPassive, Fault::kValueOutOfRange}));
  // Gone from the bus, and yet there: it is latched.
  digging.step(digging.inputs());
  assert_true(digging.outputs.status.faults == set_of({Fault::kSwashMissing}));
}
