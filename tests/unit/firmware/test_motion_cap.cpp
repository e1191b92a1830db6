#include "firmware/excavator/tasks/fence.hpp"

#include <limits>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"

namespace {

using namespace graben;
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

/// 12 t: gain 2 /s, 0.5 m/s2; slack 0.05 mm.
void cylinder_ends(void**) {
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
void swing_ends(void**) {
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
void the_strongest_limit_holds(void**) {
  assert_cap(cap({0.946, 1.120, 0.4375, 0.0}, {0.1, 0.1, 0.0, 0.0}), 2.0 * 0.00405 / 0.1,
             LimitKind::kStrokeEnd, kBoom);
  assert_cap(cap({0.940, 1.126, 0.4375, 0.0}, {0.1, 0.1, 0.0, 0.0}), 2.0 * 0.00405 / 0.1,
             LimitKind::kStrokeEnd, kArm);
}

/// A ceiling over the arm pin, the highest of the points: the boom alone rises towards it.
void fences_hold_the_point_that_is_nearest(void**) {
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
void a_wall_holds_the_swing(void**) {
  const DriveVector then(0.475, 0.565, 0.4375, 0.3);
  const Eigen::Vector3d teeth_m = machine().teeth(then).position_m;
  FenceSet fences;
  fences.count = 1;
  fences.fence[0] = {Eigen::Vector3d::UnitY(), teeth_m.y() + 0.05, FenceGuard::kTeeth};
  const double closing_mps = 0.4 * teeth_m.x();
  assert_cap(cap(then, {0.0, 0.0, 0.0, 0.4}, fences),
             std::min(2.0 * 0.0502, std::sqrt(2.0 * 0.25 * 0.0502)) / closing_mps,
             LimitKind::kFence, 0);
  assert_cap(cap(then, {0.0, 0.0, 0.0, -0.4}, fences), 1.0, LimitKind::kNone, 0);
}

/// Rounding towards a limit that is passed already stops nothing; neither does NaN pass.
void rounding_is_free_and_nan_is_not(void**) {
  assert_cap(cap({0.96, 0.565, 0.4375, 0.0}, {1e-12, 0.2, 0.0, 0.0}), 1.0, LimitKind::kNone, 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  assert_cap(cap({0.5, 0.5, 0.5, 0.0}, {0.1, nan, 0.0, 0.0}), 0.0, LimitKind::kNone, 0);
  assert_cap(cap({0.5, nan, 0.5, 0.0}, {0.1, 0.0, 0.0, 0.0}), 0.0, LimitKind::kNone, 0);
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
  FenceSet fences;
  fences.count = 1;
  fences.fence[0] = DesignPlane{}.fence();
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

void sliding_along_a_plane_does_not_chatter(void**) {
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(cylinder_ends),
      cmocka_unit_test(swing_ends),
      cmocka_unit_test(the_strongest_limit_holds),
      cmocka_unit_test(fences_hold_the_point_that_is_nearest),
      cmocka_unit_test(a_wall_holds_the_swing),
      cmocka_unit_test(rounding_is_free_and_nan_is_not),
      cmocka_unit_test(sliding_along_a_plane_does_not_chatter),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
