// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/fence.hpp"

#include <limits>
#include <random>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"
#include "tests/unit/firmware/grid_ground.hpp"

using test::kCycle_s;

const test::ReplayMachine& machine() {
  static const test::ReplayMachine loaded(test::excavator_12t());
  return loaded;
}

VelocityCap cap(const DriveVector& then, const DriveVector& velocity, const FenceSet& fences = {}) {
  return test::motion_cap(machine().profile, machine().kinematics, fences, then, velocity);
}

void assert_cap(const VelocityCap& cap, double factor, LimitKind kind, int index) {
  assert_near(cap.factor, factor, 1e-9);
  assert_int_equal(cap.limit.kind, kind);
  assert_int_equal(cap.limit.index, index);
}

FenceSet one(const Fence& fence) {
  FenceSet fences;
  fences.count = 1;
  fences.fence[0] = fence;
  return fences;
}

/// 12 t: gain 2 /s, 0.5 m/s2; slack 0.05 mm.
TEST(cylinder_ends) {
  const DriveVector middle(0.475, 0.565, 0.4375, 0.0);
  assert_cap(cap(middle, {0.2, -0.3, 0.3, 0.5}), 1.0, LimitKind::kNone, 0);
  assert_cap(cap({0.93, 0.565, 0.4375, 0.0}, {0.1, 0.0, 0.0, 0.0}), 2.0 * 0.02005 / 0.1,
             LimitKind::kStrokeEnd, kBoom);
  assert_cap(cap({0.475, 0.01, 0.4375, 0.0}, {0.1, -0.2, 0.0, 0.0}), 2.0 * 0.01005 / 0.2,
             LimitKind::kStrokeEnd, kArm);
  // Fast and far: what can be braked counts, sqrt(2 a d).
  assert_cap(cap({0.475, 0.565, 0.575, 0.0}, {0.0, 0.0, 0.9, 0.0}),
             std::sqrt(2.0 * 0.5 * 0.30005) / 0.9, LimitKind::kStrokeEnd, kBucket);
  // At the end: away is free, on is over.
  assert_cap(cap({0.95, 0.565, 0.4375, 0.0}, {-0.2, 0.0, 0.0, 0.0}), 1.0, LimitKind::kNone, 0);
  assert_cap(cap({0.95, 0.565, 0.4375, 0.0}, {0.2, 0.0, 0.0, 0.0}), 2.0 * 0.00005 / 0.2,
             LimitKind::kStrokeEnd, kBoom);
  assert_cap(cap({0.9501, 0.565, 0.4375, 0.0}, {0.2, 0.0, 0.0, 0.0}), 0.0, LimitKind::kStrokeEnd,
             kBoom);
}

/// 0.7 rad/s2; slack 0.02 mrad.
TEST(swing_ends) {
  ExcavatorProfile quick = machine().profile;
  quick.swing.acceleration_max_radps2 = 0.7;
  const auto cap = [&quick](const DriveVector& then, const DriveVector& velocity) {
    return test::motion_cap(quick, machine().kinematics, {}, then, velocity);
  };
  assert_cap(cap({0.475, 0.565, 0.4375, 2.9}, {0.0, 0.0, 0.0, 0.5}), 2.0 * 0.10002 / 0.5,
             LimitKind::kSwingEnd, 0);
  assert_cap(cap({0.475, 0.565, 0.4375, -2.2}, {0.0, 0.0, 0.0, -1.4}),
             std::sqrt(2.0 * 0.7 * 0.80002) / 1.4, LimitKind::kSwingEnd, 0);
  assert_cap(cap({0.475, 0.565, 0.4375, -3.0}, {0.0, 0.0, 0.0, 1.4}), 1.0, LimitKind::kNone, 0);
  // A machine whose swing is held has no range, and none in the way.
  ExcavatorProfile held = machine().profile;
  held.drive_count = kAxisCount;
  const DriveVector moves(0.1, 0.0, 0.0, 0.0);
  assert_near(
      test::motion_cap(held, machine().kinematics, {}, {0.475, 0.5, 0.4, 9.0}, moves).factor, 1.0,
      0.0);
}

/// Whichever comes first: boom 4 mm, arm 10 mm before its end, both as fast.
TEST(the_strongest_limit_holds) {
  assert_cap(cap({0.946, 1.120, 0.4375, 0.0}, {0.1, 0.1, 0.0, 0.0}), 2.0 * 0.00405 / 0.1,
             LimitKind::kStrokeEnd, kBoom);
  assert_cap(cap({0.940, 1.126, 0.4375, 0.0}, {0.1, 0.1, 0.0, 0.0}), 2.0 * 0.00405 / 0.1,
             LimitKind::kStrokeEnd, kArm);
}

