// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/bus_record.hpp"

#include <algorithm>

#include "hal/link/dm1.hpp"
#include "tests/faults/dozer_kind.hpp"
#include "tests/faults/excavator_kind.hpp"

namespace graben::faults {
namespace {

template <class EcuStatus>
BusRecord::Status status_of(const CanFrame& frame) {
  const EcuStatus message = EcuStatus::decode(frame.data);
  return {frame.stamp_us,
          static_cast<EcuMode>(message.mode.value),
          static_cast<Fault>(message.fault.value),
          {static_cast<LimitKind>(message.limit_kind.value),
           static_cast<std::uint8_t>(message.limit_index.value)}};
}

template <class TroubleCodes>
BusRecord::Trouble trouble_of(const CanFrame& frame) {
  const TroubleCodes message = TroubleCodes::decode(frame.data);
  constexpr unsigned kLowBits = 16;
  const std::uint32_t spn = message.spn_low.value | (message.spn_high.value << kLowBits);
  const bool is_ours = spn >= kDm1FirstSpn && spn < kDm1FirstSpn + kFaultCount;
  return {frame.stamp_us, is_ours ? static_cast<Fault>(spn - kDm1FirstSpn) : Fault::kNone};
}

}  // namespace

template <class Kind>
void BusRecord::see_command(const CanFrame& frame) {
  Command command;
  command.at_us = frame.stamp_us;
  if (!commands.empty() && commands.back().at_us == frame.stamp_us) {
    command = commands.back();
    commands.pop_back();
  }
  if (Kind::read_command(frame, command)) {
    ++command.frames;
  }
  if (command.frames > 0) {
    commands.push_back(command);
  }
}

template <class Kind>
void BusRecord::see(const CanFrame& frame, bool from_controller) {
  if (!from_controller) {
    last_us[frame.id] = frame.stamp_us;
    return;
  }
  see_command<Kind>(frame);
  if (several_.hear(frame, frame.stamp_us)) {
    const j1939::LongMessage& all = several_.message();
    for (std::size_t i = 0; i < j1939::codes_of(all); ++i) {
      troubles.push_back(trouble_of<typename Kind::Dbc::DM1>(
          j1939::single_code(all, i, kOwnAddress, frame.stamp_us)));
    }
  }
  switch (frame.id) {
    case Kind::Dbc::EcuStatus::kId:
      statuses.push_back(status_of<typename Kind::Dbc::EcuStatus>(frame));
      break;
    case Kind::Dbc::DM1::kId:
      troubles.push_back(trouble_of<typename Kind::Dbc::DM1>(frame));
      break;
    case Kind::Dbc::EcuHealth::kId:
      refusals.push_back(
          {frame.stamp_us, Kind::Dbc::EcuHealth::decode(frame.data).why_not_armed.value});
      break;
    case Kind::Dbc::EcuMotion::kId:
      wanted.push_back({frame.stamp_us, Kind::wanted_mps(frame)});
      break;
    default:
      break;
  }
}

template void BusRecord::see<Excavator>(const CanFrame& frame, bool from_controller);
template void BusRecord::see<Dozer>(const CanFrame& frame, bool from_controller);

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

TimeUs BusRecord::first_neutral_us(TimeUs since_us, int frames) const {
  const auto first = std::find_if(commands.begin(), commands.end(), [=](const Command& command) {
    return command.at_us >= since_us && command.frames == frames && command.is_neutral();
  });
  return first == commands.end() ? -1 : first->at_us;
}

TimeUs BusRecord::first_brake_us(TimeUs since_us) const {
  const auto first = std::find_if(commands.begin(), commands.end(), [=](const Command& command) {
    return command.at_us >= since_us && command.brake;
  });
  return first == commands.end() ? -1 : first->at_us;
}

}  // namespace graben::faults
