// SPDX-License-Identifier: Apache-2.0
#include "app/runs/grade_truth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::runs {

GradeTruth::GradeTruth(const DozerProfile& profile)
    : linkage_(profile.blade),
      tilt_(profile.tilt),
      tilt_linkage_(profile.tilt),
      design_(profile.grade),
      cap_area_m2_(profile.blade.cap_area_m2()),
      rod_area_m2_(profile.blade.rod_area_m2()) {
  if (profile.grade.curves()) {
    track_.emplace(profile.grade.heights);
  }
}

double GradeTruth::blade_angle_rad(double stroke_m) const {
  constexpr int kHalvings = 50;  // To the last bit, nearly.
  double low_rad = linkage_.lowest_rad();
  double high_rad = linkage_.highest_rad();
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_rad = 0.5 * (low_rad + high_rad);
    // The stroke is longest with the blade down.
    (linkage_.stroke_m(middle_rad) > stroke_m ? low_rad : high_rad) = middle_rad;
  }
  return 0.5 * (low_rad + high_rad);
}

Eigen::Vector2d GradeTruth::edge_m(const BodyPose& body, double blade_angle_rad) const {
  const Eigen::Vector2d edge = linkage_.edge_m(blade_angle_rad);
  const double cosine = std::cos(body.pitch_rad);
  const double sine = std::sin(body.pitch_rad);
  return {body.position_m + edge.x() * cosine - edge.y() * sine,
          body.height_m + edge.x() * sine + edge.y() * cosine};
}

double GradeTruth::required_blade_mps(const BodyPose& body, const BodyRates& rates,
                                      double blade_angle_rad) const {
  const auto error_at = [&](double time_s, double angle_rad) {
    const BodyPose moved = {body.position_m + rates.velocity_mps * time_s,
                            body.height_m + rates.climb_mps * time_s,
                            body.pitch_rad + rates.pitch_rate_radps * time_s};
    return error_m(edge_m(moved, angle_rad));
  };
  const double rise_mps =
      (error_at(kStep_s, blade_angle_rad) - error_at(-kStep_s, blade_angle_rad)) / (2.0 * kStep_s);
  const double up_rad = blade_angle_rad + kStep_rad;
  const double down_rad = blade_angle_rad - kStep_rad;
  const double rise_per_stroke = (error_at(0.0, up_rad) - error_at(0.0, down_rad)) /
                                 (linkage_.stroke_m(up_rad) - linkage_.stroke_m(down_rad));
  return -rise_mps / rise_per_stroke;
}

double GradeTruth::tilt_angle_rad(double stroke_m) const {
  if (!tilt_.present) {
    return 0.0;
  }
  constexpr int kHalvings = 50;
  // From where the stroke is shortest to where it is longest.
  const bool lengthens = tilt_linkage_.length_per_angle_m(0.0) > 0.0;
  double short_rad = lengthens ? -tilt_linkage_.most_rad() : tilt_linkage_.most_rad();
  double long_rad = -short_rad;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_rad = 0.5 * (short_rad + long_rad);
    (tilt_linkage_.stroke_m(middle_rad) > stroke_m ? long_rad : short_rad) = middle_rad;
  }
  return 0.5 * (short_rad + long_rad);
}

Eigen::Vector3d GradeTruth::edge_point_m(const BodyPose& body, const BladeAngles& blade,
                                         double along_edge_m) const {
  const Eigen::AngleAxisd pitch(body.pitch_rad, -Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd roll(body.roll_rad, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd lift(blade.lift_rad, -Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd tilt(blade.tilt_rad, Eigen::Vector3d::UnitX());
  const Eigen::Vector2d edge = linkage_.edge_m(blade.lift_rad);
  const Eigen::Vector3d in_body = Eigen::Vector3d(edge.x(), 0.0, edge.y()) +
                                  lift * (tilt * Eigen::Vector3d(0.0, along_edge_m, 0.0));
  const Eigen::Vector3d off = pitch * (roll * in_body);
  if (track_) {
    const double direction = track_->direction_rad(body.position_m) + body.heading_rad;
    const Eigen::Rotation2Dd turn(direction);
    const plant::PlanPlace place =
        track_->place_of(track_->at_m({body.position_m, body.offset_m}) + turn * off.head<2>(),
                         body.position_m + off.x());
    return {place.station_m, place.offset_m, body.height_m + off.z()};
  }
  return Eigen::Vector3d(body.position_m, 0.0, body.height_m) + off;
}

double GradeTruth::worst_error_m(const BodyPose& body, const BladeAngles& blade) const {
  if (!tilt_.present) {
    return error_m(edge_m(body, blade.lift_rad));
  }
  const double left_m = point_error_m(edge_point_m(body, blade, tilt_.half_width_m()));
  const double right_m = point_error_m(edge_point_m(body, blade, -tilt_.half_width_m()));
  return std::abs(left_m) > std::abs(right_m) ? left_m : right_m;
}

double GradeTruth::across_error_m(const BodyPose& body, const BladeAngles& blade) const {
  return point_error_m(edge_point_m(body, blade, tilt_.half_width_m())) -
         point_error_m(edge_point_m(body, blade, -tilt_.half_width_m()));
}

double GradeTruth::required_tilt_mps(const BodyPose& body, const BodyRates& rates,
                                     const BladeAngles& blade) const {
  if (!tilt_.present) {
    return 0.0;
  }
  const auto after = [&](double time_s) {
    return across_error_m(
        {body.position_m + rates.velocity_mps * time_s, body.height_m + rates.climb_mps * time_s,
         body.pitch_rad + rates.pitch_rate_radps * time_s,
         body.roll_rad + rates.roll_rate_radps * time_s},
        blade);
  };
  const double change_mps = (after(kStep_s) - after(-kStep_s)) / (2.0 * kStep_s);
  const double left_rad = blade.tilt_rad + kStep_rad;
  const double right_rad = blade.tilt_rad - kStep_rad;
  const double per_stroke = (across_error_m(body, {blade.lift_rad, left_rad}) -
                             across_error_m(body, {blade.lift_rad, right_rad})) /
                            (tilt_linkage_.stroke_m(left_rad) - tilt_linkage_.stroke_m(right_rad));
  return -change_mps / per_stroke;
}

double GradeTruth::tilt_inflow_m3ps(double tilt_mps) const {
  return tilt_mps > 0.0 ? tilt_.cap_area_m2() * tilt_mps : -tilt_.rod_area_m2() * tilt_mps;
}

double GradeTruth::inflow_m3ps(double blade_mps) const {
  return blade_mps > 0.0 ? cap_area_m2_ * blade_mps : -rod_area_m2_ * blade_mps;
}

BodyPose true_pose(const plant::DozerPlant& plant) {
  BodyPose pose{plant.position_m(), plant.height_m(), plant.pitch_rad(), plant.roll_rad()};
  if (plant.plan()) {
    pose.offset_m = plant.plan()->offset_m();
    pose.heading_rad = plant.plan()->heading_rad();
  }
  return pose;
}

double available_flow_m3ps(const DozerProfile& machine, double engine_radps) {
  const ImplementProfile& implement = machine.implement;
  return std::min(engine_radps / kTwoPi * implement.displacement_m3prev * implement.efficiency,
                  implement.valve_flow_max_m3ps);
}

}  // namespace graben::runs
