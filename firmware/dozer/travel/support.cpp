// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/travel/support.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/dozer/mobile_jacobian.hpp"
#include "firmware/dozer/travel/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// What is missing to equilibrium, and how it changes with height and pitch.
struct Balance {
  double force_n = 0.0;
  double moment_nm = 0.0;
  double force_per_m = 0.0;
  double force_per_rad = 0.0;
  double moment_per_m = 0.0;
  double moment_per_rad = 0.0;
};

/// The wheels' springs on this stand. On level ground the origin is at the ground: each spring has
/// then given way by its share of the weight.
Balance balance_of(const DozerBody& body, const GroundMap& ground, const GradeProfile& design,
                   double x_m, const Stand& stand) {
  const double weight_n = body.mass_kg * kStandardGravity_mps2;
  const double sag_m = weight_n / (body.wheels * body.suspension_npm);
  const double c = std::cos(stand.pitch_rad);
  const double s = std::sin(stand.pitch_rad);
  const double spacing_m = body.track_contact_m / (body.wheels - 1);
  const double back_m = body.mass_centre_height_m * s;
  double along_m = -0.5 * body.track_contact_m;
  Balance balance;
  balance.force_n = -weight_n;
  for (int i = 0; i < body.wheels; ++i, along_m += spacing_m) {
    const double ahead_m = along_m * c;
    const double up_m = along_m * s;
    const double pressed_m =
        ground.height_m(x_m + ahead_m, design) + sag_m - (stand.height_m + up_m);
    if (pressed_m > 0.0) {
      // l cos - h sin of (15): about the mass centre, which the pitch takes back or forth.
      const double lever_m = ahead_m + back_m;
      const double force_n = body.suspension_npm * pressed_m;
      balance.force_n += force_n;
      balance.moment_nm += force_n * lever_m;
      balance.force_per_m -= body.suspension_npm;
      balance.force_per_rad -= body.suspension_npm * ahead_m;
      balance.moment_per_m -= body.suspension_npm * lever_m;
      balance.moment_per_rad -= body.suspension_npm * ahead_m * lever_m;
      balance.moment_per_rad += force_n * (body.mass_centre_height_m * c - up_m);
    }
  }
  return balance;
}

/// One bounded step of Newton's method.
Stand next_stand(const Balance& balance, const Stand& stand) {
  const double determinant =
      balance.force_per_m * balance.moment_per_rad - balance.force_per_rad * balance.moment_per_m;
  double up_m = -balance.force_n / std::min(balance.force_per_m, -1.0);
  double turn_rad = 0.0;
  if (determinant > 0.0) {
    up_m = -(balance.force_n * balance.moment_per_rad - balance.moment_nm * balance.force_per_rad) /
           determinant;
    turn_rad = -(balance.moment_nm * balance.force_per_m - balance.force_n * balance.moment_per_m) /
               determinant;
  } else if (balance.force_per_m < 0.0) {
    // No rest here: it tips to where the moment drives it.
    turn_rad = std::copysign(kStandMostStep_rad, balance.moment_nm);
  }
  return {
      stand.height_m + std::clamp(up_m, -kStandMostStep_m, kStandMostStep_m),
      std::clamp(stand.pitch_rad + std::clamp(turn_rad, -kStandMostStep_rad, kStandMostStep_rad),
                 -kModelMostPitch_rad, kModelMostPitch_rad)};
}

}  // namespace

StandStep step_to_rest(const DozerBody& body, const GroundMap& ground, const GradeProfile& design,
                       double x_m, const Stand& stand) {
  const Stand next = next_stand(balance_of(body, ground, design, x_m, stand), stand);
  return {next, std::abs(next.height_m - stand.height_m) < kStandAtRest_m &&
                    std::abs(next.pitch_rad - stand.pitch_rad) < kStandAtRest_rad};
}

Stand stand_at(const DozerBody& body, const GroundMap& ground, const GradeProfile& design,
               double x_m, const Stand& guess) {
  StandStep step{guess};
  for (int n = 0; n < kMostStandSteps && !step.at_rest; ++n) {
    step = step_to_rest(body, ground, design, x_m, step.stand);
  }
  return step.stand;
}

namespace {

/// Places of a design, at most. [-; size: 20 km at kGradeReachStep_m]
constexpr int kMostSteps = 100'000;
/// Steps to the edge on the design. [-; size: Newton's method ends by then, from the blade's home]
constexpr int kReachSteps = 6;

/// theta_1 with the edge on the design, whether the cylinders allow it or not.
double angle_on(const BladeKinematics& blade, const GradeProfile& design, const BodyPose& body) {
  double angle_rad = 0.0;
  for (int step = 0; step < kReachSteps; ++step) {
    const Eigen::Vector3d edge = edge_in_world_m(blade, body, angle_rad);
    const GradeSample wanted = design.at(edge.x());
    const Vector6d rate = blade_jacobian(blade, body, angle_rad);
    angle_rad += (wanted.height_m - edge.z()) / std::max(rate[2] - wanted.slope * rate[0], 0.1);
    angle_rad = std::clamp(angle_rad, -kGradeReachMostAngle_rad, kGradeReachMostAngle_rad);
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
  const int steps =
      std::clamp(static_cast<int>((to_m - from_m) / kGradeReachStep_m), 0, kMostSteps);
  for (int step = 0; step <= steps; ++step) {
    const double x_m = from_m + step * kGradeReachStep_m;
    stand = stand_at(profile.body, ground, design, x_m, stand);
    const BodyPose body{{x_m, 0.0, stand.height_m}, rotation_from_pitch(stand.pitch_rad)};
    const double edge_m = blade.edge_m(angle_on(blade, design, body)).y();
    if (edge_m < profile.blade.edge_min_m - kGradeReachTolerance_m ||
        edge_m > profile.blade.edge_max_m + kGradeReachTolerance_m) {
      return {false, x_m, edge_m};
    }
  }
  return {};
}

}  // namespace graben
