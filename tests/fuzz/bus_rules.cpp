#include "tests/fuzz/bus_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "hal/e2e.hpp"
#include "hal/excavator_transmitter.hpp"

namespace graben::test {
namespace {

namespace bus = dbc::excavator;
using dbc::RawState;

constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
constexpr TimeUs kLate_us = 15 * kMillisecondUs;
constexpr TimeUs kStalled_us = 50 * kMillisecondUs;
/// A duty on the bus has steps of 0.05 per mille.
constexpr double kDutyStep = 5e-5;

const dbc::MessageInfo* own_message(std::uint32_t id) {
  for (const dbc::MessageInfo& message : bus::kMessages) {
    if (message.id == id && std::strcmp(message.sender, "Graben") == 0) {
      return &message;
    }
  }
  return nullptr;
}

/// Name of a signal that says nothing it should; 'not available' is for PumpCommand to say, and for
/// the pilot cut of a process that has not armed yet.
template <class Message>
const char* unsaid(const dbc::Payload& payload) {
  const char* name = nullptr;
  const Message message = Message::decode(payload);
  Message::visit(message, [&name](const dbc::Field& field, const auto& signal) {
    const bool may_miss =
        (Message::kId == bus::PumpCommand::kId || std::strcmp(field.name, "PilotCut") == 0) &&
        signal.state == RawState::kNotAvailable;
    if (signal.state != RawState::kValid && !may_miss) {
      name = field.name;
    }
  });
  return name;
}

template <class... Messages>
const char* unsaid(dbc::MessageList<Messages...>, const CanFrame& frame) {
  const char* name = nullptr;
  ((name = frame.id == Messages::kId ? unsaid<Messages>(frame.data) : name), ...);
  return name;
}

bool is_on(const bus::SpoolCommand& command) {
  return command.enable.value == bus::SpoolCommand::Enable::kOn;
}

std::array<double, kAxisCount> duties(const bus::SpoolCommand& command) {
  return {command.boom_duty_ratio.value, command.arm_duty_ratio.value,
          command.bucket_duty_ratio.value};
}

bool in_motion(EcuMode mode) { return mode == EcuMode::kArmed || mode == EcuMode::kActive; }

}  // namespace

std::string BusRules::check_frame(const CanFrame& frame) {
  const dbc::MessageInfo* message = own_message(frame.id);
  if (message == nullptr || !frame.extended || frame.remote || frame.error || frame.fd ||
      frame.length != message->length) {
    return fmt::format("a frame {:X} that is none of its messages", frame.id);
  }
  if (const char* name = unsaid(bus::AllMessages{}, frame); name != nullptr) {
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

std::string BusRules::may_not_move(const BusCycle& cycle) const {
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

/// Opening a spool has a rate, closing none; the step across the deadband takes no time.
std::string BusRules::check_opening(const bus::SpoolCommand& command, TimeUs now) {
  const double edge = profile_.valve.spool_to_duty.y_first();
  const double elapsed_s = static_cast<double>(now - command_us_) * 1e-6;
  const double most = any_command_ ? profile_.control.spool_rate_ps * elapsed_s : 0.0;
  const std::array<double, kAxisCount> duty = duties(command);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    if (std::abs(duty[i]) > 1.0) {
      return fmt::format("duty {}", duty[i]);
    }
    const double size = std::max(0.0, (std::abs(duty[i]) - edge) / (1.0 - edge));
    const double opening = std::copysign(size, duty[i]);
    const double last = opening * opening_[i] > 0.0 ? std::abs(opening_[i]) : 0.0;
    const double slack = profile_.control.spool_threshold + 2.0 * kDutyStep / (1.0 - edge);
    if (size > last + most + slack) {
      return fmt::format("spool {} opens from {} to {} in {} s", i, opening_[i], opening,
                         elapsed_s);
    }
    opening_[i] = opening;
  }
  return "";
}

std::string BusRules::check_command(const BusCycle& cycle, const CanFrame& frame) {
  const auto command = bus::SpoolCommand::decode(frame.data);
  const bool cuts = command.pilot_cut.value == bus::SpoolCommand::PilotCut::kOn;
  if (is_on(command)) {
    if (const std::string why_not = may_not_move(cycle); !why_not.empty()) {
      return "enable On " + why_not;
    }
    if (cuts || command.pilot_cut.state != RawState::kValid) {
      return "enable On with the pilot cut, or not known";
    }
  } else if (duties(command) != std::array<double, kAxisCount>{}) {
    return "a spool open without enable";
  }
  return check_opening(command, cycle.now);
}

std::string BusRules::check_status(const BusCycle& cycle, const CanFrame& frame) {
  const ExcavatorStatus& inner = cycle.outputs->status;
  if (frame.id == bus::EcuStatus::kId) {
    const auto status = bus::EcuStatus::decode(frame.data);
    if (static_cast<int>(status.mode.value) != static_cast<int>(inner.mode)) {
      return fmt::format("mode {} is called {}", static_cast<int>(inner.mode),
                         static_cast<int>(status.mode.value));
    }
    if (!(status.lambda.value >= 0.0 && status.lambda.value <= 1.0 && inner.lambda >= 0.0 &&
          inner.lambda <= 1.0)) {
      return fmt::format("lambda {}", inner.lambda);
    }
  } else if (frame.id == bus::EcuHealth::kId) {
    const auto why = bus::EcuHealth::decode(frame.data).why_not_armed.value;
    if ((why == 0) != in_motion(inner.mode)) {
      return fmt::format("WhyNotArmed {:X} in mode {}", why, static_cast<int>(inner.mode));
    }
  }
  return "";
}

/// Whatever ended motion, the operator lets go before there is any again, and it begins at rest.
std::string BusRules::check_arming(const BusCycle& cycle) {
  const EcuMode last = mode_;
  mode_ = cycle.outputs->status.mode;
  if (!in_motion(mode_)) {
    return "";
  }
  const bool released = cycle.released_us >= motion_us_;
  motion_us_ = cycle.now;
  if (in_motion(last)) {
    return "";
  }
  return mode_ == EcuMode::kActive ? "Active without having been Armed"
         : released                ? ""
                                   : "Armed without enable released";
}

std::string BusRules::check(const BusCycle& cycle) {
  late_ = cycle.elapsed_us > kLate_us ? late_ + 1 : 0;
  if (cycle.sent->size() > ExcavatorTransmitter::kMessageCount) {
    return fmt::format("{} frames in a cycle", cycle.sent->size());
  }
  const SentFrame* command = nullptr;
  const SentFrame* pump = nullptr;
  std::string wrong = check_arming(cycle);
  for (std::size_t i = 0; i < cycle.sent->size() && wrong.empty(); ++i) {
    const SentFrame& sent = (*cycle.sent)[i];
    for (std::size_t j = 0; j < i; ++j) {
      if ((*cycle.sent)[j].frame.id == sent.frame.id) {
        return fmt::format("two frames {:X} in a cycle", sent.frame.id);
      }
    }
    command = sent.frame.id == bus::SpoolCommand::kId ? &sent : command;
    pump = sent.frame.id == bus::PumpCommand::kId ? &sent : pump;
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
  if (wrong.empty() && pump != nullptr) {
    const auto swash = bus::PumpCommand::decode(pump->frame.data);
    const bool moves = is_on(bus::SpoolCommand::decode(command->frame.data));
    if ((swash.pump1_swash_ratio.state == RawState::kValid) != moves ||
        (swash.pump2_swash_ratio.state == RawState::kValid) != moves) {
      return "a swash without enable, or none with it";
    }
  }
  return wrong;
}

}  // namespace graben::test
