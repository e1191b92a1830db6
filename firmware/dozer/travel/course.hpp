// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The machine on a track that curves in plan: where its cutting edge is against the track, and how
/// it steers. Left is positive, and x the station along the track.

#include <array>

#include "firmware/dozer/grade_profile.hpp"
#include "firmware/dozer/travel/tuning.hpp"

namespace graben {

/// Of the body's origin against the track beside it.
struct Course {
  double offset_m = 0.0;
  double heading_rad = 0.0;
  double yaw_rate_radps = 0.0;
};

/// The same `lead_s` on, driving so fast.
[[nodiscard]] Course course_after(const GradeProfile& design, const Course& course, double x_m,
                                  double speed_mps, double lead_s);

/// Middle of the cutting edge.
struct EdgeCourse {
  double ahead_m = 0.0;      ///< Its station over the origin's.
  double offset_m = 0.0;     ///< Of the track beside it.
  double heading_rad = 0.0;  ///< The body's against the track there.
};

/// With the edge `reach_m` ahead of an origin at station `x_m`: the track's way up to there, summed
/// up over its curvature.
[[nodiscard]] EdgeCourse edge_course(const GradeProfile& design, double x_m, const Course& course,
                                     double reach_m);

/// State from cycle to cycle.
struct SteeringState {
  double trim_pm = 0.0;       ///< Curvature that the tracks lose by slipping.
  double wanted_radps = 0.0;  ///< Of the last cycle.
  double curvature_pm = 0.0;  ///< Asked of the tracks.
  double short_mps = 0.0;     ///< By which the outer track lags behind what it is to run.
};

/// Where the machine is.
struct SteeringSituation {
  double x_m = 0.0;
  double reach_m = 0.0;
  double speed_mps = 0.0;  ///< That it is to have; backward is negative.
  double measured_mps = 0.0;
  Course course;
  bool learns = true;  ///< What the tracks slip of a turn.
};

/// Forward the edge is what steers: it comes back to the track within kComeBack_m of way, and the
/// body follows as a trailer does, its origin inside of the curve. Backward that would swing out,
/// so the origin is led to where it was, by its offset and heading. What the tracks slip of the
/// turn, by the measured rate, is added. Never tighter than kTightest_pm.
[[nodiscard]] SteeringState steer(const GradeProfile& design, const SteeringState& last,
                                  const SteeringSituation& now, double period_s);

/// Speeds of both tracks for it, from what each ran with before. Where the outer one can't run as
/// fast as it is to, the inner one waits for it, or the machine would go straight on.
[[nodiscard]] std::array<double, kTrackCount> steered_mps(
    const DozerBody& body, double speed_mps, const std::array<double, kTrackCount>& measured_mps,
    double period_s, SteeringState& state);

}  // namespace graben
