// SPDX-License-Identifier: Apache-2.0
// One step, from end to end: arming, driving, and what stops or slows it.

#include <functional>
#include <limits>

#include "firmware/dozer/blade.hpp"
#include "tests/unit/firmware/flip_bit.hpp"
#include "tests/unit/firmware/grading_dozer.hpp"
#include "tests/unit/firmware/memory_access.hpp"

using test::assert_neutral;
using test::Grading;

using Change = std::function<void(DozerInputs&)>;

TEST(before_anything_is_received_it_is_neutral_and_braked) {
  const DozerSetup setup(test::dozer().profile);
  DozerController controller(setup);
  const DozerOutputs outputs = controller.step(DozerInputs(), kSecondUs);
  assert_neutral(outputs);
  assert_true(outputs.brake);
  assert_int_equal(outputs.status.mode, EcuMode::kSilent);
  assert_true(outputs.status.why_not_armed != 0);
}

TEST(with_drives_that_were_not_commissioned_it_is_refused_or_slow) {
  DozerProfile part = test::dozer().profile;
  part.safety.unknown.tasks = 1U << static_cast<unsigned>(Task::kGrade);
  part.safety.unknown.speed_ratio = 0.25;
  Grading slow(part);
  slow.run(130);
  assert_near(slow.outputs.status.wanted_speed_mps, 0.25 * part.travel.speed_desired_mps, 0.02);
  part.safety.unknown.speed_ratio = 0.0;
  const DozerSetup setup(part);
  DozerController controller(setup);
  DozerInputs inputs = test::complete_dozer_inputs(kSecondUs);
  const DozerOutputs outputs = controller.step(inputs, kSecondUs);
  assert_neutral(outputs);
  assert_true(outputs.status.faults.has(Fault::kTaskUnknown));
}

TEST(it_gets_faster_at_its_rate_and_lets_the_brake_go, Grading grading) {
  assert_false(grading.outputs.brake);
  grading.run(130);
  assert_near(grading.outputs.status.wanted_speed_mps, 0.5 * 1.5, 0.02);
  assert_near(grading.speed_mps, grading.outputs.status.wanted_speed_mps, 0.05);
  assert_near(grading.outputs.status.lambda, grading.outputs.status.wanted_speed_mps / 1.6, 1e-12);
  assert_int_equal(grading.outputs.status.limit.kind, LimitKind::kRise);
  assert_near(grading.outputs.pump_ratio[kLeft], grading.outputs.pump_ratio[kRight], 0.0);
}

/// The machine of the test stays level: only the edge's way into the trench asks for flow.
TEST(before_the_trench_it_slows_down_and_its_blade_follows, Grading grading) {
  double slowest_mps = 9.0;
  while (grading.position_m < 2.5) {
    grading.run(1);
    if (grading.position_m > 1.0) {
      slowest_mps = std::min(slowest_mps, grading.outputs.status.wanted_speed_mps);
      const DozerStatus& status = grading.outputs.status;
      assert_true(status.required_flow_m3ps <= status.available_flow_m3ps);
      assert_near(status.grade_error_m, 0.0, 0.01);
    }
  }
  assert_true(slowest_mps < 1.0);
  assert_true(grading.blade.angle_rad(grading.stroke_m) < -0.1);
}

double slowest_into_the_trench_mps(double share) {
  Grading grading;
  double slowest_mps = 9.0;
  while (grading.position_m < 2.5) {
    auto& memory = DozerMemoryAccess::memory(grading.controller);
    memory->estimates.flow.share = share;
    memory.seal();
    grading.run(1);
    if (grading.position_m > 1.0) {
      slowest_mps = std::min(slowest_mps, grading.outputs.status.wanted_speed_mps);
    }
  }
  return slowest_mps;
}

TEST(what_its_pump_does_not_give_is_not_planned_with) {
  const double whole_mps = slowest_into_the_trench_mps(1.0);
  assert_near(slowest_into_the_trench_mps(0.8), 0.8 * whole_mps, 0.05 * whole_mps);
}

TEST(the_operators_share_of_the_speed_is_kept, Grading grading) {
  for (int n = 0; n < 300; ++n) {
    DozerInputs inputs = grading.next();
    inputs.driver.speed_override_ratio.value = 0.25;
    grading.step(inputs);
  }
  assert_near(grading.outputs.status.wanted_speed_mps, 0.4, 1e-9);
  assert_near(grading.outputs.status.lambda, 0.25, 1e-9);
}

