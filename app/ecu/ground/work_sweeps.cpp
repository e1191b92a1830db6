// SPDX-License-Identifier: Apache-2.0
#include "app/ecu/ground/work_sweeps.hpp"

#include <algorithm>
#include <cmath>

namespace graben::ground {
namespace {

/// Of the speed: a stroke's last digit is no motion.
constexpr double kSmooth_s = 0.05;

/// Against the way, N; 0 where nothing is told.
double holds_n(const EdgePlace& place, double way) { return -way * place.level_n; }

bool is_felt(const EdgePlace& place, double way) {
  return place.deviation_n > 0.0 && holds_n(place, way) > kFelt_deviations * place.deviation_n;
}

bool is_strong(const EdgePlace& place, double way) {
  const double width_m = (place.left_m - place.right_m).norm();
  const double least_npm = way > 0.0 ? kStrongOutwards_npm : kStrong_npm;
  return place.deviation_n > 0.0 &&
         holds_n(place, way) >
             std::max(least_npm * width_m, kStrong_deviations * place.deviation_n);
}

/// For as long as kStrong_s in one go.
bool has_strong(const std::vector<EdgeStep>& steps, double way) {
  double since_s = 0.0;
  bool strong = false;
  for (const EdgeStep& step : steps) {
    const bool now = is_strong(step.to, way);
    since_s = now && strong ? since_s : step.time_s;
    strong = now;
    if (strong && step.time_s - since_s >= kStrong_s) {
      return true;
    }
  }
  return false;
}

}  // namespace

void WorkSweeps::add(const EdgeStep& step) {
  const double passed_s = any_ ? step.time_s - before_s_ : 1e-6 * static_cast<double>(kPeriod_us);
  const double went_mps = (step.to.outwards_m - step.from.outwards_m) / std::max(passed_s, 1e-3);
  speed_mps_ += std::min(1.0, passed_s / kSmooth_s) * (went_mps - speed_mps_);
  before_s_ = step.time_s;
  any_ = true;
  const double way = speed_mps_ > kSweep_mps ? 1.0 : speed_mps_ < -kSweep_mps ? -1.0 : 0.0;
  const bool turned = way != 0.0 && way_ != 0.0 && way != way_;
  const bool rested = way == 0.0 && step.time_s - went_s_ > kPause_s;
  if (turned || rested) {
    const double speed_mps = speed_mps_;
    end();
    speed_mps_ = speed_mps;
    before_s_ = step.time_s;
    any_ = true;
  }
  if (way != 0.0) {
    way_ = way;
    went_s_ = step.time_s;
  }
  make_room();
  step_.push_back(step);
}

void WorkSweeps::make_room() {
  if (step_.size() < kMostSteps) {
    return;
  }
  for (std::size_t n = 0; n < kMostSteps / 2; ++n) {
    const EdgeStep& first = step_[2 * n];
    EdgeStep both = step_[2 * n + 1];
    both.from = first.from;
    step_[n] = both;
  }
  step_.resize(kMostSteps / 2);
}

void WorkSweeps::end() {
  if (way_ != 0.0 && has_strong(step_, way_)) {
    const auto felt = [this](const EdgeStep& step) { return is_felt(step.to, way_); };
    const auto first = std::find_if(step_.begin(), step_.end(), felt);
    const auto last = std::find_if(step_.rbegin(), step_.rend(), felt).base();
    std::for_each(first, last, [](EdgeStep& step) { step.to.at_work = true; });
  }
  for (const EdgeStep& step : step_) {
    take_(step);
  }
  step_.clear();
  way_ = 0.0;
  speed_mps_ = 0.0;
  any_ = false;
}

}  // namespace graben::ground
