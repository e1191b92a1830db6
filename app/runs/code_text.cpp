// SPDX-License-Identifier: Apache-2.0
#include "app/runs/code_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/machines/axis_names.hpp"
#include "app/runs/generated/code_texts.hpp"

namespace graben::runs {

const ActuatorNames& excavator_actuators() {
  static const ActuatorNames names(machines::kDriveNames.begin(), machines::kDriveNames.end());
  return names;
}

const ActuatorNames& dozer_actuators() {
  static const ActuatorNames names = {"blade"};
  return names;
}

namespace {

std::string owner_words(LimitOf of, unsigned index, const ActuatorNames& actuators) {
  switch (of) {
    case LimitOf::kNothing:
      return "";
    case LimitOf::kPump:
      return fmt::format(": Pump {}", index + 1);
    case LimitOf::kDrive:
      return fmt::format(": {}", actuators[std::min<std::size_t>(index, actuators.size() - 1)]);
    case LimitOf::kFault:
      return fmt::format(": {}", fault_words(static_cast<Fault>(index)));
    case LimitOf::kTrack:
      return index == 0 ? ": left track" : ": right track";
    case LimitOf::kFence:
      return fmt::format("[{}]", index);
    case LimitOf::kSource:
      return fmt::format(": source {}", index);
  }
  return "";
}

/// CiA 301, emergency error codes: by the high byte, or its high half.
const char* emergency_class(std::uint16_t code) {
  switch (code >> 12U) {
    case 0x2:
      return "current";
    case 0x3:
      return "voltage";
    case 0x4:
      return "temperature";
    case 0x5:
      return "device hardware";
    case 0x6:
      return "device software";
    case 0x7:
      return "additional modules";
    case 0x8:
      return "monitoring, communication";
    case 0x9:
      return "external error";
    case 0xF:
      return (code >> 8U) == 0xFF ? "device specific" : "additional functions";
    default:
      return "generic error";
  }
}

/// The row with this number, or null.
template <class Row, std::size_t count, class Code>
const Row* row_of(const std::array<Row, count>& rows, Code code) {
  const auto number = static_cast<std::size_t>(code);
  return number < count ? &rows[number] : nullptr;
}

}  // namespace

std::string emergency_words(const NodeEmergency& emergency) {
  if (emergency.id == 0) {
    return "";
  }
  return fmt::format(", node {} has emergency {:04X}h ({})", emergency.id, emergency.code,
                     emergency_class(emergency.code));
}

const char* fault_words(Fault fault) {
  const FaultText* row = row_of(kFaultTexts, fault);
  return row != nullptr ? row->text : "unknown";
}

const char* fault_help(Fault fault) {
  const FaultText* row = row_of(kFaultTexts, fault);
  return row != nullptr ? row->help : "";
}

const char* pilot_words(Fault fault) {
  const FaultText* row = row_of(kFaultTexts, fault);
  switch (row != nullptr ? row->pilot : PilotAfter::kStays) {
    case PilotAfter::kStays:
      break;
    case PilotAfter::kLater:
      return "The pilot pressure goes 1 s later; it is back in Manual with enable released, or "
             "armed "
             "again.";
    case PilotAfter::kAtOnce:
      return "The pilot pressure goes at once; it is back in Manual with enable released, or armed "
             "again.";
    case PilotAfter::kKept:
      return "The pilot pressure goes at once and is back only when armed again.";
    case PilotAfter::kByMotion:
      return "The pilot pressure goes at once; after motion it is back only when armed again.";
  }
  return "";
}

const char* mode_words(EcuMode mode) {
  switch (mode) {
    case EcuMode::kSilent:
      return "Silent";
    case EcuMode::kReady:
      return "Ready";
    case EcuMode::kArmed:
      return "Armed";
    case EcuMode::kActive:
      return "Active";
    case EcuMode::kStopping:
      return "Stopping";
    case EcuMode::kFault:
      return "Fault";
  }
  return "unknown";
}

const char* arm_block_words(ArmBlock block) {
  const char* const* row = row_of(kArmBlockTexts, block);
  return row != nullptr ? *row : "unknown";
}

std::string limit_words(const Limit& limit, const ActuatorNames& actuators) {
  const LimitText* row = row_of(kLimitTexts, limit.kind);
  return row != nullptr ? row->text + owner_words(row->of, limit.index, actuators) : "unknown";
}

void LimitCount::add(const Limit& limit, double held_s) {
  for (Held* to : {&held_[limit_words(limit, actuators_)], &all_}) {
    to->time_s += held_s;
    ++to->frames;
  }
}

LimitShares LimitCount::shares() const {
  const auto share = [this](const Held& held) {
    // A single frame has no time before it.
    return all_.time_s > 0.0 ? held.time_s / all_.time_s
           : all_.frames > 0 ? static_cast<double>(held.frames) / static_cast<double>(all_.frames)
                             : 0.0;
  };
  const auto none = held_.find("none");
  LimitShares shares = {{"none", share(none != held_.end() ? none->second : Held{})}};
  for (const auto& [name, held] : held_) {
    if (name != "none") {
      shares.emplace_back(name, share(held));
    }
  }
  return shares;
}

}  // namespace graben::runs
