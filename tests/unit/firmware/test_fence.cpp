// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/fence.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"

const test::ReplayMachine& machine() {
  static const test::ReplayMachine loaded(test::excavator_12t());
  return loaded;
}

const PointMotion& at(const MachineMotion& motion, MachinePoint point) {
  return motion.point[static_cast<unsigned>(point)];
}

/// Against the closed chain: teeth by its own function, the pins a link's length apart, the boom's
/// end by hand.
TEST(points_of_the_machine) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    plant::Random random(seed, plant::Draw::kStart);
    const DriveVector drive = machine().random_drive(random);
    const MachineMotion motion = machine().points(drive);
    assert_int_equal(motion.status, ReachStatus::kOk);
    const Eigen::Vector3d teeth_m = at(motion, MachinePoint::kTeeth).position_m;
    const Eigen::Vector3d pin_m = at(motion, MachinePoint::kBucketPin).position_m;
    const Eigen::Vector3d arm_pin_m = at(motion, MachinePoint::kArmPin).position_m;
    assert_true((teeth_m - machine().teeth(drive).position_m).norm() < 1e-12);
    assert_near((teeth_m - pin_m).norm(), 1.23, 1e-12);
    assert_near((pin_m - arm_pin_m).norm(), 2.52, 1e-12);
    const double boom_rad = machine().kinematics.joints_from_drive(drive).value[kBoom];
    const double radius_m = 0.14 + 4.60 * std::cos(boom_rad);
    const Eigen::Vector3d by_hand(radius_m * std::cos(drive[kSwing]),
                                  radius_m * std::sin(drive[kSwing]),
                                  1.424 + 4.60 * std::sin(boom_rad));
    assert_true((arm_pin_m - by_hand).norm() < 1e-12);
  }
}

TEST(closing_speed_is_the_distance_s_difference) {
  constexpr double kStep_s = 1e-6;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    plant::Random random(seed, plant::Draw::kStart);
    const DriveVector drive = machine().random_drive(random, -0.01);
    const Fence fence = test::random_fence(machine(), random, drive, 2.0);
    DriveVector velocity;
    for (int i = 0; i < kDriveCount; ++i) {
      velocity[i] = random.symmetric(1.0);
    }
    const MachineMotion here = machine_motion(machine().kinematics, drive, velocity);
    const MachineMotion ahead = machine().points(drive + kStep_s * velocity);
    const MachineMotion behind = machine().points(drive - kStep_s * velocity);
    for (unsigned p = 0; p < kMachinePointCount; ++p) {
      const double shrinks_mps = (fence_gap(fence, behind.point[p]).distance_m -
                                  fence_gap(fence, ahead.point[p]).distance_m) /
                                 (2.0 * kStep_s);
      assert_near(fence_gap(fence, here.point[p]).closing_mps, shrinks_mps, 1e-6);
    }
  }
}

TEST(the_design_is_a_fence_for_the_teeth_from_above) {
  const DesignPlane design{{1.0, 2.0, -0.5}, Eigen::Vector3d(0.1, 0.0, 1.0).normalized(), 0.02};
  const Eigen::Vector3d above_m = design.through_m + 0.3 * design.up;
  assert_near(design.height_m(above_m), 0.3, 1e-12);
  const FenceGap gap = fence_gap(design.fence(), {above_m, -design.up});
  assert_near(gap.distance_m, 0.3, 1e-12);
  assert_near(gap.closing_mps, 1.0, 1e-12);
  // Both corners of the edge; of a level plane all but the counterweight.
  assert_int_equal(gap_count(design.fence(), {}), 2);
  assert_int_equal(gap_count(Fence{}, {}), 10);
}

const test::ReplayMachine& whole() {
  static const test::ReplayMachine loaded(test::excavator_12t().profile);
  return loaded;
}

/// The bucket is as the simulated machine has it: edge to heel 0.5535 m at 0.65 rad, 1 m wide; the
/// counterweight's corners are 2.2 m from the swing axis.
TEST(the_outline_goes_with_the_machine) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    plant::Random random(seed, plant::Draw::kStart);
    const DriveVector drive = whole().random_drive(random);
    const MachineMotion motion = whole().points(drive);
    const auto place = [&motion](MachinePoint point) { return at(motion, point).position_m; };
    const Eigen::Vector3d teeth_m = place(MachinePoint::kTeeth);
    const double swing_rad = drive[kSwing];
    const Eigen::Vector3d left(-std::sin(swing_rad), std::cos(swing_rad), 0.0);
    const Eigen::Vector3d ahead(std::cos(swing_rad), std::sin(swing_rad), 0.0);
    assert_true((motion.left - left).norm() < 1e-12);
    assert_true((place(MachinePoint::kEdgeLeft) - teeth_m - 0.5 * left).norm() < 1e-12);
    assert_true((place(MachinePoint::kEdgeRight) - teeth_m + 0.5 * left).norm() < 1e-12);
    const double floor_rad = whole().teeth(drive).attitude_rad - 0.65;
    const Eigen::Vector3d floor_m =
        0.5535 * (std::cos(floor_rad) * ahead + std::sin(floor_rad) * Eigen::Vector3d::UnitZ());
    assert_true((place(MachinePoint::kHeelRight) - teeth_m - floor_m + 0.5 * left).norm() < 1e-12);
    const Eigen::Vector3d tail_m = place(MachinePoint::kTailLeft);
    assert_near(tail_m.head<2>().norm(), 2.2 - 0.3, 1e-12);
    assert_near(tail_m.dot(left), 0.9, 1e-12);
    assert_true(tail_m.dot(ahead) < 0.0);
    assert_near(tail_m.z(), 0.9, 0.0);
  }
}

