// SPDX-License-Identifier: Apache-2.0
/// Random machines driven at random targets with nothing but the soft limit between them and
/// cylinder ends, swing ends and fences: no planner refuses anything here.

#include <limits>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/drive_replay.hpp"
#include "tests/unit/rounds.hpp"

using test::kCycle_s;

constexpr int kTargets = test::rounds(10000, 400);
constexpr int kCyclesMost = 400;
constexpr double kOverrun_m = 1e-3;
/// A factor below this holds the machine.
constexpr double kHeld = 0.05;

const test::ReplayMachine& machine_12t() {
  static const test::ReplayMachine machine(test::excavator_12t());
  return machine;
}

const test::ReplayMachine& machine_22t() {
  static const test::ReplayMachine machine(test::excavator());
  return machine;
}

/// What drives the machine on: a velocity at each place, and how the way goes on.
class RandomTarget {
 public:
  RandomTarget(const test::ReplayMachine& machine, plant::Random& random, const DriveVector& start)
      : machine_(machine), line_(random.uniform() < 0.5) {
    if (line_) {
      // In braces: drawn in this order by every compiler.
      const Eigen::Vector3d level{random.symmetric(1.0), random.symmetric(1.0),
                                  random.symmetric(1.0)};
      const bool turns = machine.profile.has_swing();
      const TeethPose teeth = machine.teeth(start);
      // In the plane that the machine stands in, where it has no swing to leave it.
      const double across = turns ? level.y() : level.x() * std::tan(start[kSwing]);
      rate_.position_m = Eigen::Vector3d(level.x(), across, level.z()).normalized();
      rate_.attitude_rad = 0.3 * random.symmetric(1.0);
      from_ = teeth;
      speed_mps_ = 0.05 + 1.5 * random.uniform();
    } else {
      DriveVector to = machine.random_drive(random, 0.2);
      plan_ = plan_drives(machine.limits, start, to, {0.1 + 0.9 * random.uniform(), 0.0});
    }
  }

  [[nodiscard]] DriveVector velocity(const DriveVector& then) const {
    return line_ ? along_line(then) : drive_state(plan_, time_s_).velocity;
  }
  void advance(double by_s) { time_s_ += by_s; }
  [[nodiscard]] bool over() const { return !line_ && time_s_ >= plan_.ramp.duration_s; }

 private:
  /// The teeth on along their direction from wherever they are, as fast as the drives can.
  [[nodiscard]] DriveVector along_line(const DriveVector& then) const {
    const DriveMotion motion =
        machine_.kinematics.motion_from_teeth(machine_.teeth(then), rate_, {}, then[kSwing]);
    if (motion.blind.kind != BlindKind::kNone) {
      return DriveVector::Zero();
    }
    const double speed_mps =
        std::min(speed_mps_, machine_.profile.line.acceleration_mps2 * (time_s_ + kCycle_s));
    DriveVector velocity = speed_mps * motion.rate;
    double ratio = 1.0;
    for (int i = 0; i < kDriveCount; ++i) {
      const double most =
          velocity[i] > 0.0 ? machine_.limits.speed_out[i] : machine_.limits.speed_in[i];
      ratio = std::max(ratio, std::abs(velocity[i]) / most);
    }
    return velocity / ratio;
  }

  const test::ReplayMachine& machine_;
  bool line_;
  TeethPose from_;
  TeethPose rate_;
  double speed_mps_ = 0.0;
  DrivePlan plan_;
  double time_s_ = 0.0;
};

