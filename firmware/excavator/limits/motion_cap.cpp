// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/limits/motion_cap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/excavator/swing.hpp"

namespace graben {
namespace {

DriveVector inside_stops(DriveRows drives, DriveVector travel_m) {
  for (int i = 0; i < drives.count(); ++i) {
    if (drives[i].control.has_end_stops) {
      travel_m[i] = std::clamp(travel_m[i], drives[i].least_travel_m, drives[i].most_travel_m);
    }
  }
  return travel_m;
}

/// `turn`: cosine and sine.
void turn_right(const Eigen::Vector2d& turn, Eigen::Vector3d& vector) {
  const double x = vector.x();
  vector.x() = turn.x() * x + turn.y() * vector.y();
  vector.y() = turn.x() * vector.y() - turn.y() * x;
}

/// What is beyond a fence and would go on.
struct Beyond {
  std::uint8_t fence = 0;
  std::uint8_t gap = 0;
};

/// The fences before a machine that stands somewhere.
class FencedMachine {
 public:
  FencedMachine(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                const FenceView& fences, const DriveVector& at, double zero_m)
      : profile_(profile), kinematics_(kinematics), fences_(fences), at_(at), zero_m_(zero_m) {}

  /// False: it can't be there.
  [[nodiscard]] bool slow(const DriveVector& velocity, VelocityCap& cap) {
    MachineMotion motion = machine_motion(kinematics_, at_, velocity, unsure_drives(profile_));
    if (motion.status != ReachStatus::kOk) {
      return false;
    }
    const double far_m = nothing_to_slow_m(motion);
    // The design is the last of them.
    const int moved = is_moved() ? 1 : 0;
    for (int i = 0; i < fences_.count - moved; ++i) {
      slow_at(i, motion, far_m, cap);
    }
    if (moved > 0) {
      look_from_site(motion);
      slow_at(fences_.count - 1, motion, far_m, cap);
    }
    return true;
  }

  /// Those drives whose motion by itself leads nothing further beyond; none where nothing is
  /// beyond, or more than is kept.
  [[nodiscard]] DriveVector free_drives(const DriveVector& velocity) const {
    DriveVector free = DriveVector::Zero();
    if (beyond_count_ == 0 || beyond_count_ > kBeyondMost) {
      return free;
    }
    for (int drive = 0; drive < kDriveCount; ++drive) {
      DriveVector alone = DriveVector::Zero();
      alone[drive] = velocity[drive];
      free[drive] = leads_further(alone) ? 0.0 : 1.0;
    }
    return free;
  }

 private:
  /// Most gaps beyond a fence that are kept. [-; size: with more, no drive by itself is free]
  static constexpr int kBeyondMost = 16;

  void slow_at(int number, const MachineMotion& motion, double far_m, VelocityCap& cap) {
    const Fence& fence = fence_at(number);
    const Limit limit{LimitKind::kFence, static_cast<std::uint8_t>(number)};
    const int count = gap_count(fence, body());
    for (int i = 0; i < count; ++i) {
      const FenceGap gap = fence_gap(fence, body(), motion, i, far_m);
      const double zero_m = fence.guard == FenceGuard::kTeeth ? zero_m_ : 0.0;
      if (fence.is_surface() && gap.point != MachinePoint::kTeeth) {
        slow_ahead(*fence.surface, motion.at(gap.point), zero_m, limit, cap);
      }
      const double left_m = gap.distance_m - zero_m -
                            held_margin_m(profile_.fence, fence, motion, gap) + kFenceSlack_m;
      approach(profile_.control.stroke_end_gain_ps, profile_.line.acceleration_mps2, left_m,
               gap.closing_mps, limit, cap);
      if (left_m <= 0.0 && gap.closing_mps > kStandsStill && beyond_count_++ < kBeyondMost) {
        beyond_[static_cast<unsigned>(beyond_count_ - 1)] = {static_cast<std::uint8_t>(number),
                                                             static_cast<std::uint8_t>(i)};
      }
    }
  }

  /// Before what rises on the way of a point: under it there may be no more to see of that yet.
  void slow_ahead(const DesignSurface& surface, const PointMotion& point, double zero_m,
                  Limit limit, VelocityCap& cap) const {
    const SurfaceContact contact = surface.ahead(point, zero_m);
    if (contact.met) {
      const double closing_mps = -contact.up.dot(point.velocity_mps);
      approach(profile_.control.stroke_end_gain_ps, profile_.line.acceleration_mps2,
               contact.time_s * closing_mps + kFenceSlack_m, closing_mps, limit, cap);
    }
  }

