// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/line_plan.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/motion/program/tuning.hpp"
#include "firmware/excavator/swing.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool positive(const DriveVector& values) { return values.allFinite() && values.minCoeff() > 0.0; }
bool finite(const TeethPose& pose) {
  return pose.position_m.allFinite() && std::isfinite(pose.attitude_rad);
}

bool usable(const DriveLimits& limits, const LineRequest& request) {
  const bool one_pace = positive(request.duration_s)
                            ? request.speed_mps == 0.0
                            : request.duration_s == 0.0 && positive(request.speed_mps);
  return finite(request.from) && finite(request.to) && positive(request.acceleration_mps2) &&
         one_pace && positive(limits.speed_out) && positive(limits.speed_in) &&
         positive(limits.acceleration);
}

/// Highest value of a curve that is sampled in equal steps.
class Peak {
 public:
  void begin() { count_ = 0; }

  void add(double value) {
    highest_ = std::max(highest_, value);
    if (count_ >= 2 && last_ >= before_ && last_ >= value) {
      const double bend = 2.0 * last_ - before_ - value;
      const double slope = value - before_;
      highest_ = std::max(highest_, bend > 0.0 ? last_ + slope * slope / (8.0 * bend) : last_);
    }
    before_ = last_;
    last_ = value;
    ++count_;
  }

  [[nodiscard]] double highest() const { return highest_; }

 private:
  double highest_ = 0.0;
  double before_ = 0.0;
  double last_ = 0.0;
  int count_ = 0;
};

struct DrivePeaks {
  Peak speed;
  Peak speed_ratio;
  Peak acceleration;
};

/// `ramp` slowed until no drive passes its limits; tells which one made it so.
void keep_limits(PlanResult& result) {
  int fastest = 0;
  int hardest = 0;
  const double speed = result.peaks.speed_ratio.maxCoeff(&fastest);
  const double acceleration = std::sqrt(result.peaks.acceleration_ratio.maxCoeff(&hardest));
  const double factor = std::max(speed, acceleration);
  if (!(factor > 1.0)) {
    return;
  }
  result.slowed_by = speed >= acceleration ? PlanLimit::kSpeed : PlanLimit::kAcceleration;
  result.drive = speed >= acceleration ? fastest : hardest;
  result.slowed_ratio = factor;
  result.plan.ramp = result.plan.ramp.slowed(factor);
  result.peaks.speed /= factor;
  result.peaks.speed_ratio /= factor;
  result.peaks.acceleration /= factor * factor;
  result.peaks.acceleration_ratio /= factor * factor;
}

}  // namespace

PlanState plan_state(const SwingKinematics& kinematics, const LinePlan& plan, double time_s) {
  PlanState state;
  state.progress = plan.ramp.at(time_s);
  const Progress& progress = state.progress;
  state.teeth = plan.line.at(progress.share);
  state.teeth_velocity_mps = progress.rate_ps * plan.line.change.position_m;
  state.teeth_acceleration_mps2 = progress.rate_change_ps2 * plan.line.change.position_m;
  state.by_share = line_motion(kinematics, plan.line, progress.share);
  state.velocity = progress.rate_ps * state.by_share.rate;
  state.acceleration = progress.rate_change_ps2 * state.by_share.rate +
                       progress.rate_ps * progress.rate_ps * state.by_share.curvature;
  return state;
}

PlanPeaks plan_peaks(const SwingKinematics& kinematics, const DriveLimits& limits,
                     const LinePlan& plan) {
  const SineRamp& ramp = plan.ramp;
  const std::array<double, 4> period_s = {0.0, ramp.ramp_s, ramp.duration_s - ramp.ramp_s,
                                          ramp.duration_s};
  std::array<DrivePeaks, kDriveCount> drive;
  for (unsigned period = 0; period < 3; ++period) {
    for (DrivePeaks& peaks : drive) {
      peaks.speed.begin();
      peaks.speed_ratio.begin();
      peaks.acceleration.begin();
    }
    for (int step = 0; step <= kPeakSteps; ++step) {
      const double part = static_cast<double>(step) / kPeakSteps;
      const double time_s = (1.0 - part) * period_s[period] + part * period_s[period + 1];
      const PlanState state = plan_state(kinematics, plan, time_s);
      for (unsigned i = 0; i < kDriveCount; ++i) {
        const double speed = state.velocity[i];
        drive[i].speed.add(std::abs(speed));
        drive[i].speed_ratio.add(
            std::abs(speed / (speed > 0.0 ? limits.speed_out[i] : limits.speed_in[i])));
        drive[i].acceleration.add(std::abs(state.acceleration[i]));
      }
    }
  }
  PlanPeaks peaks;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    peaks.speed[i] = drive[i].speed.highest();
    peaks.speed_ratio[i] = drive[i].speed_ratio.highest();
    peaks.acceleration[i] = drive[i].acceleration.highest();
    peaks.acceleration_ratio[i] = peaks.acceleration[i] / limits.acceleration[i];
  }
  return peaks;
}

PlanResult plan_line(const SwingKinematics& kinematics, const DriveLimits& limits,
                     const LineRequest& request) {
  PlanResult result;
  if (!usable(limits, request)) {
    return result;
  }
  LinePlan& plan = result.plan;
  plan.line = line_between(kinematics, request.from, request.to);
  plan.way_m = way_m(kinematics, plan.line);
  if (plan.way_m < kLineWayLeast_m) {
    result.refusal = PlanRefusal::kNoWay;
    return result;
  }
  result.blind = first_blind_place(kinematics, plan.line);
  if (result.blind.blind.kind != BlindKind::kNone) {
    result.refusal = PlanRefusal::kBlindSpot;
    return result;
  }
  const bool timed = request.duration_s > 0.0;
  plan.ramp = timed ? ramp_for_duration(plan.way_m, request.duration_s, request.acceleration_mps2)
                    : ramp_for_speed(plan.way_m, request.speed_mps, request.acceleration_mps2);
  if (timed && plan.ramp.duration_s > request.duration_s) {
    result.slowed_by = PlanLimit::kTeethAcceleration;
  }
  result.peaks = plan_peaks(kinematics, limits, plan);
  keep_limits(result);
  result.refusal = PlanRefusal::kNone;
  return result;
}

}  // namespace graben
