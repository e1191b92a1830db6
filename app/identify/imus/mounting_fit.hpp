// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How IMUs sit on their links, found by least squares: the bucket's edge was on one fixed point, a
/// peg, in several postures. Gravity in each IMU's axes gives its link's angle but for how it is
/// turned; the right turns are those with which the links' chain ends on the peg in every posture.
///
/// From one peg alone two differences of the three turns follow, and not the turn that all three
/// have in common: with it the whole picture, peg and all, is turned about the boom's foot. That
/// one wants a reference: how high the peg is, how much higher another one is, or an IMU that is
/// known to sit right. Frames as in excavator_profile.hpp, but level: y is against gravity.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/identify/imus/rest_log.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

/// By the turn that was found a link's end is off by this at most, standard deviation.
inline constexpr double kMostEnd_m = 0.012;
/// Farther from the profile no IMU is turned by accident, rad: 20 deg.
inline constexpr double kMostMounting_rad = 0.35;
/// The edge was farther off its peg than any hand puts it, with all that is known now.
inline constexpr double kMostOff_m = 0.05;

/// Touches of one peg.
struct Peg {
  std::vector<Rest> touches;
  std::optional<double> height_m;  ///< Over the boom foot's pin, as it was levelled.
};

struct MountingAsk {
  std::vector<Peg> pegs;
  std::optional<double> rise_m;  ///< Of the second peg over the first, as it was levelled.
  std::optional<int> kept;       ///< Axis whose IMU is known to sit right.
  double touch_m = 0.005;        ///< So well the edge is put on a peg, standard deviation.
  double level_m = 0.003;        ///< So well a height is known, the same.
};

/// A touch after the fit.
struct TouchResult {
  std::size_t peg = 0;
  Rest rest;
  double before_m = 0.0;  ///< The edge off the peg, with the turns that the profile had.
  double after_m = 0.0;
};

struct MountingFit {
  std::array<double, kAxisCount> turn_rad{};  ///< New, of each mount.
  std::array<double, kAxisCount> deviation_rad{};
  std::array<double, kAxisCount> end_m{};  ///< What that is at the link's end.
  std::vector<Eigen::Vector2d> peg_m;      ///< From the boom foot's pin: ahead, up.
  std::vector<TouchResult> touches;

  [[nodiscard]] double rms_m() const;
  [[nodiscard]] double most_m() const;
};

/// Throws std::runtime_error, with what is missing and what to do: too few touches, no reference, a
/// rest in which a link sank, a touch that is off the point of the others, postures that are too
/// much alike, a turn beyond kMostMounting_rad.
[[nodiscard]] MountingFit fit_mounting(const ExcavatorProfile& profile, const MountingAsk& ask);

}  // namespace graben::identify
