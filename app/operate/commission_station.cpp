// SPDX-License-Identifier: Apache-2.0
#include "app/operate/commission_station.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/operate/screen.hpp"
#include "app/runs/code_text.hpp"

namespace graben::operate {
namespace {

Fault stopping_fault(const EcuListener& ecu) {
  return ecu.status().said ? static_cast<Fault>(ecu.status().said->fault.value) : Fault::kNone;
}

/// The controller is ready once it has seen enable released, and nothing else is missing.
std::string waiting_text(const Deadman& deadman, const EcuListener& ecu, TimeUs now) {
  const auto mode = ecu.mode(now);
  const bool is_ready = mode == EcuMode::kReady || is_armed(mode);
  std::string controller = fmt::format("the controller is {}", mode_words(mode));
  if (const std::string reason = not_armed_words(ecu); !reason.empty()) {
    controller += ": " + reason;
  }
  if (deadman.is_on()) {
    return is_ready ? "the controller arms" : controller + "; release the deadman";
  }
  if (deadman.trouble() != Trouble::kNone) {
    return fmt::format("{}; release the deadman", trouble_words(deadman.trouble()));
  }
  return is_ready ? "press and hold the deadman" : controller;
}

}  // namespace

template <class Lead>
CommissionStationOf<Lead>::CommissionStationOf(const CommissionSetupOf<Lead>& setup)
    : setup_(setup), lead_(setup.sequence, setup.done), tried_(lead_.tried(false)) {}

/// The sequence stops before the controller has to, but where it touches an end: this one misses
/// the window.
template <class Lead>
bool CommissionStationOf<Lead>::is_held(const EcuListener& ecu) {
  constexpr double kPeriod_s = 0.01;
  constexpr double kHeld_s = 0.2;
  const auto& status = ecu.status().said;
  const bool held = moving_ && !lead_.touches() && status &&
                    static_cast<LimitKind>(status->limit_kind.value) == LimitKind::kStrokeEnd;
  held_s_ = held ? held_s_ + kPeriod_s : 0.0;
  return held_s_ > kHeld_s;
}

template <class Lead>
void CommissionStationOf<Lead>::look_for_end(const EcuListener& ecu, TimeUs now) {
  const auto mode = ecu.mode(now);
  const auto& identity = ecu.identity().said;
  if (sequence().is_done()) {
    end_ = CommissionEnd::kDone;
  } else if (sequence().wrong()) {
    end_ = CommissionEnd::kWrongWay;
  } else if (was_armed_ && mode == EcuMode::kFault) {
    end_ = CommissionEnd::kFault;
    fault_ = stopping_fault(ecu);
  } else if (identity && identity->profile_hash.state == dbc::RawState::kValid &&
             identity->profile_hash.value != setup_.profile_hash) {
    end_ = CommissionEnd::kOtherProfile;
  }
}

template <class Lead>
void CommissionStationOf<Lead>::step(const Hands& hands, Trouble around, const EcuListener& ecu,
                                     TimeUs now) {
  const bool on = deadman_.step(hands.deadman, hands.levers.are_at_rest(),
                                trouble_with(hands, around, setup_.silent_after_us));
  const auto mode = ecu.mode(now);
  const bool heard = lead_.look(ecu, now) && !is_held(ecu);
  moving_ = on && end_ == CommissionEnd::kNone && mode == EcuMode::kActive && heard;
  lead_.step(ecu, moving_, now);
  if (end_ == CommissionEnd::kNone) {
    look_for_end(ecu, now);
  }
  was_armed_ = on ? was_armed_ || is_armed(mode) : was_armed_ && hands.deadman;
  const bool goes_on = on && end_ == CommissionEnd::kNone;
  request_ = {};
  request_.enable = goes_on;
  request_.mode = OperatorMode::kAutomatic;
  request_.task = goes_on && is_armed(mode) ? Task::kCommission : Task::kNone;
  request_.axes.swing_ratio = goes_on ? lead_.swing_duty() : 0.0;
  request_.speed_override_ratio = 1.0;
  tried_ = lead_.tried(goes_on);
}

template <class Lead>
std::string CommissionStationOf<Lead>::end_words() const {
  switch (end_) {
    case CommissionEnd::kNone:
    case CommissionEnd::kDone:
      return "";
    case CommissionEnd::kFault:
      return fmt::format("the controller has stopped: {}. {}", runs::fault_words(fault_),
                         runs::fault_help(fault_));
    case CommissionEnd::kWrongWay:
      return lead_.wrong_text();
    case CommissionEnd::kOtherProfile:
      return "the controller has another profile now";
  }
  return "";
}

template <class Lead>
std::string commission_line(const CommissionStationOf<Lead>& station, const EcuListener& ecu,
                            TimeUs now) {
  const Lead& lead = station.lead();
  const std::size_t at = station.sequence().at();
  const std::string step =
      station.sequence().is_done()
          ? "all done"
          : fmt::format("{} of {}, {}", at + 1, lead.steps(), lead.step_text(at));
  if (station.is_moving()) {
    return step;
  }
  return fmt::format("waiting, {}; then {}", waiting_text(station.deadman(), ecu, now), step);
}

template <class Lead>
std::string result_line(const Lead& lead, std::size_t at) {
  const commission::StepResult result = lead.sequence().results()[at];
  return fmt::format("{}: {}, duty {:.1f} %, {}", lead.step_text(at),
                     commission::end_text(result.end), 100.0 * result.duty, lead.speed_text(at));
}

template class CommissionStationOf<ExcavatorLead>;
template class CommissionStationOf<DozerLead>;
template std::string commission_line(const CommissionStation&, const EcuListener&, TimeUs);
template std::string commission_line(const DozerStation&, const EcuListener&, TimeUs);
template std::string result_line(const ExcavatorLead&, std::size_t);
template std::string result_line(const DozerLead&, std::size_t);

}  // namespace graben::operate
