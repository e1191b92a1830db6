// SPDX-License-Identifier: Apache-2.0
#include "app/operate/station.hpp"

#include <algorithm>
#include <cmath>

namespace graben::operate {
namespace {

double stepped(double ratio, int steps) {
  // In whole steps, or tenths would add up to something else than 1.
  const double count = std::round(ratio / Station::kSpeedStep) + steps;
  return std::clamp(count * Station::kSpeedStep, 0.0, 1.0);
}

}  // namespace

bool is_armed(const std::optional<EcuMode>& mode) {
  return mode == EcuMode::kArmed || mode == EcuMode::kActive;
}

Station::Station(const StationOptions& options)
    : options_(options), speed_ratio_(options.speed_override_ratio) {}

Trouble trouble_with(const Hands& hands, Trouble around, TimeUs silent_after_us) {
  if (!hands.is_there) {
    return Trouble::kDeviceGone;
  }
  if (hands.lost_events) {
    return Trouble::kEventsLost;
  }
  if (hands.deadman && hands.quiet_us > silent_after_us) {
    return Trouble::kDeviceSilent;
  }
  return around;
}

Request Station::step(const Hands& hands, const Surroundings& around) {
  const bool was_on = deadman_.is_on();
  const bool on = deadman_.step(hands.deadman, hands.levers.are_at_rest(),
                                trouble_with(hands, around.trouble, options_.silent_after_us));
  if (hands.changes_mode) {
    mode_ = mode_ == OperatorMode::kManual ? OperatorMode::kAutomatic : OperatorMode::kManual;
  }
  if (hands.changes_task && !was_on && !on) {
    task_ = task_ == Task::kJog           ? Task::kCoordinated
            : task_ == Task::kCoordinated ? Task::kAssist
                                          : Task::kJog;
  }
  if (hands.speed_steps != 0) {
    speed_ratio_ = stepped(speed_ratio_, hands.speed_steps);
  }
  Request request;
  request.enable = on;
  request.mode = mode_;
  request.task = on && is_armed(around.ecu_mode) ? task_ : Task::kNone;
  request.speed_override_ratio = speed_ratio_;
  request.axes = on ? axes_of(hands.levers, task_) : Axes{};
  return request;
}

}  // namespace graben::operate
