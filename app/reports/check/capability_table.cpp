// SPDX-License-Identifier: Apache-2.0
// What a machine can do without and what that costs. The figures are those of tests/README.md,
// which tests/results/check_capabilities.py holds them to.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/reports/check/machine_check.hpp"

namespace graben::reports {
namespace {

struct Capability {
  const char* lost;
  const char* stand_in;
  const char* unseen;
  /// Path error of the true tip with all errors, max over a loop, median / p95 of draws, mm: 22 t
  /// dry, 22 t in Kim's soil, 12 t dry, 12 t in Kim's soil; - where not measured.
  const char* costs;
  bool (*is_lost)(const ExcavatorProfile& profile);
};

constexpr Capability kCapabilities[] = {
    {"nothing", "-", "-", "23.1 / 38.6; 58.8 / 85.5; 21.7 / 36.1; 54.4 / 74.1",
     [](const ExcavatorProfile&) { return false; }},
    {"strokes", "IMUs on the links",
     "a frame of another IMU under this one's address; one whose bits changed within its range; "
     "an IMU that is mounted up to 3 deg off; a drift below 1 deg/s; a step of 25 mm",
     "27.0 / 40.2; 61.4 / 93.6; 21.0 / 35.7; 58.3 / 80.3",
     [](const ExcavatorProfile& profile) { return profile.imu.known(); }},
    {"strokes", "slope sensors or joint angles by a bus profile",
     "a slope that stands still where spools or pressures are not measured; one that is mounted up "
     "to 3 deg off",
     "-; -; 24.7 / 38.1; -",
     [](const ExcavatorProfile& profile) {
       return profile.bus.joint_angles && profile.bus.identity;
     }},
    {"spool positions", "the command",
     "SpoolMissing, SpoolStuck; a stroke against its oil (StrokeStuck, MotionImplausible); spools "
     "that are not centred before arming",
     "22.5 / 37.0; 58.4 / 83.6; 21.2 / 36.8; 54.7 / 77.4",
     [](const ExcavatorProfile& profile) { return !profile.bus.spool_feedback; }},
    {"swash of the pumps", "the command", "SwashMissing, SwashDisagrees",
     "23.5 / 43.2; 60.2 / 85.9; 21.5 / 37.7; 53.9 / 78.6",
     [](const ExcavatorProfile& profile) {
       return !profile.bus.swash_feedback && !profile.pump[0].regulator.sets_swash();
     }},
    {"chamber pressures", "the links' weight; lambda by a worst load",
     "PressureMissing, PressureImplausible, WrongDirection, Blocked; a stroke against its oil "
     "(StrokeStuck, MotionImplausible); tip force and payload",
     "29.1 / 62.7; 80.4 / 111.1; 25.0 / 40.5; 77.4 / 102.5",
     [](const ExcavatorProfile& profile) { return !profile.bus.pressures; }},
    {"our own bus", "zx200: angles, pilot pressures, the profile's swash",
     "IdentityMismatch, MessageCorrupt, MessageSequence, MessageMasquerade; a spool that sticks "
     "under a right pilot pressure; SwashMissing, SwashDisagrees",
     "28.5 / 42.5; 57.0 / 83.4; -; -",
     [](const ExcavatorProfile& profile) {
       return profile.bus.joint_angles && !profile.bus.identity;
     }},
    {"a told swash", "load-sensing pumps", "SwashMissing, SwashDisagrees",
     "25.0 / 40.7; -; 20.9 / 33.2; -",
     [](const ExcavatorProfile& profile) {
       return profile.pump[0].regulator.kind == PumpKind::kLoadSensing;
     }},
    {"a told swash", "pumps under negative flow control", "SwashMissing, SwashDisagrees",
     "43.5 / 66.6; -; 27.3 / 45.2; -",
     [](const ExcavatorProfile& profile) {
       return profile.pump[0].regulator.kind == PumpKind::kNegativeFlow;
     }},
};

/// Parts of the text between "; ".
std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find("; "), text.size());
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 2, text.size()));
  }
  return parts;
}

const std::vector<std::string> kPathErrors{"22 t, dry, mm", "22 t, soil, mm", "12 t, dry, mm",
                                           "12 t, soil, mm"};

FactTable with_path_errors(std::vector<std::string> heads) {
  heads.insert(heads.end(), kPathErrors.begin(), kPathErrors.end());
  return {"What this machine does without",
          std::move(heads),
          {},
          "mm: path error of the true tip, median / p95 of the shipped machines with all errors "
          "(tests/README.md)"};
}

}  // namespace

FactTable capability_table(const ExcavatorProfile& profile) {
  FactTable table = with_path_errors({"lost", "stands in", "not seen any more"});
  const auto add = [&table](std::vector<std::string> cells, const char* costs) {
    const std::vector<std::string> parts = parts_of(costs);
    cells.insert(cells.end(), parts.begin(), parts.end());
    table.rows.push_back(std::move(cells));
  };
  for (const Capability& each : kCapabilities) {
    if (each.is_lost(profile)) {
      add({each.lost, each.stand_in, each.unseen}, each.costs);
    }
  }
  if (table.rows.empty()) {
    table = with_path_errors({"lost"});
    add({kCapabilities[0].lost}, kCapabilities[0].costs);
  }
  return table;
}

}  // namespace graben::reports
