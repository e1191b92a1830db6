#pragma once
/// The controllers' friends: what they keep from cycle to cycle.

#include "firmware/dozer/dozer_controller.hpp"
#include "firmware/excavator/excavator_controller.hpp"

namespace graben {

struct ControllerMemoryAccess {
  static auto& mode(ExcavatorController& controller) { return controller.memory_.mode; }
  static auto& lambda(ExcavatorController& controller) { return controller.memory_.lambda; }
  static auto& opening(ExcavatorController& controller) { return controller.memory_.gate.opening; }
  static auto& task(ExcavatorController& controller) { return controller.memory_.task; }
  static auto& cycle(ExcavatorController& controller) { return controller.memory_.cycle; }
};

struct DozerMemoryAccess {
  static auto& mode(DozerController& controller) { return controller.memory_.mode; }
  static auto& speed(DozerController& controller) { return controller.memory_.speed_mps; }
  static auto& speed_state(DozerController& controller) { return controller.memory_.speed; }
  static auto& gate(DozerController& controller) { return controller.memory_.gate; }
};

}  // namespace graben
