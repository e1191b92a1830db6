// SPDX-License-Identifier: Apache-2.0
// The blade's tilt: its cylinder, the slope of the edge, and what holds it to the design's.

#include "firmware/dozer/tilt_control.hpp"
#include "firmware/dozer/travel/preview.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/tilting_dozer.hpp"

using test::CrossDesign;

constexpr double kStep_rad = 1e-6;
constexpr double kReach_m = 2.2;

const DozerProfile& profile() { return test::tilting_dozer().profile; }
TiltKinematics shipped() { return TiltKinematics(profile().tilt); }
/// Its pins on the other side: extension turns the blade the other way.
TiltKinematics mirrored() {
  TiltProfile tilt = profile().tilt;
  tilt.base_m.x() = -tilt.base_m.x();
  tilt.eye_m.x() = -tilt.eye_m.x();
  return TiltKinematics(tilt);
}

TEST(stroke_and_angle_belong_together) {
  for (const TiltKinematics& tilt : {shipped(), mirrored()}) {
    for (const double angle_rad : {-0.16, -0.1, 0.0, 0.05, 0.16}) {
      assert_near(tilt.angle_rad(tilt.stroke_m(angle_rad)), angle_rad, 1e-9);
    }
    const double rate =
        (tilt.stroke_m(0.05 + kStep_rad) - tilt.stroke_m(0.05 - kStep_rad)) / (2.0 * kStep_rad);
    assert_near(tilt.stroke_rate_mprad(0.05), rate, 1e-6);
    assert_near(std::min(tilt.stroke_m(-0.16), tilt.stroke_m(0.16)), 0.0, 1e-12);
    assert_near(std::max(tilt.stroke_m(-0.16), tilt.stroke_m(0.16)), tilt.stroke_max_m(), 1e-12);
  }
  assert_true(shipped().stroke_rate_mprad(0.0) * mirrored().stroke_rate_mprad(0.0) < 0.0);
}

/// The pins as they are: half a metre above the axis, extension to the left takes the left end
/// down.
TEST(the_cylinder_is_as_long_as_its_pins_are_apart) {
  const TiltProfile& tilt = profile().tilt;
  const double apart_m = (tilt.eye_m - tilt.base_m).norm();
  const double turned_m =
      (Eigen::Rotation2Dd(-tilt.angle_most_rad) * tilt.eye_m - tilt.base_m).norm();
  assert_near(std::abs(apart_m - turned_m),
              std::abs(shipped().stroke_m(0.0) - shipped().stroke_m(-tilt.angle_most_rad)), 1e-12);
}

TEST(a_blade_without_tilt_stays_level) {
  const TiltKinematics none{TiltProfile()};
  assert_near(none.stroke_max_m(), 0.0, 0.0);
  const EdgeSlope edge = edge_slope(rotation_from_pitch(0.2), -0.1, 0.0);
  assert_near(edge.slope, 0.0, 1e-15);
}

TEST(roll_and_tilt_add_up) {
  assert_near(edge_slope(rotation_from_pitch_and_roll(0.0, 0.1), 0.0, 0.0).slope, std::tan(0.1),
              1e-12);
  assert_near(edge_slope(rotation_from_pitch_and_roll(0.0, 0.07), 0.0, 0.03).slope, std::tan(0.1),
              1e-12);
  // About the same axis: however it is pitched, a tilt makes up for a roll.
  assert_near(edge_slope(rotation_from_pitch_and_roll(0.3, 0.1), 0.0, -0.1).slope, 0.0, 1e-12);
}

TEST(its_derivatives_are_those_of_the_slope) {
  const auto slope = [](double roll_rad, double tilt_rad) {
    return edge_slope(rotation_from_pitch_and_roll(0.2, roll_rad), -0.15, tilt_rad).slope;
  };
  const EdgeSlope edge = edge_slope(rotation_from_pitch_and_roll(0.2, 0.1), -0.15, -0.05);
  assert_near(edge.per_tilt,
              (slope(0.1, -0.05 + kStep_rad) - slope(0.1, -0.05 - kStep_rad)) / (2.0 * kStep_rad),
              1e-7);
  assert_near(edge.per_roll,
              (slope(0.1 + kStep_rad, -0.05) - slope(0.1 - kStep_rad, -0.05)) / (2.0 * kStep_rad),
              1e-7);
}

