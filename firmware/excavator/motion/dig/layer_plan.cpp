// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/dig/layer_plan.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/dig/tuning.hpp"

namespace graben {
namespace {

/// Attitudes that are tried, from the steepest on. [-; size: of this loop]
constexpr int kSteepLooks = 16;
/// Places of a line that are looked at. [-; size: of this loop]
constexpr int kLineLooks = 8;
/// Heights over each that are looked at. [-; size: of this loop]
constexpr int kHeights = 4;

/// What the teeth spring along `up` by a force along `way`, through the oil of boom and arm.
double give_mpn(const ExcavatorProfile& profile, const KinematicState& at,
                const Eigen::Vector2d& way, const Eigen::Vector2d& up) {
  if (!profile.oil.known()) {
    return kGiveUnknown_mpn;
  }
  double sum = 0.0;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const CylinderGeometry& cylinder = profile.geometry.cylinder[static_cast<unsigned>(axis)];
    const double dead_m3 = profile.oil.dead_volume_m3[static_cast<unsigned>(axis)];
    const double cap_m2 = cylinder.cap_area_m2();
    const double rod_m2 = cylinder.rod_area_m2();
    const double cap_m3 = dead_m3 + cap_m2 * at.strokes_m[axis];
    const double rod_m3 = dead_m3 + rod_m2 * (cylinder.stroke_m - at.strokes_m[axis]);
    const double stiffness_npm =
        profile.oil.bulk_modulus_pa * (cap_m2 * cap_m2 / cap_m3 + rod_m2 * rod_m2 / rod_m3);
    const Eigen::Vector2d lever = at.jacobian.block<2, 1>(0, axis);
    sum += std::abs(lever.dot(way) * lever.dot(up)) / stiffness_npm;
  }
  return sum;
}

/// The first pose that the machine can't have, of all that a cut may lead to.
BlindPlace first_unreached(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                           const TaskProgram& program) {
  const LayerPlan& plan = program.layers;
  for (int look = 0; look <= kLineLooks; ++look) {
    const double share = static_cast<double>(look) / kLineLooks;
    const double highest_m =
        std::max(0.0, ground_m(plan, share)) + kPlannedOver_share * plan.bucket_m;
    for (int n = 0; n <= kHeights; ++n) {
      const TeethPose pose = line_over(program, 0, highest_m * n / kHeights).at(share);
      const DriveResult drives = kinematics.drive_from_teeth(pose);
      if (drives.blind.kind != BlindKind::kNone) {
        return {drives.blind, share, pose};
      }
      if (lift_line(profile, kinematics, plan, pose, LiftPart::kOut).way_m <= 0.0) {
        return {{BlindKind::kOutOfReach, kBoom}, share, pose};
      }
    }
  }
  return {};
}

/// The steepest attitude at which the machine reaches down to the design and up from it at the
/// line's beginning: the bucket's floor straight down, or the line's own attitude at least.
double enter_rad(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                 const TaskProgram& program) {
  const LayerPlan& plan = program.layers;
  TeethPose pose = line_over(program, 0, 0.0).at(0.0);
  const double flat_rad = pose.attitude_rad;
  const double steep_rad = profile.geometry.body.floor_rad + kSteep_rad;
  const double highest_m = std::max(0.0, ground_m(plan, 0.0)) + kPlannedOver_share * plan.bucket_m;
  const Eigen::Vector3d foot_m = pose.position_m;
  for (int n = 0; n < kSteepLooks; ++n) {
    pose.attitude_rad = steep_rad + n * (flat_rad - steep_rad) / kSteepLooks;
    bool reaches = steep_rad > flat_rad;
    for (int look = 0; look <= kHeights; ++look) {
      pose.position_m = foot_m + highest_m * look / kHeights * plan.up;
      reaches = reaches && kinematics.drive_from_teeth(pose).blind.kind == BlindKind::kNone;
    }
    if (reaches) {
      return pose.attitude_rad;
    }
  }
  return flat_rad;
}

}  // namespace

double holding_force_n(const ExcavatorProfile& profile, const KinematicState& at,
                       const Eigen::Vector2d& way) {
  double least_n = 1e9;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const CylinderGeometry& cylinder = profile.geometry.cylinder[static_cast<unsigned>(axis)];
    const SpoolProfile& spool = profile.valve.spool[static_cast<unsigned>(axis)];
    const double relief_pa = profile.pump[static_cast<unsigned>(spool.pump)].relief_pa;
    // f dl = F dx: the cylinder pushes where the teeth go along as it extends.
    const double lever = at.jacobian.block<2, 1>(0, axis).dot(way);
    const double area_m2 = lever > 0.0 ? cylinder.cap_area_m2() : cylinder.rod_area_m2();
    least_n = std::min(least_n, relief_pa * area_m2 / std::max(std::abs(lever), 1e-3));
  }
  return least_n;
}

LayerPlanResult plan_layers(const ExcavatorProfile& profile, const SwingKinematics& kinematics,
                            const ProgramRequest& request, const TaskProgram& program) {
  const StepRequest& asked = request.step[0];
  const LinePlan& line = program.step[0].line;
  const ExcavatorBody& body = profile.geometry.body;
  LayerPlanResult result;
  TaskProgram with = program;
  LayerPlan& plan = with.layers;
  plan.step = 0;
  plan.up = request.design.up;
  const auto height_m = [&](double share) {
    // Straight down from the ground, measured along the design's normal.
    return (asked.ground_m - line.line.at(share).position_m.z()) * plan.up.z();
  };
  plan.ground_from_m = height_m(0.0);
  plan.ground_to_m = height_m(1.0);
  plan.ground_z_m = asked.ground_m;
  plan.way_m = line.line.change.position_m.norm();
  plan.width_m = body.bucket_width_m;
  plan.bucket_m = profile.geometry.bucket_length_m;
  plan.full_m3 = body.capacity_m3 / kSwell;
  plan.depth_most_m = kDepthMost_share * plan.bucket_m;
  plan.speed_mps = line.way_m * line.ramp.peak_rate_ps();
  plan.carry_rad = kCarry_rad;
  plan.turns_m = kTurnsWay * body.floor_m;
  plan.strips = asked.strips;
  plan.strip_rad = asked.strip_rad;
  plan.first_rad = -0.5 * (asked.strips - 1) * asked.strip_rad;
  const TeethLine& way = line.line;
  const double level_m = way.change.position_m.head<2>().norm();
  const Eigen::Vector2d inwards = Eigen::Vector2d(-level_m, way.change.position_m.z()).normalized();
  const Eigen::Vector2d up(-inwards.y(), inwards.x());
  plan.force_n = 1e9;
  for (int look = 0; look <= kLineLooks; ++look) {
    const DriveResult drives =
        kinematics.drive_from_teeth(way.at(static_cast<double>(look) / kLineLooks));
    const KinematicState at = kinematics.planar().state(drives.value.head<kAxisCount>());
    if (at.status == ReachStatus::kOk) {
      plan.force_n = std::min(plan.force_n, kForceUsed * holding_force_n(profile, at, inwards));
      plan.give_mpn = std::max(plan.give_mpn, give_mpn(profile, at, inwards, up));
      const Eigen::Vector2d down = -Eigen::Vector2d::UnitY();
      plan.give_down_mpn = std::max(plan.give_down_mpn, give_mpn(profile, at, down, down));
    }
  }
  plan.enter_rad = enter_rad(profile, kinematics, with);
  plan.touch_share = asked.touches ? touch_share(profile, kinematics, with) : -1.0;
  result.place = first_unreached(profile, kinematics, with);
  result.plan = plan;
  return result;
}

}  // namespace graben
