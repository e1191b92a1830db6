// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bus_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "hal/link/e2e.hpp"
#include "tests/fuzz/dozer_bus.hpp"
#include "tests/fuzz/excavator_bus.hpp"

namespace graben::test {
namespace {

using dbc::RawState;

constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
constexpr TimeUs kLate_us = 15 * kMillisecondUs;
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;
/// A duty on the bus has steps of 0.05 per mille.
constexpr double kDutyStep = 5e-5;

template <class Kind>
const dbc::MessageInfo* own_message(std::uint32_t id) {
  for (const dbc::MessageInfo& message : Kind::Dbc::kMessages) {
    if (message.id == id && std::strcmp(message.sender, "Graben") == 0) {
      return &message;
    }
  }
  return nullptr;
}

/// Of a process that has not armed yet the pilot cut says nothing, of the shipped dozer a tilt.
bool says_nothing(const char* field) {
  constexpr const char* kFields[] = {"PilotCut", "TiltDuty", "WantedTiltVelocity", "CrossError"};
  return std::any_of(std::begin(kFields), std::end(kFields),
                     [field](const char* name) { return std::strcmp(field, name) == 0; });
}

/// Name of a signal that says nothing it should; 'not available' is for some commands to say.
template <class Kind, class Message>
const char* unsaid(const dbc::Payload& payload) {
  const char* name = nullptr;
  const Message message = Message::decode(payload);
  Message::visit(message, [&name](const dbc::Field& field, const auto& signal) {
    const bool may_miss = (Kind::may_miss(Message::kId) || says_nothing(field.name)) &&
                          signal.state == RawState::kNotAvailable;
    if (signal.state != RawState::kValid && !may_miss) {
      name = field.name;
    }
  });
  return name;
}

template <class Kind, class... Messages>
const char* unsaid(dbc::MessageList<Messages...>, const CanFrame& frame) {
  const char* name = nullptr;
  ((name = frame.id == Messages::kId ? unsaid<Kind, Messages>(frame.data) : name), ...);
  return name;
}

template <class SpoolCommand>
bool is_on(const SpoolCommand& command) {
  return command.enable.value == SpoolCommand::Enable::kOn;
}

bool armed_or_active(EcuMode mode) { return mode == EcuMode::kArmed || mode == EcuMode::kActive; }

}  // namespace

template <class Kind>
std::string BusRules<Kind>::check_frame(const CanFrame& frame) {
  const dbc::MessageInfo* message = own_message<Kind>(frame.id);
  if (message == nullptr || !frame.extended || frame.remote || frame.error || frame.fd ||
      frame.length != message->length) {
    return fmt::format("a frame {:X} that is none of its messages", frame.id);
  }
  if (const char* name = unsaid<Kind>(typename Kind::Dbc::AllMessages{}, frame); name != nullptr) {
    return fmt::format("{} of {} has no value", name, message->name);
  }
  if (!message->is_protected) {
    return "";
  }
  if (!e2e_crc_fits(frame.data, message->data_id)) {
    return fmt::format("CRC of {}", message->name);
  }
  const int counter = frame.data[1] & 0x0F;
  const auto [last, is_first] = counter_.try_emplace(frame.id, counter);
  if (counter >= kE2eCounterCount ||
      (!is_first && counter != (last->second + 1) % kE2eCounterCount)) {
    return fmt::format("counter {} of {} after {}", counter, message->name, last->second);
  }
  last->second = counter;
  return "";
}

template <class Kind>
std::string BusRules<Kind>::may_not_move(const BusCycle<Kind>& cycle) const {
  if (cycle.outputs->status.mode != EcuMode::kActive) {
    return fmt::format("in mode {}", static_cast<int>(cycle.outputs->status.mode));
  }
  if (!cycle.bus_active) {
    return "on a bus that is not active";
  }
  if (cycle.against_motion[0] != '\0') {
    return fmt::format("against {}", cycle.against_motion);
  }
  if (refused_ >= 2) {
    return "on a bus that does not take it";
  }
  return cycle.elapsed_us > kStalled_us || late_ >= 2 ? "in a late cycle" : "";
}

/// A led spool is only about where the duties say: they come in steps, late, or not at all.
constexpr double kLedSlack = 0.3;

/// Opening a spool has a rate, closing none; the step across the deadband takes no time. Of a spool
/// that is led this holds for where its duty takes it; beyond full duty that comes later.
template <class Kind>
std::string BusRules<Kind>::check_opening(const typename Kind::Dbc::SpoolCommand& command,
                                          TimeUs now) {
  const double edge = Kind::duty_edge(profile_);
  const double elapsed_s = static_cast<double>(now - command_us_) * 1e-6;
  const double most = any_command_ ? profile_.control.spool_rate_ps * elapsed_s : 0.0;
  const auto duty = Kind::duties(command);
  const double time_constant_s = Kind::spool_time_constant_s(profile_);
  for (unsigned i = 0; i < Kind::kSpools; ++i) {
    if (std::abs(duty[i]) > 1.0) {
      return fmt::format("duty {}", duty[i]);
    }
    const double from = duty[i] * duty_[i] > 0.0 ? std::abs(duty_[i]) : 0.0;
    const double rise = any_command_ ? profile_.control.duty_rate_ps * elapsed_s : 0.0;
    if (std::abs(duty[i]) > from + rise + kDutyStep) {
      return fmt::format("duty {} from {} to {} in {} s", i, duty_[i], duty[i], elapsed_s);
    }
    duty_[i] = duty[i];
    const bool is_led = i < Kind::kLed && time_constant_s > 0.0;
    if (is_led && std::abs(elapsed_s - 0.01) > 0.001) {
      led_[i].miss();
    }
    const double goal = is_led ? led_[i].aim(duty[i], time_constant_s) : duty[i];
    const double size = std::max(0.0, (std::abs(goal) - edge) / (1.0 - edge));
    const double opening = std::copysign(size, goal);
    if (is_led && (!led_[i].is_known() || std::abs(duty[i]) > 1.0 - kDutyStep)) {
      opening_[i] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    if (std::isnan(opening_[i])) {
      opening_[i] = opening;
    }
    const double last = opening * opening_[i] > 0.0 ? std::abs(opening_[i]) : 0.0;
    const double slack = profile_.control.spool_threshold + 2.0 * kDutyStep / (1.0 - edge);
    if (size > last + most + slack + (is_led ? kLedSlack : 0.0)) {
      return fmt::format("spool {} opens from {} to {} in {} s", i, opening_[i], opening,
                         elapsed_s);
    }
    opening_[i] = opening;
  }
  return "";
}

template <class Kind>
std::string BusRules<Kind>::check_command(const BusCycle<Kind>& cycle, const CanFrame& frame) {
  const auto command = Kind::Dbc::SpoolCommand::decode(frame.data);
  const bool cuts = command.pilot_cut.value == Kind::Dbc::SpoolCommand::PilotCut::kOn;
  if (is_on(command)) {
    if (const std::string why_not = may_not_move(cycle); !why_not.empty()) {
      return "enable On " + why_not;
    }
    if (cuts || command.pilot_cut.state != RawState::kValid) {
      return "enable On with the pilot cut, or not known";
    }
  } else if (Kind::duties(command) != std::array<double, Kind::kSpools>{}) {
    return "a spool open without enable";
  }
  if (!is_on(command)) {
    led_ = {};
  }
  return check_opening(command, cycle.now);
}

template <class Kind>
std::string BusRules<Kind>::check_status(const BusCycle<Kind>& cycle, const CanFrame& frame) {
  const MachineStatus& inner = cycle.outputs->status;
  if (frame.id == Kind::Dbc::EcuStatus::kId) {
    const auto status = Kind::Dbc::EcuStatus::decode(frame.data);
    if (static_cast<int>(status.mode.value) != static_cast<int>(inner.mode)) {
      return fmt::format("mode {} is called {}", static_cast<int>(inner.mode),
                         static_cast<int>(status.mode.value));
    }
    if (!(status.lambda.value >= 0.0 && status.lambda.value <= 1.0 && inner.lambda >= 0.0 &&
          inner.lambda <= 1.0)) {
      return fmt::format("lambda {}", inner.lambda);
    }
  } else if (frame.id == Kind::Dbc::EcuHealth::kId) {
    const auto why = Kind::Dbc::EcuHealth::decode(frame.data).why_not_armed.value;
    if ((why == 0) != armed_or_active(inner.mode)) {
      return fmt::format("WhyNotArmed {:X} in mode {}", why, static_cast<int>(inner.mode));
    }
  }
  return "";
}

/// Whatever ended motion, the operator lets go before there is any again, and it begins at rest.
template <class Kind>
std::string BusRules<Kind>::check_arming(const BusCycle<Kind>& cycle) {
  const EcuMode last = mode_;
  mode_ = cycle.outputs->status.mode;
  if (!armed_or_active(mode_)) {
    return "";
  }
  const bool released = cycle.released_us >= motion_us_;
  motion_us_ = cycle.now;
  if (armed_or_active(last)) {
    return "";
  }
  return mode_ == EcuMode::kActive ? "Active without having been Armed"
         : released                ? ""
                                   : "Armed without enable released";
}

template <class Kind>
std::string BusRules<Kind>::check(const BusCycle<Kind>& cycle) {
  late_ = cycle.elapsed_us > kLate_us ? late_ + 1 : 0;
  if (cycle.sent->size() > Kind::kMostFrames) {
    return fmt::format("{} frames in a cycle", cycle.sent->size());
  }
  const SentFrame* command = nullptr;
  std::string wrong = check_arming(cycle);
  for (std::size_t i = 0; i < cycle.sent->size() && wrong.empty(); ++i) {
    const SentFrame& sent = (*cycle.sent)[i];
    for (std::size_t j = 0; j < i; ++j) {
      if ((*cycle.sent)[j].frame.id == sent.frame.id) {
        return fmt::format("two frames {:X} in a cycle", sent.frame.id);
      }
    }
    command = sent.frame.id == Kind::Dbc::SpoolCommand::kId ? &sent : command;
    wrong = check_frame(sent.frame);
    wrong = wrong.empty() ? check_status(cycle, sent.frame) : wrong;
  }
  if (!wrong.empty()) {
    return wrong;
  }
  if (command == nullptr) {
    const bool due = !any_command_ || cycle.now - command_us_ >= kPeriod_us;
    return due ? "a cycle without SpoolCommand" : "";
  }
  wrong = check_command(cycle, command->frame);
  any_command_ = true;
  command_us_ = cycle.now;
  refused_ = command->taken ? 0 : refused_ + 1;
  if (wrong.empty()) {
    const bool moves = is_on(Kind::Dbc::SpoolCommand::decode(command->frame.data));
    wrong = others_.check(*cycle.sent, moves, cycle.now);
  }
  return wrong;
}

template class BusRules<ExcavatorBus>;
template class BusRules<DozerBus>;

}  // namespace graben::test
