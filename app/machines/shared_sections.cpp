// SPDX-License-Identifier: Apache-2.0
#include "app/machines/shared_sections.hpp"

#include <fmt/format.h>

#include <vector>

namespace graben::machines {

CylinderSize read_cylinder_size(TomlReader& reader, const std::string& at) {
  CylinderSize size;
  size.count = reader.integer(at + ".count", 1, 4, "cylinders that move together");
  size.bore_m = reader.number(at + ".bore", {0.02, 1.0, "m"}, "piston diameter");
  size.rod_m = reader.number(at + ".rod", {0.01, 1.0, "m"}, "rod diameter; less than the bore");
  if (size.rod_m >= size.bore_m) {
    reader.fail(at + ".rod",
                fmt::format("{} m; allowed: less than the bore of {} m", size.rod_m, size.bore_m));
  }
  return size;
}

DutyTable read_spool_to_duty(TomlReader& reader, const std::string& key) {
  const auto pairs =
      reader.pairs(key, {0.0, 1.0, ""}, {0.0, 1000.0, "per mille"}, 2, DutyTable::capacity(),
                   "opening to duty; rising in both, from opening 0, where the spool begins to "
                   "open, to opening 1");
  std::vector<double> opening;
  std::vector<double> duty;
  for (const auto& [x, y] : pairs) {
    opening.push_back(x);
    duty.push_back(y * 1e-3);
  }
  DutyTable table;
  if (!pairs.empty() && table.fill(opening.data(), duty.data(), static_cast<int>(opening.size())) !=
                            DutyTable::Fill::kOk) {
    reader.fail(key, "must be strictly increasing in both columns");
  } else if (!pairs.empty() && (opening.front() != 0.0 || opening.back() != 1.0)) {
    reader.fail(key, "must run from opening 0 to opening 1");
  }
  return table;
}

}  // namespace graben::machines
