// SPDX-License-Identifier: Apache-2.0
#include "app/machines/simulated/soil_kinds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/plant/random.hpp"

#include "firmware/numeric/constants.hpp"

namespace graben::machines {
namespace {

using plant::SoilKind;

constexpr double kDegree = kPi / 180.0;

// Sand: c and phi of dry sand (Land Locomotion Laboratory) in J. Y. Wong, Theory of Ground
// Vehicles. delta: 0.5 to 0.7 of phi is usual on polished steel. Density, swell and repose here and
// below: chosen within what earthmoving reckons with.
constexpr SoilKind kSand = {1600.0, 1.04e3, 0.0, 28.0 * kDegree, 20.0 * kDegree, 32.0 * kDegree,
                            1.12,   0.0,    0.0};
// Loam: values usual in tillage for sandy loam, c 5 to 15 kPa, phi 35 and delta 20 to 22 degrees,
// and for loam, 20 kPa, 20 and 10 degrees; between the two.
constexpr SoilKind kLoam = {1750.0, 10.0e3, 0.5e3, 30.0 * kDegree, 21.0 * kDegree, 37.0 * kDegree,
                            1.22,   0.0,    0.0};
// Clay: values usual in tillage for clay loam, c 30 kPa (moist plastic clay: 10 to 40), phi 10 and
// delta 6 degrees.
constexpr SoilKind kClay = {1850.0, 30.0e3, 3.0e3, 10.0 * kDegree, 6.0 * kDegree, 42.0 * kDegree,
                            1.32,   0.0,    0.0};
// Loam with stones: loam's cohesion; all else chosen, for stones of a fist's size to a head's.
constexpr SoilKind kStones = {1900.0, 10.0e3, 0.0, 38.0 * kDegree, 25.0 * kDegree, 40.0 * kDegree,
                              1.18,   0.35,   0.15};

/// Where nobody has measured it, soil is this far from its kind's values, each way.
constexpr double kSoilOff = 0.4;
constexpr double kDensityOff = 0.15;

double angle_times(double angle_rad, double factor) {
  return std::atan(factor * std::tan(angle_rad));
}

}  // namespace

std::optional<SoilKind> soil_kind(std::string_view name) {
  constexpr std::array<const SoilKind*, kSoilNames.size()> kKinds = {&kSand, &kLoam, &kClay,
                                                                     &kStones};
  const auto* const at = std::find(kSoilNames.begin(), kSoilNames.end(), name);
  if (at == kSoilNames.end()) {
    return std::nullopt;
  }
  return *kKinds[static_cast<std::size_t>(at - kSoilNames.begin())];
}

SoilKind scaled(const SoilKind& soil, const SoilFactors& factors) {
  SoilKind other = soil;
  other.density_kgpm3 *= factors.density;
  other.cohesion_pa *= factors.cohesion;
  other.adhesion_pa *= factors.adhesion;
  other.friction_rad = angle_times(soil.friction_rad, factors.friction);
  other.wall_friction_rad =
      std::min(other.friction_rad, angle_times(soil.wall_friction_rad, factors.wall_friction));
  return other;
}

plant::SoilKind ground_of(const std::string& name, bool drawn, std::uint64_t seed) {
  const auto kind = soil_kind(name);
  if (!kind) {
    throw std::runtime_error(fmt::format("--soil: '{}' is unknown; there are {}, and kim", name,
                                         fmt::join(kSoilNames, ", ")));
  }
  SoilFactors factors;
  if (drawn) {
    plant::Random random(seed, plant::Draw::kSoilKind);
    factors.density *= 1.0 + random.symmetric(kDensityOff);
    for (double* of :
         {&factors.cohesion, &factors.adhesion, &factors.friction, &factors.wall_friction}) {
      *of *= 1.0 + random.symmetric(kSoilOff);
    }
  }
  return scaled(*kind, factors);
}

}  // namespace graben::machines
