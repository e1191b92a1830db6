// SPDX-License-Identifier: Apache-2.0
// How far the machine goes on after a stop from outside, and a limit that comes too late for it.

#include <fmt/format.h>

#include "app/reports/check/stop_table.hpp"

namespace graben::reports {
namespace {

std::string load_words(const runs::Stopping& stop) {
  return stop.load_kg > 0.0 ? fmt::format("{:.0f} kg", stop.load_kg) : "empty";
}

/// The largest share that stops within `within_m` in this motion with this load, and all below it.
double allowed_ratio(const std::vector<runs::Stopping>& stops, const runs::Stopping& like,
                     double within_m) {
  double ratio = 0.0;
  for (const runs::Stopping& stop : stops) {
    const bool alike = stop.motion == like.motion && stop.load_kg == like.load_kg;
    if (alike && stop.distance_m <= within_m) {
      ratio = std::max(ratio, stop.speed_ratio);
    } else if (alike) {
      ratio = 0.0;
    }
  }
  return ratio;
}

/// A swing that is slowed may come further before its range ends it, and be the faster one.
const runs::Stopping& farthest_like(const std::vector<runs::Stopping>& stops,
                                    const runs::Stopping& like) {
  const runs::Stopping* farthest = &like;
  for (const runs::Stopping& stop : stops) {
    const bool alike = stop.motion == like.motion && stop.load_kg == like.load_kg;
    farthest = alike && stop.distance_m > farthest->distance_m ? &stop : farthest;
  }
  return *farthest;
}

}  // namespace

FactTable stop_table(const std::vector<runs::Stopping>& stops) {
  FactTable table{
      "Stop from outside",
      {"motion", "bucket", "of full speed", "m/s", "s until it stands", "m"},
      {},
      "simulated, as designed; from when the source decides, where the motion is fastest, its "
      "frame's 50 ms in it; "
      "the farthest that teeth, or a dozer's body, come from where they were then. What "
      "a detector needs before it decides comes on top"};
  for (const runs::Stopping& stop : stops) {
    table.rows.push_back({stop.motion, load_words(stop),
                          fmt::format("{:.0f} %", 100.0 * stop.speed_ratio),
                          fmt::format("{:.2f}", stop.speed_mps), fmt::format("{:.2f}", stop.time_s),
                          fmt::format("{:.2f}", stop.distance_m)});
  }
  return table;
}

std::vector<Warning> stop_warnings(const std::vector<runs::Stopping>& stops, double within_m) {
  std::vector<Warning> warnings;
  for (const runs::Stopping& stop : stops) {
    if (stop.speed_ratio < 1.0) {
      continue;
    }
    const runs::Stopping& farthest = farthest_like(stops, stop);
    if (farthest.distance_m <= within_m) {
      continue;
    }
    const double allowed = allowed_ratio(stops, stop, within_m);
    warnings.push_back(
        {"--stop-within",
         fmt::format("{:g} m: {} at {:.0f} % of its speed, {}, goes on for {:.2f} m; a stop comes "
                     "too late, {}",
                     within_m, stop.motion, 100.0 * farthest.speed_ratio, load_words(stop),
                     farthest.distance_m,
                     allowed > 0.0
                         ? fmt::format("unless it was slowed to {:.0f} % before", 100.0 * allowed)
                         : "however slow it was before")});
  }
  return warnings;
}

}  // namespace graben::reports
