// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faults of a simulation while it runs: a row of the table of faults each.

#include <functional>
#include <string>

#include "app/plant/operator_node.hpp"
#include "platform/loopback/loopback_bus.hpp"

namespace graben::scope {

/// What the controller is meant to do.
enum class SimReaction {
  kStops,         ///< Neutral and latched.
  kStopsUnheard,  ///< The same, but the bus carries none of it: the valve side closes by itself.
  kLetsGo,        ///< Neutral without a fault: enable is not given any more.
  kRefused,       ///< Nothing arms.
  kSlower,        ///< Goes on, slower.
  kIgnored,       ///< Goes on, and counts a frame that it refused.
  kBridged,       ///< Goes on, as if nothing had been.
};
[[nodiscard]] const char* reaction_words(SimReaction reaction);

struct SimFault {
  std::string id;  ///< What a page names it by.
  int number = 0;  ///< Of the table of faults.
  std::string words;
  SimReaction reaction = SimReaction::kStops;
  bool once = false;  ///< Happens and is over; else stays until it is taken back.
};

/// A fault that is on. Whatever is empty does nothing. What a member changes beside the bus, `undo`
/// takes back; all the rest ends with the effect itself.
struct SimEffect {
  LoopbackBus::FaultHook tamper;            ///< Of every frame on its way; false loses it.
  std::function<void()> before_controller;  ///< In each cycle, after machine and operator.
  std::function<bool()> controller_runs;    ///< In each cycle; false: its cycle is left out.
  std::function<void(plant::OperatorRequest&)> operator_does;  ///< Instead of what he asks for.
  std::function<bool()> is_over;  ///< Of what happens once, after each cycle.
  std::function<void()> undo;
};

template <class Kind>
class SimRig;

/// Of one kind of machine.
template <class Kind>
struct SimFaultRow : SimFault {
  using Begin = SimEffect (*)(SimRig<Kind>& rig);

  SimFaultRow(const char* row_id, int row_number, std::string row_words, SimReaction meant,
              Begin how, bool is_once = false)
      : SimFault{row_id, row_number, std::move(row_words), meant, is_once}, begin(how) {}

  Begin begin;  ///< From the next cycle on. The rig outlives the effect.
};

}  // namespace graben::scope
