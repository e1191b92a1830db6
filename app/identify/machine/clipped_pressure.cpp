// SPDX-License-Identifier: Apache-2.0
#include "app/identify/machine/clipped_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/identify/machine/median.hpp"

namespace graben::identify {
namespace {

constexpr int kHalvings = 60;
constexpr double kAwayFrom0_pa = 3.0e6;
/// Median of the magnitude of a difference of two normal values, of their deviation.
constexpr double kMedianDifference = 0.954;
/// No zero is farther below 0 than so many deviations of the noise, or nothing would be seen.
constexpr double kFarthest = 4.0;
/// Farther below 0 a mean over a few readings tells nothing.
constexpr double kLeastMean = 2.0;

double density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * M_PI); }
/// That a normal value is above x.
double chance_above(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }
/// How fast the chance of a reading of 0 falls.
double hazard(double x) { return density(x) / std::max(chance_above(x), 1e-300); }

}  // namespace

std::optional<ClippedZero> clipped_zero(const std::vector<double>& readings_pa, double noise_pa) {
  double sum_pa = 0.0;
  double above = 0.0;
  double most_pa = 0.0;
  for (const double reading_pa : readings_pa) {
    if (reading_pa > 0.0) {
      sum_pa += reading_pa;
      above += 1.0;
      most_pa = std::max(most_pa, reading_pa);
    }
  }
  if (above == 0.0) {
    return std::nullopt;
  }
  const double clipped = static_cast<double>(readings_pa.size()) - above;
  // The slope of the logarithm of the likelihood falls as z grows.
  double low_pa = -kFarthest * noise_pa;
  double high_pa = most_pa;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double middle_pa = 0.5 * (low_pa + high_pa);
    const double slope =
        (sum_pa - above * middle_pa) / noise_pa - clipped * hazard(middle_pa / noise_pa);
    (slope > 0.0 ? low_pa : high_pa) = middle_pa;
  }
  const double zero_pa = 0.5 * (low_pa + high_pa);
  const double x = zero_pa / noise_pa;
  const double falls = hazard(x);
  const double information = above + clipped * falls * (falls - x);
  return ClippedZero{zero_pa, noise_pa / std::sqrt(information)};
}

double unclipped_mean(double mean_pa, double noise_pa) {
  if (noise_pa <= 0.0 || mean_pa > kFarthest * noise_pa) {
    return mean_pa;
  }
  // E[max(0, x + noise)] = density(x) + x chance(x), in deviations of the noise, rises with x.
  double low = -kLeastMean;
  double high = kFarthest;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double middle = 0.5 * (low + high);
    (density(middle) + middle * chance_above(-middle) < mean_pa / noise_pa ? low : high) = middle;
  }
  return noise_pa * 0.5 * (low + high);
}

double pressure_noise_pa(const std::vector<MachineLog>& logs, std::size_t axis) {
  std::vector<double> differences_pa;
  for (const MachineLog& log : logs) {
    for (const LogSegment& segment : log.segments) {
      for (const std::vector<double>* of :
           {&segment.axis[axis].cap_pa, &segment.axis[axis].rod_pa}) {
        for (std::size_t at = 1; at < of->size(); ++at) {
          if (std::min((*of)[at], (*of)[at - 1]) > kAwayFrom0_pa) {
            differences_pa.push_back(std::abs((*of)[at] - (*of)[at - 1]));
          }
        }
      }
    }
  }
  if (differences_pa.empty()) {
    return 0.0;
  }
  return median(std::move(differences_pa)) / kMedianDifference;
}

}  // namespace graben::identify