TEST(without_a_task_it_stands, Grading grading) {
  grading.run(100);
  grading.step(grading.at_rest(true));
  assert_int_equal(grading.outputs.status.mode, EcuMode::kArmed);
  assert_neutral(grading.outputs);
}

TEST(released_it_is_neutral_in_the_same_cycle, Grading grading) {
  grading.run(100);
  DozerInputs inputs = grading.next();
  inputs.driver.enable.value = false;
  assert_neutral(grading.step(inputs));
  assert_int_equal(grading.outputs.status.mode, EcuMode::kReady);
  grading.step(grading.at_rest(false));
  assert_true(grading.outputs.brake);
}

void assert_stops(const char* what, Fault fault, const Change& change, int cycles) {
  Grading grading;
  grading.run(50);
  for (int n = 0; n < cycles && grading.outputs.enable; ++n) {
    DozerInputs inputs = grading.next();
    change(inputs);
    grading.step(inputs);
  }
  if (grading.outputs.status.fault != fault) {
    print_error("%s: fault %d\n", what, static_cast<int>(grading.outputs.status.fault));
  }
  assert_neutral(grading.outputs);
  assert_int_equal(grading.outputs.status.fault, fault);
  assert_int_equal(grading.outputs.status.mode, EcuMode::kFault);
  grading.step(grading.next());
  assert_int_equal(grading.outputs.status.mode, EcuMode::kFault);
  // Released, and given afresh at rest, it may go on.
  repeat(100, [&] { grading.step(grading.at_rest(false)); });
  grading.step(grading.at_rest(true));
  assert_int_equal(grading.outputs.status.mode, EcuMode::kArmed);
}

TEST(what_stops_it_stops_it) {
  constexpr TimeUs kOld = 60 * kMillisecondUs;
  const struct {
    const char* what;
    Fault fault;
    int cycles;
    Change change;
  } rows[] = {
      {"stroke old", Fault::kStrokeMissing, 1,
       [](DozerInputs& in) { in.blade_stroke_m.stamp_us -= kOld; }},
      {"spool lost", Fault::kSpoolMissing, 1,
       [](DozerInputs& in) { in.blade_spool_ratio.validity = Validity::kNotAvailable; }},
      {"height lost", Fault::kPoseMissing, 8,
       [](DozerInputs& in) { in.body.height_m.validity = Validity::kNotAvailable; }},
      {"pitch rate not finite", Fault::kPoseMissing, 8,
       [](DozerInputs& in) {
         in.body.pitch_rate_radps.value = std::numeric_limits<double>::quiet_NaN();
       }},
      {"pump feedback lost", Fault::kTransmissionMissing, 1,
       [](DozerInputs& in) { in.track[kRight].pump_ratio.validity = Validity::kNotAvailable; }},
      {"operator lost", Fault::kOperatorMissing, 1,
       [](DozerInputs& in) { in.driver.mode.stamp_us -= kOld; }},
      {"bus off", Fault::kBusOff, 1, [](DozerInputs& in) { in.link.bus = BusState::kOff; }},
      {"another machine", Fault::kIdentityMismatch, 1,
       [](DozerInputs& in) { in.same_machine.value = false; }},
      {"spool open", Fault::kSpoolStuck, 100,
       [](DozerInputs& in) { in.blade_spool_ratio.value = 0.8; }},
      {"pump the wrong way", Fault::kDisplacementRunaway, 20,
       [](DozerInputs& in) { in.track[kLeft].pump_ratio.value = -0.6; }},
      {"pump stays behind", Fault::kDisplacementDisagrees, 200,
       [](DozerInputs& in) {
         in.track[kLeft].pump_ratio.value = std::min(0.5, in.track[kLeft].pump_ratio.value);
       }},
  };
  for (const auto& row : rows) {
    assert_stops(row.what, row.fault, row.change, row.cycles);
  }
}

