// SPDX-License-Identifier: Apache-2.0
#include "app/runs/assist_way.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/plant/excavator_plant.hpp"
#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/excavator/motion/program/drive_plan.hpp"
#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/optimiser.hpp"

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

FastestByFlow::FastestByFlow(const machines::SimulatedExcavator& machine, const Way& way,
                             double lever)
    : step_m_(way.length_m() / kPlaces) {
  const ExcavatorProfile& profile = machine.profile;
  const ExcavatorKinematics kinematics(profile.geometry);
  const McvMachine valve = mcv_machine(profile);
  const double arm_mps = lever * drive_limits(profile).speed_out[kArm];
  PerPump<double> full_m3ps{};
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    full_m3ps[j] = pump_flow_m3ps(profile.pump[j], profile.pump[j].rated_speed_radps, 1.0);
  }
  for (std::size_t k = 0; k <= kPlaces; ++k) {
    const double out_m = step_m_ * static_cast<double>(k);
    const Eigen::Vector2d out = way.tangent(out_m);
    const PathMotion motion =
        kinematics.motion_from_pose(way.at(out_m), {out.x(), out.y(), 0.0}, {});
    const Eigen::Vector3d& at_m = motion.strokes_m;
    const plant::ExcavatorPlant rests(machine.plant, {at_m[0], at_m[1], at_m[2]});
    for (std::size_t way_in = 0; way_in < mps_.size(); ++way_in) {
      // Extending, the arm draws in; outwards is positive.
      const double edge_mps = (way_in == 1 ? arm_mps : -arm_mps) / motion.strokes_rate[kArm];
      McvInput input;
      input.pump_flow_m3ps = full_m3ps;
      for (unsigned i = 0; i < kAxisCount; ++i) {
        input.velocity_mps[i] = edge_mps * motion.strokes_rate[static_cast<int>(i)];
        input.cap_pressure_pa[i] = rests.cap_pressures_pa()[i];
        input.rod_pressure_pa[i] = rests.rod_pressures_pa()[i];
      }
      const McvSolution best = solve_mcv(valve, input, McvPolicy::kGlobal);
      mps_[way_in][k] = best.point.lambda * std::abs(edge_mps) * std::abs(out.dot(way.along()));
    }
  }
}

double FastestByFlow::mps(double out_m, bool inwards) const {
  const double at = std::clamp(out_m / step_m_, 0.0, static_cast<double>(kPlaces) - 1e-9);
  const auto k = static_cast<std::size_t>(at);
  const auto& mps = mps_[inwards ? 1 : 0];
  return mps[k] + (at - static_cast<double>(k)) * (mps[k + 1] - mps[k]);
}

}  // namespace graben::runs
