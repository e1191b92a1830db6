// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated dozer in plan, on a design whose track curves.

#include <Eigen/Core>
#include <vector>

#include "app/plant/dozer_plant_profile.hpp"

namespace graben::plant {

/// A place beside the track; left is positive.
struct PlanPlace {
  double station_m = 0.0;
  double offset_m = 0.0;
};

/// The track as a line in the plane: its curvature summed up, straight beyond both ends.
class PlanTrack {
 public:
  explicit PlanTrack(const GradeHeights& heights);

  [[nodiscard]] double curvature_pm(double station_m) const;
  [[nodiscard]] double direction_rad(double station_m) const;
  [[nodiscard]] Eigen::Vector2d at_m(const PlanPlace& place) const;
  /// Foot on the track, from a guess of its station that is some metres off at most.
  [[nodiscard]] PlanPlace place_of(const Eigen::Vector2d& at_m, double guess_m) const;

 private:
  struct Node {
    Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
    double direction_rad = 0.0;
    double curvature_pm = 0.0;
  };
  /// The one before, and how far it is back.
  [[nodiscard]] const Node& before(double station_m, double& back_m) const;

  double from_m_;
  std::vector<Node> node_;
};

/// The body turns about the vertical as its tracks push. What holds it back is the ground that they
/// shear aside: at most mu W l / 4 (Wong), growing with what a place of the contact is dragged
/// across on its way from end to end, kappa l^2 / 8, over the shear modulus. It does not slide
/// sideways. Its inertia counts as much as in pitch.
class PlanMotion {
 public:
  explicit PlanMotion(const DozerPlantProfile& profile);

  /// A step on: what the right track pushes with more than the left one, what turns the body to the
  /// left beside that, its load and speed.
  void step(double more_right_n, double moment_nm, double load_n, double speed_mps,
            double station_m, double step_s);

  [[nodiscard]] double offset_m() const { return offset_m_; }
  [[nodiscard]] double heading_rad() const { return heading_rad_; }
  [[nodiscard]] double yaw_rate_radps() const { return yaw_rate_radps_; }
  /// Way along the track over the body's.
  [[nodiscard]] double station_share(double station_m) const;
  /// Of a point so far ahead of the body's origin and to its left.
  [[nodiscard]] PlanPlace place_of(double station_m, double ahead_m, double left_m) const;
  [[nodiscard]] const PlanTrack& track() const { return track_; }

 private:
  [[nodiscard]] double turning_nm(double load_n, double speed_mps) const;

  PlanTrack track_;
  double half_gauge_m_;
  double contact_m_;
  double friction_;
  double modulus_m_;
  double inertia_kgm2_;
  double offset_m_ = 0.0;
  double heading_rad_ = 0.0;
  double yaw_rate_radps_ = 0.0;
};

}  // namespace graben::plant
