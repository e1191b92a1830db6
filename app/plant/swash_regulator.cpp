// SPDX-License-Identifier: Apache-2.0
#include "app/plant/swash_regulator.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

constexpr double kDamping = 0.7;
/// Of the unloading valve, above what the line is to be at. Chosen.
constexpr double kUnload_pa = 1.0e6;
/// Of the pump's cut-off, under the relief. Chosen.
constexpr double kCutOff_pa = 0.5e6;

}  // namespace

SwashRegulator::SwashRegulator(const PumpRegulator& data, const RegulatedLine& line, double step_s)
    : data_(data), line_(line), step_s_(step_s) {
  if (!data_.sets_swash()) {
    return;
  }
  if (senses_load()) {
    const double rise_paps = line_.stiffness_papm3 * line_.full_flow_m3ps;
    per_pa_s_ = 1.0 / (data_.response_s * data_.margin_pa);
    per_pa_ = 2.0 * kDamping * std::sqrt(per_pa_s_ / rise_paps);
  }
  lag_share_ = -std::expm1(-3.0 * step_s / data_.response_s);
}

double SwashRegulator::relief_pa(double load_pa) const {
  return senses_load() ? std::min(line_.relief_pa, load_pa + data_.margin_pa + kUnload_pa)
                       : line_.relief_pa;
}

double SwashRegulator::settled(double bypass_m3ps) const {
  const double root = bypass_m3ps / line_.tank_orifice;
  const double gone =
      (root * root - data_.full_swash_pa) / (data_.least_swash_pa - data_.full_swash_pa);
  return 1.0 + std::clamp(gone, 0.0, 1.0) * (data_.least_swash_ratio - 1.0);
}

double SwashRegulator::by_load(const Felt& felt) {
  const double wanted_pa = std::min(felt.load_pa + data_.margin_pa, line_.relief_pa - kCutOff_pa);
  const double missing_pa = wanted_pa - felt.line_pa;
  integral_ = std::clamp(integral_ + per_pa_s_ * step_s_ * missing_pa, 0.0, 1.0);
  return std::clamp(integral_ + per_pa_ * missing_pa, 0.0, 1.0);
}

double SwashRegulator::next(double swash_ratio, const Felt& felt) {
  const double missing = senses_load() ? by_load(felt) - swash_ratio
                                       : lag_share_ * (settled(felt.bypass_m3ps) - swash_ratio);
  const double most = step_s_ / data_.response_s;
  return swash_ratio + std::clamp(missing, -most, most);
}

}  // namespace graben::plant
