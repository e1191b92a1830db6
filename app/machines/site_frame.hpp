// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where a machine stands on its site: one benchmark that the teeth have touched, and a heading.
/// Site: x east, y north, z up, as a design's file has them. Machine: the ground frame of
/// firmware/excavator/kinematics/swing_kinematics.hpp. The machine stands level.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "firmware/excavator/fences/site_frame.hpp"

namespace graben::machines {

class TomlReader;

struct SiteFrame {
  Eigen::Vector3d benchmark_m = Eigen::Vector3d::Zero();  ///< A place of the site,
  Eigen::Vector3d touched_m = Eigen::Vector3d::Zero();    ///< which is here for the machine.
  /// Direction of the machine's x axis (swing 0) against the site's, to the left.
  double heading_rad = 0.0;

  [[nodiscard]] Eigen::Vector3d to_site(const Eigen::Vector3d& machine_m) const;
  [[nodiscard]] Eigen::Vector3d to_machine(const Eigen::Vector3d& site_m) const;
  /// Of a direction, from the site into the machine.
  [[nodiscard]] Eigen::Vector3d turned_to_machine(const Eigen::Vector3d& direction) const;
};

/// A point of the site, and the teeth's place for the machine as they stood on it.
struct TouchedPoint {
  Eigen::Vector3d site_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d machine_m = Eigen::Vector3d::Zero();
};

/// Two points of a heading lie at least so far apart, seen from above: at the bound's 30 mm the
/// heading is then off by 0.6 deg.
inline constexpr double kLeastApart_m = 3.0;
/// Touched points and points of the site may contradict each other by so much, unless told.
inline constexpr double kUsualBound_m = 0.03;

/// How well touched points fit.
struct SiteFit {
  SiteFrame frame;
  double most_off_m = 0.0;       ///< Of any point, from where the frame has it, in plan or height.
  double heading_off_rad = 0.0;  ///< That the bound makes of the heading.
};

/// The first point is the benchmark, where it is right by itself; the heading is that which fits
/// all of them best. Throws std::runtime_error: fewer than two, the second nowhere kLeastApart_m
/// from another, or one that lies more than `bound_m` from where the others have it; it says which.
[[nodiscard]] SiteFit fit_site(const std::vector<TouchedPoint>& points, double bound_m);

/// Section [site].
struct SiteSection {
  /// With points that are touched at run time: as if the machine stood on the benchmark and looked
  /// east.
  SiteFrame frame;
  SitePoints points;  ///< In the frame that the design is read into.

  /// Of the same site, given alike.
  [[nodiscard]] bool is_like(const SiteSection& other) const;
};

/// Section [site]: benchmark, touched and heading, or the points instead; with `second` the points
/// can be touched at run time, and without touched and heading they have to be. Errors are the
/// reader's.
[[nodiscard]] SiteSection read_site(TomlReader& reader);

/// The same as text of that section.
[[nodiscard]] std::string site_text(const SiteFrame& frame);

}  // namespace graben::machines
