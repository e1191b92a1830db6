// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A low-pass of second order whose states are the filtered value and its rate: what goes through
/// several of them stays of one time, derivatives too.

#include <Eigen/Core>

#include "firmware/excavator/estimation/load/tuning.hpp"

namespace graben {

/// Of one value for each axis.
struct PairedFilter {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_ps = Eigen::Vector3d::Zero();
  Eigen::Vector3d change_ps2 = Eigen::Vector3d::Zero();  ///< Of the rate.
};

/// Noise behind the low-pass over that of a white reading every 10 ms, as deviations. [-; derived:
/// sqrt(kPairedCorner_radps kCyclePeriod_s / (4 kPairedDamping))]
inline constexpr double kPairedNoise = 0.33;

inline void begin(const Eigen::Vector3d& seen, PairedFilter& filter) {
  filter.value = seen;
  filter.rate_ps.setZero();
  filter.change_ps2.setZero();
}

inline void advance(const Eigen::Vector3d& seen, double period_s, PairedFilter& filter) {
  filter.change_ps2 = kPairedCorner_radps * (kPairedCorner_radps * (seen - filter.value) -
                                             2.0 * kPairedDamping * filter.rate_ps);
  filter.rate_ps += period_s * filter.change_ps2;
  filter.value += period_s * filter.rate_ps;
}

}  // namespace graben
