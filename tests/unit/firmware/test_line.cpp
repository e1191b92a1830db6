// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/line.hpp"

#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

constexpr double kTwoPi = 6.28318530717958647693;

const SwingKinematics& machine() {
  static const SwingKinematics kinematics(test::excavator_12t().profile.geometry);
  return kinematics;
}

TeethPose teeth(double boom_m, double arm_m, double bucket_m, double swing_rad) {
  const DriveResult joints = machine().joints_from_drive({boom_m, arm_m, bucket_m, swing_rad});
  assert_int_equal(joints.blind.kind, BlindKind::kNone);
  return machine().teeth_from_joints(joints.value);
}

bool blind_at(const TeethLine& line, double share) {
  return line_motion(machine(), line, share).blind.kind != BlindKind::kNone;
}

BlindPlace walked(const TeethPose& from, const TeethPose& to) {
  return first_blind_place(machine(), line_between(machine(), from, to));
}

/// Against every 1/10000 of the line, and the last digits of the place itself.
TEST(the_place_is_where_it_begins) {
  const TeethPose inside = teeth(0.5, 0.6, 0.4, 0.3);
  const TeethPose targets[] = {{{9.5, 2.0, 0.5}, inside.attitude_rad},
                               {{5.0, 2.0, -5.0}, inside.attitude_rad},
                               {{0.8, 0.2, 0.0}, inside.attitude_rad},
                               {{5.0, 2.0, 0.5}, inside.attitude_rad + 2.5},
                               {{-5.0, -2.0, 1.0}, inside.attitude_rad}};
  for (const TeethPose& to : targets) {
    const TeethLine line = line_between(machine(), inside, to);
    const BlindPlace place = first_blind_place(machine(), line);
    assert_int_not_equal(place.blind.kind, BlindKind::kNone);
    assert_true(blind_at(line, place.share));
    assert_false(blind_at(line, place.share - 1e-9));
    for (double share = 0.0; share < place.share - 1e-4; share += 1e-4) {
      assert_false(blind_at(line, share));
    }
    assert_true((place.teeth.position_m - line.at(place.share).position_m).norm() < 1e-12);
  }
}

TEST(a_blind_start_is_told_as_such) {
  const BlindPlace place = walked({{9.5, 0.0, 0.0}, 2.0}, teeth(0.5, 0.6, 0.4, 0.0));
  assert_int_equal(place.blind.kind, BlindKind::kOutOfReach);
  assert_near(place.share, 0.0, 0.0);
}

/// A line across the machine's plane, nearest to it between two steps of the walk.
TeethLine across(double x_m) {
  TeethPose from = teeth(0.5, 1.129, 0.4, 0.0);
  from.position_m += Eigen::Vector3d(x_m, -1.0, 0.0);
  return {from, {{0.0, 2.0 + 1.0 / 64.0, 0.0}, 0.0}};
}

/// The arm cylinder's range is left between two steps only, by less and less: the line brushes it
/// from inside.
TEST(a_brush_with_a_stroke_s_end_is_seen) {
  const double middle = 1.0 / (2.0 + 1.0 / 64.0);
  double inside_m = 0.05;
  double outside_m = -0.05;
  for (int i = 0; i < 50; ++i) {
    const double x_m = 0.5 * (inside_m + outside_m);
    (blind_at(across(x_m), middle) ? outside_m : inside_m) = x_m;
  }
  for (const double depth_m : {1e-6, 3e-6, 5e-6}) {
    const TeethLine line = across(outside_m - depth_m);
    for (int i = 0; i <= kWalkSteps; ++i) {
      assert_false(blind_at(line, static_cast<double>(i) / kWalkSteps));
    }
    const BlindPlace place = first_blind_place(machine(), line);
    assert_int_equal(place.blind.kind, BlindKind::kStrokeEnd);
    assert_int_equal(place.blind.drive, kArm);
    assert_near(place.share, middle, 0.5 / kWalkSteps);
  }
  const BlindPlace none = first_blind_place(machine(), across(inside_m + 1e-6));
  assert_int_equal(none.blind.kind, BlindKind::kNone);
}

