// SPDX-License-Identifier: Apache-2.0
#include "app/runs/load_figures.hpp"

#include <algorithm>
#include <cmath>

namespace graben::runs {
namespace {

/// Of the largest true force.
constexpr double kWithin = 0.1;
/// Of the capacity: a full bucket, and a payload told well.
constexpr double kFull = 0.9;
constexpr double kExact = 0.02;

}  // namespace

void LoadFigures::weigh(const AutodigSample& sample) {
  const StepKind kind = sample.progress.kind;
  if ((kind == StepKind::kLift || kind == StepKind::kSwing) && sample.told.payload_known) {
    carried_error_kg_ = sample.told.payload_kg - sample.fill_kg;
    carried_deviation_kg_ = sample.told.payload_sd_kg;
    return;
  }
  if (kind != StepKind::kDump || carried_deviation_kg_ == 0.0) {
    return;
  }
  if (dumps_++ > 0) {
    ++weighed_;
    exact_ += std::abs(carried_error_kg_) <= kExact * capacity_kg_ ? 1 : 0;
    worst_kg_ = std::max(worst_kg_, std::abs(carried_error_kg_));
    const double spread = carried_error_kg_ / carried_deviation_kg_;
    spread_squares_ += spread * spread;
  }
  carried_deviation_kg_ = 0.0;
}

void LoadFigures::count_round(const AutodigSample& sample) {
  const StepKind kind = sample.progress.kind;
  if (kind == StepKind::kSwing) {
    carried_kg_ = sample.fill_kg;
  } else if (kind == StepKind::kDump && carried_kg_ >= 0.0) {
    ++rounds_;
    full_ += carried_kg_ >= kFull * capacity_kg_ ? 1 : 0;
    carried_kg_ = -1.0;
  }
}

void LoadFigures::add(const AutodigSample& sample) {
  if (!std::isfinite(sample.tip_force_n[0])) {
    return;
  }
  weigh(sample);
  count_round(sample);
  if (sample.progress.kind != StepKind::kDig) {
    return;
  }
  const Eigen::Vector2d true_n(sample.tip_force_n.data());
  largest_n_ = std::max(largest_n_, true_n.norm());
  // What is not told is off by all of it.
  dug_.push_back(sample.told.known
                     ? Compared{(sample.told.force_n - true_n).norm(), sample.told.force_sd_n}
                     : Compared{true_n.norm(), 0.0});
}

void LoadFigures::tell(AutodigSummary& summary) const {
  if (largest_n_ > 0.0) {
    double within = 0.0;
    double squares = 0.0;
    double spread = 0.0;
    for (const Compared& one : dug_) {
      within += one.error_n <= kWithin * largest_n_ ? 1.0 : 0.0;
      squares += one.error_n * one.error_n;
      if (one.deviation_n > 0.0) {
        const double over = one.error_n / one.deviation_n;
        spread += 0.5 * over * over;  // the deviation is that of each component
      }
    }
    const auto count = static_cast<double>(dug_.size());
    summary.tip_force_within_ratio = within / count;
    summary.tip_force_error_n = std::sqrt(squares / count);
    summary.tip_force_spread = std::sqrt(spread / count);
  }
  if (rounds_ > 0) {
    summary.full_rounds_ratio = static_cast<double>(full_) / rounds_;
  }
  if (weighed_ > 0) {
    summary.payload_within_ratio = static_cast<double>(exact_) / weighed_;
    summary.payload_error_ratio = worst_kg_ / capacity_kg_;
    summary.payload_spread = std::sqrt(spread_squares_ / weighed_);
  }
}

}  // namespace graben::runs