/// A ceiling over the arm pin, the highest of the points: the boom alone rises towards it.
TEST(fences_hold_the_point_that_is_nearest) {
  const DriveVector then(0.475, 0.565, 0.4375, 0.3);
  const DriveVector up(0.1, 0.0, 0.0, 0.0);
  const MachineMotion motion = machine_motion(machine().kinematics, then, up);
  const PointMotion& arm_pin = motion.point[static_cast<unsigned>(MachinePoint::kArmPin)];
  FenceSet fences;
  fences.count = 2;
  fences.fence[0] = {-Eigen::Vector3d::UnitZ(), 10.0, FenceGuard::kMachine};
  fences.fence[1] = {Eigen::Vector3d::UnitZ(), arm_pin.position_m.z() + 0.03, FenceGuard::kMachine};
  assert_cap(cap(then, up, fences), 2.0 * 0.0302 / arm_pin.velocity_mps.z(), LimitKind::kFence, 1);
  assert_cap(cap(then, -up, fences), 1.0, LimitKind::kNone, 0);
  // The teeth alone are far below it.
  fences.fence[1].guard = FenceGuard::kTeeth;
  assert_cap(cap(then, up, fences), 1.0, LimitKind::kNone, 0);
}

/// The swing turns the teeth towards a wall.
TEST(a_wall_holds_the_swing) {
  const DriveVector then(0.475, 0.565, 0.4375, 0.3);
  const Eigen::Vector3d teeth_m = machine().teeth(then).position_m;
  FenceSet fences = one({Eigen::Vector3d::UnitY(), teeth_m.y() + 0.05, FenceGuard::kTeeth});
  const double closing_mps = 0.4 * teeth_m.x();
  assert_cap(cap(then, {0.0, 0.0, 0.0, 0.4}, fences),
             std::min(2.0 * 0.0502, std::sqrt(2.0 * 0.25 * 0.0502)) / closing_mps,
             LimitKind::kFence, 0);
  assert_cap(cap(then, {0.0, 0.0, 0.0, -0.4}, fences), 1.0, LimitKind::kNone, 0);
}

