// SPDX-License-Identifier: Apache-2.0
#include "app/operate/bus_survey.hpp"

#include <fmt/format.h>

#include <string_view>

#include "app/commission/commission_plan.hpp"
#include "app/operate/bus_link.hpp"
#include "app/operate/command_frames.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"

namespace graben::operate {
namespace {

/// Seldom or only when there is something to say.
bool may_be_missing(const dbc::MessageInfo& message, bool has_swing) {
  using namespace dbc::excavator;
  const bool of_swing = message.id == SwingState::kId || message.id == SwingValveState::kId ||
                        message.id == SwingCommand::kId;
  return message.id == DM1::kId || (of_swing && !has_swing);
}

bool is_operators(const dbc::MessageInfo& message) {
  return std::string_view(message.sender) == "Operator";
}

std::string identity_text(const char* who, const dbc::Count& hash, const dbc::Count& version) {
  return fmt::format("{}: profile {:08x}, DBC version {}", who, hash.value, version.value);
}

}  // namespace

void BusSurvey::hear(const CanFrame& frame, TimeUs now) {
  using Identity = EcuListener::Dbc::MachineIdentity;
  ecu_.hear(frame, now);
  if (!frame.extended) {
    ++short_ids_;
    return;
  }
  ++count_[identity_of(frame.id)];
  if (same_message(frame.id, Identity::kId) && frame.length == Identity::kLength) {
    machine_.said = Identity::decode(frame.data);
    machine_.at_us = now;
  }
}

int BusSurvey::count(std::uint32_t id) const {
  const auto found = count_.find(identity_of(id));
  return found == count_.end() ? 0 : found->second;
}

std::vector<std::string> BusSurvey::lines(const ExcavatorProfile& profile, double listened_s,
                                          TimeUs now) const {
  std::vector<std::string> lines;
  std::map<std::uint32_t, int> others = count_;
  for (const dbc::MessageInfo& message : EcuListener::Dbc::kMessages) {
    others.erase(identity_of(message.id));
    const int heard = count(message.id);
    const bool has_swing = profile.drive_count == kDriveCount;
    if (heard > 0) {
      const double expected = message.cycle_time_ms > 0 ? 1e3 / message.cycle_time_ms : 0.0;
      lines.push_back(fmt::format("{:<18} {:>6.1f} a second, {:g} expected", message.name,
                                  heard / listened_s, expected));
    } else if (!is_operators(message) && !may_be_missing(message, has_swing)) {
      lines.push_back(fmt::format("{:<18} missing, of {}", message.name, message.sender));
    }
  }
  if (!others.empty() || short_ids_ > 0) {
    lines.push_back(
        fmt::format("{} other ids of 29 bits, {} frames with 11 bits", others.size(), short_ids_));
  }
  if (machine_.said) {
    lines.push_back(
        identity_text("machine", machine_.said->profile_hash, machine_.said->dbc_version));
  }
  if (const auto& said = ecu_.identity().said) {
    lines.push_back(identity_text("controller", said->profile_hash, said->dbc_version));
  }
  const auto strokes_m = ecu_.strokes_m(now);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    const std::string stroke =
        strokes_m[k] ? fmt::format("{:.3f} m", *strokes_m[k]) : std::string("not heard");
    lines.push_back(fmt::format("{} stroke: {} of {:.3f} m; has to rise as its cylinder extends",
                                commission::axis_name(axis), stroke,
                                profile.geometry.cylinder[k].stroke_m));
  }
  return lines;
}

std::string BusSurvey::obstacle(std::uint32_t profile_hash, TimeUs now) const {
  if (const auto other = ecu_.other_station()) {
    return fmt::format(
        "another station sends OperatorCommand (source address {}); two at a time "
        "are none",
        *other);
  }
  if (!ecu_.hears_ecu(now) || !ecu_.identity().said) {
    return "no controller is heard";
  }
  if (const auto version = ecu_.other_version()) {
    return fmt::format("the controller's frames are version {}, this station's {}", *version,
                       EcuListener::Dbc::kDbcVersion);
  }
  const dbc::Count& hash = ecu_.identity().said->profile_hash;
  if (hash.value != profile_hash) {
    return fmt::format("the controller has another profile ({:08x}, this one's is {:08x})",
                       hash.value, profile_hash);
  }
  for (const auto& stroke_m : ecu_.strokes_m(now)) {
    if (!stroke_m) {
      return "a stroke is not heard, or is not valid";
    }
  }
  return "";
}

BusSurvey survey_bus(const std::string& interface, double listen_s, TimeUs& end_us) {
  BusLink link(interface);
  BusSurvey survey;
  end_us = monotonic_now_us();
  link.set_tap([&](const CanFrame& frame) { survey.hear(frame, end_us); });
  CyclicClock clock(CommandFrames::kPeriod_us);
  const TimeUs until_us = end_us + static_cast<TimeUs>(listen_s * 1e6);
  while (end_us < until_us && !stop_requested()) {
    end_us = clock.wait().now_us;
    link.hear(end_us);
  }
  return survey;
}

}  // namespace graben::operate
