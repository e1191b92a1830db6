// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is on a bus, by listening alone.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/commission/dozer_ear.hpp"
#include "app/operate/ecu_listener.hpp"
#include "firmware/dozer/dozer_profile.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::operate {

/// What a kind's bus is to carry, and under which version of its frames.
struct SurveyedBus {
  const dbc::MessageInfo* first = nullptr;
  std::size_t count = 0;
  std::uint32_t dbc_version = 0;
};
[[nodiscard]] SurveyedBus surveyed_bus(const ExcavatorProfile& profile);
[[nodiscard]] SurveyedBus surveyed_bus(const DozerProfile& profile);

class BusSurvey {
 public:
  explicit BusSurvey(const SurveyedBus& bus);

  void hear(const CanFrame& frame, TimeUs now);

  /// After so long: every message of machine and controller with its rate or that it is missing;
  /// then what else is heard, the machine's and the controller's profile and DBC, the strokes, of a
  /// dozer where it stands.
  [[nodiscard]] std::vector<std::string> lines(const ExcavatorProfile& profile, double listened_s,
                                               TimeUs now) const;
  [[nodiscard]] std::vector<std::string> lines(const DozerProfile& profile, double listened_s,
                                               TimeUs now) const;
  /// Why nothing can be commissioned here with this profile; empty if it can.
  [[nodiscard]] std::string obstacle(const ExcavatorProfile& profile, std::uint32_t profile_hash,
                                     TimeUs now) const;
  [[nodiscard]] std::string obstacle(const DozerProfile& profile, std::uint32_t profile_hash,
                                     TimeUs now) const;
  [[nodiscard]] const EcuListener& ecu() const { return ecu_; }

 private:
  [[nodiscard]] int count(std::uint32_t id) const;
  /// Of all messages but those that this machine need not have.
  [[nodiscard]] std::vector<std::string> common_lines(const std::vector<std::uint32_t>& may_miss,
                                                      double listened_s) const;
  [[nodiscard]] std::string common_obstacle(std::uint32_t profile_hash, TimeUs now) const;

  SurveyedBus bus_;
  EcuListener ecu_;
  commission::DozerEar dozer_;
  std::map<std::uint32_t, int> count_;  ///< Of frames with a 29-bit id.
  int short_ids_ = 0;                   ///< Frames with an 11-bit one.
  Heard<EcuListener::Dbc::MachineIdentity> machine_;
};

/// Listens on an interface for so long, and sends nothing. Throws std::runtime_error, with the
/// reason, if there is no bus.
[[nodiscard]] BusSurvey survey_bus(const std::string& interface, const SurveyedBus& bus,
                                   double listen_s, TimeUs& end_us);

}  // namespace graben::operate