TEST(a_runaway_asks_for_the_brake_at_once, Grading grading) {
  grading.run(100);
  for (int n = 0; n < 30 && grading.outputs.enable; ++n) {
    DozerInputs inputs = grading.next();
    inputs.track[kLeft].pump_ratio.value = -0.6;
    grading.step(inputs);
  }
  assert_int_equal(grading.outputs.status.fault, Fault::kDisplacementRunaway);
  assert_true(grading.outputs.brake);
}

TEST(a_lost_engine_speed_slows_it, Grading grading) {
  for (int n = 0; n < 400; ++n) {
    DozerInputs inputs = grading.next();
    if (n > 200) {
      inputs.engine_speed_radps.validity = Validity::kNotAvailable;
    }
    grading.step(inputs);
    assert_true(grading.outputs.enable);
  }
  assert_int_equal(grading.outputs.status.fault, Fault::kEngineSpeedMissing);
  assert_near(grading.outputs.status.wanted_speed_mps,
              1.6 * test::dozer().profile.safety.degraded_speed_ratio, 1e-6);
  assert_near(grading.outputs.status.available_flow_m3ps,
              available_flow_m3ps(grading.profile.implement, grading.profile.safety.idle_radps),
              1e-12);
}

/// A track shown much too slow: it goes on slower, and that track is not driven after its sensor.
TEST(a_wrong_track_speed_is_not_followed, Grading grading) {
  for (int n = 0; n < 600; ++n) {
    DozerInputs inputs = grading.next();
    if (n > 200) {
      inputs.track[kLeft].speed_mps.value = std::max(0.0, grading.speed_mps - 0.8);
    }
    grading.step(inputs);
    assert_true(grading.outputs.enable);
  }
  assert_int_equal(grading.outputs.status.fault, Fault::kTrackSpeedDisagrees);
  const double slowed_mps = 1.6 * test::dozer().profile.safety.degraded_speed_ratio;
  assert_near(grading.outputs.status.wanted_speed_mps, slowed_mps, 1e-6);
  assert_near(
      track_speed_mps(grading.profile.hst, grading.profile.hst.engine_radps,
                      grading.outputs.pump_ratio[kLeft], grading.outputs.motor_ratio[kLeft]),
      slowed_mps, 0.05);
}

TEST(every_bit_of_the_memory_is_sealed, Grading grading) {
  grading.run(30);
  test::assert_every_bit_is_sealed(DozerMemoryAccess::memory(grading.controller));
}

/// One of each word: neutral in this cycle, and nothing of what it has become counts.
TEST(a_flipped_bit_stops_it, Grading running) {
  running.run(30);
  const std::size_t size = sizeof DozerMemoryAccess::memory(running.controller);
  for (std::size_t bit = 0; bit < 8 * size; bit += 63) {
    Grading copy = running;
    test::flip_bit_at(&DozerMemoryAccess::memory(copy.controller), bit);
    copy.step(copy.next());
    assert_neutral(copy.outputs);
    assert_int_equal(copy.outputs.status.fault, Fault::kMemoryCorrupt);
  }
}

TEST(cycles_that_come_late_stop_it, Grading grading) {
  grading.now_us += 6 * kMillisecondUs;
  grading.step(grading.next());
  assert_true(grading.outputs.enable);
  grading.now_us += 6 * kMillisecondUs;
  grading.step(grading.next());
  assert_neutral(grading.outputs);
  assert_int_equal(grading.outputs.status.fault, Fault::kCycleOverrun);
}

TEST(told_to_end_it_is_neutral_for_good, Grading grading) {
  DozerInputs last = grading.next();
  last.link.stop_requested = true;
  assert_neutral(grading.step(last));
  assert_neutral(grading.step(grading.next()));
  assert_int_equal(grading.outputs.status.mode, EcuMode::kStopping);
}

/// Where a blade cannot reach the design its end says so.
TEST(a_design_out_of_reach_ends_at_the_stroke) {
  DozerProfile deep = test::dozer().profile;
  deep.grade = test::level(-1.0);
  Grading grading(deep);
  for (int n = 0; n < 1000; ++n) {
    DozerInputs inputs = grading.next();
    inputs.driver.speed_override_ratio.value = 0.1;  // What flow and ground allow anyway.
    grading.step(inputs);
  }
  assert_near(grading.stroke_m, grading.blade.stroke_max_m(), 1e-3);
  assert_int_equal(grading.outputs.status.limit.kind, LimitKind::kStrokeEnd);
}