/// The limit that holds the machine is near, and the machine would close on it.
void assert_holds(const test::ReplayMachine& machine, const FenceSet& fences,
                  const DriveVector& then, const DriveVector& velocity, const Limit& limit) {
  constexpr double kNear = 0.05;
  const DriveVector at = machine.inside(then);
  if (limit.kind == LimitKind::kStrokeEnd) {
    assert_in_range(limit.index, kBoom, kBucket);
    const double most_m = machine.profile.geometry.cylinder[limit.index].stroke_m;
    const double left_m = velocity[limit.index] > 0.0 ? most_m - at[limit.index] : at[limit.index];
    assert_true(left_m < kNear);
    return;
  }
  if (limit.kind == LimitKind::kSwingEnd) {
    const double end_rad = velocity[kSwing] > 0.0 ? machine.profile.swing.left_end_rad
                                                  : machine.profile.swing.right_end_rad;
    assert_true(std::abs(end_rad - at[kSwing]) < kNear);
    return;
  }
  assert_int_equal(limit.kind, LimitKind::kFence);
  assert_in_range(limit.index, 0, fences.count - 1);
  const Fence& fence = fences.fence[limit.index];
  const MachineMotion motion = machine_motion(machine.kinematics, at, velocity);
  bool near = false;
  for (int k = 0; k < gap_count(fence, machine.profile.geometry.body); ++k) {
    const FenceGap gap = fence_gap(fence, machine.profile.geometry.body, motion, k, 1e3);
    near = near || (gap.distance_m < kNear && gap.closing_mps > 0.0);
  }
  assert_true(near);
}

struct Tally {
  double worst_m = -1e3;
  int held_by_stroke = 0;
  int held_by_swing = 0;
  int held_by_fence = 0;
  int free = 0;
};

void count_end(Tally& tally, const VelocityCap& cap) {
  if (cap.factor > kHeld) {
    ++tally.free;
    return;
  }
  tally.held_by_stroke += cap.limit.kind == LimitKind::kStrokeEnd ? 1 : 0;
  tally.held_by_swing += cap.limit.kind == LimitKind::kSwingEnd ? 1 : 0;
  tally.held_by_fence += cap.limit.kind == LimitKind::kFence ? 1 : 0;
}

void replay(const test::ReplayMachine& machine, std::uint64_t seed, bool late, Tally& tally) {
  plant::Random random(seed, plant::Draw::kStart);
  const DriveVector start = machine.random_drive(random);
  const FenceSet fences = test::random_fences(machine, random, start, 1.0);
  RandomTarget target(machine, random, start);
  test::ReplayedDrives drives(start, late);
  VelocityCap cap;
  int held = 0;
  double worst_m = -1e3;
  for (int i = 0; i < kCyclesMost && held < 60 && !target.over(); ++i) {
    const DriveVector then = drives.then();
    const DriveVector velocity = target.velocity(then);
    if (velocity.isZero(0.0)) {
      break;
    }
    cap = test::motion_cap(machine.profile, machine.kinematics, fences, then, velocity);
    held = cap.factor < kHeld ? held + 1 : 0;
    if (held == 1) {
      assert_holds(machine, fences, then, velocity, cap.limit);
    }
    drives.ask(cap.factor * velocity);
    target.advance(cap.factor * kCycle_s);
    worst_m = std::max(worst_m, test::overrun_m(machine, fences, drives.value()));
  }
  if (!(worst_m <= kOverrun_m)) {
    print_error("seed %d overran by %.3f mm\n", static_cast<int>(seed), 1e3 * worst_m);
  }
  tally.worst_m = std::max(tally.worst_m, worst_m);
  count_end(tally, cap);
}

TEST(no_limit_is_overrun) {
  std::array<Tally, 2> tallies;
  for (int i = 0; i < kTargets; ++i) {
    const bool late = i % 2 == 1;
    const test::ReplayMachine& machine = i % 8 < 6 ? machine_12t() : machine_22t();
    replay(machine, static_cast<std::uint64_t>(i), late, tallies[late ? 1 : 0]);
  }
  for (const Tally& tally : tallies) {
    print_message("overrun %.4f mm; held by strokes %d, swing %d, fences %d; free %d\n",
                  1e3 * tally.worst_m, tally.held_by_stroke, tally.held_by_swing,
                  tally.held_by_fence, tally.free);
    assert_true(tally.worst_m <= kOverrun_m);
    assert_true(tally.held_by_stroke > kTargets / 100);
    assert_true(tally.held_by_swing > kTargets / 500);
    assert_true(tally.held_by_fence > kTargets * 3 / 100);
    assert_true(tally.free > kTargets / 20);
  }
}
