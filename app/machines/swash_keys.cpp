// SPDX-License-Identifier: Apache-2.0
#include "app/machines/swash_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace graben::machines {
namespace {

constexpr const char* kOnDemand = "task.swash_on_demand";

}  // namespace

void read_swash(TomlReader& reader, ExcavatorProfile& profile) {
  const bool by_itself = profile.pump[0].regulator.sets_swash();
  double swash_ratio = 1.0;
  if (!by_itself || reader.has("task.swash")) {
    swash_ratio = reader.number("task.swash", {0.0, 1.0, ""},
                                "swash that the pumps are told, of full; this and the next two are "
                                "not looked at where they set it themselves");
  }
  std::fill_n(profile.dig_swash_ratio.begin(), profile.pump_count, by_itself ? 1.0 : swash_ratio);
  if (!reader.has(kOnDemand)) {
    return;
  }
  const std::vector<double> range = reader.numbers(
      kOnDemand, {0.05, 1.0, ""}, 2,
      "least and most swash that the pumps are told in motion, where it goes by what the motion "
      "needs; without it, it is task.swash always");
  if (range[0] > range[1]) {
    reader.fail(kOnDemand,
                fmt::format("least {:g}, most {:g}; allowed: a least of at most the most", range[0],
                            range[1]));
  }
  const double power_w =
      reader.number("task.pump_power", {1e3, 1e6, "W"},
                    "that the pumps together may take from the engine; only with swash_on_demand");
  if (!by_itself) {
    profile.demand_swash = {range[0], range[1], power_w};
  }
}

}  // namespace graben::machines
