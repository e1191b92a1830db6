// SPDX-License-Identifier: Apache-2.0
#include "app/plant/dozer_plan.hpp"

#include <algorithm>
#include <cmath>

namespace graben::plant {
namespace {

constexpr int kFootSteps = 4;
constexpr double kSlowest_mps = 0.2;

Eigen::Vector2d towards(double direction_rad) {
  return {std::cos(direction_rad), std::sin(direction_rad)};
}

Eigen::Vector2d left_of(double direction_rad) {
  return {-std::sin(direction_rad), std::cos(direction_rad)};
}

/// Along an arc from its beginning.
Eigen::Vector2d chord_m(double direction_rad, double curvature_pm, double way_m) {
  return way_m * towards(direction_rad + 0.5 * curvature_pm * way_m);
}

}  // namespace

PlanTrack::PlanTrack(const GradeHeights& heights) : from_m_(heights.from_m) {
  Node node;
  for (int i = 0; i < heights.count; ++i) {
    // From node to node by the mean of both; the last one goes on straight.
    const bool last = i + 1 == heights.count;
    node.curvature_pm = last ? 0.0 : 0.5 * (heights.curvature[i] + heights.curvature[i + 1]);
    node_.push_back(node);
    node.at_m += chord_m(node.direction_rad, node.curvature_pm, GradeHeights::kStep_m);
    node.direction_rad += node.curvature_pm * GradeHeights::kStep_m;
  }
}

const PlanTrack::Node& PlanTrack::before(double station_m, double& back_m) const {
  const double place = std::floor((station_m - from_m_) / GradeHeights::kStep_m);
  const double index = std::clamp(place, 0.0, static_cast<double>(node_.size() - 1));
  back_m = station_m - from_m_ - index * GradeHeights::kStep_m;
  return node_[static_cast<std::size_t>(index)];
}

double PlanTrack::curvature_pm(double station_m) const {
  double back_m = 0.0;
  const Node& node = before(station_m, back_m);
  return back_m < 0.0 ? 0.0 : node.curvature_pm;
}

double PlanTrack::direction_rad(double station_m) const {
  double back_m = 0.0;
  const Node& node = before(station_m, back_m);
  return node.direction_rad + (back_m < 0.0 ? 0.0 : node.curvature_pm * back_m);
}

Eigen::Vector2d PlanTrack::at_m(const PlanPlace& place) const {
  double back_m = 0.0;
  const Node& node = before(place.station_m, back_m);
  const double curvature_pm = back_m < 0.0 ? 0.0 : node.curvature_pm;
  return node.at_m + chord_m(node.direction_rad, curvature_pm, back_m) +
         place.offset_m * left_of(direction_rad(place.station_m));
}

PlanPlace PlanTrack::place_of(const Eigen::Vector2d& at_m, double guess_m) const {
  PlanPlace place{guess_m, 0.0};
  for (int i = 0; i < kFootSteps; ++i) {
    const double direction = direction_rad(place.station_m);
    const Eigen::Vector2d off_m = at_m - this->at_m({place.station_m, 0.0});
    place.offset_m = off_m.dot(left_of(direction));
    place.station_m += off_m.dot(towards(direction)) /
                       std::max(0.2, 1.0 - curvature_pm(place.station_m) * place.offset_m);
  }
  return place;
}

PlanMotion::PlanMotion(const DozerPlantProfile& profile)
    : track_(profile.machine.grade.heights),
      half_gauge_m_(profile.machine.body.half_gauge_m),
      contact_m_(profile.machine.body.track_contact_m),
      friction_(profile.ground.friction),
      modulus_m_(profile.ground.slip_modulus_m),
      inertia_kgm2_(profile.pitch_inertia_kgm2) {}

double PlanMotion::turning_nm(double load_n, double speed_mps) const {
  const double most_nm = 0.25 * friction_ * load_n * contact_m_;
  const double curvature_pm =
      std::abs(yaw_rate_radps_) / std::max(std::abs(speed_mps), kSlowest_mps);
  const double dragged_m = 0.125 * curvature_pm * contact_m_ * contact_m_;
  return std::copysign(-most_nm * std::expm1(-dragged_m / modulus_m_), yaw_rate_radps_);
}

double PlanMotion::station_share(double station_m) const {
  return std::cos(heading_rad_) / (1.0 - track_.curvature_pm(station_m) * offset_m_);
}

void PlanMotion::step(double more_right_n, double moment_nm, double load_n, double speed_mps,
                      double station_m, double step_s) {
  const double turns_nm = half_gauge_m_ * more_right_n + moment_nm - turning_nm(load_n, speed_mps);
  yaw_rate_radps_ += step_s * turns_nm / inertia_kgm2_;
  const double along_mps = speed_mps * station_share(station_m);
  offset_m_ += step_s * speed_mps * std::sin(heading_rad_);
  heading_rad_ += step_s * (yaw_rate_radps_ - track_.curvature_pm(station_m) * along_mps);
}

PlanPlace PlanMotion::place_of(double station_m, double ahead_m, double left_m) const {
  const double direction = track_.direction_rad(station_m) + heading_rad_;
  const Eigen::Vector2d at_m = track_.at_m({station_m, offset_m_}) + ahead_m * towards(direction) +
                               left_m * left_of(direction);
  return track_.place_of(at_m, station_m + ahead_m);
}

}  // namespace graben::plant
