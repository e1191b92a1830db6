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

CommissionStation::CommissionStation(const CommissionSetup& setup)
    : setup_(setup), sequence_(setup.sequence) {
  sequence_.resume(setup.done);
  tried_.window = setup.sequence.window;
  tried_.has_window = setup.sequence.drives;
}

bool CommissionStation::hears_strokes(const EcuListener& ecu, TimeUs now) {
  const auto strokes_m = ecu.strokes_m(now);
  for (std::size_t k = 0; k < strokes_m.size(); ++k) {
    stroke_m_[k] = strokes_m[k].value_or(stroke_m_[k]);
  }
  const auto swing_rad = ecu.swing_rad(now);
  swing_rad_ = swing_rad.value_or(swing_rad_);
  return (swing_rad || !setup_.sequence.swing) &&
         std::all_of(strokes_m.begin(), strokes_m.end(),
                     [](const auto& stroke_m) { return stroke_m.has_value(); });
}

/// The sequence stops before the controller has to, but where it touches an end: this one misses
/// the window.
bool CommissionStation::is_held(const EcuListener& ecu) {
  constexpr double kPeriod_s = 0.01;
  constexpr double kHeld_s = 0.2;
  const auto& status = ecu.status().said;
  const bool touches = !sequence_.is_done() &&
                       sequence_.steps()[sequence_.at()].kind == commission::StepKind::kTouch;
  const bool held = moving_ && !touches && status &&
                    static_cast<LimitKind>(status->limit_kind.value) == LimitKind::kStrokeEnd;
  held_s_ = held ? held_s_ + kPeriod_s : 0.0;
  return held_s_ > kHeld_s;
}

void CommissionStation::look_for_end(const EcuListener& ecu, TimeUs now) {
  const auto mode = ecu.mode(now);
  const auto& identity = ecu.identity().said;
  if (sequence_.is_done()) {
    end_ = CommissionEnd::kDone;
  } else if (sequence_.wrong()) {
    end_ = CommissionEnd::kWrongWay;
  } else if (was_armed_ && mode == EcuMode::kFault) {
    end_ = CommissionEnd::kFault;
    fault_ = stopping_fault(ecu);
  } else if (identity && identity->profile_hash.state == dbc::RawState::kValid &&
             identity->profile_hash.value != setup_.profile_hash) {
    end_ = CommissionEnd::kOtherProfile;
  }
}

void CommissionStation::step(const Hands& hands, Trouble around, const EcuListener& ecu,
                             TimeUs now) {
  const bool on = deadman_.step(hands.deadman, hands.levers.are_at_rest(),
                                trouble_with(hands, around, setup_.silent_after_us));
  const auto mode = ecu.mode(now);
  const bool heard = hears_strokes(ecu, now) && !is_held(ecu);
  moving_ = on && end_ == CommissionEnd::kNone && mode == EcuMode::kActive && heard;
  sequence_.step(static_cast<double>(now) * 1e-6,
                 {stroke_m_, ecu.sent_ratio(), moving_, swing_rad_, ecu.swing_sent_ratio()});
  if (end_ == CommissionEnd::kNone) {
    look_for_end(ecu, now);
  }
  was_armed_ = on ? was_armed_ || is_armed(mode) : was_armed_ && hands.deadman;
  const bool goes_on = on && end_ == CommissionEnd::kNone;
  request_ = {};
  request_.enable = goes_on;
  request_.mode = OperatorMode::kAutomatic;
  request_.task = goes_on && is_armed(mode) ? Task::kCommission : Task::kNone;
  request_.axes.swing_ratio = goes_on ? sequence_.swing_duty() : 0.0;
  request_.speed_override_ratio = 1.0;
  tried_.duty_ratio = {};
  if (goes_on) {
    tried_.duty_ratio = sequence_.duty();
  }
}

std::string CommissionStation::end_words() const {
  switch (end_) {
    case CommissionEnd::kNone:
    case CommissionEnd::kDone:
      return "";
    case CommissionEnd::kFault:
      return fmt::format("the controller has stopped: {}. {}", runs::fault_words(fault_),
                         runs::fault_help(fault_));
    case CommissionEnd::kWrongWay:
      return commission::wrong_text(*sequence_.wrong());
    case CommissionEnd::kOtherProfile:
      return "the controller has another profile now";
  }
  return "";
}

std::string commission_line(const CommissionStation& station, const EcuListener& ecu, TimeUs now) {
  const auto& sequence = station.sequence();
  const std::string step =
      sequence.is_done() ? "all done"
                         : fmt::format("{} of {}, {}", sequence.at() + 1, sequence.steps().size(),
                                       commission::step_text(sequence.steps()[sequence.at()]));
  if (station.is_moving()) {
    return step;
  }
  return fmt::format("waiting, {}; then {}", waiting_text(station.deadman(), ecu, now), step);
}

std::string result_line(const commission::CommissionSequence& sequence, std::size_t at) {
  const commission::StepResult& result = sequence.results()[at];
  return fmt::format("{}: {}, duty {:.1f} %, {}", commission::step_text(sequence.steps()[at]),
                     commission::end_text(result.end), 100.0 * result.duty,
                     commission::speed_text(sequence.steps()[at], result));
}

}  // namespace graben::operate
