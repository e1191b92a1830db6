// SPDX-License-Identifier: Apache-2.0
// A machine whose blade tilts, from signals to commands: it holds its slope, and stops as one
// without tilt does where a sensor or a spool of the tilt fails.

#include "tests/unit/firmware/grading_dozer.hpp"
#include "tests/unit/firmware/tilting_dozer.hpp"

using test::CrossDesign;
using test::Grading;
using test::on;

TEST(the_edge_takes_on_the_designs_slope) {
  const CrossDesign design(0.05, 0.03);
  Grading grading(on(design));
  assert_true(grading.outputs.tilts);
  while (grading.position_m < 6.0) {
    grading.run(1);
    assert_int_equal(grading.outputs.status.mode, EcuMode::kActive);
    assert_near(grading.outputs.status.cross_error, 0.0, 0.004);
  }
  assert_near(grading.setup->tilt.angle_rad(grading.tilt_stroke_m), std::atan(0.05), 1e-3);
}

/// The body's roll is measured, and what of it the blade has to make up for.
TEST(a_rolled_body_is_made_up_for) {
  const CrossDesign level(0.0, 0.0);
  Grading grading(on(level));
  for (int n = 0; n < 200; ++n) {
    grading.roll_rad = std::min(0.04, grading.roll_rad + 4e-4);
    grading.run(1);
  }
  assert_int_equal(grading.outputs.status.mode, EcuMode::kActive);
  assert_near(grading.setup->tilt.angle_rad(grading.tilt_stroke_m), -0.04, 2e-3);
}

void assert_stops(Fault fault, const test::ChangeOfDozer& change) {
  const CrossDesign design(0.05, 0.03);
  test::assert_stopped_by(fault, test::graded_with(on(design), change, 100).outputs);
}

TEST(what_the_tilt_needs_is_required) {
  for (const auto signal : {&BodyInputs::roll_rad, &BodyInputs::roll_rate_radps}) {
    assert_stops(Fault::kPoseMissing, [signal](DozerInputs& inputs) {
      (inputs.body.*signal).validity = Validity::kNotAvailable;
    });
  }
  const auto assert_misses = [](Fault fault, Signal<double> DozerInputs::*signal) {
    assert_stops(fault, [signal](DozerInputs& inputs) {
      (inputs.*signal).validity = Validity::kNotAvailable;
    });
  };
  assert_misses(Fault::kStrokeMissing, &DozerInputs::tilt_stroke_m);
  assert_misses(Fault::kSpoolMissing, &DozerInputs::tilt_spool_ratio);
}

/// In motion it would be a jump first.
TEST(what_cannot_be_keeps_it_from_arming) {
  const CrossDesign design(0.05, 0.03);
  const auto fault_of = [&](const test::ChangeOfDozer& change) {
    Grading grading(on(design));
    DozerInputs inputs = grading.next();
    change(inputs);
    DozerValidationState state;
    return validate(grading.profile, grading.setup->bank.rows(), inputs, false, grading.now_us,
                    state)
        .fault;
  };
  assert_int_equal(fault_of([](DozerInputs&) {}), Fault::kNone);
  assert_int_equal(fault_of([](DozerInputs& inputs) { inputs.tilt_stroke_m.value = 0.5; }),
                   Fault::kStrokeImplausible);
  assert_int_equal(fault_of([](DozerInputs& inputs) { inputs.body.roll_rad.value = -0.9; }),
                   Fault::kPoseImplausible);
}

TEST(a_tilt_spool_that_stays_open_is_stuck) {
  assert_stops(Fault::kSpoolStuck,
               [](DozerInputs& inputs) { inputs.tilt_spool_ratio.value = 0.8; });
}

TEST(a_roll_that_does_not_go_with_its_rate_is_seen) {
  double roll_rad = 0.0;
  assert_stops(Fault::kPoseDisagrees, [&roll_rad](DozerInputs& inputs) {
    roll_rad += 5e-4;
    inputs.body.roll_rad.value = roll_rad;
  });
}

/// Nothing of it is asked of a machine without.
TEST(a_machine_without_tilt_needs_none_of_it, Grading grading) {
  grading.run(50);
  assert_false(grading.outputs.tilts);
  assert_near(grading.outputs.tilt_duty_ratio, 0.0, 0.0);
  assert_int_equal(grading.outputs.status.mode, EcuMode::kActive);
}