  /// A design lies elsewhere than it is given: the machine is seen in its frame.
  [[nodiscard]] bool is_moved() const {
    return fences_.shift != nullptr && fences_.count > 0 && fence_at(fences_.count - 1).is_design();
  }

  /// Of one that is moved: the same motion, turned about the swing's axis.
  void look_from_site(MachineMotion& motion) const {
    const Eigen::Vector2d turn(std::cos(fences_.shift->turn_rad),
                               std::sin(fences_.shift->turn_rad));
    turn_right(turn, motion.left);
    for (PointMotion& point : motion.point) {
      turn_right(turn, point.position_m);
      turn_right(turn, point.velocity_mps);
      point.position_m += fences_.shift->origin_m;
    }
  }

  [[nodiscard]] bool leads_further(const DriveVector& velocity) const {
    const MachineMotion here = machine_motion(kinematics_, at_, velocity);
    MachineMotion on_site = here;
    const int moved = is_moved() ? fences_.count - 1 : -1;
    if (moved >= 0) {
      look_from_site(on_site);
    }
    bool further = false;
    for (int i = 0; i < beyond_count_; ++i) {
      const Beyond& what = beyond_[static_cast<unsigned>(i)];
      const FenceGap gap =
          fence_gap(fence_at(what.fence), body(), what.fence == moved ? on_site : here, what.gap,
                    std::numeric_limits<double>::infinity());
      further = further || gap.closing_mps > kStandsStill;
    }
    return further;
  }

  /// At this distance nothing that moves so has to be slowed.
  [[nodiscard]] double nothing_to_slow_m(const MachineMotion& motion) const {
    double fastest_m2ps2 = 0.0;
    double margin_m = 0.0;
    for (const PointMotion& point : motion.point) {
      fastest_m2ps2 = std::max(fastest_m2ps2, point.velocity_mps.squaredNorm());
      margin_m = std::max(margin_m, point.unsure_m);
    }
    return margin_m + profile_.fence.give_m +
           std::max(std::sqrt(fastest_m2ps2) / profile_.control.stroke_end_gain_ps,
                    0.5 * fastest_m2ps2 / profile_.line.acceleration_mps2);
  }

  [[nodiscard]] const Fence& fence_at(int number) const { return fences_.at(number); }
  [[nodiscard]] const ExcavatorBody& body() const { return kinematics_.geometry().body; }

  const ExcavatorProfile& profile_;
  const SwingKinematics& kinematics_;
  const FenceView& fences_;
  DriveVector at_;
  double zero_m_;
  std::array<Beyond, kBeyondMost> beyond_;
  int beyond_count_ = 0;
};

}  // namespace

MotionCap motion_cap(const ExcavatorProfile& profile, DriveRows drives,
                     const SwingKinematics& kinematics, const FenceView& fences,
                     const DriveVector& then_m, const DriveVector& velocity_mps, double coast_m,
                     double zero_m) {
  const auto held = [] {
    MotionCap cap;
    cap.factor = 0.0;
    return cap;
  };
  if (!then_m.allFinite() || !velocity_mps.allFinite() || !std::isfinite(coast_m)) {
    return held();
  }
  MotionCap cap;
  approach_ends(drives, span_of(then_m), span_of(velocity_mps), cap);
  if (fences.count == 0) {
    return cap;
  }
  const DriveVector comes_to_m = with_swing(then_m, swing_of(then_m) + coast_m);
  FencedMachine machine(profile, kinematics, fences,
                        drives_of(profile, inside_stops(drives, comes_to_m)), zero_m);
  const DriveVector velocity = drives_of(profile, velocity_mps);
  if (!machine.slow(velocity, cap)) {
    return held();
  }
  const DriveVector free = machine.free_drives(velocity);
  const DriveVector free_mps = velocity_mps.cwiseProduct(free);
  if (free_mps.isZero(0.0)) {
    return cap;
  }
  MotionCap alone;
  alone.share = free;
  approach_ends(drives, span_of(then_m), span_of(free_mps), alone);
  static_cast<void>(machine.slow(velocity.cwiseProduct(free), alone));
  alone.limit = alone.limit.kind == LimitKind::kNone ? cap.limit : alone.limit;
  return alone;
}

}  // namespace graben
