// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include "firmware/excavator/motion/field/dig_field.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/excavator_steps.hpp"
#include "tests/unit/firmware/fixture.hpp"
#include "tests/unit/rounds.hpp"

using test::stroke_end_cap;

const ExcavatorProfile& profile() { return test::excavator().profile; }

const ExcavatorKinematics& machine() {
  static const ExcavatorKinematics kinematics(profile().geometry);
  return kinematics;
}

const DigField& field() {
  static const DigField dig_field(profile(), machine());
  return dig_field;
}

TEST(closest_point_is_the_nearest_of_the_path) {
  const RoundedRectangle& path = field().path();
  constexpr int kPoints = test::rounds(4000, 500);
  const double half_apart_m = 0.5 * path.length_m() / kPoints;
  for (double x = 2.0; x <= 8.0; x += 0.31) {
    for (double y = -4.0; y <= 2.0; y += 0.29) {
      const Eigen::Vector2d from(x, y);
      double nearest = 1e9;
      for (int k = 0; k < kPoints; ++k) {
        const double share = static_cast<double>(k) / kPoints;
        nearest = std::min(nearest, (path.at_share(share).position_m - from).norm());
      }
      const double found = (path.closest(from).position_m - from).norm();
      assert_true(found <= nearest + 1e-12);
      assert_near(found, nearest, half_apart_m + 1e-12);
    }
  }
}

/// Equal shares are equal lengths, the tangent is the direction, and the path closes.
TEST(path_runs_at_constant_speed) {
  const RoundedRectangle& path = field().path();
  constexpr int kPoints = 10000;
  const double step_m = path.length_m() / kPoints;
  for (int k = 0; k < kPoints; ++k) {
    const PathPoint here = path.at_share(static_cast<double>(k) / kPoints);
    const PathPoint next = path.at_share(static_cast<double>(k + 1) / kPoints);
    const Eigen::Vector2d step = next.position_m - here.position_m;
    assert_near(step.norm(), step_m, 1e-6);
    assert_near(step.dot(here.tangent), step_m, 1e-5);
    assert_near(next.attitude_rad - here.attitude_rad, here.attitude_slope_radpm * step_m, 1e-6);
    const PathPoint back = path.closest(here.position_m);
    assert_near((back.position_m - here.position_m).norm(), 0.0, 1e-12);
    assert_near((back.tangent - here.tangent).norm(), 0.0, 1e-9);
  }
}

/// Kim's section 5: 45 deg at 3.5 m, 120 deg at 6.5 m; the bottom is dug towards the machine.
TEST(path_is_the_papers) {
  const RoundedRectangle& path = field().path();
  const PathPoint near_side = path.closest({3.0, -1.0});
  assert_near(near_side.position_m.x(), 3.5, 1e-12);
  assert_near(near_side.attitude_rad, 0.785398, 1e-9);
  assert_near(near_side.tangent.y(), 1.0, 1e-12);
  const PathPoint far_side = path.closest({7.0, -1.0});
  assert_near(far_side.position_m.x(), 6.5, 1e-12);
  assert_near(far_side.attitude_rad, 2.094395, 1e-9);
  const PathPoint bottom = path.closest({5.0, -3.0});
  assert_near(bottom.tangent.x(), -1.0, 1e-12);
}

TEST(contour_points_along_and_towards_the_path) {
  const double speed = profile().dig_speed_mps;
  const TipVelocity on_path = field().contour({6.5, -1.0, 2.094395});
  assert_near(on_path.linear_mps.x(), 0.0, 1e-12);
  assert_near(on_path.linear_mps.y(), -speed, 1e-12);
  assert_near(on_path.attitude_radps, 0.0, 1e-9);
  // At the error that slows: half the speed along, the whole of what leads back.
  const double off_m = profile().control.slow_error_m;
  const TipVelocity beside = field().contour({6.5 + off_m, -1.0, 2.0});
  assert_near(beside.linear_mps.y(), -0.5 * speed, 1e-12);
  assert_near(beside.linear_mps.x(), -speed * off_m / profile().control.convergence_length_m,
              1e-12);
  assert_true(beside.attitude_radps > 0.0);
  // Far away: straight back, at the task's speed.
  const TipVelocity far = field().contour({16.5, -1.0, 2.0});
  assert_near(far.linear_mps.norm(), speed, 1e-12);
  assert_near(far.linear_mps.x(), -speed, 1e-3);
  // Never faster than the task.
  for (double error_m = 0.0; error_m < 1.0; error_m += 0.003) {
    assert_true(field().contour({6.5 + error_m, -1.0, 2.0}).linear_mps.norm() <= speed + 1e-12);
  }
  // Along the bottom, 75 deg over 3 m towards the machine: the attitude must turn with the tip.
  const TipVelocity bottom = field().contour({5.0, -2.2, 0.5 * (0.785398 + 2.094395)});
  assert_near(bottom.attitude_radps, -speed * (2.094395 - 0.785398) / 3.0, 1e-6);
}

