// SPDX-License-Identifier: Apache-2.0
#include "app/runs/grade_truth.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::runs {

GradeTruth::GradeTruth(const DozerProfile& profile)
    : linkage_(profile.blade),
      design_(profile.grade),
      cap_area_m2_(profile.blade.cap_area_m2()),
      rod_area_m2_(profile.blade.rod_area_m2()) {}

double GradeTruth::blade_angle_rad(double stroke_m) const {
  constexpr int kHalvings = 50;  // To the last bit, nearly.
  double low_rad = linkage_.lowest_rad();
  double high_rad = linkage_.highest_rad();
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_rad = 0.5 * (low_rad + high_rad);
    // The stroke is longest with the blade down.
    (linkage_.stroke_m(middle_rad) > stroke_m ? low_rad : high_rad) = middle_rad;
  }
  return 0.5 * (low_rad + high_rad);
}

Eigen::Vector2d GradeTruth::edge_m(const BodyPose& body, double blade_angle_rad) const {
  const Eigen::Vector2d edge = linkage_.edge_m(blade_angle_rad);
  const double cosine = std::cos(body.pitch_rad);
  const double sine = std::sin(body.pitch_rad);
  return {body.position_m + edge.x() * cosine - edge.y() * sine,
          body.height_m + edge.x() * sine + edge.y() * cosine};
}

double GradeTruth::required_blade_mps(const BodyPose& body, const BodyRates& rates,
                                      double blade_angle_rad) const {
  const auto error_at = [&](double time_s, double angle_rad) {
    const BodyPose moved = {body.position_m + rates.velocity_mps * time_s,
                            body.height_m + rates.climb_mps * time_s,
                            body.pitch_rad + rates.pitch_rate_radps * time_s};
    return error_m(edge_m(moved, angle_rad));
  };
  const double rise_mps =
      (error_at(kStep_s, blade_angle_rad) - error_at(-kStep_s, blade_angle_rad)) / (2.0 * kStep_s);
  const double up_rad = blade_angle_rad + kStep_rad;
  const double down_rad = blade_angle_rad - kStep_rad;
  const double rise_per_stroke = (error_at(0.0, up_rad) - error_at(0.0, down_rad)) /
                                 (linkage_.stroke_m(up_rad) - linkage_.stroke_m(down_rad));
  return -rise_mps / rise_per_stroke;
}

double GradeTruth::inflow_m3ps(double blade_mps) const {
  return blade_mps > 0.0 ? cap_area_m2_ * blade_mps : -rod_area_m2_ * blade_mps;
}

double available_flow_m3ps(const DozerProfile& machine, double engine_radps) {
  const ImplementProfile& implement = machine.implement;
  return std::min(engine_radps / kTwoPi * implement.displacement_m3prev * implement.efficiency,
                  implement.valve_flow_max_m3ps);
}

}  // namespace graben::runs
