// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Joint 1 of the dozer: blade cylinder, angle, cutting edge. Body frame as in dozer_signals.hpp.

#include <Eigen/Core>
#include <algorithm>

#include "firmware/dozer/dozer_profile.hpp"
#include "firmware/machine/drive_bank.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {

/// theta_1 is 0 at home and rises with the blade. The stroke counts from the blade fully raised, so
/// extension lowers it.
class BladeKinematics {
 public:
  explicit BladeKinematics(const BladeGeometry& geometry);

  /// Strokes and angles outside the blade's reach are taken for its end.
  [[nodiscard]] double angle_rad(double stroke_m) const;
  [[nodiscard]] double stroke_m(double angle_rad) const;
  /// dx_cyl / dtheta_1 of (6), m/rad; below 0. The paper's minus stands here: its q_cc, the angle
  /// between L11 and L12, falls as the blade rises.
  [[nodiscard]] double stroke_rate_mprad(double angle_rad) const;
  /// Cutting edge, x and z, and its derivative by theta_1.
  [[nodiscard]] Eigen::Vector2d edge_m(double angle_rad) const;
  [[nodiscard]] Eigen::Vector2d edge_rate_mprad(double angle_rad) const {
    return edge_rate_at_mprad(edge_m(angle_rad));
  }
  /// The same where the edge itself is known.
  [[nodiscard]] Eigen::Vector2d edge_rate_at_mprad(const Eigen::Vector2d& edge_m) const {
    return {pivot_m_.y() - edge_m.y(), edge_m.x() - pivot_m_.x()};
  }

  [[nodiscard]] double stroke_max_m() const { return stroke_max_m_; }
  [[nodiscard]] double angle_min_rad() const { return angle_min_rad_; }
  [[nodiscard]] double angle_max_rad() const { return angle_max_rad_; }
  /// L12: pivot to rod eye.
  [[nodiscard]] double eye_radius_m() const { return l12_m_; }

 private:
  [[nodiscard]] double length_m(double angle_rad) const;

  Eigen::Vector2d pivot_m_;
  double edge_radius_m_;
  double edge_home_rad_;  ///< Direction of the cutting edge from the pivot, at home.
  double l11_m_;
  double l12_m_;
  double enclosed_home_rad_;  ///< q_cc at home.
  double angle_min_rad_;
  double angle_max_rad_;
  double shortest_m_;
  double stroke_max_m_;
};

// The dozer's drives: the blade's lift, and where it has one its tilt. Their pressures are not
// measured; a spool's travel is the share of its valve's largest flow.

/// Drives of a blade, at most. [-; size: rows of DozerBank, for lift and tilt]
inline constexpr int kBladeCount = 2;
/// Row of the lift in DozerBank. [-; derived: the first of kBladeCount]
inline constexpr unsigned kBladeLift = 0;
/// Row of the tilt in DozerBank. [-; derived: the one after kBladeLift]
inline constexpr unsigned kBladeTilt = 1;
using DozerBank = DriveBank<kBladeCount>;
[[nodiscard]] DozerBank dozer_bank(const DozerProfile& profile);

/// What comes of a velocity while the pump can give no more.
[[nodiscard]] inline double fed_mps(const BladeGeometry& blade, double velocity_mps,
                                    double available_flow_m3ps) {
  return std::clamp(velocity_mps, -available_flow_m3ps / blade.rod_area_m2(),
                    available_flow_m3ps / blade.cap_area_m2());
}

/// Q_in of (7), m^3/s: what the cylinders take in at this velocity; extension is positive.
[[nodiscard]] inline double inflow_m3ps(const BladeGeometry& blade, double velocity_mps) {
  return velocity_mps >= 0.0 ? blade.cap_area_m2() * velocity_mps
                             : -blade.rod_area_m2() * velocity_mps;
}

/// The same of the tilt cylinder.
[[nodiscard]] inline double inflow_m3ps(const TiltProfile& tilt, double velocity_mps) {
  return velocity_mps >= 0.0 ? tilt.cap_area_m2() * velocity_mps
                             : -tilt.rod_area_m2() * velocity_mps;
}

/// Opening -1 .. 1 of the valve's full flow that gives this velocity while the pump can feed it.
[[nodiscard]] inline double opening_for(const DozerProfile& profile, double velocity_mps) {
  const double share =
      inflow_m3ps(profile.blade, velocity_mps) / profile.implement.valve_flow_max_m3ps;
  return std::clamp(velocity_mps < 0.0 ? -share : share, -1.0, 1.0);
}

/// The same of the tilt.
[[nodiscard]] inline double opening_for(const TiltProfile& tilt, double velocity_mps) {
  const double share = inflow_m3ps(tilt, velocity_mps) / tilt.valve_flow_max_m3ps;
  return std::clamp(velocity_mps < 0.0 ? -share : share, -1.0, 1.0);
}

/// min(Q_max,imp, Q_max,valve) of (11) with (12), m^3/s.
[[nodiscard]] inline double available_flow_m3ps(const ImplementProfile& implement,
                                                double engine_radps) {
  const double pump_m3ps =
      engine_radps / kTwoPi * implement.displacement_m3prev * implement.efficiency;
  return std::clamp(pump_m3ps, 0.0, implement.valve_flow_max_m3ps);
}

}  // namespace graben
