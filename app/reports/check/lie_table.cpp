// SPDX-License-Identifier: Apache-2.0
// What a sensor of a joint may lie before it is seen, as it was measured (tests/lies).

#include <string_view>

#include "app/reports/check/machine_check.hpp"
#include "app/reports/check/measured_lies.hpp"

namespace graben::reports {
namespace {

constexpr std::string_view kSecond = "second sensors: ";

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
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
  FactTable table{
      some ? "What a sensor may lie, with second sensors"
           : "What a sensor may lie, without second sensors ([second])",
      {"lie", "speed 1", "speed 0.3", "speed 0.1"},
      {},
      "draws that were stopped, median / last s until then; then how far the true tool "
      "was off by then, median / worst, m, of a swing rad; of the shipped 22 t and 12 t "
      "(firmware/safety/README.md)"};
  for (const MeasuredLie& lie : kMeasuredLies) {
    if (concerns(profile, lie.name)) {
      std::string_view name = lie.name;
      name.remove_prefix(name.rfind(kSecond, 0) == 0 ? kSecond.size() : 0);
      table.rows.push_back({std::string(name), lie.at_1, lie.at_03, lie.at_01});
    }
  }
  return table;
}

}  // namespace graben::reports
