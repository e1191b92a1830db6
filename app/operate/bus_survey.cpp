// SPDX-License-Identifier: Apache-2.0
#include "app/operate/bus_survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/commission/dozer_plan.hpp"
#include "app/operate/bus_link.hpp"
#include "app/operate/command_frames.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "platform/linux/cyclic_clock.hpp"
#include "platform/linux/process.hpp"

namespace graben::operate {
namespace {

bool is_operators(const dbc::MessageInfo& message) {
  return std::string_view(message.sender) == "Operator";
}

std::string identity_text(const char* who, const dbc::Count& hash, const dbc::Count& version) {
  return fmt::format("{}: profile {:08x}, DBC version {}", who, hash.value, version.value);
}

std::string stroke_text(const char* drive, const std::optional<double>& at_m, double stroke_m) {
  const std::string stroke = at_m ? fmt::format("{:.3f} m", *at_m) : std::string("not heard");
  return fmt::format("{} stroke: {} of {:.3f} m; has to rise as its cylinder extends", drive,
                     stroke, stroke_m);
}

}  // namespace

SurveyedBus surveyed_bus(const ExcavatorProfile& /*profile*/) {
  const auto& all = dbc::excavator::kMessages;
  return {all.data(), all.size(), dbc::excavator::kDbcVersion};
}

SurveyedBus surveyed_bus(const DozerProfile& /*profile*/) {
  const auto& all = dbc::dozer::kMessages;
  return {all.data(), all.size(), dbc::dozer::kDbcVersion};
}

BusSurvey::BusSurvey(const SurveyedBus& bus) : bus_(bus), ecu_(bus.dbc_version) {}

void BusSurvey::hear(const CanFrame& frame, TimeUs now) {
  using Identity = EcuListener::Dbc::MachineIdentity;
  ecu_.hear(frame, now);
  dozer_.hear(frame, now);
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

std::vector<std::string> BusSurvey::common_lines(const std::vector<std::uint32_t>& may_miss,
                                                 double listened_s) const {
  std::vector<std::string> lines;
  std::map<std::uint32_t, int> others = count_;
  for (std::size_t n = 0; n < bus_.count; ++n) {
    const dbc::MessageInfo& message = bus_.first[n];
    others.erase(identity_of(message.id));
    const int heard = count(message.id);
    const bool may = std::find(may_miss.begin(), may_miss.end(), message.id) != may_miss.end();
    if (heard > 0) {
      const double expected = message.cycle_time_ms > 0 ? 1e3 / message.cycle_time_ms : 0.0;
      lines.push_back(fmt::format("{:<18} {:>6.1f} a second, {:g} expected", message.name,
                                  heard / listened_s, expected));
    } else if (!is_operators(message) && !may && message.id != dbc::excavator::DM1::kId) {
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
  return lines;
}

std::vector<std::string> BusSurvey::lines(const ExcavatorProfile& profile, double listened_s,
                                          TimeUs now) const {
  using namespace dbc::excavator;
  const std::vector<std::uint32_t> of_swing = {SwingState::kId, SwingValveState::kId,
                                               SwingCommand::kId};
  std::vector<std::string> lines = common_lines(
      profile.drive_count == kDriveCount ? std::vector<std::uint32_t>{} : of_swing, listened_s);
  const auto strokes_m = ecu_.strokes_m(now);
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    lines.push_back(stroke_text(commission::axis_name(axis), strokes_m[k],
                                profile.geometry.cylinder[k].stroke_m));
  }
  return lines;
}

std::vector<std::string> BusSurvey::lines(const DozerProfile& profile, double listened_s,
                                          TimeUs now) const {
  using namespace dbc::dozer;
  std::vector<std::uint32_t> may_miss;
  if (!profile.tilt.present) {
    may_miss.push_back(TiltState::kId);
  }
  if (!profile.grade.curves()) {
    may_miss.push_back(BodyCourse::kId);
  }
  std::vector<std::string> lines = common_lines(may_miss, listened_s);
  const commission::DozerOptions whole = commission::whole_dozer(profile);
  for (std::size_t drive = 0; drive < (profile.tilt.present ? 2U : 1U); ++drive) {
    lines.push_back(stroke_text(commission::kDozerDrives[drive], dozer_.stroke_m(drive, now),
                                whole.blade.stroke_m[drive]));
  }
  const auto position_m = dozer_.position_m(now);
  lines.push_back(
      position_m ? fmt::format("body: at {:.2f} m; has to rise as it goes forward", *position_m)
                 : std::string("body: its position is not heard"));
  return lines;
}

std::string BusSurvey::common_obstacle(std::uint32_t profile_hash, TimeUs now) const {
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
                       ecu_.dbc_version());
  }
  const dbc::Count& hash = ecu_.identity().said->profile_hash;
  if (hash.value != profile_hash) {
    return fmt::format("the controller has another profile ({:08x}, this one's is {:08x})",
                       hash.value, profile_hash);
  }
  return "";
}

std::string BusSurvey::obstacle(const ExcavatorProfile& /*profile*/, std::uint32_t profile_hash,
                                TimeUs now) const {
  std::string obstacle = common_obstacle(profile_hash, now);
  for (const auto& stroke_m : ecu_.strokes_m(now)) {
    if (obstacle.empty() && !stroke_m) {
      obstacle = "a stroke is not heard, or is not valid";
    }
  }
  return obstacle;
}

std::string BusSurvey::obstacle(const DozerProfile& profile, std::uint32_t profile_hash,
                                TimeUs now) const {
  const std::string obstacle = common_obstacle(profile_hash, now);
  const bool lacks = obstacle.empty() && !dozer_.hears_machine(profile.tilt.present, now);
  return lacks ? "a stroke or the body's pose is not heard, or is not valid" : obstacle;
}

BusSurvey survey_bus(const std::string& interface, const SurveyedBus& bus, double listen_s,
                     TimeUs& end_us) {
  BusLink link(interface, bus.dbc_version);
  BusSurvey survey(bus);
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