/// Drives off by what they may be off at most, all ways: no point is farther off than it says, and
/// some way it is, nearly.
TEST(a_point_is_unsure_by_what_its_drives_may_be_off) {
  const DriveVector unsure(2e-3, 2e-3, 2e-3, 1e-3);
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    plant::Random random(seed, plant::Draw::kStart);
    const DriveVector drive = whole().random_drive(random, -0.1);
    const MachineMotion motion =
        machine_motion(whole().kinematics, drive, DriveVector::Zero(), unsure);
    std::array<double, kMachinePointCount> most_m{};
    for (unsigned signs = 0; signs < 16; ++signs) {
      DriveVector off;
      for (unsigned i = 0; i < kDriveCount; ++i) {
        off[i] = (signs >> i & 1U) != 0 ? unsure[i] : -unsure[i];
      }
      const MachineMotion other = whole().points(drive + off);
      for (unsigned p = 0; p < kMachinePointCount; ++p) {
        const double off_m = (other.point[p].position_m - motion.point[p].position_m).norm();
        most_m[p] = std::max(most_m[p], off_m);
        // Second order: a lever changes on the way.
        assert_true(off_m <= 1.03 * motion.point[p].unsure_m + 1e-6);
      }
    }
    for (unsigned p = 0; p < kMachinePointCount; ++p) {
      assert_true(most_m[p] >= 0.4 * motion.point[p].unsure_m);
    }
  }
}

TEST(what_is_looked_at) {
  const ExcavatorBody& body = whole().profile.geometry.body;
  Fence wall;
  wall.normal = Eigen::Vector3d::UnitX();
  Fence box;
  box.shape = FenceShape::kBox;
  assert_int_equal(gap_count(wall, body), 12);
  assert_int_equal(gap_count(Fence{}, body), 10);
  assert_int_equal(gap_count(box, body), 5);
  assert_int_equal(gap_count(box, {}), 4);
  // Links are as thick as they are.
  const MachineMotion motion = whole().points({0.475, 0.565, 0.4375, 0.3});
  const Eigen::Vector3d arm_pin_m = at(motion, MachinePoint::kArmPin).position_m;
  const FenceGap ceiling =
      fence_gap({Eigen::Vector3d::UnitZ(), arm_pin_m.z() + 1.0}, body, motion, 7, 1e3);
  assert_int_equal(ceiling.point, MachinePoint::kArmPin);
  assert_near(ceiling.distance_m, 1.0 - 0.4, 1e-12);
}

/// Sensors' errors and what it gives; more for what is planned, the faster the more; none before a
/// design.
TEST(margins) {
  const FenceProfile allows{2e-3, 1e-3, 0.02, 0.01, 0.03};
  ExcavatorProfile profile = whole().profile;
  profile.fence = allows;
  assert_true((unsure_drives(profile) - DriveVector(2e-3, 2e-3, 2e-3, 1e-3)).norm() == 0.0);
  profile.drive_count = kAxisCount;
  assert_near(unsure_drives(profile)[kSwing], 0.0, 0.0);
  MachineMotion motion;
  motion.point[0].unsure_m = 0.05;
  motion.point[0].velocity_mps = {3.0, 0.0, 4.0};
  const FenceGap gap;
  assert_near(held_margin_m(allows, {}, motion, gap), 0.07, 1e-15);
  assert_near(planned_margin_m(allows, {}, motion, gap, 0.2), 0.07 + 0.01 + 0.03, 1e-15);
  assert_near(planned_margin_m(allows, DesignPlane{}.fence(), motion, gap, 0.2), 0.0, 0.0);
  assert_near(held_margin_m(allows, DesignPlane{}.fence(), motion, gap), 0.0, 0.0);
}

TEST(strokes_that_can_t_be_have_no_points) {
  const MachineMotion motion =
      machine_motion(machine().kinematics, {0.5, 1.2, 0.4, 0.0}, DriveVector::Zero());
  assert_int_equal(motion.status, ReachStatus::kArmStroke);
}
