// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the controller said on the bus, decoded frame by frame: the only witness of its reactions.

#include <cstdint>
#include <map>
#include <vector>

#include "can_dbc/codec.hpp"
#include "firmware/core/codes.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_frame.hpp"
#include "hal/j1939/ids.hpp"
#include "hal/j1939/transport.hpp"
#include "hal/link/message_rules.hpp"

namespace graben::faults {

struct BusRecord {
  /// What all of a cycle's commands come to.
  struct Command {
    TimeUs at_us = 0;
    int frames = 0;
    bool enable = false;
    bool neutral = true;  ///< Every duty and pump is 0, every motor at full displacement.
    bool pilot_cut = false;
    bool brake = false;

    [[nodiscard]] bool is_neutral() const { return !enable && neutral; }
  };
  struct Status {
    TimeUs at_us = 0;
    EcuMode mode = EcuMode::kSilent;
    Fault fault = Fault::kNone;
    Limit limit;
  };
  struct Trouble {
    TimeUs at_us = 0;
    Fault fault = Fault::kNone;
  };
  struct Refusal {
    TimeUs at_us = 0;
    std::uint32_t why_not_armed = 0;
  };
  struct Wanted {
    TimeUs at_us = 0;
    double speed_mps = 0.0;  ///< As the machine kind has it.
  };

  std::vector<Command> commands;
  std::vector<Status> statuses;
  std::vector<Trouble> troubles;
  std::vector<Refusal> refusals;
  std::vector<Wanted> wanted;
  std::map<std::uint32_t, TimeUs> last_us;  ///< Of each message of the others.

  template <class Kind>
  void see(const CanFrame& frame, bool from_controller);

  /// Whether EcuStatus named this fault, or DM1 its trouble code, at or after `since_us`.
  [[nodiscard]] bool status_named(Fault fault, TimeUs since_us) const;
  [[nodiscard]] bool dm1_named(Fault fault, TimeUs since_us, TimeUs until_us) const;
  /// Whether any fault at all was named at or after `since_us`.
  [[nodiscard]] bool any_fault(TimeUs since_us) const;
  /// Of all frames sent at or after `since_us`.
  [[nodiscard]] bool all_neutral(TimeUs since_us) const;
  [[nodiscard]] bool any_pilot_cut(TimeUs since_us) const;
  /// When the first neutral command at or after `since_us` came, of so many frames; -1: none has.
  [[nodiscard]] TimeUs first_neutral_us(TimeUs since_us, int frames) const;
  /// When the parking brake was first asked for at or after `since_us`; -1: it was not.
  [[nodiscard]] TimeUs first_brake_us(TimeUs since_us) const;

 private:
  template <class Kind>
  void see_command(const CanFrame& frame);

  j1939::BamReceiver several_{j1939::kActiveCodesPgn, kOwnAddress};  ///< Codes in one DM1.
};

/// Enable and pilot cut of a spool's command.
template <class SpoolCommand>
SpoolCommand read_spool_command(const CanFrame& frame, BusRecord::Command& command) {
  const SpoolCommand message = SpoolCommand::decode(frame.data);
  // What does not decode as Off counts as On.
  command.enable = message.enable.state != dbc::RawState::kValid ||
                   message.enable.value != SpoolCommand::Enable::kOff;
  command.pilot_cut = message.pilot_cut.state == dbc::RawState::kValid &&
                      message.pilot_cut.value == SpoolCommand::PilotCut::kOn;
  return message;
}

[[nodiscard]] inline bool says(const dbc::Physical& value, double number) {
  return value.state == dbc::RawState::kValid && value.value == number;
}

}  // namespace graben::faults
