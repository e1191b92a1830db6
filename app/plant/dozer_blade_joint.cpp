// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_blade_joint.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {

BladeLinkage::BladeLinkage(const BladeGeometry& blade)
    : pivot_(blade.pivot_m), edge_reach_(blade.cutting_edge_m) {
  const Eigen::Vector2d to_base = blade.base_m - blade.pivot_m;
  arm_home_ = std::atan2(blade.arm_m.y(), blade.arm_m.x());
  base_angle_ = std::atan2(to_base.y(), to_base.x());
  l11_ = to_base.norm();
  // The home length is the triangle's third side: a quadratic in L12, of which the one further out.
  const double along = l11_ * std::cos(base_angle_ - arm_home_);
  const double across = l11_ * std::sin(base_angle_ - arm_home_);
  l12_ = along + std::sqrt(blade.length_home_m * blade.length_home_m - across * across);
  edge_home_ = -std::asin(pivot_.y() / edge_reach_);
  const auto angle_at = [this](double edge_m) {
    return std::asin((edge_m - pivot_.y()) / edge_reach_) - edge_home_;
  };
  lowest_ = angle_at(blade.edge_min_m);
  highest_ = angle_at(blade.edge_max_m);
  shortest_ = length_m(highest_);
}

double BladeLinkage::length_m(double angle_rad) const {
  const double between = base_angle_ - arm_angle_rad(angle_rad);
  return std::sqrt(l11_ * l11_ + l12_ * l12_ - 2.0 * l11_ * l12_ * std::cos(between));
}

double BladeLinkage::length_per_angle_m(double angle_rad) const {
  const double between = base_angle_ - arm_angle_rad(angle_rad);
  return -l11_ * l12_ * std::sin(between) / length_m(angle_rad);
}

Eigen::Vector2d BladeLinkage::edge_m(double angle_rad) const {
  const double angle = edge_home_ + angle_rad;
  return pivot_ + edge_reach_ * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

BladeJoint::BladeJoint(const DozerPlantProfile& profile)
    : linkage_(profile.machine.blade),
      weight_moment_(profile.blade_mass_kg * profile.gravity_mps2 * profile.blade_reach_m),
      inertia_(profile.blade_mass_kg * profile.blade_reach_m * profile.blade_reach_m),
      lever_(linkage_.length_per_angle_m(0.0)) {}

double BladeJoint::gravity_moment_nm(double body_pitch_rad) const {
  return -weight_moment_ * std::cos(linkage_.arm_angle_rad(angle_) + body_pitch_rad);
}

double BladeJoint::holding_force_n(double body_pitch_rad) const {
  return -gravity_moment_nm(body_pitch_rad) / lever_;
}

double BladeJoint::accelerate(const PistonLoad& load, double body_pitch_rad, double step_s,
                              double moment_nm) {
  // J dw = h (M + G f - G^2 d w), with the damping on the mean of old and new.
  const double damping = lever_ * lever_ * load.damping_nspm;
  const double mobility = step_s / (inertia_ + 0.5 * step_s * damping);
  const double before = rate_;
  const double free = before + mobility * (gravity_moment_nm(body_pitch_rad) + moment_nm +
                                           lever_ * load.force_n - damping * before);
  const double friction = mobility * std::abs(lever_) * load.coulomb_n;
  rate_ = free - std::clamp(free, -friction, friction);
  return 0.5 * lever_ * (before + rate_);
}

void BladeJoint::move(double step_s) {
  angle_ += step_s * rate_;
  lever_ = linkage_.length_per_angle_m(angle_);
}

}  // namespace graben::plant
