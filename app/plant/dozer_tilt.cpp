// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_tilt.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

CylinderData cylinder_of(const DozerPlantProfile& profile, double stroke_m) {
  const TiltProfile& tilt = profile.machine.tilt;
  CylinderData data;
  data.area = piston_areas(tilt.cylinder_count, tilt.bore_m, tilt.rod_m);
  data.stroke_m = stroke_m;
  data.dead_volume_m3 = profile.tilt.dead_volume_m3;
  data.bulk_modulus_pa = profile.bulk_modulus_pa;
  data.friction = {profile.tilt.coulomb_n, profile.tilt.viscous_nspm};
  data.details = profile.details();
  return data;
}

}  // namespace

TiltLinkage::TiltLinkage(const TiltProfile& tilt)
    : base_(tilt.base_m), eye_(tilt.eye_m), most_(tilt.angle_most_rad) {
  const double at_right = length_m(-most_);
  const double at_left = length_m(most_);
  shortest_ = std::min(at_right, at_left);
  full_stroke_ = std::max(at_right, at_left) - shortest_;
}

Eigen::Vector2d TiltLinkage::eye_m(double angle_rad) const {
  const double cosine = std::cos(angle_rad);
  const double sine = std::sin(angle_rad);
  return {cosine * eye_.x() - sine * eye_.y(), sine * eye_.x() + cosine * eye_.y()};
}

double TiltLinkage::length_per_angle_m(double angle_rad) const {
  const Eigen::Vector2d eye = eye_m(angle_rad);
  const Eigen::Vector2d along = (eye - base_).normalized();
  return along.y() * eye.x() - along.x() * eye.y();
}

TiltDrive::TiltDrive(const DozerPlantProfile& profile, double step_s)
    : linkage_(profile.machine.tilt),
      step_(step_s),
      inertia_(profile.tilt.inertia_kgm2),
      weight_nm_(profile.blade_mass_kg * profile.gravity_mps2 * 0.5 * profile.blade_shape.height_m),
      pilot_(profile.valve(1).dead_time, profile.valve(1).pilot_lag_s, step_s),
      section_(profile, tilt_section(profile)),
      cylinder_(cylinder_of(profile, linkage_.full_stroke_m()), step_s) {
  cylinder_.start(linkage_.stroke_m(angle_), 0.0);
}

double TiltDrive::weight_moment_nm(double roll_rad) const {
  return weight_nm_ * std::sin(angle_ + roll_rad);
}

double TiltDrive::accelerate(double moment_nm) {
  // As BladeJoint: the damping on the mean of old and new.
  const double lever = linkage_.length_per_angle_m(angle_);
  const PistonLoad load = cylinder_.load();
  const double damping = lever * lever * load.damping_nspm;
  const double mobility = step_ / (inertia_ + 0.5 * step_ * damping);
  const double before = rate_;
  const double free = before + mobility * (moment_nm + lever * load.force_n - damping * before);
  const double friction = mobility * std::abs(lever) * load.coulomb_n;
  rate_ = free - std::clamp(free, -friction, friction);
  return 0.5 * lever * (before + rate_);
}

void TiltDrive::step(double available_m3ps, double roll_rad, bool pilot_cut, double moment_nm) {
  section_.set_command(pilot_.step(duty_, pilot_cut));
  const ImplementFlows& flows =
      section_.solve(available_m3ps, cylinder_.cap_port(), cylinder_.rod_port());
  const double velocity = accelerate(weight_moment_nm(roll_rad) + moment_nm);
  angle_ += step_ * rate_;
  cylinder_.step(flows.cap_in, flows.rod_in, velocity);
  cylinder_.set_motion(stroke_m(), velocity_mps());
  section_.step(step_);
}

}  // namespace graben::plant
