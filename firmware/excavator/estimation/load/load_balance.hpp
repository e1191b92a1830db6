// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Balance of forces at the three cylinders: what each pushes beyond what its links need.

#include <array>

#include "firmware/excavator/estimation/load/link_moments.hpp"
#include "firmware/excavator/estimation/load/load_terms.hpp"
#include "firmware/excavator/estimation/load/paired_filter.hpp"

namespace graben {

/// What is seen in a cycle.
struct LoadSeen {
  bool posed = false;  ///< The pose is known.
  bool known = false;  ///< The pose, and all pressures.
  Eigen::Vector3d stroke_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();  ///< p_A A_A - p_B A_B.
  Eigen::Vector3d lever_m = Eigen::Vector3d::Ones();  ///< d stroke / d joint angle.
  Eigen::Vector3d joints_rad = Eigen::Vector3d::Zero();
  double swing_radps = 0.0;
};

/// Of all that goes into the balance, so that it is of one time.
struct BalanceFilter {
  PairedFilter stroke_m;
  PairedFilter force_n;    ///< Beyond what holds the links up.
  PairedFilter load_npkg;  ///< That holds a kilogram in the bucket up.
};

/// Forces along the cylinders, extension positive.
struct LoadBalance {
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();  ///< Beyond what the links need.
  std::array<TermRow, kAxisCount> row{};              ///< What of it the terms make.
  /// What a force of 1 N on the teeth, outwards and up, takes off it.
  Eigen::Matrix<double, kAxisCount, 2> teeth = Eigen::Matrix<double, kAxisCount, 2>::Zero();
  Eigen::Vector3d speed_mps = Eigen::Vector3d::Zero();
};

/// A cycle on; `restart` begins the filters at what is seen.
///
/// lever F + teeth f = moments(q, q', q'') + m load + lever (offset + friction), joint by joint,
/// divided by the lever. Forces at rest go through a low-pass, and so do the strokes, whose second
/// derivative then is of the same time as they are.
void next_balance(const ExcavatorProfile& profile, const LoadSeen& seen, double elapsed_s,
                  bool restart, BalanceFilter& filter, LoadBalance& balance);

}  // namespace graben
