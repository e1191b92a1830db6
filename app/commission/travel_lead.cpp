// SPDX-License-Identifier: Apache-2.0
#include "app/commission/travel_lead.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace graben::commission {
namespace {

constexpr double kTravelPeriod_s = 0.01;
/// Before the ends of the way, and what the machine needs to stop.
constexpr double kTravelMargin_m = 0.20;
constexpr double kTravelStopsIn_s = 0.9;
/// Low-pass of the velocity: its noise.
constexpr double kSpeedLag_s = 0.08;
constexpr double kTravelStill_mps = 0.03;
constexpr double kTravelStillFor_s = 0.4;
constexpr double kTravelMoving_mps = 0.04;
constexpr std::array<double, kTravelLevelCount> kTravelLevels = {0.10, 0.25, 0.50, 0.90};
/// A step lasts so long after it has begun to move.
constexpr double kTravelHold_s = 1.3;
constexpr double kTravelNoMotion_s = 1.5;
constexpr double kTravelRestMost_s = 3.0;
/// While the motors are tried: the pumps', the motors' own, and when these begin.
constexpr double kMotorPump = 0.55;
constexpr double kMotorRatio = 0.5;
constexpr double kMotorFrom_s = 1.0;
constexpr double kMotorHold_s = 2.2;
/// Of the speed that was confirmed.
constexpr double kTravelOfMost = 0.8;

}  // namespace

void TravelLead::begin(const TravelStep& step) {
  step_ = step;
  result_ = {};
  to_phase(Phase::kWait);
}

void TravelLead::to_phase(Phase phase) {
  phase_ = phase;
  phase_s_ = 0.0;
  pump_ = 0.0;
  motor_ = 1.0;
  moving_s_ = 0.0;
}

void TravelLead::observe(double position_m, double velocity_mps) {
  from_m_ = from_m_.value_or(position_m);
  at_m_ = position_m;
  speed_mps_ += (velocity_mps - speed_mps_) * kTravelPeriod_s / (kSpeedLag_s + kTravelPeriod_s);
  stands_s_ = std::abs(speed_mps_) < kTravelStill_mps ? stands_s_ + kTravelPeriod_s : 0.0;
}

double TravelLead::room_m() const {
  const double way_m = at_m_ - *from_m_;
  return step_.sign > 0 ? way_.most_m - way_m : way_m - way_.least_m;
}

/// What was tried before says how fast the next one will be at most.
double TravelLead::level_ratio() const {
  const double wanted =
      step_.motor ? kMotorPump : kTravelLevels[static_cast<std::size_t>(step_.level)];
  const double gain_mps = most_gain_mps_ / (step_.motor ? kMotorRatio : 1.0);
  return gain_mps > 0.0 ? std::min(wanted, kTravelOfMost * way_.most_mps / gain_mps) : wanted;
}

void TravelLead::remember(const TravelStep& step, const StepResult& result) {
  if (!step.motor && result.duty > 0.0) {
    most_gain_mps_ = std::max(most_gain_mps_, result.speed_mps / result.duty);
  }
}

bool TravelLead::step(double position_m, double velocity_mps) {
  observe(position_m, velocity_mps);
  phase_s_ += kTravelPeriod_s;
  result_.took_s += kTravelPeriod_s;
  switch (phase_) {
    case Phase::kWait:
      if (stands_s_ > kTravelStillFor_s) {
        to_phase(Phase::kRun);
      }
      return false;
    case Phase::kRun:
      run();
      return false;
    case Phase::kRest:
      return stands_s_ > kTravelStillFor_s || phase_s_ > kTravelRestMost_s;
  }
  return false;
}

void TravelLead::run() {
  const double along_mps = step_.sign * speed_mps_;
  result_.speed_mps = std::max(result_.speed_mps, along_mps);
  if (room_m() < kTravelMargin_m + std::max(0.0, along_mps) * kTravelStopsIn_s) {
    return finish(StepEnd::kAtWindow);
  }
  if (moving_s_ > 0.0 || along_mps > kTravelMoving_mps) {
    moving_s_ += kTravelPeriod_s;
  }
  if (moving_s_ == 0.0 && phase_s_ > kTravelNoMotion_s) {
    return finish(StepEnd::kNoMotion);
  }
  if (moving_s_ > (step_.motor ? kMotorHold_s : kTravelHold_s)) {
    return finish(StepEnd::kDone);
  }
  pump_ = step_.sign * level_ratio();
  motor_ = step_.motor && moving_s_ > kMotorFrom_s ? kMotorRatio : 1.0;
  result_.duty = std::max(result_.duty, std::abs(pump_));
  if (motor_ == 1.0) {
    most_gain_mps_ = std::max(most_gain_mps_, along_mps / std::abs(pump_));
  }
}

void TravelLead::finish(StepEnd end) {
  result_.end = end;
  to_phase(Phase::kRest);
}

}  // namespace graben::commission
