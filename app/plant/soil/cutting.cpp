// SPDX-License-Identifier: Apache-2.0
#include "app/plant/soil/cutting.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

double cot(double angle_rad) { return 1.0 / std::tan(angle_rad); }

/// The failure surface's angle is looked for in steps of a degree.
constexpr double kDegree = kPi / 180.0;
constexpr double kFlattest = 5.0 * kDegree;

CuttingFactors factors_at(const SoilKind& soil, double rake_rad, double failure_rad) {
  const double wedge = cot(failure_rad + soil.friction_rad);
  const double push = rake_rad + soil.wall_friction_rad;
  const double share = std::cos(push) + std::sin(push) * wedge;
  CuttingFactors factors;
  factors.failure_rad = failure_rad;
  factors.surcharge = (cot(rake_rad) + cot(failure_rad)) / share;
  factors.gravity = 0.5 * factors.surcharge;
  factors.cohesion = (1.0 + cot(failure_rad) * wedge) / share;
  factors.adhesion = (1.0 - cot(rake_rad) * wedge) / share;
  return factors;
}

}  // namespace

CuttingFactors cutting_factors(const SoilKind& soil, double rake_rad) {
  const double rake = std::clamp(rake_rad, kLeastRake_rad, kMostRake_rad);
  CuttingFactors best = factors_at(soil, rake, kFlattest);
  for (double failure = kFlattest + kDegree; failure + soil.friction_rad < kPi;
       failure += kDegree) {
    const CuttingFactors tried = factors_at(soil, rake, failure);
    // Beyond its smallest value N_gamma grows without bound; what follows means nothing.
    if (tried.gravity <= 0.0 || tried.gravity > best.gravity) {
      break;
    }
    best = tried;
  }
  return best;
}

CuttingTable::CuttingTable(const SoilKind& soil) {
  for (std::size_t n = 0; n < factors_.size(); ++n) {
    const double share = static_cast<double>(n) / (kPoints - 1);
    factors_[n] = cutting_factors(soil, kLeastRake_rad + share * (kMostRake_rad - kLeastRake_rad));
  }
}

CuttingFactors CuttingTable::at(double rake_rad) const {
  const double place =
      (kPoints - 1) *
      std::clamp((rake_rad - kLeastRake_rad) / (kMostRake_rad - kLeastRake_rad), 0.0, 1.0);
  return factors_[static_cast<std::size_t>(std::lround(place))];
}

CuttingForce cutting_force(const SoilKind& soil, const CuttingFactors& factors, double rake_rad,
                           double depth_m, double width_m, double surcharge_pa,
                           double gravity_mps2) {
  const double rake = std::clamp(rake_rad, kLeastRake_rad, kMostRake_rad);
  const double weight_pa = soil.density_kgpm3 * gravity_mps2 * depth_m;
  const double pressure_pa = weight_pa * factors.gravity + soil.cohesion_pa * factors.cohesion +
                             surcharge_pa * factors.surcharge +
                             soil.adhesion_pa * std::max(0.0, factors.adhesion);
  const double force_n = width_m * depth_m * pressure_pa;
  const double sticks_n = width_m * depth_m * soil.adhesion_pa;
  const double push = rake + soil.wall_friction_rad;
  return {std::max(0.0, force_n * std::sin(push) + sticks_n * cot(rake)),
          force_n * std::cos(push) - sticks_n};
}

double bearing_pa(const SoilKind& soil, double width_m, double depth_m, double gravity_mps2) {
  const double weight_npm3 = soil.density_kgpm3 * gravity_mps2;
  const double tangent = std::tan(soil.friction_rad);
  const double n_q =
      std::exp(kPi * tangent) * std::pow(std::tan(0.25 * kPi + 0.5 * soil.friction_rad), 2);
  const double n_c = tangent > 1e-6 ? (n_q - 1.0) / tangent : kPi + 2.0;
  const double n_gamma = 2.0 * (n_q + 1.0) * tangent;
  return soil.cohesion_pa * n_c + weight_npm3 * depth_m * n_q +
         0.5 * weight_npm3 * width_m * n_gamma;
}

}  // namespace graben::plant
