// SPDX-License-Identifier: Apache-2.0
// What the page draws a machine by that tells its links on a bus of its own.
#include "app/reports/page_setup.hpp"
#include "hal/buses/bus_table.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

/// Null: it says nothing of where a link is.
const char* told_by(SourcePlace place) {
  switch (place) {
    case SourcePlace::kStroke:
      return "stroke";
    case SourcePlace::kJointAngle:
      return "joint_angle";
    case SourcePlace::kSlope:
      return "slope";
    default:
      return nullptr;
  }
}

json signal_json(const TableSource& source) {
  return {{"tells", told_by(source.place)},
          {"of", source.index},
          {"start", source.bits.start_bit},
          {"width", source.bits.width},
          {"motorola", source.bits.motorola},
          {"signed", source.bits.is_signed},
          {"scale", source.scale},
          {"offset", source.offset},
          {"least", source.least},
          {"most", source.most}};
}

}  // namespace

json bus_json(const BusTable& bus) {
  json messages = json::array();
  for (std::size_t i = 0; i < bus.message_count; ++i) {
    json signals = json::array();
    const std::size_t first = bus.message[i].first;
    for (std::size_t k = first; k < first + bus.message[i].count; ++k) {
      if (told_by(bus.source[k].place) != nullptr) {
        signals.push_back(signal_json(bus.source[k]));
      }
    }
    if (!signals.empty()) {
      messages.push_back({{"id", bus.rule[i].id},
                          {"extended", bus.rule[i].extended},
                          {"length", bus.rule[i].length},
                          {"signals", signals}});
    }
  }
  return {{"messages", messages}};
}

}  // namespace graben::reports
