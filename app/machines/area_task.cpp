// SPDX-License-Identifier: Apache-2.0
#include "app/machines/area_task.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "firmware/excavator/kinematics/swing_kinematics.hpp"

namespace graben::machines {
namespace {

constexpr Range kRadius{0.5, 20.0, "m"};
constexpr Range kDepth{0.02, 8.0, "m"};
constexpr Range kPlace{-30.0, 30.0, "m"};

/// Between the bucket's floor and what it leaves behind.
constexpr double kReliefAngle_rad = 0.30;
/// Steeper or flatter only where the machine can't be otherwise.
constexpr double kAttitudeStep_rad = 0.05;
constexpr int kAttitudeSteps = 24;
/// Of the line over the design: what sensors and a light cut are off by.
constexpr double kClearance_m = 0.001;
constexpr double kCutSpeed_mps = 0.6;
/// Of what the drives can: at all of it a full bucket on soft oil rings.
constexpr double kPace = 0.85;
constexpr double kCarried_rad = 0.3;
constexpr double kEmptied_rad = 2.0;
/// Lengths from here on are shares of the bucket's, teeth to pin; tried on a 12 t machine, 1.23 m.
/// Height over the ground that a cut comes down from.
constexpr double kOver = 0.285;
/// To the left, where nothing is said of where to dump.
constexpr double kAside_rad = 1.2;
constexpr double kAsideHeight = 1.3;
/// Beyond the far end, of a machine that can't swing: as far as it reaches, so that the heap's foot
/// stays out of the cut.
constexpr double kBeyondMost = 2.1;
constexpr double kBeyondStep = 0.08;
constexpr int kBeyondSteps = 12;
/// Over the far end: a straight way from the heap's top down to the cut would scrape its side.
constexpr double kOverHeap = 0.8;
/// Of a slope's plane, that far beyond its far end.
constexpr double kRise = 1.6;
constexpr int kStripsUsual = 3;
/// Strips overlap by this share of the bucket's width.
constexpr double kOverlap = 0.15;

enum class AreaKind { kTrench = 0, kBench = 1, kLevel = 2, kSlope = 3, kTruck = 4, kPit = 5 };

Eigen::Vector3d at(double radius_m, double height_m, double swing_rad) {
  return {radius_m * std::cos(swing_rad), radius_m * std::sin(swing_rad), height_m};
}

struct Area {
  AreaKind kind = AreaKind::kTrench;
  double far_m = 0.0;
  double near_m = 0.0;
  double ground_m = 0.0;
  double depth_far_m = 0.0;
  double depth_near_m = 0.0;
  double turn_rad = 0.0;
  double speed_mps = kCutSpeed_mps;
  int strips = 1;
  bool touches = true;
  Eigen::Vector3d dump_m = Eigen::Vector3d::Zero();

