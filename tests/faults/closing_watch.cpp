#include "tests/faults/closing_watch.hpp"

#include <algorithm>
#include <cmath>

#include "app/cli/dig_run.hpp"

namespace graben::faults {
namespace {

constexpr TimeUs kCycle_us = 10 * kMillisecondUs;

bool in_deadband(const plant::ExcavatorPlant& plant) {
  const auto spools = plant.spool_travels_ratio();
  return std::all_of(spools.begin(), spools.end(), [&plant](double travel) {
    return std::abs(travel) <= plant.profile().deadband_ratio;
  });
}

double stroke_m(const plant::ExcavatorPlant& plant, unsigned axis) {
  return plant.profile().machine.geometry.cylinder[axis].stroke_m;
}

}  // namespace

void ClosingWatch::before(const plant::ExcavatorPlant& plant) {
  if (!has_begun()) {
    last_ = plant;
  }
}

void ClosingWatch::begin(const plant::ExcavatorPlant& from) {
  reference_ = from;
  reference_->set_duty({}, false);
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    reference_->set_pilot_fault(i, std::nullopt, 0.0);
  }
}

void ClosingWatch::after(const plant::ExcavatorPlant& plant, bool closed) {
  if (!has_begun()) {
    if (!closed || (disobeying_ && !in_deadband(plant))) {
      return;
    }
    begin(disobeying_ ? plant : *last_);
    if (disobeying_) {
      return;
    }
  }
  reference_->advance(kCycle_us);
  const auto strokes_m = plant.strokes_m();
  const auto allowed_m = reference_->strokes_m();
  plant::ExcavatorPlant::AxisArray shares{};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    shares[i] = strokes_m[i] / stroke_m(plant, i);
    beyond_share_ =
        std::max(beyond_share_, std::abs(strokes_m[i] - allowed_m[i]) / stroke_m(plant, i));
  }
  if (!strokes_.empty() || in_deadband(plant)) {
    strokes_.push_back(shares);
  }
}

double ClosingWatch::creep_share() const {
  constexpr auto kPeriod = static_cast<std::size_t>(cli::kOilPeriod_s * 100.0 + 0.5);
  if (strokes_.size() < 2 * kPeriod) {
    return 0.0;
  }
  double creep_share = 0.0;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    std::vector<double> means;
    for (std::size_t n = 0; n + kPeriod <= strokes_.size(); ++n) {
      double sum = 0.0;
      for (std::size_t k = n; k < n + kPeriod; ++k) {
        sum += strokes_[k][i];
      }
      means.push_back(sum / static_cast<double>(kPeriod));
    }
    for (const double mean : means) {
      creep_share = std::max(creep_share, std::abs(mean - means.back()));
    }
  }
  return creep_share;
}

}  // namespace graben::faults
