// SPDX-License-Identifier: Apache-2.0
// What the check at the mark sees: from which error of a sensor on the teeth miss it.

#include <fmt/format.h>
#include <cmath>
#include <optional>
#include <vector>

#include "app/machines/axis_names.hpp"
#include "app/reports/check/machine_check.hpp"
#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben::reports {
namespace {

constexpr int kAttitudes = 360;
constexpr double kStep_rad = 0.0175;

/// Drives with the teeth at the mark and the bucket in the middle of what it can be there.
std::optional<DriveVector> drives_at(const SwingKinematics& kinematics,
                                     const Eigen::Vector3d& mark_m) {
  std::vector<DriveVector> found;
  for (int i = 0; i < kAttitudes; ++i) {
    const DriveResult drive = kinematics.drive_from_teeth({mark_m, kStep_rad * i});
    if (drive.blind.kind == BlindKind::kNone) {
      found.push_back(drive.value);
    }
  }
  return found.empty() ? std::nullopt : std::optional(found[found.size() / 2]);
}

Eigen::Vector3d teeth_m(const SwingKinematics& kinematics, const DriveVector& drive) {
  return kinematics.teeth_from_joints(kinematics.joints_from_drive(drive).value).position_m;
}

}  // namespace

FactTable mark_table(const ExcavatorProfile& profile) {
  constexpr double kSmall = 1e-4;
  const SwingKinematics kinematics(profile.geometry);
  const MarkProfile& mark = profile.mark;
  FactTable table{"Teeth at the mark",
                  {"sensor", "teeth per unit", "seen from"},
                  {},
                  fmt::format("off by more than {:.0f} mm nothing arms; errors of two sensors may "
                              "hide each other; the bucket in the middle of what reaches the mark",
                              1e3 * mark.tolerance_m)};
  const std::optional<DriveVector> at = drives_at(kinematics, mark.place_m);
  if (!at) {
    table.note = "the teeth can't reach it";
    return table;
  }
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    DriveVector off = *at;
    off[i] += kSmall;
    const double per_unit = (teeth_m(kinematics, off) - teeth_m(kinematics, *at)).norm() / kSmall;
    const bool turns = i == kSwing;
    table.rows.push_back(
        {machines::kDriveNames[i], fmt::format("{:.1f} {}", per_unit, turns ? "mm/mrad" : "mm/mm"),
         fmt::format("{:.1f} {}", 1e3 * mark.tolerance_m / per_unit, turns ? "mrad" : "mm")});
  }
  return table;
}

}  // namespace graben::reports
