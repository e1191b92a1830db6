// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is on a bus, by listening alone.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/operate/ecu_listener.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::operate {

class BusSurvey {
 public:
  void hear(const CanFrame& frame, TimeUs now);

  /// After so long: every message of machine and controller with its rate or that it is missing;
  /// then what else is heard, the machine's and the controller's profile and DBC, the strokes.
  [[nodiscard]] std::vector<std::string> lines(const ExcavatorProfile& profile, double listened_s,
                                               TimeUs now) const;
  /// Why nothing can be commissioned here with this profile; empty if it can.
  [[nodiscard]] std::string obstacle(std::uint32_t profile_hash, TimeUs now) const;
  [[nodiscard]] const EcuListener& ecu() const { return ecu_; }

 private:
  [[nodiscard]] int count(std::uint32_t id) const;

  EcuListener ecu_;
  std::map<std::uint32_t, int> count_;  ///< Of frames with a 29-bit id.
  int short_ids_ = 0;                   ///< Frames with an 11-bit one.
  Heard<EcuListener::Dbc::MachineIdentity> machine_;
};

/// Listens on an interface for so long, and sends nothing. Throws std::runtime_error, with the
/// reason, if there is no bus.
[[nodiscard]] BusSurvey survey_bus(const std::string& interface, double listen_s, TimeUs& end_us);

}  // namespace graben::operate
