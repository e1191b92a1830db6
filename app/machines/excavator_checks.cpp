// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/machines/axis_names.hpp"
#include "app/machines/excavator_sections.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"

namespace graben::machines {
namespace {

const char* hindrance_text(ReachStatus status) {
  switch (status) {
    case ReachStatus::kBoomStroke:
      return "the boom cylinder's stroke";
    case ReachStatus::kArmStroke:
      return "the arm cylinder's stroke";
    case ReachStatus::kBucketStroke:
      return "the bucket cylinder's stroke";
    case ReachStatus::kLinkageOpen:
      return "the bucket's linkage";
    default:
      return "the reach of boom and arm";
  }
}

std::string angle_key(unsigned axis) { return std::string(kAxisNames[axis]) + ".angle"; }

/// The angle range is documentation; off by more than this, a pin is wrong.
constexpr double kAngleTolerance_rad = 0.15;

/// False: the pins are not those of the angles; what is judged by them says nothing new.
bool check_angles(TomlReader& reader, const ExcavatorProfile& profile,
                  const std::array<std::vector<double>, kAxisCount>& range) {
  const auto given = joint_ranges(profile.geometry);
  if (!given) {
    reader.fail("bucket.linkage", "can't close over the whole stroke of the bucket cylinder");
    return false;
  }
  bool fits = true;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const std::string key = angle_key(i);
    const auto [least, most] = (*given)[i];
    if (std::abs(least - range[i][0]) > kAngleTolerance_rad ||
        std::abs(most - range[i][1]) > kAngleTolerance_rad) {
      fits = false;
      reader.fail(key, fmt::format("[{}, {}] rad; the pins and stroke ends give [{:.3f}, {:.3f}] "
                                   "rad; allowed: within {} rad of that",
                                   range[i][0], range[i][1], least, most, kAngleTolerance_rad));
    }
  }
  return fits;
}

}  // namespace

std::optional<std::array<std::array<double, 2>, kAxisCount>> joint_ranges(
    const ExcavatorGeometry& geometry) {
  const ExcavatorKinematics kinematics(geometry);
  const auto stroke = [&](unsigned i) { return geometry.cylinder[i].stroke_m; };
  const JointResult closed = kinematics.joints_from_strokes(Eigen::Vector3d::Zero());
  const JointResult open = kinematics.joints_from_strokes({stroke(0), stroke(1), stroke(2)});
  if (closed.status != ReachStatus::kOk || open.status != ReachStatus::kOk) {
    return std::nullopt;
  }
  std::array<std::array<double, 2>, kAxisCount> ranges{};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const auto [least, most] = std::minmax(closed.joints_rad[i], open.joints_rad[i]);
    ranges[i] = {least, most};
  }
  return ranges;
}

void check_path(TomlReader& reader, const char* key, const ProfileCheck& check) {
  if (check.path != ReachStatus::kOk) {
    reader.fail(key, fmt::format("leaves the work space at x {:.3f} m, y {:.3f} m, attitude {:.3f} "
                                 "rad: {} does not allow it",
                                 check.unreached.x_m, check.unreached.y_m,
                                 check.unreached.attitude_rad, hindrance_text(check.path)));
  }
}

void check_excavator_across_keys(TomlReader& reader, const ExcavatorProfile& profile) {
  std::array<std::vector<double>, kAxisCount> angle_range;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    angle_range[i] = reader.numbers(
        angle_key(i), {-7.0, 7.0, "rad"}, 2,
        "joint range [least, most]; says again what pins and stroke ends give, within 0.15 rad");
  }
  if (!reader.is_sound()) {
    return;
  }
  const bool fits = check_angles(reader, profile, angle_range);
  const ProfileCheck check = profile_check(profile);
  if (check.valve.defect != McvDefect::kNone) {
    reader.fail("valve", fmt::format("spool or pump {} can't be solved (defect {})",
                                     check.valve.index, static_cast<int>(check.valve.defect)));
  }
  if (fits) {
    check_path(reader, "task.path", check);
  }
}

}  // namespace graben::machines