/// An ideal machine, strokes moving just as the field wants: from any pose it must reach the path,
/// never leave a cylinder's range, and then stay on the path.
TEST(every_pose_leads_to_the_path) {
  std::mt19937 random(7);
  constexpr double kPeriod_s = 0.02;
  for (int start = 0; start < test::rounds(200, 20); ++start) {
    DriveVector strokes = DriveVector::Zero();
    for (int axis = 0; axis < kAxisCount; ++axis) {
      const double most = profile().geometry.cylinder[static_cast<unsigned>(axis)].stroke_m;
      strokes[axis] = std::uniform_real_distribution<double>(0.0, most)(random);
      if (start < 8) {
        strokes[axis] = (start >> axis & 1) != 0 ? most : 0.0;  // The corners first.
      }
    }
    double error_m = 0.0;
    double last_on_path_s = 0.0;
    for (double t = 0.0; t < 60.0; t += kPeriod_s) {
      const KinematicState state = machine().state(strokes.head<kAxisCount>());
      assert_int_equal(state.status, ReachStatus::kOk);
      DriveVector wanted = DriveVector::Zero();
      wanted.head<kAxisCount>() = field().wanted(state, 1.0);
      assert_true(wanted.allFinite());
      const VelocityCap cap = stroke_end_cap(profile(), strokes, wanted);
      strokes += kPeriod_s * cap.factor * wanted;
      const Eigen::Vector2d tip(state.tip.x_m, state.tip.y_m);
      error_m = (field().path().closest(tip).position_m - tip).norm();
      if (error_m > 0.01) {
        last_on_path_s = t;
      }
    }
    assert_near(error_m, 0.0, 0.01);
    assert_true(last_on_path_s < 40.0);
  }
}

/// Far from the path the strokes move on a straight line.
TEST(the_approach_is_straight_in_stroke_space) {
  const KinematicState state = machine().state({0.1, 0.2, 1.0});
  const Eigen::Vector3d first = field().wanted(state, 1.0);
  const KinematicState later = machine().state(state.strokes_m + 0.5 * first);
  const Eigen::Vector3d second = field().wanted(later, 1.0);
  assert_near(first.normalized().dot(second.normalized()), 1.0, 1e-9);
  assert_true(first.cwiseAbs().maxCoeff() <= profile().control.approach_speed_mps + 1e-12);
}

TEST(override_scales_without_turning) {
  const KinematicState state =
      machine().state(machine().strokes_from_pose({6.4, -0.5, 2.0}).strokes_m);
  const Eigen::Vector3d full = field().wanted(state, 1.0);
  const Eigen::Vector3d part = field().wanted(state, 0.3);
  assert_near((part - 0.3 * full).norm(), 0.0, 1e-12);
  assert_near(field().wanted(state, 0.0).norm(), 0.0, 0.0);
}

TEST(a_path_out_of_reach_is_told) {
  ExcavatorProfile far = profile();
  far.dig_path.x_min_m = 8.5;
  far.dig_path.x_max_m = 11.5;
  const DigField unreachable(far, machine());
  assert_int_not_equal(unreachable.reach(), ReachStatus::kOk);
  assert_int_equal(field().reach(), ReachStatus::kOk);
}

TEST(a_cylinder_near_its_end_slows_all_axes_alike) {
  const double most = profile().geometry.cylinder[kBoom].stroke_m;
  const double gain = profile().control.stroke_end_gain_ps;
  const DriveVector velocity(0.3, -0.1, 0.1, 0.0);
  const VelocityCap near_end = stroke_end_cap(profile(), {most - 0.01, 0.7, 0.5, 0.0}, velocity);
  assert_near(near_end.factor, gain * 0.01 / 0.3, 1e-12);
  assert_int_equal(near_end.limit.kind, LimitKind::kStrokeEnd);
  assert_int_equal(near_end.limit.index, kBoom);
  const VelocityCap away = stroke_end_cap(profile(), {most - 0.01, 0.7, 0.5, 0.0}, -velocity);
  assert_near(away.factor, 1.0, 0.0);
  const VelocityCap closing = stroke_end_cap(profile(), {0.5, 0.0, 0.5, 0.0}, velocity);
  assert_near(closing.factor, 0.0, 0.0);
  assert_int_equal(closing.limit.index, kArm);
}
