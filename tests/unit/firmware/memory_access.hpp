// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The controllers' friends: what they keep from cycle to cycle. What is written here is sealed
/// only where a test says so.

#include "firmware/dozer/dozer_controller.hpp"
#include "firmware/excavator/excavator_controller.hpp"

namespace graben {

struct ControllerMemoryAccess {
  /// Of a node on a bus.
  template <class Ecu>
  static auto& controller(Ecu& ecu) {
    return ecu.controller_;
  }
  static auto& memory(ExcavatorController& controller) { return controller.memory_; }
  static auto& last(ExcavatorController& controller) { return controller.memory_->last.commands; }
};

struct DozerMemoryAccess {
  static auto& memory(DozerController& controller) { return controller.memory_; }
};

}  // namespace graben
