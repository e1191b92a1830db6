// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/closing_watch.hpp"

#include <algorithm>
#include <cmath>

#include "app/runs/dig_run.hpp"
#include "tests/faults/dozer_kind.hpp"
#include "tests/faults/excavator_kind.hpp"

namespace graben::faults {
namespace {

template <class Kind>
bool in_deadband(const typename Kind::Plant& plant) {
  const auto spools = Kind::spools(plant);
  return std::all_of(spools.begin(), spools.end(),
                     [&plant](double travel) { return std::abs(travel) <= Kind::deadband(plant); });
}

}  // namespace

template <class Kind>
void ClosingWatch<Kind>::before(const Plant& plant) {
  if (!has_begun()) {
    last_ = plant;
  }
}

template <class Kind>
void ClosingWatch<Kind>::begin(const Plant& from) {
  reference_ = from;
  Kind::make_neutral_and_sound(*reference_);
}

template <class Kind>
void ClosingWatch<Kind>::after(const Plant& plant, bool closed) {
  closed_ = closed_ || closed;
  if (const std::optional<Rolling> rolling = Kind::rolling(plant); closed_ && rolling) {
    rolling_.see(*rolling);
  }
  if (!has_begun()) {
    const bool in_middle = in_deadband<Kind>(plant);
    strayed_ = strayed_ || !in_middle;
    if (!closed || (disobeying_ && !(strayed_ && in_middle))) {
      return;
    }
    begin(disobeying_ ? plant : *last_);
    if (disobeying_) {
      return;
    }
  }
  reference_->advance(kCycle_us);
  const auto strokes_m = Kind::strokes_m(plant);
  const auto allowed_m = Kind::strokes_m(*reference_);
  const auto longest_m = Kind::longest_m(plant);
  typename Kind::AxisArray shares{};
  for (unsigned i = 0; i < Kind::kAxes; ++i) {
    shares[i] = strokes_m[i] / longest_m[i];
    beyond_share_ = std::max(beyond_share_, std::abs(strokes_m[i] - allowed_m[i]) / longest_m[i]);
  }
  if (!strokes_.empty() || in_deadband<Kind>(plant)) {
    strokes_.push_back(shares);
  }
}

template <class Kind>
double ClosingWatch<Kind>::creep_share() const {
  constexpr auto kPeriod = static_cast<std::size_t>(runs::kOilPeriod_s * 100.0 + 0.5);
  if (strokes_.size() < 2 * kPeriod) {
    return 0.0;
  }
  double creep_share = 0.0;
  for (std::size_t i = 0; i < Kind::kAxes; ++i) {
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

template class ClosingWatch<Excavator>;
template class ClosingWatch<Dozer>;

}  // namespace graben::faults
