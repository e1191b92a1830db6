// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Place of a dozer's cutting edge, and the blade velocity that the design needs there, by the
/// simulation's own geometry: the controller is measured against it and takes no part in it.

#include <Eigen/Core>
#include <optional>

#include "app/plant/dozer_blade_joint.hpp"
#include "app/plant/dozer_plan.hpp"
#include "app/plant/dozer_plant.hpp"
#include "app/plant/dozer_tilt.hpp"
#include "firmware/dozer/grade_profile.hpp"

namespace graben::runs {

/// Of the body frame's origin, in the world; pitch is positive nose up.
struct BodyPose {
  double position_m = 0.0;
  double height_m = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;  ///< Left side up; of a blade that tilts, as all that follows of roll.
  double offset_m = 0.0;  ///< Left of a track that curves, along which `position_m` is the station.
  double heading_rad = 0.0;  ///< Against the track beside it.
};

struct BodyRates {
  double velocity_mps = 0.0;
  double climb_mps = 0.0;
  double pitch_rate_radps = 0.0;
  double roll_rate_radps = 0.0;
};

/// Of the blade against the body.
struct BladeAngles {
  double lift_rad = 0.0;
  double tilt_rad = 0.0;
};

class GradeTruth {
 public:
  explicit GradeTruth(const DozerProfile& profile);

  /// Angle of the blade at this stroke; a stroke out of reach counts as its end.
  [[nodiscard]] double blade_angle_rad(double stroke_m) const;
  /// Cutting edge in the world, x and z.
  [[nodiscard]] Eigen::Vector2d edge_m(const BodyPose& body, double blade_angle_rad) const;
  /// Angle of the tilt at this stroke; 0 without one.
  [[nodiscard]] double tilt_angle_rad(double stroke_m) const;
  /// A point of the edge, so far to the left along it from its middle; x, y, z: of a track that
  /// curves, station, offset to the left of it, height.
  [[nodiscard]] Eigen::Vector3d edge_point_m(const BodyPose& body, const BladeAngles& blade,
                                             double along_edge_m) const;
  /// The error, below, of the edge's end that is farther off; of its middle without a tilt.
  [[nodiscard]] double worst_error_m(const BodyPose& body, const BladeAngles& blade) const;
  [[nodiscard]] double design_m(double x_m) const { return design_.at(x_m).height_m; }
  /// Height over the design, straight up.
  [[nodiscard]] double error_m(const Eigen::Vector2d& edge_m) const {
    return edge_m.y() - design_m(edge_m.x());
  }
  /// The same of a point beside the middle: x, y, z.
  [[nodiscard]] double point_error_m(const Eigen::Vector3d& at_m) const {
    return at_m.z() - design_m(at_m.x()) - design_.cross_at(at_m.x()).slope * at_m.y();
  }
  /// Velocity of the tilt cylinder at which the edge would keep its slope over the design's, as the
  /// next; 0 without a tilt.
  [[nodiscard]] double required_tilt_mps(const BodyPose& body, const BodyRates& rates,
                                         const BladeAngles& blade) const;
  /// Velocity of the blade cylinders at which the edge, where it is, would keep its height over the
  /// design while the body moves so; extension is positive. By central differences over kStep_s of
  /// the body's motion and kStep_rad of the blade: no Jacobian that the controller has too.
  [[nodiscard]] double required_blade_mps(const BodyPose& body, const BodyRates& rates,
                                          double blade_angle_rad) const;
  /// (7) at this velocity, m^3/s.
  [[nodiscard]] double inflow_m3ps(double blade_mps) const;
  [[nodiscard]] double tilt_inflow_m3ps(double tilt_mps) const;

 private:
  static constexpr double kStep_s = 1e-4;
  static constexpr double kStep_rad = 1e-5;

  /// One end's error over the other's.
  [[nodiscard]] double across_error_m(const BodyPose& body, const BladeAngles& blade) const;

  plant::BladeLinkage linkage_;
  TiltProfile tilt_;
  plant::TiltLinkage tilt_linkage_;
  std::optional<plant::PlanTrack> track_;  ///< That curves.
  GradeProfile design_;
  double cap_area_m2_;
  double rod_area_m2_;
};

[[nodiscard]] BodyPose true_pose(const plant::DozerPlant& plant);

/// min of (11): what the implement pump of this machine gives at this speed, and the valve's most.
[[nodiscard]] double available_flow_m3ps(const DozerProfile& machine, double engine_radps);

}  // namespace graben::runs
