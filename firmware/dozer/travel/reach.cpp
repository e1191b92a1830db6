#include "firmware/dozer/travel/reach.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/mobile_jacobian.hpp"
#include "firmware/dozer/travel/support.hpp"

namespace graben {
namespace {

constexpr double kStep_m = 0.2;
constexpr int kMostSteps = 100'000;
constexpr int kReachSteps = 6;
constexpr double kMostAngle_rad = 1.0;
constexpr double kTolerance_m = 0.008;

/// theta_1 with the edge on the design, whether the cylinders allow it or not.
double angle_on(const BladeKinematics& blade, const GradeProfile& design, const BodyPose& body) {
  double angle_rad = 0.0;
  for (int step = 0; step < kReachSteps; ++step) {
    const Eigen::Vector3d edge = edge_in_world_m(blade, body, angle_rad);
    const GradeSample wanted = design.at(edge.x());
    const Vector6d rate = blade_jacobian(blade, body, angle_rad);
    angle_rad += (wanted.height_m - edge.z()) / std::max(rate[2] - wanted.slope * rate[0], 0.1);
    angle_rad = std::clamp(angle_rad, -kMostAngle_rad, kMostAngle_rad);
  }
  return angle_rad;
}

}  // namespace

GradeReach grade_reach(const DozerProfile& profile, double from_m, double to_m) {
  const BladeKinematics blade(profile.blade);
  const GradeProfile design(profile.grade);
  const double start_m = design.at(from_m).height_m;
  GroundMap ground;
  ground.pass(from_m, start_m, design, from_m, start_m, 0.0);
  Stand stand{start_m, 0.0};
  const int steps = std::clamp(static_cast<int>((to_m - from_m) / kStep_m), 0, kMostSteps);
  for (int step = 0; step <= steps; ++step) {
    const double x_m = from_m + step * kStep_m;
    stand = stand_at(profile.body, ground, design, x_m, stand);
    const BodyPose body{{x_m, 0.0, stand.height_m}, rotation_from_pitch(stand.pitch_rad)};
    const double edge_m = blade.edge_m(angle_on(blade, design, body)).y();
    if (edge_m < profile.blade.edge_min_m - kTolerance_m ||
        edge_m > profile.blade.edge_max_m + kTolerance_m) {
      return {false, x_m, edge_m};
    }
  }
  return {};
}

}  // namespace graben
