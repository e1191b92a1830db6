#include "app/runs/limit_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/machines/axis_names.hpp"
#include "app/runs/fault_text.hpp"

namespace graben::runs {

const ActuatorNames& excavator_actuators() {
  static const ActuatorNames names(machines::kDriveNames.begin(), machines::kDriveNames.end());
  return names;
}

const ActuatorNames& dozer_actuators() {
  static const ActuatorNames names = {"blade"};
  return names;
}

std::string limit_words(const Limit& limit, const ActuatorNames& actuators) {
  const char* actuator = actuators[std::min<std::size_t>(limit.index, actuators.size() - 1)];
  switch (limit.kind) {
    case LimitKind::kNone:
      return "none";
    case LimitKind::kPumpFlow:
      return fmt::format("pump flow: Pump {}", limit.index + 1);
    case LimitKind::kBackFlow:
      return fmt::format("back flow: {}", actuator);
    case LimitKind::kSpoolTravel:
      return fmt::format("spool travel: {}", actuator);
    case LimitKind::kStrokeEnd:
      return fmt::format("stroke end: {}", actuator);
    case LimitKind::kRise:
      return "rise of lambda";
    case LimitKind::kDegraded:
      return fmt::format("slowed: {}", fault_words(static_cast<Fault>(limit.index)));
    case LimitKind::kImplementFlow:
      return "implement flow";
    case LimitKind::kTransmissionFlow:
      return fmt::format("transmission flow: {} track", limit.index == 0 ? "left" : "right");
    case LimitKind::kAhead:
      return "what lies ahead";
    case LimitKind::kOffGrade:
      return "off the grade";
    case LimitKind::kSwingEnd:
      return "swing end";
    case LimitKind::kFence:
      return fmt::format("fence[{}]", limit.index);
    case LimitKind::kOffPath:
      return "behind the plan";
  }
  return "unknown";
}

void LimitCount::add(const Limit& limit) {
  ++cycles_[limit_words(limit, actuators_)];
  ++all_;
}

LimitShares LimitCount::shares() const {
  const auto share = [this](long cycles) {
    return all_ > 0 ? static_cast<double>(cycles) / static_cast<double>(all_) : 0.0;
  };
  const auto none = cycles_.find("none");
  LimitShares shares = {{"none", share(none != cycles_.end() ? none->second : 0)}};
  for (const auto& [name, cycles] : cycles_) {
    if (name != "none") {
      shares.emplace_back(name, share(cycles));
    }
  }
  return shares;
}

}  // namespace graben::runs