/// Rounding towards a limit that is passed already stops nothing; neither does NaN pass.
TEST(rounding_is_free_and_nan_is_not) {
  assert_cap(cap({0.96, 0.565, 0.4375, 0.0}, {1e-12, 0.2, 0.0, 0.0}), 1.0, LimitKind::kNone, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  assert_cap(cap({0.5, 0.5, 0.5, 0.0}, {0.1, nan, 0.0, 0.0}), 0.0, LimitKind::kNone, 0);
  assert_cap(cap({0.5, nan, 0.5, 0.0}, {0.1, 0.0, 0.0, 0.0}), 0.0, LimitKind::kNone, 0);
}

/// Twice as far as the sensors may be off: with its margin it stops before the fence.
TEST(it_stops_at_the_margin) {
  const test::ReplayMachine whole(test::excavator_12t().profile);
  const DriveVector then(0.8, 0.565, 0.4375, 0.3);
  const DriveVector up(0.1, 0.0, 0.0, 0.0);
  const MachineMotion motion =
      machine_motion(whole.kinematics, then, up, unsure_drives(whole.profile));
  const PointMotion& pin = motion.at(MachinePoint::kArmPin);
  const double margin_m = pin.unsure_m + whole.profile.fence.give_m;
  // 2.1 mm at the boom's cylinder, 3.1 mrad of swing at the arm's pin, and 20 mm.
  print_message("margin %.1f mm\n", 1e3 * margin_m);
  assert_true(margin_m > 0.045 && margin_m < 0.075);
  FenceSet fences;
  fences.count = 1;
  const double thick_m = whole.profile.geometry.body.boom_radius_m;
  const auto factor = [&](double left_m) {
    fences.fence[0] = {Eigen::Vector3d::UnitZ(), pin.position_m.z() + thick_m + left_m,
                       FenceGuard::kMachine};
    return test::motion_cap(whole.profile, whole.kinematics, fences, then, up).factor;
  };
  assert_near(factor(margin_m - 0.001), 0.0, 0.0);
  assert_near(factor(margin_m + 0.01), 2.0 * 0.0102 / pin.velocity_mps.z(), 1e-9);
}

/// Beyond a ceiling the boom leads further and is held, the swing is free: it alone goes on. With
/// the boom alone nothing does.
TEST(beyond_a_fence_only_what_leads_back_moves) {
  const DriveVector then(0.475, 0.565, 0.4375, 0.3);
  const double pin_m = machine().points(then).at(MachinePoint::kArmPin).position_m.z();
  FenceSet fences = one({Eigen::Vector3d::UnitZ(), pin_m - 0.5, FenceGuard::kMachine});
  const auto held = [&](const DriveVector& velocity) {
    return test::motion_cap(machine().profile, machine().kinematics, fences, then, velocity);
  };
  const MotionCap both = held({0.1, 0.0, 0.0, 0.2});
  assert_cap(both, 1.0, LimitKind::kFence, 0);
  assert_true((both.share - DriveVector(0.0, 1.0, 1.0, 1.0)).norm() == 0.0);
  const MotionCap boom = held({0.1, 0.0, 0.0, 0.0});
  assert_cap(boom, 0.0, LimitKind::kFence, 0);
  const MotionCap down = held({-0.1, 0.0, 0.0, 0.2});
  assert_cap(down, 1.0, LimitKind::kNone, 0);
  assert_true(down.share == DriveVector::Ones());
  // What is free is slowed before another fence as anything is.
  const Eigen::Vector3d teeth_m = machine().teeth(then).position_m;
  fences.count = 2;
  fences.fence[1] = {Eigen::Vector3d::UnitY(), teeth_m.y() + 0.05, FenceGuard::kTeeth};
  const MotionCap swing = held({0.1, 0.0, 0.0, 0.4});
  assert_cap(swing, std::min(2.0 * 0.0502, std::sqrt(2.0 * 0.25 * 0.0502)) / (0.4 * teeth_m.x()),
             LimitKind::kFence, 1);
  assert_near(swing.share[kBoom], 0.0, 0.0);
}

/// A platform that turns by itself is taken to be where it will come to.
TEST(its_own_momentum_counts) {
  const DriveVector then(0.475, 0.565, 0.4375, 0.3);
  const Eigen::Vector3d teeth_m = machine().teeth(then).position_m;
  FenceSet fences = one({Eigen::Vector3d::UnitY(), teeth_m.y() + 0.5, FenceGuard::kTeeth});
  const double lever_m = machine().profile.swing.lever_m;
  const ExcavatorBank bank = excavator_bank(machine().profile);
  const auto factor = [&](double radps) {
    return motion_cap(machine().profile, bank.rows(), machine().kinematics, fences,
                      travel_of(machine().profile, then), DriveVector(0.0, 0.0, 0.0, 0.1 * lever_m),
                      swing_coast_m(radps * lever_m, 0.0))
        .factor;
  };
  assert_near(factor(0.0), 1.0, 0.0);
  assert_near(factor(-0.4), 1.0, 0.0);
  assert_near(factor(0.4), 0.0, 0.0);
  assert_near(swing_coast_m(0.2, 0.1), 0.04, 1e-15);
}

struct Slide {
  double time_ratio = 0.0;  ///< Taken over planned.
  double deepest_m = 0.0;
  double least_factor = 1.0;
};

/// The line of the paper on a surface that it lies in, with a feedback as strong as the soft
/// limit's own gain allows.
Slide slide_on_design(double speed_mps, bool late) {
  LineRequest request{test::excavator_12t().experiment.line.from,
                      test::excavator_12t().experiment.line.to,
                      machine().profile.line.acceleration_mps2};
  request.speed_mps = speed_mps;
  const LinePlan plan = plan_line(machine().kinematics, machine().limits, request).plan;
  const FenceSet fences = one(DesignPlane{}.fence());
  test::ReplayedDrives drives(plan_state(machine().kinematics, plan, 0.0).by_share.value, late);
  Slide slide;
  double time_s = 0.0;
  int cycles = 0;
  for (; time_s < plan.ramp.duration_s && cycles < 20000; ++cycles) {
    const PlanState wanted = plan_state(machine().kinematics, plan, time_s);
    const DriveVector then = drives.then();
    const DriveVector velocity = wanted.velocity + 2.0 * (wanted.by_share.value - then);
    const VelocityCap held = cap(then, velocity, fences);
    slide.least_factor = std::min(slide.least_factor, held.factor);
    drives.ask(held.factor * velocity);
    time_s += held.factor * kCycle_s;
    const double height_m = machine().teeth(drives.value()).position_m.z();
    slide.deepest_m = std::max(slide.deepest_m, -height_m);
  }
  slide.time_ratio = cycles * kCycle_s / plan.ramp.duration_s;
  return slide;
}

TEST(sliding_along_a_plane_does_not_chatter) {
  for (const double speed_mps : {0.2, 0.5, 1.0}) {
    for (const bool late : {false, true}) {
      const Slide slide = slide_on_design(speed_mps, late);
      print_message("%.1f m/s%s: %.4f of the time, %.3f mm deep, factor %.3f\n", speed_mps,
                    late ? " late" : "", slide.time_ratio, 1e3 * slide.deepest_m,
                    slide.least_factor);
      assert_true(slide.deepest_m < 1e-3);
      assert_near(slide.time_ratio, 1.0, 0.02);
    }
  }
}

/// Heights that are seen too high let a design seem as much farther off than it is.
TEST(a_design_lies_where_the_ground_was_felt, FenceSet fences) {
  const DriveVector at(0.475, 0.565, 0.4375, 0.0);
  const double teeth_z_m =
      machine()
          .kinematics.teeth_from_joints(machine().kinematics.joints_from_drive(at).value)
          .position_m.z();
  Fence& design = fences.fence[0];
  design.normal = -Eigen::Vector3d::UnitZ();
  design.offset_m = -(teeth_z_m - 0.03);
  design.guard = FenceGuard::kTeeth;
  fences.count = 1;
  const ExcavatorBank bank = excavator_bank(machine().profile);
  const auto factor = [&](double zero_m) {
    return graben::motion_cap(machine().profile, bank.rows(), machine().kinematics, fences,
                              travel_of(machine().profile, at),
                              travel_of(machine().profile, {-0.1, 0.0, 0.0, 0.0}), 0.0, zero_m)
        .factor;
  };
  assert_true(factor(0.0) > 0.0);
  assert_near(factor(0.01) / factor(0.0), (0.02 + 5e-5) / (0.03 + 5e-5), 5e-3);
  assert_true(factor(-0.01) > factor(0.0));
}

/// A swing over level ground towards a bank: it slows before the bank, though under the edge there
/// is nothing to see of it yet; away from it, and over ground without a design, nothing does.
TEST(a_surface_that_rises_ahead_is_slowed_for) {
  const DriveVector at(0.475, 0.565, 0.4375, 0.0);
  const Eigen::Vector3d teeth_m = machine().teeth(at).position_m;
  const double half_m = 0.5 * machine().profile.geometry.body.bucket_width_m;
  const test::GridGround bank(
      [&](double, double y) { return teeth_m.z() - 0.1 + std::max(0.0, y - half_m - 0.4); });
  const test::GridGround none([](double, double) { return std::nan(""); });
  const ExcavatorBank rows = excavator_bank(machine().profile);
  const auto cap = [&](const test::GridGround& ground, double side) {
    return graben::motion_cap(machine().profile, rows.rows(), machine().kinematics, ground.fences(),
                              travel_of(machine().profile, at),
                              travel_of(machine().profile, {0.0, 0.0, 0.0, 0.25 * side}));
  };
  assert_true(cap(bank, 1.0).factor < 0.7);
  assert_int_equal(cap(bank, 1.0).limit.kind, LimitKind::kFence);
  assert_near(cap(bank, -1.0).factor, 1.0, 0.0);
  assert_near(cap(none, 1.0).factor, 1.0, 0.0);
}

/// As many keep-outs as there may be, about the bucket: each part is looked at against each of
/// them, and one that moves into the nearest is held by it.
TEST(eight_keep_outs) {
  const DriveVector then(0.475, 0.565, 0.4375, 0.0);
  const Eigen::Vector3d teeth_m = machine().teeth(then).position_m;
  std::mt19937 random(5);
  const auto within = [&random](double least, double most) {
    return least + (most - least) * static_cast<double>(random() % 1000U) / 1000.0;
  };
  int held = 0;
  for (int n = 0; n < 200; ++n) {
    FenceSet fences;
    fences.count = kFenceMost;
    for (Fence& fence : fences.fence) {
      fence.shape = n % 2 == 0 ? FenceShape::kBox : FenceShape::kCylinder;
      fence.guard = FenceGuard::kMachine;
      fence.centre_m =
          teeth_m + Eigen::Vector3d(within(-4.0, 1.0), within(-1.0, 1.0), within(-1.0, 2.0));
      fence.half_m = {within(0.2, 1.0), within(0.2, 1.0), within(0.2, 1.0)};
      fence.normal = Eigen::Vector3d::UnitX();
    }
    const VelocityCap by = cap(then, {0.1, -0.1, 0.1, 0.3}, fences);
    assert_true(by.factor >= 0.0 && by.factor <= 1.0);
    assert_true(by.limit.kind != LimitKind::kFence || by.limit.index < kFenceMost);
    held += by.limit.kind == LimitKind::kFence && by.factor < 1.0 ? 1 : 0;
  }
  assert_true(held > 50);
}
