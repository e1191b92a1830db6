#include "tests/faults/bus_record.hpp"

#include <algorithm>
#include <cmath>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "hal/dm1.hpp"

namespace graben::faults {
namespace {

namespace bus = dbc::excavator;
using dbc::RawState;

BusRecord::Command command_of(const CanFrame& frame) {
  const bus::SpoolCommand message = bus::SpoolCommand::decode(frame.data);
  BusRecord::Command command;
  command.at_us = frame.stamp_us;
  // What does not decode as Off counts as On.
  command.enable = message.enable.state != RawState::kValid ||
                   message.enable.value != bus::SpoolCommand::Enable::kOff;
  command.pilot_cut = message.pilot_cut.state == RawState::kValid &&
                      message.pilot_cut.value == bus::SpoolCommand::PilotCut::kOn;
  command.neutral = true;
  for (const dbc::Physical& duty :
       {message.boom_duty_ratio, message.arm_duty_ratio, message.bucket_duty_ratio}) {
    command.neutral = command.neutral && duty.state == RawState::kValid && duty.value == 0.0;
  }
  return command;
}

BusRecord::Status status_of(const CanFrame& frame) {
  const bus::EcuStatus message = bus::EcuStatus::decode(frame.data);
  return {frame.stamp_us,
          static_cast<EcuMode>(message.mode.value),
          static_cast<Fault>(message.fault.value),
          {static_cast<LimitKind>(message.limit_kind.value),
           static_cast<std::uint8_t>(message.limit_index.value)}};
}

BusRecord::Trouble trouble_of(const CanFrame& frame) {
  const bus::DM1 message = bus::DM1::decode(frame.data);
  constexpr unsigned kLowBits = 16;
  const std::uint32_t spn = message.spn_low.value | (message.spn_high.value << kLowBits);
  const bool is_ours = spn >= kDm1FirstSpn && spn < kDm1FirstSpn + kFaultCount;
  return {frame.stamp_us, is_ours ? static_cast<Fault>(spn - kDm1FirstSpn) : Fault::kNone};
}

double speed_of(const CanFrame& frame) {
  const bus::EcuMotion message = bus::EcuMotion::decode(frame.data);
  return std::hypot(message.boom_wanted_velocity_mps.value, message.arm_wanted_velocity_mps.value,
                    message.bucket_wanted_velocity_mps.value);
}

}  // namespace

void BusRecord::see(const CanFrame& frame, bool from_controller) {
  if (!from_controller) {
    last_us[frame.id] = frame.stamp_us;
    return;
  }
  switch (frame.id) {
    case bus::SpoolCommand::kId:
      commands.push_back(command_of(frame));
      break;
    case bus::EcuStatus::kId:
      statuses.push_back(status_of(frame));
      break;
    case bus::DM1::kId:
      troubles.push_back(trouble_of(frame));
      break;
    case bus::EcuHealth::kId:
      refusals.push_back({frame.stamp_us, bus::EcuHealth::decode(frame.data).why_not_armed.value});
      break;
    case bus::EcuMotion::kId:
      wanted.push_back({frame.stamp_us, speed_of(frame)});
      break;
    default:
      break;
  }
}

bool BusRecord::status_named(Fault fault, TimeUs since_us) const {
  return std::any_of(statuses.begin(), statuses.end(), [=](const Status& status) {
    return status.at_us >= since_us && status.fault == fault;
  });
}

bool BusRecord::dm1_named(Fault fault, TimeUs since_us, TimeUs until_us) const {
  return std::any_of(troubles.begin(), troubles.end(), [=](const Trouble& trouble) {
    return trouble.at_us >= since_us && trouble.at_us <= until_us && trouble.fault == fault;
  });
}

bool BusRecord::any_fault(TimeUs since_us) const {
  const auto is_fault = [since_us](const auto& said) {
    return said.at_us >= since_us && said.fault != Fault::kNone;
  };
  return std::any_of(statuses.begin(), statuses.end(), is_fault) ||
         std::any_of(troubles.begin(), troubles.end(), is_fault);
}

bool BusRecord::all_neutral(TimeUs since_us) const {
  return std::all_of(commands.begin(), commands.end(), [=](const Command& command) {
    return command.at_us < since_us || command.is_neutral();
  });
}

bool BusRecord::any_pilot_cut(TimeUs since_us) const {
  return std::any_of(commands.begin(), commands.end(), [=](const Command& command) {
    return command.at_us >= since_us && command.pilot_cut;
  });
}

TimeUs BusRecord::first_neutral_us(TimeUs since_us) const {
  const auto first = std::find_if(commands.begin(), commands.end(), [=](const Command& command) {
    return command.at_us >= since_us && command.is_neutral();
  });
  return first == commands.end() ? -1 : first->at_us;
}

}  // namespace graben::faults
