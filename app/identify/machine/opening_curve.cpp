// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "app/identify/machine/estimate.hpp"

namespace graben::identify {
namespace {

/// ln(1 + exp(z)) without overflow.
double soft_plus(double z) { return std::max(z, 0.0) + std::log1p(std::exp(-std::abs(z))); }

}  // namespace

double OpeningCurve::area_ratio(double travel) const {
  const double full = soft_plus((1.0 - edge) / softness);
  return std::pow(soft_plus((travel - edge) / softness) / full, exponent);
}

double OpeningCurve::travel_at(double area_ratio) const {
  const double full = soft_plus((1.0 - edge) / softness);
  const double opening = full * std::pow(area_ratio, 1.0 / exponent);
  // ln(exp(opening) - 1), the other way round.
  const double z = opening + std::log1p(-std::exp(-opening));
  return std::clamp(edge + softness * z, 0.0, 1.0);
}

}  // namespace graben::identify