/// Its swing goes past half a turn, and on.
TEST(a_line_passes_behind_the_machine) {
  const TeethPose left = teeth(0.5, 0.6, 0.4, 2.9);
  const TeethPose right = teeth(0.5, 0.6, 0.4, -2.9);
  const TeethLine line = line_between(machine(), left, right);
  assert_int_equal(first_blind_place(machine(), line).blind.kind, BlindKind::kNone);
  assert_near(line_motion(machine(), line, 0.0).value[kSwing], 2.9, 1e-12);
  assert_near(line_motion(machine(), line, 1.0).value[kSwing], kTwoPi - 2.9, 1e-12);
}

/// Past the swing axis there is no way nearer than the least radius, however reachable both ends
/// are, and be it for less than a step of the walk.
TEST(no_line_over_the_swing_axis) {
  ExcavatorGeometry geometry = machine().geometry();
  for (CylinderGeometry& cylinder : geometry.cylinder) {
    cylinder.stroke_m = 10.0;
    cylinder.closed_length_m = 0.0;
  }
  geometry.boom_foot_m.x() = -4.0;
  const SwingKinematics backwards(geometry);
  const auto passing_at = [&](double radius_m) {
    const TeethLine line{{{-2.0, radius_m, 0.5}, 2.0}, {{4.02, 0.0, 0.0}, 0.0}};
    return first_blind_place(backwards, line).blind;
  };
  assert_int_equal(passing_at(kLeastSwingRadius_m + 1e-6).kind, BlindKind::kNone);
  for (const double depth_m : {1e-6, 1e-4, 1e-2, 0.3}) {
    const BlindSpot blind = passing_at(kLeastSwingRadius_m - depth_m);
    assert_int_equal(blind.kind, BlindKind::kSingular);
    assert_int_equal(blind.drive, kSwing);
  }
}

/// Whichever turn the ends' attitudes are written in, the bucket takes the same way.
TEST(full_turns_of_the_attitude_are_none) {
  const TeethPose from = teeth(0.5, 0.6, 0.2, 0.3);
  TeethPose to = teeth(0.4, 0.5, 0.6, 0.5);
  const TeethLine plain = line_between(machine(), from, to);
  to.attitude_rad += kTwoPi;
  const TeethLine turned = line_between(machine(), from, to);
  assert_near(turned.change.attitude_rad, plain.change.attitude_rad, 1e-12);
  TeethPose back = from;
  back.attitude_rad -= 2.0 * kTwoPi;
  assert_near(line_between(machine(), back, to).change.attitude_rad, plain.change.attitude_rad,
              1e-12);
}

/// A turn on the spot has a way too: the pin's about the teeth.
TEST(way_of_a_turn_on_the_spot) {
  const TeethPose from{{5.0, 0.0, 1.0}, 2.0};
  const TeethPose to{{5.0, 0.0, 1.0}, 1.5};
  assert_near(way_m(machine(), line_between(machine(), from, to)), 0.5 * 1.23, 1e-12);
  const TeethPose far{{5.0, 3.0, 5.0}, 1.5};
  assert_near(way_m(machine(), line_between(machine(), from, far)), 5.0, 1e-12);
}

TEST(distance_from_a_line_and_from_a_turn_on_the_spot, TeethLine line) {
  line.from.position_m = {1.0, 2.0, 3.0};
  line.change.position_m = {0.0, 4.0, 0.0};
  assert_near(line_distance_m(line, {4.0, 9.0, 7.0}), 5.0, 1e-12);
  line.change.position_m.setZero();
  line.change.attitude_rad = 0.5;
  assert_near(line_distance_m(line, {1.0, 2.0, 2.5}), 0.5, 1e-12);
}
