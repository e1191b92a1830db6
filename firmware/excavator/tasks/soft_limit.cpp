#include "firmware/excavator/tasks/soft_limit.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// The cap that all limits so far have made.
class Holding {
 public:
  explicit Holding(double gain_ps) : gain_ps_(gain_ps) {}

  /// Closing speed and distance in m or rad, the distance with its slack.
  void look_at(double distance, double closing, double deceleration, Limit limit) {
    if (closing <= kStandsStill) {
      return;
    }
    const double left = std::max(0.0, distance);
    const double allowed = std::min(gain_ps_ * left, std::sqrt(2.0 * deceleration * left));
    if (closing * cap_.factor > allowed) {
      cap_ = {allowed / closing, limit};
    }
  }

  /// A range from both its ends.
  void look_at_range(double least, double most, double value, double velocity, double deceleration,
                     Limit limit) {
    look_at(velocity > 0.0 ? most - value : value - least, std::abs(velocity), deceleration, limit);
  }

  [[nodiscard]] const VelocityCap& cap() const { return cap_; }

 private:
  double gain_ps_;
  VelocityCap cap_;
};

void look_at_fences(Holding& holding, const FenceSet& fences, const MachineMotion& motion,
                    double deceleration_mps2) {
  for (int i = 0; i < fences.count; ++i) {
    const Fence& fence = fences.fence[static_cast<unsigned>(i)];
    const Limit limit{LimitKind::kFence, static_cast<std::uint8_t>(i)};
    for (int p = 0; p < fence.guarded(); ++p) {
      const FenceGap gap = fence_gap(fence, motion.point[static_cast<unsigned>(p)]);
      holding.look_at(gap.distance_m + kFenceSlack_m, gap.closing_mps, deceleration_mps2, limit);
    }
  }
}

}  // namespace

VelocityCap soft_limit(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                       const FenceSet& fences, const DriveVector& then,
                       const DriveVector& velocity) {
  if (!then.allFinite() || !velocity.allFinite()) {
    return {0.0, {}};
  }
  Holding holding(profile.control.stroke_end_gain_ps);
  DriveVector inside = then;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double most_m = profile.geometry.cylinder[i].stroke_m;
    inside[i] = std::clamp(then[i], 0.0, most_m);
    holding.look_at_range(-kStrokeSlack_m, most_m + kStrokeSlack_m, then[i], velocity[i],
                          profile.line.cylinder_acceleration_mps2[i],
                          {LimitKind::kStrokeEnd, static_cast<std::uint8_t>(i)});
  }
  if (profile.has_swing()) {
    const SwingProfile& swing = profile.swing;
    holding.look_at_range(swing.right_end_rad - kSwingSlack_rad,
                          swing.left_end_rad + kSwingSlack_rad, then[kSwing], velocity[kSwing],
                          swing.acceleration_max_radps2, {LimitKind::kSwingEnd, 0});
  }
  if (fences.count == 0) {
    return holding.cap();
  }
  const MachineMotion motion = machine_motion(kinematics, inside, velocity);
  if (motion.status != ReachStatus::kOk) {
    return {0.0, {}};
  }
  look_at_fences(holding, fences, motion, profile.line.acceleration_mps2);
  return holding.cap();
}

}  // namespace graben
