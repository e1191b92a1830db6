// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine of drives alone, to replay velocities on: how they arrive, where it then is, and by
/// how much it passes a limit.

#include <algorithm>
#include <array>
#include <cmath>

#include "app/plant/random.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/limits/motion_cap.hpp"
#include "firmware/excavator/motion/program/drive_plan.hpp"
#include "firmware/excavator/swing.hpp"
#include "tests/unit/firmware/fixture.hpp"

namespace graben::test {

inline constexpr double kCycle_s = 0.01;

/// At once, or after 50 ms of dead time and two lags of 26 ms each.
class ReplayedDrives {
 public:
  ReplayedDrives(const DriveVector& value, bool late) : value_(value), late_(late) {
    waiting_.fill(DriveVector::Zero());
  }

  void ask(const DriveVector& velocity) {
    if (!late_) {
      value_ += kCycle_s * velocity;
      return;
    }
    const DriveVector due = waiting_[next_];
    waiting_[next_] = velocity;
    next_ = (next_ + 1) % waiting_.size();
    lag_[0] += newest() * (due - lag_[0]);
    lag_[1] += newest() * (lag_[0] - lag_[1]);
    value_ += kCycle_s * lag_[1];
  }

  [[nodiscard]] const DriveVector& value() const { return value_; }

  /// When all that is under way has arrived.
  [[nodiscard]] DriveVector then() const {
    DriveVector sum = (1.0 - newest()) / newest() * (lag_[0] + lag_[1]);
    for (const DriveVector& velocity : waiting_) {
      sum += velocity;
    }
    return value_ + kCycle_s * sum;
  }

 private:
  static double newest() { return 1.0 - std::exp(-kCycle_s / 0.026); }

  DriveVector value_;
  bool late_;
  std::array<DriveVector, 5> waiting_;
  std::size_t next_ = 0;
  std::array<DriveVector, 2> lag_{DriveVector::Zero(), DriveVector::Zero()};
};

/// Exact sensors, stiff oil, and an outline of points: fences hold it at their place.
inline ExcavatorProfile without_body(ExcavatorProfile profile) {
  profile.geometry.body = {};
  profile.fence = {};
  return profile;
}

/// An excavator with all that a replay asks of it, without body unless told.
struct ReplayMachine {
  explicit ReplayMachine(const machines::SimulatedExcavator& machine)
      : ReplayMachine(without_body(machine.profile)) {}
  explicit ReplayMachine(const ExcavatorProfile& of)
      : profile(of), kinematics(of.geometry), limits(drive_limits(of)) {}

  [[nodiscard]] DriveVector inside(DriveVector drive) const {
    for (unsigned i = 0; i < kAxisCount; ++i) {
      drive[i] = std::clamp(drive[i], 0.0, profile.geometry.cylinder[i].stroke_m);
    }
    return drive;
  }
  [[nodiscard]] TeethPose teeth(const DriveVector& drive) const {
    return kinematics.teeth_from_joints(kinematics.joints_from_drive(inside(drive)).value);
  }
  [[nodiscard]] MachineMotion points(const DriveVector& drive) const {
    return machine_motion(kinematics, inside(drive), DriveVector::Zero());
  }
  /// In the box widened by `beyond` of its size, both ways.
  [[nodiscard]] DriveVector random_drive(plant::Random& random, double beyond = 0.0) const {
    DriveVector drive = DriveVector::Zero();
    const auto within = [&](double least, double most) {
      const double more = beyond * (most - least);
      return least - more + random.uniform() * (most - least + 2.0 * more);
    };
    for (unsigned i = 0; i < kAxisCount; ++i) {
      drive[i] = within(0.0, profile.geometry.cylinder[i].stroke_m);
    }
    drive[kSwing] = within(profile.swing.right_end_rad, profile.swing.left_end_rad);
    return drive;
  }

  ExcavatorProfile profile;
  SwingKinematics kinematics;
  DriveLimits limits;
};

/// The cap for strokes m and swing rad, and their velocities.
inline MotionCap motion_cap(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                            const FenceView& fences, const DriveVector& then,
                            const DriveVector& velocity) {
  const ExcavatorBank bank = excavator_bank(profile);
  return graben::motion_cap(profile, bank.rows(), kinematics, fences, travel_of(profile, then),
                            travel_of(profile, velocity));
}

/// Beyond the farthest passed limit, m, the swing's at the teeth; negative inside all.
inline double overrun_m(const ReplayMachine& machine, const FenceSet& fences,
                        const DriveVector& drive) {
  double most_m = -1e3;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    most_m =
        std::max({most_m, -drive[i], drive[i] - machine.profile.geometry.cylinder[i].stroke_m});
  }
  const MachineMotion motion = machine.points(drive);
  if (machine.profile.has_swing()) {
    const double radius_m = motion.point[0].position_m.head<2>().norm();
    most_m = std::max({most_m, radius_m * (drive[kSwing] - machine.profile.swing.left_end_rad),
                       radius_m * (machine.profile.swing.right_end_rad - drive[kSwing])});
  }
  for (int i = 0; i < fences.count; ++i) {
    const Fence& fence = fences.fence[static_cast<unsigned>(i)];
    for (int k = 0; k < gap_count(fence, machine.profile.geometry.body); ++k) {
      const FenceGap gap = fence_gap(fence, machine.profile.geometry.body, motion, k, 1e3);
      most_m = std::max(most_m, -gap.distance_m);
    }
  }
  return most_m;
}

/// A ceiling, a floor, a wall or any plane, up to `most_m` away from a machine that stands there.
inline Fence random_fence(const ReplayMachine& machine, plant::Random& random,
                          const DriveVector& drive, double most_m) {
  Fence fence;
  const double turn_rad = 3.14159265 * random.symmetric(1.0);
  const double kind = random.uniform();
  if (kind < 0.4) {
    fence.normal = Eigen::Vector3d(0.0, 0.0, kind < 0.2 ? 1.0 : -1.0);
  } else if (kind < 0.7) {
    fence.normal = Eigen::Vector3d(std::cos(turn_rad), std::sin(turn_rad), 0.0);
  } else {
    const double up = random.symmetric(1.0);
    const double level = std::sqrt(1.0 - up * up);
    fence.normal = Eigen::Vector3d(level * std::cos(turn_rad), level * std::sin(turn_rad), up);
  }
  fence.guard = random.uniform() < 0.5 ? FenceGuard::kTeeth : FenceGuard::kMachine;
  const MachineMotion motion = machine.points(drive);
  const double out_m = most_m * random.uniform();
  double most_out_m = -1e3;
  for (int k = 0; k < gap_count(fence, machine.profile.geometry.body); ++k) {
    const FenceGap gap = fence_gap(fence, machine.profile.geometry.body, motion, k, 1e3);
    most_out_m = std::max(most_out_m, -gap.distance_m);
  }
  fence.offset_m = most_out_m + out_m;
  return fence;
}

inline FenceSet random_fences(const ReplayMachine& machine, plant::Random& random,
                              const DriveVector& drive, double most_m = 3.0) {
  FenceSet fences;
  fences.count = static_cast<int>(4.0 * random.uniform());
  for (int i = 0; i < fences.count; ++i) {
    fences.fence[static_cast<unsigned>(i)] = random_fence(machine, random, drive, most_m);
  }
  return fences;
}

}  // namespace graben::test