/// Before the slope it leads, on it the body lies as the design does.
TEST(the_design_asks_for_a_tilt_where_it_changes) {
  const CrossDesign across(0.08, 0.04);
  const GradeProfile design(across.grade);
  assert_near(design.cross_at(3.0).slope, 0.04, 1e-12);
  assert_near(design.cross_at(3.0).change_pm, 0.04, 1e-12);
  assert_near(design.cross_at(1.0).slope, 0.0, 0.0);
  assert_near(design.cross_at(100.0).slope, 0.08, 1e-15);
  assert_near(tilt_on_rad(profile().body, design, 0.5, kReach_m), std::atan(0.028), 1e-12);
  assert_near(tilt_on_rad(profile().body, design, 10.0, kReach_m), 0.0, 1e-15);
  assert_near(tilt_oil_m2(profile(), shipped(), design, 10.0, kReach_m), 0.0, 1e-15);
  const double lever_m = std::abs(shipped().stroke_rate_mprad(std::atan(0.028)));
  const double oil_m2 = tilt_oil_m2(profile(), shipped(), design, 0.5, kReach_m);
  assert_true(oil_m2 >= 0.99 * profile().tilt.rod_area_m2() * lever_m * 0.04);
  assert_true(oil_m2 <= 1.01 * profile().tilt.cap_area_m2() * lever_m * 0.04);
}

DriveRow row() { return dozer_bank(profile()).row[kBladeTilt]; }

TiltSituation level_at(double x_m) {
  TiltSituation at;
  at.edge_x_m = x_m;
  at.speed_mps = 1.0;
  return at;
}

TiltCommand asked(const GradeProfile& design, const TiltSituation& at, bool fed = true) {
  return control_tilt(profile().tilt, row(), shipped(), design, {}, at, at, fed, 0.01);
}

TEST(the_left_end_rises_where_the_design_is_higher_there) {
  const CrossDesign left(0.06, 0.5);
  const GradeProfile design(left.grade);
  const TiltCommand command = asked(design, level_at(10.0));
  assert_near(command.error, -0.06, 1e-12);
  const double angle_radps = command.velocity_mps / shipped().stroke_rate_mprad(0.0);
  assert_near(angle_radps, profile().tilt.gain_ps * 0.06, 1e-9);
  assert_near(command.feed_forward_mps, 0.0, 1e-12);
  assert_true(command.state.integral_radps < 0.0);
  assert_near(asked(design, level_at(10.0), false).state.integral_radps, 0.0, 0.0);
}

TEST(it_goes_along_with_the_design_and_against_the_body) {
  const CrossDesign left(0.3, 0.05);
  const GradeProfile design(left.grade);
  TiltSituation at = level_at(4.0);
  at.tilt_rad = std::atan(0.1);
  const TiltCommand along = asked(design, at);
  assert_near(along.error, 0.0, 1e-12);
  const double change_ps = along.feed_forward_mps / shipped().stroke_rate_mprad(at.tilt_rad) *
                           edge_slope(at.body_rotation, 0.0, at.tilt_rad).per_tilt;
  assert_near(change_ps, 0.05, 1e-9);
  at.roll_rate_radps = 0.05 / 1.01;  // The body turns it as fast.
  assert_near(asked(design, at).velocity_mps, 0.0, 1e-4);
}

TEST(towards_the_end_of_its_stroke_it_slows) {
  const CrossDesign left(-0.3, -0.5);
  TiltSituation at = level_at(10.0);
  at.tilt_rad = -0.159;
  const TiltCommand command = asked(GradeProfile(left.grade), at);
  assert_true(command.at_end);
  assert_near(command.state.integral_radps, 0.0, 0.0);
  assert_true(std::abs(command.velocity_mps) < 0.01);
}

/// The pump's flow is shared: what the tilt takes makes the machine slower, and slows the lift.
TEST(the_speed_leaves_the_tilt_its_flow) {
  const BladeKinematics blade(profile().blade);
  const double flow_m3ps = available_flow_m3ps(profile().implement, 157.08);
  const auto limit_mps = [&](double per_m) {
    const CrossDesign across(0.29, per_m);
    const GradeProfile design(across.grade);
    Preview preview(profile(), blade);
    const GroundMap untouched;
    for (int n = 0; n < 400; ++n) {
      preview.look(untouched, design, 0.0, {0.0, 0.0}, flow_m3ps);
    }
    return preview.limit(0.0, 1.0, 0.006, 0.0).lowest_mps;
  };
  assert_true(limit_mps(0.01) > 1.6);
  const double slope_mps = limit_mps(0.4);
  const double lever_m = std::abs(shipped().stroke_rate_mprad(0.1));
  const double least_mps =
      kPreviewTiltShare * flow_m3ps / (profile().tilt.cap_area_m2() * lever_m * 0.4);
  const double most_mps =
      kPreviewTiltShare * flow_m3ps / (profile().tilt.rod_area_m2() * lever_m * 0.4);
  assert_true(slope_mps > 0.9 * least_mps && slope_mps < 1.1 * most_mps);
  assert_near(limit_mps(0.8) / slope_mps, 0.5, 0.1);
}
