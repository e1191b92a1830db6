// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faults, reasons for not arming and limits of lambda in text, from firmware/safety/faults.toml
/// and limits.toml; shares of time of each limit.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "firmware/core/codes.hpp"
#include "hal/link/message_rules.hpp"

namespace graben::runs {

/// "a stroke or angle is missing", ...; "none" for kNone.
[[nodiscard]] const char* fault_words(Fault fault);
/// What the operator should do about it; empty for kNone.
[[nodiscard]] const char* fault_help(Fault fault);
/// When the pilot pressure goes by it, and how it comes back; empty where it does not go.
[[nodiscard]] const char* pilot_words(Fault fault);

/// ", node 17 has emergency 5010h (device hardware)"; empty where there is none.
[[nodiscard]] std::string emergency_words(const NodeEmergency& emergency);

/// "Silent", "Ready", ...
[[nodiscard]] const char* mode_words(EcuMode mode);

/// Text of a bit of MachineStatus::why_not_armed.
[[nodiscard]] const char* arm_block_words(ArmBlock block);

/// Of a kind's actuators, in the order of their indices.
using ActuatorNames = std::vector<const char*>;
[[nodiscard]] const ActuatorNames& excavator_actuators();
[[nodiscard]] const ActuatorNames& dozer_actuators();

/// "none", "pump flow: Pump 1", "back flow: boom", ...
[[nodiscard]] std::string limit_words(const Limit& limit, const ActuatorNames& actuators);

/// Share of the cycles for each limit, by its words.
using LimitShares = std::vector<std::pair<std::string, double>>;

class LimitCount {
 public:
  explicit LimitCount(const ActuatorNames& actuators) : actuators_(actuators) {}

  /// By the time that it held, s.
  void add(const Limit& limit, double held_s);
  /// "none" first, the others by their words.
  [[nodiscard]] LimitShares shares() const;

 private:
  const ActuatorNames& actuators_;
  struct Held {
    double time_s = 0.0;
    long frames = 0;
  };
  std::map<std::string, Held> held_;
  Held all_;
};

}  // namespace graben::runs
