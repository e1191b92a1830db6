// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/preview.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/travel/tuning.hpp"
#include "firmware/dozer/tuning.hpp"

namespace graben {
namespace {

/// Steps to the edge on the design. [-; size: Newton's method ends by then, from a near guess]
constexpr int kEdgeSteps = 4;

/// Of the lift's cylinders within a station.
struct LiftReach {
  double raised_m = 0.0;
  double lowered_m = 0.0;
};

}  // namespace

Preview::Preview(const DozerProfile& profile, const BladeKinematics& blade)
    : profile_(profile),
      blade_(blade),
      tilt_(profile.tilt),
      edge_per_stroke_(blade.edge_rate_mprad(0.0).y() / -blade.stroke_rate_mprad(0.0)),
      count_(std::clamp(static_cast<int>(profile.travel.preview_m / kPreviewStep_m), 1,
                        kMostStations - kBehind - 1)) {}

double Preview::probe_mps(int probe) const {
  return kProbeShare[static_cast<unsigned>(probe)] * profile_.travel.speed_desired_mps;
}

/// theta_1 with the edge on the design.
double Preview::angle_on(const GradeProfile& design, double x_m, const Stand& stand,
                         double guess_rad) const {
  const double c = std::cos(stand.pitch_rad);
  const double s = std::sin(stand.pitch_rad);
  double angle_rad = guess_rad;
  double change_rad = 1.0;
  for (int step = 0; step < kEdgeSteps && std::abs(change_rad) > kPreviewOnDesign_rad; ++step) {
    const Eigen::Vector2d edge_m = blade_.edge_m(angle_rad);
    const Eigen::Vector2d rate = blade_.edge_rate_at_mprad(edge_m);
    const GradeSample wanted = design.at(x_m + c * edge_m.x() - s * edge_m.y());
    const double below_m = wanted.height_m - (stand.height_m + s * edge_m.x() + c * edge_m.y());
    const double approach =
        s * rate.x() + c * rate.y() - wanted.slope * (c * rate.x() - s * rate.y());
    const double last_rad = angle_rad;
    angle_rad = std::clamp(angle_rad + below_m / std::max(approach, 0.1), blade_.angle_min_rad(),
                           blade_.angle_max_rad());
    change_rad = angle_rad - last_rad;
  }
  return angle_rad;
}

/// Of a design below the blade's reach, the stroke that there would have to be.
double Preview::stroke_on(const GradeProfile& design, double x_m, const Stand& stand,
                          double angle_rad) const {
  const double stroke_m = blade_.stroke_m(angle_rad);
  if (angle_rad > blade_.angle_min_rad()) {
    return stroke_m;
  }
  const double c = std::cos(stand.pitch_rad);
  const double s = std::sin(stand.pitch_rad);
  const Eigen::Vector2d edge_m = blade_.edge_m(angle_rad);
  const double design_m = design.at(x_m + c * edge_m.x() - s * edge_m.y()).height_m;
  const double above_m = stand.height_m + s * edge_m.x() + c * edge_m.y() - design_m;
  return stroke_m + std::max(0.0, above_m) / edge_per_stroke_;
}

void Preview::start(Probe& probe, double x_m, const Stand& measured) {
  probe = {};
  probe.motion = motion_of(profile_.body, measured, 0.0, 0.0);
  probe.x_m = x_m;
  probe.begin = station_of(x_m) + 1;
  probe.end = probe.begin;
  probe.started = true;
}

/// Makes the place of the machine that of the first stations; a probe that has not been there, or
/// that the machine has overtaken, starts from it.
void Preview::follow(double x_m, const Stand& measured) {
  const int here = station_of(x_m);
  first_ = here - kBehind;
  for (Probe& probe : probe_) {
    if (!probe.started || here + 1 < probe.begin || here + 1 > probe.end ||
        probe.end > last() + 1) {
      start(probe, std::isfinite(x_m) ? std::clamp(x_m, -kFurthest_m, kFurthest_m) : 0.0, measured);
    }
    probe.begin = std::max(probe.begin, first_);
  }
}

void Preview::step(const GroundMap& ground, const GradeProfile& design, int number) {
  Probe& probe = probe_[static_cast<unsigned>(number)];
  const double speed_mps = probe_mps(number);
  const double step_s = std::min(kMotionStep_s, kPreviewStep_m / speed_mps);
  const Stand before = stand_of(profile_.body, probe.motion);
  probe.motion =
      next_motion(profile_.body, ground, design, probe.x_m, speed_mps, probe.motion, step_s);
  const double from_m = probe.x_m;
  probe.x_m += speed_mps * step_s;
  const double station_m = probe.end * kPreviewStep_m;
  if (probe.x_m < station_m) {
    return;
  }
  const double share = std::clamp((station_m - from_m) / (probe.x_m - from_m), 0.0, 1.0);
  const Stand after = stand_of(profile_.body, probe.motion);
  const Stand at{before.height_m + share * (after.height_m - before.height_m),
                 before.pitch_rad + share * (after.pitch_rad - before.pitch_rad)};
  probe.angle_rad = angle_on(design, station_m, at, probe.angle_rad);
  if (profile_.tilt.present) {
    tilt_m2_[slot(probe.end)] =
        tilt_oil_m2(profile_, tilt_, design, station_m, blade_.edge_m(0.0).x());
  }
  if (design.curves()) {
    outer_[slot(probe.end)] =
        static_cast<float>(profile_.body.half_gauge_m * std::abs(design.curvature_at(station_m)));
  }
  need(number, probe.end) = {stroke_on(design, station_m, at, probe.angle_rad), 0.0, 0.0};
  ++probe.end;
}

/// Extension lowers: a stroke below the one on the design lifts the edge. Towards its end the blade
/// goes down ever slower, and no further than it.
template <class ReachOf>
void Preview::cost(int number, const ReachOf& reach_of) {
  const Probe& probe = probe_[static_cast<unsigned>(number)];
  const double time_s = kPreviewStep_m / probe_mps(number);
  const double towards_end = kBladeEndGain_ps * time_s / (1.0 + kBladeEndGain_ps * time_s);
  double stroke_m = 0.0;
  for (int index = probe.end - 1; index >= probe.begin; --index) {
    Need& at = need(number, index);
    stroke_m = index == probe.end - 1 ? at.stroke_m
                                      : std::min(at.stroke_m, stroke_m + reach_of(index).raised_m);
    at.lift_m = stroke_m;  // As a stroke, until the way back.
  }
  int stretch = probe.begin;
  double most_m = 0.0;
  for (int index = probe.begin; index < probe.end; ++index) {
    Need& at = need(number, index);
    const double left_m = blade_.stroke_max_m() - stroke_m;
    stroke_m = index == probe.begin
                   ? std::min(at.lift_m, blade_.stroke_max_m())
                   : std::min(at.lift_m,
                              stroke_m + std::min(reach_of(index).lowered_m, towards_end * left_m));
    at.lift_m = edge_per_stroke_ * (at.stroke_m - stroke_m);
    most_m = std::max(most_m, at.lift_m);
    if (at.lift_m > kPreviewNoLift_m && index + 1 < probe.end) {
      continue;
    }
    for (; stretch <= index; ++stretch) {
      need(number, stretch).cost_m = most_m;
    }
    most_m = 0.0;
  }
}

void Preview::cost(int number, double flow_m3ps) {
  const double speed_mps = probe_mps(number);
  const double time_s = kPreviewStep_m / speed_mps;
  const auto reach = [&](double lift_m3ps) {
    return LiftReach{time_s * lift_m3ps / profile_.blade.rod_area_m2(),
                     time_s * lift_m3ps / profile_.blade.cap_area_m2()};
  };
  if (profile_.tilt.present) {
    cost(number, [&](int index) { return reach(lift_flow_m3ps(index, speed_mps, flow_m3ps)); });
  } else {
    const LiftReach whole = reach(flow_m3ps);
    cost(number, [&whole](int) { return whole; });
  }
}

double Preview::lift_flow_m3ps(int index, double speed_mps, double flow_m3ps) const {
  const double tilt_m3ps = speed_mps * tilt_m2_[slot(index)];
  return flow_m3ps - std::min(tilt_m3ps, kPreviewTiltShare * flow_m3ps);
}

double Preview::tilt_speed_mps(int index) const {
  return std::max(
      profile_.travel.speed_min_mps,
      kPreviewTiltShare * flow_m3ps_ / std::max(tilt_m2_[slot(index)], kPreviewNoOil_m2));
}

void Preview::look(const GroundMap& ground, const GradeProfile& design, double x_m,
                   const Stand& measured, double flow_m3ps, double track_max_mps) {
  curves_ = design.curves();
  track_max_mps_ = track_max_mps;
  follow(x_m, measured);
  for (int left = kStepsPerCycle; left > 0; --left) {
    int number = 0;
    while (number < kProbes && probe_[static_cast<unsigned>(number)].end > last()) {
      ++number;
    }
    if (number == kProbes) {
      break;
    }
    step(ground, design, number);
  }
  flow_m3ps_ = flow_m3ps;
  turn_ = (turn_ + 1) % kProbes;
  cost(turn_, flow_m3ps);
}

/// From the slowest probe on that has been there, up to where it costs too much.
double Preview::lift_limit_of(int index, double allowed_m) const {
  const double least_mps = profile_.travel.speed_min_mps;
  double kept_mps = 0.0;
  double kept_m = 0.0;
  for (int number = kProbes - 1; number >= 0; --number) {
    const Probe& probe = probe_[static_cast<unsigned>(number)];
    if (index < probe.begin || index >= probe.end) {
      continue;
    }
    const double cost_m = need(number, index).cost_m;
    const double speed_mps = probe_mps(number);
    if (cost_m > allowed_m) {
      const double share = (allowed_m - kept_m) / (cost_m - kept_m);
      return std::max(least_mps, kept_mps + share * (speed_mps - kept_mps));
    }
    kept_mps = number > 0 ? speed_mps : kAnySpeed_mps;
    kept_m = cost_m;
  }
  return std::max(least_mps, index <= first_ + kBehind ? kAnySpeed_mps : kept_mps);
}

double Preview::curve_speed_mps(int index) const {
  return std::max(profile_.travel.speed_min_mps,
                  track_max_mps_ / (1.0 + static_cast<double>(outer_[slot(index)])));
}

double Preview::limit_of(int index, double allowed_m) const {
  const double lift_mps = lift_limit_of(index, allowed_m);
  const double tilted_mps =
      profile_.tilt.present ? std::min(lift_mps, tilt_speed_mps(index)) : lift_mps;
  return curves_ ? std::min(tilted_mps, curve_speed_mps(index)) : tilted_mps;
}

AheadLimit Preview::limit(double x_m, double speed_mps, double allowed_m, double lead_s) const {
  if (!std::isfinite(x_m) || !std::isfinite(speed_mps)) {
    return {profile_.travel.speed_min_mps, profile_.travel.speed_min_mps};
  }
  // Between two stations the limit goes over from one to the other: what is passed must not let go
  // at once.
  const double share = std::clamp(x_m / kPreviewStep_m - kBehind - first_, 0.0, 1.0);
  const double passed_mps = limit_of(first_, allowed_m);
  const double left_mps = passed_mps + share * (limit_of(first_ + 1, allowed_m) - passed_mps);
  AheadLimit ahead{kAnySpeed_mps, left_mps};
  double square = left_mps * left_mps;
  const double braked_from_m = x_m + std::max(0.0, speed_mps) * lead_s;
  const double held_to_m = x_m + std::max(0.0, speed_mps) * kPreviewHold_s;
  for (int index = first_ + 1; index < last(); ++index) {
    const double limit_mps = limit_of(index, allowed_m);
    const double way_m = std::max(0.0, index * kPreviewStep_m - braked_from_m);
    square = std::min(square,
                      limit_mps * limit_mps + 2.0 * profile_.travel.deceleration_max_mps2 * way_m);
    if (index * kPreviewStep_m <= held_to_m) {
      ahead.lowest_mps = std::min(ahead.lowest_mps, limit_mps);
    }
  }
  ahead.speed_mps = std::sqrt(square);
  return ahead;
}

/// Of the two probes that the speed is between. Where the limit is lower, so will the machine be by
/// then.
double Preview::lift_of(int index, double speed_mps, double allowed_m) const {
  const double held_mps = std::min(std::max(0.0, speed_mps), limit_of(index, allowed_m));
  double faster_m = 0.0;
  double faster_mps = 0.0;
  for (int number = 0; number < kProbes; ++number) {
    const Probe& probe = probe_[static_cast<unsigned>(number)];
    if (index < probe.begin || index >= probe.end) {
      continue;
    }
    const double lift_m = need(number, index).lift_m;
    const double probe_speed_mps = probe_mps(number);
    if (probe_speed_mps <= held_mps) {
      const double share =
          faster_mps > 0.0 ? (held_mps - probe_speed_mps) / (faster_mps - probe_speed_mps) : 0.0;
      return lift_m + share * (faster_m - lift_m);
    }
    faster_m = lift_m;
    faster_mps = probe_speed_mps;
  }
  return faster_mps > 0.0 ? faster_m * held_mps / faster_mps : 0.0;
}

BladeLift Preview::lift(double x_m, double speed_mps, double allowed_m) const {
  if (!std::isfinite(x_m) || !std::isfinite(speed_mps)) {
    return {};
  }
  const int before = station_of(x_m);
  if (before < first_ || before + 1 > last()) {
    return {};
  }
  const double here_m = lift_of(before, speed_mps, allowed_m);
  const double rise = (lift_of(before + 1, speed_mps, allowed_m) - here_m) / kPreviewStep_m;
  return {here_m + rise * (x_m - before * kPreviewStep_m), rise};
}

double Preview::least_cost_m(double x_m) const {
  const int index = station_of(x_m);
  double least_m = 0.0;
  bool known = false;
  for (int number = 0; number < kProbes; ++number) {
    const Probe& probe = probe_[static_cast<unsigned>(number)];
    if (index >= probe.begin && index < probe.end) {
      const double cost_m = need(number, index).cost_m;
      least_m = known ? std::min(least_m, cost_m) : cost_m;
      known = true;
    }
  }
  return least_m;
}

GradeKept grade_kept(const DozerProfile& profile, double from_m, double to_m) {
  /// Looks at each station. [-; size: as often the slowest probe keeps ahead]
  constexpr int kLooks = 3 * Preview::kProbes;
  /// Stations of a design, at most. [-; size: 5 km at kPreviewStep_m]
  constexpr int kMostSteps = 100'000;
  const BladeKinematics blade(profile.blade);
  const GradeProfile design(profile.grade);
  const double start_m = design.at(from_m).height_m;
  const double flow_m3ps =
      profile.travel.flow_share * available_flow_m3ps(profile.implement, profile.hst.engine_radps);
  GroundMap ground;
  ground.pass(from_m, start_m, design, from_m, start_m, 0.0);
  Preview preview(profile, blade);
  const double begin_m = from_m - blade.edge_m(0.0).x();
  const int steps = std::clamp(static_cast<int>((to_m - begin_m) / kPreviewStep_m), 0, kMostSteps);
  for (int step = 0; step <= steps; ++step) {
    const double x_m = begin_m + step * kPreviewStep_m;
    for (int n = 0; n < kLooks; ++n) {
      preview.look(ground, design, x_m, {start_m, 0.0}, flow_m3ps);
    }
    const double cost_m = preview.least_cost_m(x_m);
    if (cost_m > profile.grade.tolerance_m) {
      return {false, x_m, cost_m};
    }
  }
  return {};
}

}  // namespace graben
