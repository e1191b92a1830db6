// SPDX-License-Identifier: Apache-2.0
#include "app/machines/oil_section.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "app/machines/axis_names.hpp"

namespace graben::machines {

OilProfile read_oil(TomlReader& reader) {
  OilProfile oil;
  if (!reader.has("oil")) {
    return oil;
  }
  oil.bulk_modulus_pa =
      reader.number("oil.bulk_modulus", {1e8, 2e10, "Pa"},
                    "stiffness of the oil with its hoses, on the soft side; only with [oil]");
  const std::vector<double> dead_volume =
      reader.numbers("oil.dead_volume", {1e-5, 0.1, "m3"}, kAxisCount,
                     "each chamber with its hose, of boom, arm, bucket; only with [oil]");
  std::copy(dead_volume.begin(), dead_volume.end(), oil.dead_volume_m3.begin());
  const std::vector<double> mass =
      reader.numbers("oil.mass", {10.0, 1e5, "kg"}, kAxisCount,
                     "boom, arm, bucket with its linkage, on the heavy side; only with [oil]");
  const std::vector<double> inertia =
      reader.numbers("oil.inertia", {1.0, 1e6, "kg m2"}, kAxisCount,
                     "of each about its mass centre, out of plane; only with [oil]");
  for (unsigned i = 0; i < kAxisCount; ++i) {
    oil.link[i] = {mass[i], inertia[i],
                   reader.point(std::string("oil.mass_centre.") + kAxisNames[i], {-10.0, 10.0, "m"},
                                "mass centre, link frame; only with [oil]")};
  }
  oil.spool_time_constant_s = reader.number(
      "oil.spool_time_constant", {0.0, 0.2, "s"},
      "of a spool's lag of the second order, that commands lead through; only with [oil]");
  return oil;
}

void check_law(TomlReader& reader, const ExcavatorProfile& profile) {
  if (profile.control.law == ControlLaw::kOil && !profile.oil.known()) {
    reader.fail("control.law", "oil; allowed: servo or kim, as there is no section [oil]");
  }
}

}  // namespace graben::machines
