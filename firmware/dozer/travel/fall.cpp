// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/fall.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tuning.hpp"

namespace graben {
namespace {

/// Steps of a fall in a cycle. [-; size: kFallFollowed_s is followed in five cycles]
constexpr int kStepsPerCycle = 6;

double edge_over_m(const DozerBody& body, const BladeKinematics& blade, const GradeProfile& design,
                   const FallSituation& at) {
  const Stand stand = stand_of(body, at.driving.motion);
  const double c = std::cos(stand.pitch_rad);
  const double s = std::sin(stand.pitch_rad);
  const Eigen::Vector2d edge_m = blade.edge_m(blade.angle_rad(at.stroke_m));
  const double x_m = at.driving.x_m + c * edge_m.x() - s * edge_m.y();
  return stand.height_m + s * edge_m.x() + c * edge_m.y() - design.at(x_m).height_m;
}

double edge_per_stroke(const BladeKinematics& blade, double stroke_m) {
  const double angle_rad = blade.angle_rad(stroke_m);
  return -blade.edge_rate_mprad(angle_rad).y() / blade.stroke_rate_mprad(angle_rad);
}

/// kMotionStep_s on.
void fall_on(const DozerBody& body, const GroundMap& ground, const GradeProfile& design,
             FallState& fall) {
  FallSituation& at = fall.at;
  at.driving.motion = next_motion(body, ground, design, at.driving.x_m, at.driving.speed_mps,
                                  at.driving.motion, kMotionStep_s);
  at.driving.x_m += at.driving.speed_mps * kMotionStep_s;
  at.stroke_m += kMotionStep_s * (fall.time_s < at.answer_s ? at.blade_mps : -at.raise_mps);
  fall.time_s += kMotionStep_s;
}

void follow(const DozerProfile& profile, const BladeKinematics& blade, const GroundMap& ground,
            const GradeProfile& design, const FallSituation& now, FallState& fall) {
  if (!fall.followed) {
    fall.at = now;
    fall.time_s = 0.0;
    fall.begin_m = edge_over_m(profile.body, blade, design, now);
    fall.least_m = fall.begin_m;
    fall.followed = true;
  }
  for (int n = 0; n < kStepsPerCycle; ++n) {
    fall_on(profile.body, ground, design, fall);
    fall.least_m = std::min(fall.least_m, edge_over_m(profile.body, blade, design, fall.at));
  }
  if (fall.time_s >= kFallFollowed_s) {
    fall.sinks_m = fall.begin_m - fall.least_m;
    fall.followed = false;
  }
}

}  // namespace

FallState next_fall(const DozerProfile& profile, const BladeKinematics& blade,
                    const GroundMap& ground, const GradeProfile& design, const FallState& last,
                    const FallSituation& now, double period_s) {
  FallState fall = last;
  follow(profile, blade, ground, design, now, fall);
  const double tolerance_m = profile.grade.tolerance_m;
  const double wanted_m =
      std::clamp(fall.sinks_m - kFallSinksAnyway * tolerance_m, 0.0, kFallMostLift * tolerance_m);
  const double step_m =
      std::clamp(wanted_m - last.lift_m, -kFallSink_mps * period_s, kFallRise_mps * period_s);
  fall.lift_m = last.lift_m + step_m;
  fall.rate_mps = period_s > 0.0 ? step_m / period_s : 0.0;
  fall.speed_mps = kFallLetsGo_m * now.raise_mps * edge_per_stroke(blade, now.stroke_m) /
                   std::max(fall.sinks_m, kFallNone_m);
  return fall;
}

}  // namespace graben
