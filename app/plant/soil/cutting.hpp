// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Force of soil on a wide blade that cuts it: the fundamental equation of earthmoving (Reece 1964)
/// with the factors of a straight failure surface (McKyes, Soil Cutting and Tillage, 1985).

#include <array>

#include "app/plant/soil/soil_kind.hpp"

namespace graben::plant {

/// P = w (rho g d^2 N_gamma + c d N_c + q d N_q + c_a d N_ca), at the rake angle that they were
/// made for.
struct CuttingFactors {
  double gravity = 0.0;      ///< N_gamma.
  double cohesion = 0.0;     ///< N_c.
  double surcharge = 0.0;    ///< N_q.
  double adhesion = 0.0;     ///< N_ca.
  double failure_rad = 0.0;  ///< beta, of the failure surface over the direction of motion.
};

/// Smallest and largest rake that a blade is taken to have, from the direction of motion to its
/// face. Beyond the largest, soil comes to rest before the blade and is cut by itself.
inline constexpr double kLeastRake_rad = 0.26;
inline constexpr double kMostRake_rad = 1.92;

/// At the failure angle that makes N_gamma smallest: that way soil fails first.
[[nodiscard]] CuttingFactors cutting_factors(const SoilKind& soil, double rake_rad);

/// The factors of a soil over the rake, made once.
class CuttingTable {
 public:
  explicit CuttingTable(const SoilKind& soil);
  [[nodiscard]] CuttingFactors at(double rake_rad) const;

 private:
  static constexpr int kPoints = 96;
  std::array<CuttingFactors, kPoints> factors_;
};

/// What the soil does to the blade, N: `against` the motion, and `down` across it (below 0: up).
struct CuttingForce {
  double against_n = 0.0;
  double down_n = 0.0;
};

/// `surcharge_pa` is of what lies on the soil before the blade.
[[nodiscard]] CuttingForce cutting_force(const SoilKind& soil, const CuttingFactors& factors,
                                         double rake_rad, double depth_m, double width_m,
                                         double surcharge_pa, double gravity_mps2);

/// Pressure at which a strip of this width goes into the ground from this depth, Pa: Terzaghi's
/// equation with the factors of Prandtl, Reissner and Vesic.
[[nodiscard]] double bearing_pa(const SoilKind& soil, double width_m, double depth_m,
                                double gravity_mps2);

}  // namespace graben::plant
