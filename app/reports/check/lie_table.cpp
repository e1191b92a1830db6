// SPDX-License-Identifier: Apache-2.0
// What a sensor of a joint may lie before it is seen, as it was measured (tests/lies).

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "app/reports/check/machine_check.hpp"
#include "app/reports/check/measured_lies.hpp"

namespace graben::reports {
namespace {

constexpr std::string_view kSecond = "second sensors: ";

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

constexpr std::array<const char*, 3> kSpeeds{"1", "0.3", "0.1"};
/// [characters; source: so that the table fits a terminal of 80, and each name its three rows]
constexpr std::size_t kNameWidth = 28;

/// A name in as many parts as there are rows for it, broken at blanks; whatever is left over is in
/// the last.
std::array<std::string, 3> folded_name(std::string_view name) {
  std::array<std::string, 3> parts;
  for (std::size_t row = 0; row < parts.size(); ++row) {
    std::size_t end = name.size();
    if (row + 1 < parts.size() && end > kNameWidth) {
      end = name.rfind(' ', kNameWidth);
    }
    parts[row] = name.substr(0, end);
    name.remove_prefix(end < name.size() ? end + 1 : name.size());
  }
  return parts;
}

/// Of a joint that this machine has, and with or without second sensors as it has them.
bool concerns(const ExcavatorProfile& profile, std::string_view name) {
  if (has(name, "dozer") || has(name, "blade") || has(name, "retrofit")) {
    return false;
  }
  const bool of_second = name.rfind(kSecond, 0) == 0;
  if (has(name, "a swing's")) {
    return profile.has_swing() && of_second == profile.second.has[kSwing];
  }
  return of_second == profile.second.strokes();
}

}  // namespace

FactTable lie_table(const ExcavatorProfile& profile) {
  const bool some = profile.second.any();
  FactTable table{some ? "What a sensor may lie, with second sensors"
                       : "What a sensor may lie, without second sensors ([second])",
                  {"lie", "speed", "draws stopped", "after, s", "off by then, m"},
                  {},
                  "after: median / last; off: how far the true tool was from where it was "
                  "shown, median / worst, of a swing rad; shipped 22 t and 12 t "
                  "(firmware/safety/README.md)"};
  for (const MeasuredLie& lie : kMeasuredLies) {
    if (concerns(profile, lie.name)) {
      std::string_view name = lie.name;
      name.remove_prefix(name.rfind(kSecond, 0) == 0 ? kSecond.size() : 0);
      const std::array<std::string, 3> parts = folded_name(name);
      for (std::size_t row = 0; row < parts.size(); ++row) {
        const MeasuredAtSpeed& at = lie.at[row];
        table.rows.push_back({parts[row], kSpeeds[row], at.stopped, at.after_s, at.off_m});
      }
    }
  }
  return table;
}

}  // namespace graben::reports
