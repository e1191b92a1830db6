// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A loader's arm as data: all that its plant may see of the core. Lift and tilt on one pump; their
/// cylinders pull against the weight. x forward, y up from the arm's pivot. The numbers are chosen.

#include <Eigen/Core>
#include <array>

#include "firmware/machine/valve.hpp"

namespace graben {

inline constexpr int kLoaderDrives = 2;
inline constexpr unsigned kLift = 0;
inline constexpr unsigned kTilt = 1;

struct LoaderProfile {
  template <class T>
  using Each = std::array<T, kLoaderDrives>;  ///< Lift and tilt.

  Each<Eigen::Vector2d> parent_pin_m = {{{0.30, 0.90}, {-1.0, 0.45}}};  ///< See CylinderTriangle.
  Each<Eigen::Vector2d> child_pin_m = {{{1.20, 0.10}, {0.05, 0.40}}};
  Each<double> closed_length_m = {0.85, 0.83};
  Each<double> stroke_m = {0.70, 0.50};
  Each<double> cap_m2 = {cap_area_m2(2, 0.08), cap_area_m2(2, 0.07)};
  Each<double> rod_m2 = {rod_area_m2(2, 0.08, 0.05), rod_area_m2(2, 0.07, 0.045)};
  Each<SpoolProfile> spool = {{{0, 3.0e-4, 2.4e-4, 2.4e-4, 3.0e-4, 3.0e-6, 6.0e-8},
                               {0, 2.4e-4, 2.0e-4, 2.0e-4, 2.4e-4, 3.0e-6, 6.0e-8}}};
  double arm_m = 2.5;     ///< Along the arm's x.
  double bucket_m = 1.0;  ///< From the bucket's joint to its edge, along its -y.
  PumpProfile pump = {45e-6, 209.4, 2e-12, 0.0, 21e6, {5.8e-6, 5.1e-6}, {}};
  SpoolMetering metering = {0.008, 1.5, 0.62, 870.0};
  double deadband_ratio = 0.2;                  ///< Of the spools' travel.
  Eigen::Vector2d cut_from_m = {2.745, -0.46};  ///< The edge's path: a straight cut.
  Eigen::Vector2d cut_to_m = {1.90, -1.33};
  double speed_mps = 0.65;
};

}  // namespace graben
