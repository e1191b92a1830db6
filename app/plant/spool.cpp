// SPDX-License-Identifier: Apache-2.0
#include "app/plant/spool.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace graben::plant {

DeadTime::DeadTime(double dead_time_s, double step_s)
    : past_(static_cast<std::size_t>(std::lround(dead_time_s / step_s)), 0.0) {}

double DeadTime::step(double value) {
  if (past_.empty()) {
    return value;
  }
  const double delayed = std::exchange(past_[next_], value);
  next_ = next_ + 1 == past_.size() ? 0 : next_ + 1;
  return delayed;
}

namespace {

// Closer than this the lag has arrived: a spool at rest costs no power function a step.
constexpr double kArrivedTravel = 1e-9;
constexpr double kArrivedSpeedPs = 1e-7;

}  // namespace

Spool::Spool(const SpoolDynamics& dynamics)
    : opens_radps_(1.0 / dynamics.time_constant_s),
      closes_radps_(dynamics.closing_time_constant_s > 0.0 ? 1.0 / dynamics.closing_time_constant_s
                                                           : opens_radps_),
      damping_(dynamics.damping),
      extend_(dynamics.extend),
      retract_(dynamics.retract),
      bypass_closing_(dynamics.bypass_closing_travel),
      bypass_closes_at_(dynamics.bypass_closes_at) {}

void Spool::set_command(double travel_ratio) { command_ = std::clamp(travel_ratio, -1.0, 1.0); }

bool Spool::step(double step_s) {
  if (travel_ == command_ && speed_ps_ == 0.0) {
    return false;
  }
  const bool closes = travel_ * (command_ - travel_) < 0.0;
  const double w = closes ? closes_radps_ : opens_radps_;
  const double half = 0.5 * step_s;
  const double mean_speed = (speed_ps_ + half * w * w * (command_ - travel_)) /
                            (1.0 + half * half * w * w + 2.0 * damping_ * w * half);
  travel_ += step_s * mean_speed;
  speed_ps_ = 2.0 * mean_speed - speed_ps_;
  if (std::abs(travel_) >= 1.0) {
    travel_ = std::clamp(travel_, -1.0, 1.0);
    speed_ps_ = 0.0;
  }
  if (std::abs(command_ - travel_) < kArrivedTravel && std::abs(speed_ps_) < kArrivedSpeedPs) {
    travel_ = command_;
    speed_ps_ = 0.0;
  }
  update_openings();
  return true;
}

void Spool::update_openings() {
  const SpoolSide& side = travel_ < 0.0 ? retract_ : extend_;
  area_ratio_ = side.area_ratio(std::abs(travel_));
  if (bypass_closes_at_ > 0.0) {
    const double start = side.start_ratio();
    const double way = (1.0 - start) * bypass_closes_at_;
    bypass_closed_ = std::clamp((std::abs(travel_) - start) / way, 0.0, 1.0);
    return;
  }
  // Closed from where the edges open on, as (20) has it with the deadband collapsed.
  const double to_opening = std::max(0.0, side.start_ratio() - std::abs(travel_));
  bypass_closed_ = area_ratio_ > 0.0 ? 1.0 : std::max(0.0, 1.0 - to_opening / bypass_closing_);
}

}  // namespace graben::plant
