// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Place of a dozer's cutting edge, and the blade velocity that the design needs there, by the
/// simulation's own geometry: the controller is measured against it and takes no part in it.

#include <Eigen/Core>

#include "app/plant/dozer_blade_joint.hpp"
#include "firmware/dozer/grade_profile.hpp"

namespace graben::runs {

/// Of the body frame's origin, in the world; pitch is positive nose up.
struct BodyPose {
  double position_m = 0.0;
  double height_m = 0.0;
  double pitch_rad = 0.0;
};

struct BodyRates {
  double velocity_mps = 0.0;
  double climb_mps = 0.0;
  double pitch_rate_radps = 0.0;
};

class GradeTruth {
 public:
  explicit GradeTruth(const DozerProfile& profile);

  /// Angle of the blade at this stroke; a stroke out of reach counts as its end.
  [[nodiscard]] double blade_angle_rad(double stroke_m) const;
  /// Cutting edge in the world, x and z.
  [[nodiscard]] Eigen::Vector2d edge_m(const BodyPose& body, double blade_angle_rad) const;
  [[nodiscard]] double design_m(double x_m) const { return design_.at(x_m).height_m; }
  /// Height over the design, straight up.
  [[nodiscard]] double error_m(const Eigen::Vector2d& edge_m) const {
    return edge_m.y() - design_m(edge_m.x());
  }
  /// Velocity of the blade cylinders at which the edge, where it is, would keep its height over the
  /// design while the body moves so; extension is positive. By central differences over kStep_s of
  /// the body's motion and kStep_rad of the blade: no Jacobian that the controller has too.
  [[nodiscard]] double required_blade_mps(const BodyPose& body, const BodyRates& rates,
                                          double blade_angle_rad) const;
  /// (7) at this velocity, m^3/s.
  [[nodiscard]] double inflow_m3ps(double blade_mps) const;

 private:
  static constexpr double kStep_s = 1e-4;
  static constexpr double kStep_rad = 1e-5;

  plant::BladeLinkage linkage_;
  GradeProfile design_;
  double cap_area_m2_;
  double rod_area_m2_;
};

/// min of (11): what the implement pump of this machine gives at this speed, and the valve's most.
[[nodiscard]] double available_flow_m3ps(const DozerProfile& machine, double engine_radps);

}  // namespace graben::runs
