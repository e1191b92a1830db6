// SPDX-License-Identifier: Apache-2.0
// A machine on a design whose track curves, from signals to commands: it steers, no track runs
// faster than it can, and it stops where it does not know where it is.

#include "tests/unit/firmware/grading_dozer.hpp"
#include "tests/unit/firmware/tilting_dozer.hpp"

using test::Grading;
using test::on;

/// Level; straight to x = 4 m, then of this curvature.
struct CurvedDesign : test::CrossDesign {
  explicit CurvedDesign(double curvature_pm) : CrossDesign(0.0, 0.0) {
    for (int i = 0; i < grade.heights.count; ++i) {
      curvature.push_back(i * GradeHeights::kStep_m < 4.0 ? 0.0 : curvature_pm);
    }
    grade.heights.curvature = curvature.data();
  }
  std::vector<double> curvature;
};

TEST(it_steers_along_the_curve) {
  for (const double radius_m : {20.0, -12.0}) {
    const CurvedDesign design(1.0 / radius_m);
    Grading grading(on(design));
    while (grading.position_m < 15.0) {
      grading.run(1);
      assert_int_equal(grading.outputs.status.mode, EcuMode::kActive);
      assert_near(grading.outputs.status.off_track_m, 0.0, 0.05);
    }
    assert_near(grading.outputs.status.off_track_m, 0.0, 0.005);
    assert_near(grading.course.yaw_rate_radps, grading.speed_mps / radius_m,
                0.05 * grading.speed_mps / std::abs(radius_m));
  }
}

/// Where the engine is slow the outer track holds the machine: v (1 + d / R) is its fastest, and
/// that is so from before the curve on.
TEST(the_outer_track_limits_the_speed) {
  const double radius_m = 10.0;
  const CurvedDesign design(1.0 / radius_m);
  DozerProfile profile = on(design);
  profile.hst.engine_radps = 104.72;
  Grading grading(profile);
  const double most_mps = track_speed_max_mps(profile.hst, 104.72);
  double before_mps = 0.0;
  while (grading.position_m < 15.0) {
    grading.run(1);
    before_mps = grading.position_m < 2.5 ? grading.speed_mps : before_mps;
  }
  assert_near(before_mps, most_mps, 0.035);
  const double held_mps = most_mps / (1.0 + profile.body.half_gauge_m / radius_m);
  assert_near(grading.outputs.status.wanted_speed_mps, held_mps, 0.01);
  assert_near(grading.speed_mps, held_mps, 0.02);
  const LimitKind kind = grading.outputs.status.limit.kind;
  assert_true(kind == LimitKind::kAhead || kind == LimitKind::kTransmissionFlow);
}

void assert_stops(Fault fault, const test::ChangeOfDozer& change) {
  const CurvedDesign design(0.05);
  test::assert_stopped_by(fault, test::graded_with(on(design), change, 600).outputs);
}

TEST(where_it_is_has_to_be_known) {
  for (auto signal :
       {&BodyInputs::offset_m, &BodyInputs::heading_rad, &BodyInputs::yaw_rate_radps}) {
    assert_stops(Fault::kPoseMissing, [signal](DozerInputs& inputs) {
      (inputs.body.*signal).validity = Validity::kNotAvailable;
    });
  }
  // A jump is not believed, and the last one grows old.
  assert_stops(Fault::kPoseMissing, [](DozerInputs& inputs) { inputs.body.offset_m.value += 0.3; });
  assert_stops(Fault::kPoseMissing,
               [](DozerInputs& inputs) { inputs.body.heading_rad.value += 0.1; });
}

TEST(an_offset_that_does_not_go_with_the_heading_is_seen) {
  double offset_m = 0.0;
  assert_stops(Fault::kPoseDisagrees, [&offset_m](DozerInputs& inputs) {
    offset_m += 1.5e-3;
    inputs.body.offset_m.value = offset_m;
  });
}

/// On a track that turns 0.05 rad each metre.
TEST(a_yaw_rate_that_does_not_go_with_the_heading_is_seen) {
  assert_stops(Fault::kPoseDisagrees,
               [](DozerInputs& inputs) { inputs.body.yaw_rate_radps.value += 0.3; });
  assert_stops(Fault::kPoseDisagrees,
               [](DozerInputs& inputs) { inputs.body.yaw_rate_radps.value = 0.0; });
}

/// What leads it off the track, and is no jump.
TEST(an_edge_far_off_the_track_stops_it) {
  const CurvedDesign design(0.05);
  Grading grading(on(design));
  grading.run(50);
  for (int n = 0; n < 1000 && grading.outputs.status.mode == EcuMode::kActive; ++n) {
    DozerInputs inputs = grading.next();
    // It slides off, heading along.
    grading.course.offset_m -= 0.6e-3;
    grading.step(inputs);
    assert_true(std::abs(grading.outputs.status.off_track_m) < 0.5);
  }
  assert_int_equal(grading.outputs.status.mode, EcuMode::kFault);
}

/// A straight design asks for none of it.
TEST(a_straight_track_needs_none_of_it) {
  const test::CrossDesign design(0.05, 0.03);
  Grading grading(on(design));
  grading.run(100);
  assert_int_equal(grading.outputs.status.mode, EcuMode::kActive);
  assert_near(grading.outputs.pump_ratio[kLeft], grading.outputs.pump_ratio[kRight], 0.0);
}
