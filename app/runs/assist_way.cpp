// SPDX-License-Identifier: Apache-2.0
#include "app/runs/assist_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "firmware/excavator/motion/program/drive_plan.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {
namespace {

/// Of the way, as shares of the links' length together, from the swing axis.
constexpr double kFar = 0.66;
constexpr double kNear = 0.42;
constexpr double kDepth_m = 0.3;
/// Of a cylinder's stroke that is left at its ends all along the way, and the task's line ends.
constexpr double kEnds_m = 0.06;

double left_at_ends_m(const ExcavatorGeometry& geometry, const StrokeResult& strokes) {
  double left_m = strokes.status == ReachStatus::kOk ? 1.0 : 0.0;
  for (int i = 0; i < kAxisCount; ++i) {
    const double most_m = geometry.cylinder[static_cast<unsigned>(i)].stroke_m;
    left_m = std::min({left_m, strokes.strokes_m[i], most_m - strokes.strokes_m[i]});
  }
  return left_m;
}

}  // namespace

TipPose Way::at(double out_m) const {
  Eigen::Vector2d place = near_m + out_m * along();
  if (ground != nullptr) {
    constexpr int kAcross = 12;
    double most_m = -1e3;
    for (int i = 0; i <= kAcross; ++i) {
      const double left_m = half_edge_m * (2.0 * i / kAcross - 1.0);
      most_m = std::max(most_m, ground->height_m({place.x() + foot_m.x(), left_m}));
    }
    place.y() = most_m - foot_m.y();
  }
  return {place.x(), place.y(), attitude_rad};
}

Eigen::Vector2d Way::tangent(double out_m) const {
  constexpr double kBeside_m = 0.02;
  const TipPose far = at(out_m + kBeside_m);
  const TipPose near = at(out_m - kBeside_m);
  return Eigen::Vector2d(far.x_m - near.x_m, far.y_m - near.y_m).normalized();
}

Way way_of(const ExcavatorProfile& profile, const AssistOptions& options) {
  const ExcavatorGeometry& geometry = profile.geometry;
  const ExcavatorKinematics kinematics(geometry);
  const double reach_m = geometry.boom_length_m + geometry.arm_length_m + geometry.bucket_length_m;
  const double slope = options.design == AssistDesign::kSlope ? 0.5 : 0.0;
  const double middle_m = 0.5 * (kNear + kFar) * reach_m;
  const auto place = [&](double out_m) -> Eigen::Vector2d {
    return Eigen::Vector2d(out_m, -kDepth_m + slope * (out_m - middle_m) - slope) -
           geometry.boom_foot_m;
  };
  Way way;
  way.near_m = place(kNear * reach_m);
  way.far_m = place(kFar * reach_m);
  way.foot_m = geometry.boom_foot_m;
  way.half_edge_m = 0.5 * geometry.body.bucket_width_m;
  way.ground = options.ground;
  if (way.ground != nullptr) {
    way.far_m.y() = way.near_m.y();
    way.fence = surface_fence(way.ground->surface->surface);
  } else {
    DesignPlane plane;
    plane.up = Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
    const Eigen::Vector2d through = way.far_m + geometry.boom_foot_m;
    plane.through_m = {through.x(), 0.0, through.y()};
    way.fence = plane.fence();
  }
  constexpr int kPlaces = 12;
  double best_m = 0.0;
  double best_rad = 0.0;
  for (double attitude_rad = -0.5; attitude_rad < 3.5; attitude_rad += 0.05) {
    way.attitude_rad = attitude_rad;
    double left_m = 1.0;
    for (int i = 0; i <= kPlaces; ++i) {
      const TipPose pose = way.at(way.length_m() * i / kPlaces);
      left_m = std::min(left_m, left_at_ends_m(geometry, kinematics.strokes_from_pose(pose)));
    }
    best_rad = left_m > best_m ? attitude_rad : best_rad;
    best_m = std::max(best_m, left_m);
  }
  if (best_m < kEnds_m) {
    throw std::runtime_error("the machine can't hold its bucket all along the design");
  }
  way.attitude_rad = best_rad;
  return way;
}

double fastest_mps(const ExcavatorProfile& profile, const ExcavatorKinematics& kinematics,
                   const Way& way, double out_m, double lever) {
  const Eigen::Vector2d out = way.tangent(out_m);
  const Eigen::Vector2d along = out * (lever > 0.0 ? -1.0 : 1.0);
  const PathMotion motion =
      kinematics.motion_from_pose(way.at(out_m), {along.x(), along.y(), 0.0}, {});
  const DriveLimits limits = drive_limits(profile);
  double most_mps = 1e3;
  std::array<double, kPumpCount> area_m2{};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const double rate = motion.strokes_rate[static_cast<int>(i)];
    const double share = i == kArm ? std::abs(lever) : 1.0;
    const double limit_mps = i == kArm || rate > 0.0 ? limits.speed_out[i] : limits.speed_in[i];
    most_mps = std::min(most_mps, share * limit_mps / std::abs(rate));
    const SpoolProfile& spool = profile.valve.spool[i];
    const bool regenerates =
        spool.regeneration == (rate > 0.0 ? RegenerationSide::kExtend : RegenerationSide::kRetract);
    const CylinderGeometry& cylinder = profile.geometry.cylinder[i];
    const double side_m2 = rate > 0.0 ? cylinder.cap_area_m2() : cylinder.rod_area_m2();
    area_m2[static_cast<unsigned>(spool.pump)] += regenerates ? 0.0 : side_m2 * std::abs(rate);
  }
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    const PumpProfile& pump = profile.pump[j];
    const double flow_m3ps = pump.displacement_m3prev / kTwoPi * pump.rated_speed_radps;
    most_mps = area_m2[j] > 0.0 ? std::min(most_mps, flow_m3ps / area_m2[j]) : most_mps;
  }
  return most_mps * out.dot(way.along());
}

}  // namespace graben::runs
