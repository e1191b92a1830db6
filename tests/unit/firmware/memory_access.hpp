// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controllers' friends: what they keep from cycle to cycle.

#include "firmware/dozer/dozer_controller.hpp"
#include "firmware/excavator/excavator_controller.hpp"

namespace graben {

struct ControllerMemoryAccess {
  static auto& mode(ExcavatorController& controller) { return controller.memory_.cycle.mode; }
  static auto& lambda(ExcavatorController& controller) {
    return controller.memory_.last.flow.lambda;
  }
  static auto& opening(ExcavatorController& controller) {
    return controller.memory_.output.opening;
  }
  static auto& task(ExcavatorController& controller) { return controller.memory_.motion.task; }
  static auto& last(ExcavatorController& controller) { return controller.memory_.last.commands; }
};

struct DozerMemoryAccess {
  static auto& mode(DozerController& controller) { return controller.memory_.cycle.mode; }
  static auto& speed(DozerController& controller) { return controller.memory_.speed_mps; }
  static auto& speed_state(DozerController& controller) { return controller.memory_.speed; }
  static auto& gate(DozerController& controller) { return controller.memory_.gate; }
  static auto& flow(DozerController& controller) { return controller.memory_.flow; }
};

}  // namespace graben
