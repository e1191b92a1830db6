// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Margins of a law around a truth, both linear, in cycles of 10 ms.
///
/// Disk margin, symmetric (Seiler, Packard and Gahinet, 'An Introduction to Disk Margins', IEEE
/// Control Systems Magazine 40(5), 2020): the loop L is cut at one command, the other stays closed.
/// There the command is multiplied by any factor of the disk
///
///   f = (1 + a/2 d) / (1 - a/2 d), |d| < 1, also one that changes with frequency.
///
/// alpha is the largest a with which the loop is stable for every such f. With S = 1 / (1 + L) and
/// T = L S it is alpha = 2 / max |S - T| over all frequencies to Nyquist's. It holds for gain and
/// phase at the same time; each by itself may be off by the factor (2 + alpha) / (2 - alpha), up or
/// down, or by 2 atan(alpha / 2). The classic margins are those of gain alone and of phase alone.

#include <string>

#include "tests/margins/linkage_on_oil.hpp"

namespace graben::margins {

struct ChannelMargin {
  double alpha = 0.0;
  double at_hz = 0.0;      ///< Where the disk margin is least.
  double gain_up = 0.0;    ///< Classic: factor that makes it unstable; infinite if none does.
  double gain_down = 0.0;  ///< The same below 1; 0 if none does.
  double phase_rad = 0.0;  ///< Classic, either way; pi if none does.
};

struct LoopMargins {
  /// Of the closed loop's eigenvalues: stable below 1.
  double spectral_radius = 0.0;
  /// Of boom and arm, one cut at a time; all 0 if the loop is not stable.
  ChannelMargin channel[2];

  [[nodiscard]] bool stable() const { return spectral_radius < 1.0; }
  [[nodiscard]] double alpha() const;
};

/// Law from what is seen to duties, truth from duties to what is seen; the truth's d is 0.
[[nodiscard]] Eigen::MatrixXd closed_loop(const Discrete& law, const Discrete& truth);

[[nodiscard]] LoopMargins loop_margins(const Discrete& law, const Discrete& truth);

/// What alpha is worth by itself.
[[nodiscard]] double gain_db(double alpha);
[[nodiscard]] double phase_deg(double alpha);

/// Rate at which the slowest of what the loop undoes fades, 1/s.
[[nodiscard]] double decay_ps(double spectral_radius);

}  // namespace graben::margins
