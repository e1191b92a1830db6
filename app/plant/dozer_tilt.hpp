// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's blade tilted about its own longitudinal axis, through the middle of its edge.

#include <Eigen/Core>

#include "app/plant/cylinder.hpp"
#include "app/plant/dozer_implement.hpp"
#include "app/plant/dozer_plant_profile.hpp"

namespace graben::plant {

/// Cylinder between a pin on the push frame and one on the blade. Left end up is positive.
class TiltLinkage {
 public:
  explicit TiltLinkage(const TiltProfile& tilt);

  [[nodiscard]] double length_m(double angle_rad) const { return arm_m(angle_rad).norm(); }
  [[nodiscard]] double length_per_angle_m(double angle_rad) const;
  /// From the end of the range where the cylinder is shortest.
  [[nodiscard]] double stroke_m(double angle_rad) const { return length_m(angle_rad) - shortest_; }
  [[nodiscard]] double full_stroke_m() const { return full_stroke_; }
  [[nodiscard]] double most_rad() const { return most_; }

 private:
  [[nodiscard]] Eigen::Vector2d eye_m(double angle_rad) const;
  /// Base to eye.
  [[nodiscard]] Eigen::Vector2d arm_m(double angle_rad) const { return eye_m(angle_rad) - base_; }

  Eigen::Vector2d base_;
  Eigen::Vector2d eye_;
  double most_;
  double shortest_ = 0.0;
  double full_stroke_ = 0.0;
};

/// The blade on that axis, its mass centre half its height above it, with its own section of the
/// implement valve.
class TiltDrive {
 public:
  TiltDrive(const DozerPlantProfile& profile, double step_s);

  void set_duty(double duty_ratio) { duty_ = duty_ratio; }
  /// As DozerPlant::set_pilot_fault.
  void set_pilot_fault(std::optional<double> held_ratio) { pilot_.set_fault(held_ratio, 0.0); }

  /// What its spool asks of the pump, m^3/s.
  [[nodiscard]] double demand_m3ps() const { return section_.demand_m3ps(); }
  /// A step on with what the pump has for it, the body rolled so far. `moment_nm` is what acts on
  /// the blade beside its weight; raising its left end is positive.
  void step(double available_m3ps, double roll_rad, bool pilot_cut, double moment_nm = 0.0);

  [[nodiscard]] double angle_rad() const { return angle_; }
  [[nodiscard]] double stroke_m() const { return linkage_.stroke_m(angle_); }
  [[nodiscard]] double velocity_mps() const { return linkage_.length_per_angle_m(angle_) * rate_; }
  [[nodiscard]] double spool_travel_ratio() const { return section_.spool().travel_ratio(); }
  [[nodiscard]] const ImplementFlows& flows() const { return section_.flows(); }
  [[nodiscard]] const TiltLinkage& linkage() const { return linkage_; }

 private:
  [[nodiscard]] double weight_moment_nm(double roll_rad) const;
  /// Returns the cylinder's mean velocity over the step.
  double accelerate(double moment_nm);

  TiltLinkage linkage_;
  double step_;
  double inertia_;
  double weight_nm_;  ///< Of the mass centre lying level beside the axis.
  double duty_ = 0.0;
  PilotValve pilot_;
  ImplementCircuit section_;
  Cylinder cylinder_;
  double angle_ = 0.0;
  double rate_ = 0.0;
};

}  // namespace graben::plant
