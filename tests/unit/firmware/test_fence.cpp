#include "firmware/excavator/tasks/fence.hpp"

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"

namespace {

using namespace graben;

const test::ReplayMachine& machine() {
  static const test::ReplayMachine loaded(test::excavator_12t());
  return loaded;
}

const PointMotion& at(const MachineMotion& motion, MachinePoint point) {
  return motion.point[static_cast<unsigned>(point)];
}

/// Against the closed chain: teeth by its own function, the pins a link's length apart, the boom's
/// end by hand.
void points_of_the_machine(void**) {
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

void closing_speed_is_the_distance_s_difference(void**) {
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

void the_design_is_a_fence_for_the_teeth_from_above(void**) {
  const DesignPlane design{{1.0, 2.0, -0.5}, Eigen::Vector3d(0.1, 0.0, 1.0).normalized(), 0.02};
  const Eigen::Vector3d above_m = design.through_m + 0.3 * design.up;
  assert_near(design.height_m(above_m), 0.3, 1e-12);
  const FenceGap gap = fence_gap(design.fence(), {above_m, -design.up});
  assert_near(gap.distance_m, 0.3, 1e-12);
  assert_near(gap.closing_mps, 1.0, 1e-12);
  // Both corners of the edge; of a level plane all but the counterweight.
  assert_int_equal(gap_count(design.fence(), {}), 2);
  assert_int_equal(gap_count(Fence{}, {}), 8);
}

void strokes_that_can_t_be_have_no_points(void**) {
  const MachineMotion motion =
      machine_motion(machine().kinematics, {0.5, 1.2, 0.4, 0.0}, DriveVector::Zero());
  assert_int_equal(motion.status, ReachStatus::kArmStroke);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(points_of_the_machine),
      cmocka_unit_test(closing_speed_is_the_distance_s_difference),
      cmocka_unit_test(the_design_is_a_fence_for_the_teeth_from_above),
      cmocka_unit_test(strokes_that_can_t_be_have_no_points),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
