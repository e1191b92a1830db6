// SPDX-License-Identifier: Apache-2.0
#include "app/design/station_count.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace graben::design {
namespace {

constexpr double kSame_m = 1e-3;
/// What files round stations to, beside lengths of their own.
constexpr double kApart_m = 0.05;

}  // namespace

StationCount::StationCount(const LandXmlFile& xml, const pugi::xml_node& alignment, double length_m)
    : xml_(xml), alignment_(alignment) {
  const double start_m = said_m(alignment, "staStart").value_or(0.0);
  stretch_.push_back({0.0, length_m, start_m, 1.0});
  for (const pugi::xml_node& equation : alignment.children("StaEquation")) {
    add(equation, start_m);
  }
}

/// None where the attribute is not there.
std::optional<double> StationCount::said_m(const pugi::xml_node& node, const char* name) const {
  const pugi::xml_attribute said = node.attribute(name);
  const auto value = number_of<double>(said.value());
  if (said && !value) {
    xml_.refuse(node, fmt::format("{}=\"{}\"; allowed: a number", name, said.value()));
  }
  return value ? std::optional(*value * xml_.metres()) : std::nullopt;
}

void StationCount::add(const pugi::xml_node& equation, double start_m) {
  Stretch& last = stretch_.back();
  const auto ahead_m = said_m(equation, "staAhead");
  const auto back_m = said_m(equation, "staBack");
  const auto internal_m = said_m(equation, "staInternal");
  if (!ahead_m || !(back_m || internal_m)) {
    xml_.refuse(equation, "needs staAhead, and staInternal or staBack");
  }
  const double at_m =
      internal_m ? *internal_m - start_m : last.begin_m + last.side * (*back_m - last.station_m);
  if (!(at_m >= last.begin_m - kSame_m && at_m <= last.end_m + kSame_m)) {
    xml_.refuse(
        equation,
        fmt::format("lies {:.3f} m from the alignment's begin; allowed: behind the equation "
                    "before, {:.3f} .. {:.3f} m",
                    at_m, last.begin_m, last.end_m));
  }
  if (back_m && std::abs(*back_m - last.at_m(at_m)) > kApart_m) {
    xml_.refuse(equation,
                fmt::format("staBack {:.3f} m, where {:.3f} m is counted to there; allowed: the "
                            "same",
                            *back_m, last.at_m(at_m)));
  }
  const std::string_view way = equation.attribute("staIncrement").value();
  if (!way.empty() && way != "increasing" && way != "decreasing") {
    xml_.refuse(equation, fmt::format("staIncrement=\"{}\"; allowed: increasing, decreasing", way));
  }
  const Stretch next{at_m, last.end_m, *ahead_m, way == "decreasing" ? -1.0 : 1.0};
  last.end_m = at_m;
  stretch_.push_back(next);
}

std::string StationCount::stretches() const {
  std::string text;
  for (const Stretch& each : stretch_) {
    text += fmt::format("{}{:.3f} .. {:.3f}", text.empty() ? "" : ", ", each.station_m,
                        each.at_m(each.end_m));
  }
  return text + " m";
}

double StationCount::distance_m(double station_m) const {
  std::vector<double> place_m;
  for (const Stretch& each : stretch_) {
    const double at_m = each.begin_m + each.side * (station_m - each.station_m);
    const bool is_new = place_m.empty() || std::abs(place_m.back() - at_m) > kSame_m;
    if (at_m >= each.begin_m - kSame_m && at_m <= each.end_m + kSame_m && is_new) {
      place_m.push_back(std::clamp(at_m, each.begin_m, std::max(each.begin_m, each.end_m)));
    }
  }
  if (place_m.empty()) {
    xml_.refuse(alignment_,
                fmt::format("station {} m is not there; allowed: {}", station_m, stretches()));
  }
  if (place_m.size() > 1) {
    xml_.refuse(alignment_,
                fmt::format("station {} m is there {} times, {:.3f} and {:.3f} m from its begin; "
                            "allowed: one that its station equations count once",
                            station_m, place_m.size(), place_m[0], place_m[1]));
  }
  return place_m.front();
}

}  // namespace graben::design
