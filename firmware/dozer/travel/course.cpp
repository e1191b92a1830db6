// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/course.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/travel/tracks.hpp"
#include "firmware/dozer/travel/tuning.hpp"

namespace graben {
namespace {

/// Pieces of the track from origin to edge. [-; size: steps over which its curvature is summed up]
constexpr int kPieces = 8;

/// Curvature that brings the edge back to the track: it moves across it by the heading and by what
/// the body turns.
double forward_pm(const EdgeCourse& edge, double reach_m) {
  const double across = -edge.offset_m / kComeBack_m - std::sin(edge.heading_rad);
  return across / (reach_m * std::max(std::cos(edge.heading_rad), 0.5));
}

double backward_pm(double curvature_pm, const Course& course, double reach_m) {
  const double inside_m = 0.5 * curvature_pm * reach_m * reach_m;
  return curvature_pm - (course.offset_m - inside_m) / (kCourseBackward_m * kCourseBackward_m) +
         2.0 * course.heading_rad / kCourseBackward_m;
}

}  // namespace

Course course_after(const GradeProfile& design, const Course& course, double x_m, double speed_mps,
                    double lead_s) {
  const double turns_radps = course.yaw_rate_radps - design.curvature_at(x_m) * speed_mps;
  return {course.offset_m + std::sin(course.heading_rad) * speed_mps * lead_s,
          course.heading_rad + turns_radps * lead_s, course.yaw_rate_radps};
}

EdgeCourse edge_course(const GradeProfile& design, double x_m, const Course& course,
                       double reach_m) {
  const double step_m = reach_m / kPieces;
  double turned_rad = 0.0;
  double along_m = 0.0;
  double across_m = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    const double turn_rad = design.curvature_at(x_m + (i + 0.5) * step_m) * step_m;
    along_m += step_m * std::cos(turned_rad + 0.5 * turn_rad);
    across_m += step_m * std::sin(turned_rad + 0.5 * turn_rad);
    turned_rad += turn_rad;
  }
  // From the track's point there to the edge, and that in the track's direction.
  const double off_along_m = reach_m * std::cos(course.heading_rad) - along_m;
  const double off_across_m = course.offset_m + reach_m * std::sin(course.heading_rad) - across_m;
  const double c = std::cos(turned_rad);
  const double s = std::sin(turned_rad);
  EdgeCourse edge;
  edge.offset_m = c * off_across_m - s * off_along_m;
  const double wider = std::max(0.5, 1.0 - design.curvature_at(x_m + reach_m) * edge.offset_m);
  edge.ahead_m = reach_m + (c * off_along_m + s * off_across_m) / wider;
  edge.heading_rad = course.heading_rad - turned_rad;
  return edge;
}

SteeringState steer(const GradeProfile& design, const SteeringState& last,
                    const SteeringSituation& now, double period_s) {
  SteeringState state = last;
  if (now.learns && std::abs(now.measured_mps) > kCourseTrimLeast_mps) {
    const double lost_radps = last.wanted_radps - now.course.yaw_rate_radps;
    const double share = period_s / (kCourseTrim_s * now.measured_mps);
    state.trim_pm =
        std::clamp(last.trim_pm + share * lost_radps, -kCourseTrimMost_pm, kCourseTrimMost_pm);
  }
  const double wanted_pm =
      now.speed_mps >= 0.0
          ? forward_pm(edge_course(design, now.x_m, now.course, now.reach_m), now.reach_m)
          : backward_pm(design.curvature_at(now.x_m), now.course, now.reach_m);
  const double bounded_pm = std::clamp(wanted_pm, -kTightest_pm, kTightest_pm);
  state.wanted_radps = bounded_pm * now.speed_mps;
  state.curvature_pm = std::clamp(bounded_pm + state.trim_pm, -kTightest_pm, kTightest_pm);
  return state;
}

std::array<double, kTrackCount> steered_mps(const DozerBody& body, double speed_mps,
                                            const std::array<double, kTrackCount>& measured_mps,
                                            double period_s, SteeringState& state) {
  std::array<double, kTrackCount> wanted_mps =
      track_speeds_mps(body, speed_mps, state.curvature_pm * speed_mps);
  const unsigned outer =
      std::abs(wanted_mps[kLeft]) > std::abs(wanted_mps[kRight]) ? kLeft : kRight;
  const double way = speed_mps < 0.0 ? -1.0 : 1.0;
  const double lacks_mps = way * (wanted_mps[outer] - measured_mps[outer]);
  state.short_mps += (lacks_mps - state.short_mps) * period_s / (kCourseShort_s + period_s);
  if (wanted_mps[kLeft] != wanted_mps[kRight]) {
    wanted_mps[outer == kLeft ? kRight : kLeft] -=
        way * std::max(0.0, state.short_mps - kCourseNotShort_mps);
  }
  return wanted_mps;
}

}  // namespace graben