  [[nodiscard]] double run_m() const { return far_m - near_m; }
  [[nodiscard]] double fall_m() const { return depth_near_m - depth_far_m; }
};

/// Of the attitudes at which the machine reaches from the design to over the ground, the one next
/// to that which keeps the floor clear; first steeper ones. As wanted where there is none.
double reachable_attitude(const SwingKinematics& kinematics, const Eigen::Vector3d& design_m,
                          double ground_m, double wanted_rad) {
  const double bucket_m = kinematics.geometry().bucket_length_m;
  const auto reaches = [&](double attitude_rad) {
    for (const double height_m : {design_m.z() + kClearance_m, ground_m + kOver * bucket_m}) {
      TeethPose pose{{design_m.x(), design_m.y(), height_m}, attitude_rad};
      if (kinematics.drive_from_teeth(pose).blind.kind != BlindKind::kNone) {
        return false;
      }
    }
    return true;
  };
  for (int n = 0; n <= kAttitudeSteps; ++n) {
    for (const double off_rad : {n * kAttitudeStep_rad, -n * kAttitudeStep_rad}) {
      if (reaches(wanted_rad + off_rad)) {
        return wanted_rad + off_rad;
      }
    }
  }
  return wanted_rad;
}

/// Teeth at the dump, about the bucket pin as it is emptied.
TeethPose dump_pose(const Eigen::Vector3d& dump_m, double bucket_m, double attitude_rad) {
  const double swing_rad = std::atan2(dump_m.y(), dump_m.x());
  const double out_m = bucket_m * (std::cos(kEmptied_rad) - std::cos(attitude_rad));
  const double up_m = bucket_m * (std::sin(kEmptied_rad) - std::sin(attitude_rad));
  return {at(dump_m.head<2>().norm() + out_m, dump_m.z() + up_m, swing_rad), attitude_rad};
}

Eigen::Vector3d usual_dump(const Area& area, const ExcavatorProfile& profile) {
  const double bucket_m = profile.geometry.bucket_length_m;
  const double height_m = area.ground_m + kAsideHeight * bucket_m;
  if (profile.has_swing()) {
    return at(0.5 * (area.far_m + area.near_m), height_m, area.turn_rad + kAside_rad);
  }
  const SwingKinematics kinematics(profile.geometry);
  Eigen::Vector3d dump_m;
  for (int n = 0; n <= kBeyondSteps; ++n) {
    dump_m = at(area.far_m + (kBeyondMost - n * kBeyondStep) * bucket_m, height_m, area.turn_rad);
    const auto reaches = [&](double attitude_rad) {
      const TeethPose pose = dump_pose(dump_m, bucket_m, attitude_rad);
      return kinematics.drive_from_teeth(pose).blind.kind == BlindKind::kNone;
    };
    if (reaches(kCarried_rad) && reaches(kEmptied_rad)) {
      break;
    }
  }
  return dump_m;
}

/// From a heap beyond the far end the teeth come back over it, and over the plane of a slope, which
/// rises there.
TeethPose over_far_end(const Area& area, double bucket_m, double attitude_rad) {
  const double rises_m = kRise * bucket_m * std::max(0.0, area.fall_m() / area.run_m());
  return {at(area.far_m, area.ground_m + kOverHeap * bucket_m + rises_m, area.turn_rad),
          attitude_rad};
}

constexpr const char* kDepthNearHelp =
    "the same at the near end, where the ground is to fall or rise; a slope has to say it";

/// Side by side, so many as make a pit's width at its far end.
int strips_of(TomlReader& reader, const ExcavatorProfile& profile) {
  const double width_m =
      reader.number("area.width", {0.1, 20.0, "m"}, "of a pit at its far end, side to side");
  const double bucket_m = profile.geometry.body.bucket_width_m;
  const double strip_m = (1.0 - kOverlap) * bucket_m;
  if (reader.lists() || !(bucket_m > 0.0)) {
    return 1;
  }
  const int strips = 1 + static_cast<int>(std::ceil(std::max(0.0, width_m - bucket_m) / strip_m));
  const int most = profile.has_swing() ? kStripMost : 1;
  if (strips > most) {
    reader.fail("area.width",
                fmt::format("{} m are {} strips of a bucket of {} m; allowed: {} strips, {:.2f} m",
                            width_m, strips, bucket_m, most, bucket_m + (most - 1) * strip_m));
  }
  return std::min(strips, most);
}

Area read_table(TomlReader& reader, const ExcavatorProfile& profile) {
  Area area;
  area.kind = static_cast<AreaKind>(reader.choice(
      "area.kind", {"trench", "bench", "level", "slope", "truck", "pit"}, "what is made"));
  area.far_m = reader.number("area.far", kRadius, "from the swing axis, where a cut begins");
  area.near_m = reader.number("area.near", kRadius, "the same where it ends, less than far");
  area.ground_m = reader.number_or(0.0, "area.ground", kPlace,
                                   "height of the ground as it is, over that of the tracks");
  area.depth_far_m = reader.number("area.depth", kDepth, "of the design under the ground");
  area.depth_near_m = area.depth_far_m;
  const auto lists = [&](const char* key) { return reader.lists() && reader.has(key); };
  if (area.kind == AreaKind::kSlope || reader.has("area.depth_near")) {
    area.depth_near_m = reader.number("area.depth_near", kDepth, kDepthNearHelp);
  }
  area.touches = reader.boolean_or(true, "area.touch",
                                   "the ground is first felt for, and heights counted from it");
  area.turn_rad =
      reader.number_or(0.0, "area.turn", {-3.1, 3.1, "rad"}, "of its middle, to the left");
  area.speed_mps =
      reader.number_or(kCutSpeed_mps, "area.speed", {0.05, 2.0, "m/s"}, "along a cut at most");
  const bool wide = area.kind == AreaKind::kBench || area.kind == AreaKind::kLevel ||
                    area.kind == AreaKind::kTruck || lists("area.strips");
  if (wide) {
    area.strips = reader.integer_or(profile.has_swing() ? kStripsUsual : 1, "area.strips", 1,
                                    kStripMost, "side by side");
  }
  if (area.kind == AreaKind::kPit || lists("area.width")) {
    area.strips = strips_of(reader, profile);
  }
  area.dump_m = usual_dump(area, profile);
  if (reader.has("area.dump")) {
    const std::vector<double> dump =
        reader.numbers("area.dump", kPlace, 3, "teeth as the bucket is emptied: x, y, z");
    area.dump_m = {dump[0], dump[1], dump[2]};
  }
  const bool told = reader.has("area.far") && reader.has("area.near");
  if (told && reader.is_sound() && area.near_m >= area.far_m) {
    reader.fail("area.near",
                fmt::format("{} m; allowed: less than far, {} m", area.near_m, area.far_m));
  }
  const ExcavatorBody& body = profile.geometry.body;
  if (!body.known() || !(body.capacity_m3 > 0.0)) {
    reader.fail("area", "needs bucket.width and bucket.capacity in the machine's profile");
  }
  return area;
}

StepRequest move_to(StepKind kind, const TeethPose& to) {
  StepRequest step;
  step.kind = kind;
  step.to = to;
  step.straight = false;
  step.pace_ratio = kPace;
  return step;
}

}  // namespace

ProgramRequest read_area(TomlReader& reader, const ExcavatorProfile& profile) {
  const Area area = read_table(reader, profile);
  const SwingKinematics kinematics(profile.geometry);
  const double incline_rad = std::atan2(area.fall_m(), area.run_m());
  const double clear_rad = profile.geometry.body.floor_rad + kReliefAngle_rad + incline_rad;
  const Eigen::Vector3d far_m = at(area.far_m, area.ground_m - area.depth_far_m, area.turn_rad);
  const Eigen::Vector3d near_m = at(area.near_m, area.ground_m - area.depth_near_m, area.turn_rad);
  ProgramRequest request;
  request.repeats = true;
  request.start = {far_m, reachable_attitude(kinematics, far_m, area.ground_m, clear_rad)};
  StepRequest& dig = request.step[0];
  dig.kind = StepKind::kDig;
  dig.in_layers = true;
  dig.to = {near_m, reachable_attitude(kinematics, near_m, area.ground_m, clear_rad)};
  dig.speed_mps = area.speed_mps;
  dig.ground_m = area.ground_m;
  dig.touches = area.touches;
  dig.strips = area.strips;
  dig.strip_rad = (1.0 - kOverlap) * profile.geometry.body.bucket_width_m / area.far_m;
  const double bucket_m = profile.geometry.bucket_length_m;
  const TeethPose carried = dump_pose(area.dump_m, bucket_m, kCarried_rad);
  int next = 1;
  const auto add = [&](const StepRequest& step) {
    request.step[static_cast<unsigned>(next++)] = step;
  };
  if (area.kind == AreaKind::kTruck) {
    // Over the truck's side before it swings there.
    const TeethPose over{at(area.near_m, carried.position_m.z(), area.turn_rad), kCarried_rad};
    add(move_to(StepKind::kLift, over));
  }
  add(move_to(StepKind::kSwing, carried));
  add(move_to(StepKind::kDump, dump_pose(area.dump_m, bucket_m, kEmptied_rad)));
  if (!profile.has_swing()) {
    add(move_to(StepKind::kReturnToDig, over_far_end(area, bucket_m, request.start.attitude_rad)));
  }
  add(move_to(StepKind::kReturnToDig, request.start));
  request.step_count = next;
  request.has_design = true;
  request.design.through_m = far_m;
  request.design.up = at(-area.fall_m(), area.run_m(), area.turn_rad).normalized();
  request.design.clearance_m = kClearance_m;
  return request;
}

}  // namespace graben::machines
