// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "app/machines/imu_section.hpp"
#include "app/reports/page_setup.hpp"
#include "firmware/dozer/grade_profile.hpp"
#include "firmware/excavator/motion/field/dig_field.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

constexpr double kPathStep_m = 0.02;
constexpr double kFieldStep_m = 0.25;
/// Of the field around the path.
constexpr double kFieldMargin_m = 1.0;
constexpr double kDesignStep_m = 0.05;
/// The design goes on level before and after the grade, and machines begin before it.
constexpr double kDesignMargin_m = 5.0;

json vector(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }

json cylinder_json(const CylinderGeometry& cylinder) {
  return {{"count", cylinder.count},        {"bore_m", cylinder.bore_m},
          {"rod_m", cylinder.rod_m},        {"closed_length_m", cylinder.closed_length_m},
          {"stroke_m", cylinder.stroke_m},  {"base_m", vector(cylinder.base_m)},
          {"eye_m", vector(cylinder.eye_m)}};
}

json imu_json(const ImuMount& mount) {
  return {{"address", mount.address},
          {"at_m", vector(mount.at_m)},
          {"turn_rad", mount.turn_rad},
          {"backwards", mount.backwards},
          {"on_rocker", mount.on_rocker}};
}

/// The profile's, or those that a run tries in the place of stroke sensors.
json imus_json(ExcavatorProfile profile) {
  if (!profile.imu.known()) {
    machines::fit_usual_imus(profile);
  }
  const std::array<ImuMount, kImuCount>& mount = profile.imu.mount;
  return {{"boom", imu_json(mount[kBoom])},
          {"arm", imu_json(mount[kArm])},
          {"bucket", imu_json(mount[kBucket])}};
}

json path_json(const RoundedRectangle& path, const Eigen::Vector2d& foot_m) {
  const int count = static_cast<int>(std::ceil(path.length_m() / kPathStep_m));
  json points = json::array();
  for (int i = 0; i < count; ++i) {
    const PathPoint point = path.at_share(static_cast<double>(i) / count);
    const Eigen::Vector2d at_m = point.position_m + foot_m;
    points.push_back({rounded(at_m.x()), rounded(at_m.y()), rounded(point.attitude_rad)});
  }
  points.push_back(points.front());
  return points;
}

/// At the attitude that the path has beside it, which does not matter to what is shown.
json field_json(const DigField& field, const DigPath& path, const Eigen::Vector2d& foot_m) {
  const auto steps = [](double from_m, double until_m) {
    return static_cast<int>(std::ceil((until_m - from_m + 2.0 * kFieldMargin_m) / kFieldStep_m));
  };
  json arrows = json::array();
  for (int i = 0; i <= steps(path.x_min_m, path.x_max_m); ++i) {
    for (int j = 0; j <= steps(path.y_min_m, path.y_max_m); ++j) {
      const Eigen::Vector2d at_m(path.x_min_m - kFieldMargin_m + i * kFieldStep_m,
                                 path.y_min_m - kFieldMargin_m + j * kFieldStep_m);
      const double attitude_rad = field.path().closest(at_m).attitude_rad;
      const TipVelocity velocity = field.contour({at_m.x(), at_m.y(), attitude_rad});
      arrows.push_back({rounded(at_m.x() + foot_m.x()), rounded(at_m.y() + foot_m.y()),
                        rounded(velocity.linear_mps.x()), rounded(velocity.linear_mps.y())});
    }
  }
  return arrows;
}

json dig_json(const ExcavatorProfile& profile) {
  const Eigen::Vector2d foot_m = profile.geometry.boom_foot_m;
  const DigField field(profile, ExcavatorKinematics(profile.geometry));
  return {{"path", path_json(field.path(), foot_m)},
          {"speed_mps", profile.dig_speed_mps},
          {"field", field_json(field, profile.dig_path, foot_m)},
          {"ground_z_m", 0.0}};
}

/// Along the track at the places of the design: [x, value].
template <class Value>
json along_json(double length_m, const Value& value) {
  const int count = static_cast<int>(std::ceil((length_m + 2.0 * kDesignMargin_m) / kDesignStep_m));
  json points = json::array();
  for (int i = 0; i <= count; ++i) {
    const double x_m = i * kDesignStep_m - kDesignMargin_m;
    points.push_back({rounded(x_m), rounded(value(x_m))});
  }
  return points;
}

/// What a machine whose blade tilts has beside the others, and its design across the track.
void add_tilt(const DozerProfile& profile, double length_m, json& machine) {
  const TiltProfile& tilt = profile.tilt;
  if (!tilt.present) {
    return;
  }
  machine["tilt"] = {{"edge_width_m", tilt.edge_width_m},
                     {"angle_most_rad", tilt.angle_most_rad},
                     {"base_m", vector(tilt.base_m)},
                     {"eye_m", vector(tilt.eye_m)}};
  const GradeProfile design(profile.grade);
  machine["cross"] = along_json(length_m, [&](double x_m) { return design.cross_at(x_m).slope; });
  if (design.curves()) {
    machine["curvature"] =
        along_json(length_m, [&](double x_m) { return design.curvature_at(x_m); });
  }
}

json dozer_json(const machines::DozerMachine& machine, double length_m) {
  const DozerBody& body = machine.profile.body;
  const BladeGeometry& blade = machine.profile.blade;
  const GradeProfile design(machine.profile.grade);
  json result = {
      {"kind", "dozer"},
      {"name", machine.name},
      {"hash", machine.hash},
      {"blade",
       {{"pivot_m", vector(blade.pivot_m)},
        {"arm_m", vector(blade.arm_m)},
        {"cutting_edge_m", blade.cutting_edge_m},
        {"base_m", vector(blade.base_m)},
        {"length_home_m", blade.length_home_m},
        {"edge_min_m", blade.edge_min_m},
        {"edge_max_m", blade.edge_max_m},
        {"cylinders", blade.cylinder_count},
        {"bore_m", blade.bore_m},
        {"rod_m", blade.rod_m}}},
      {"track_contact_m", body.track_contact_m},
      {"half_gauge_m", body.half_gauge_m},
      {"mass_centre_height_m", body.mass_centre_height_m},
      {"design", along_json(length_m, [&](double x_m) { return design.at(x_m).height_m; })},
      {"length_m", length_m}};
  add_tilt(machine.profile, length_m, result);
  return result;
}

}  // namespace

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

json machine_json(const machines::ExcavatorMachine& machine,
                  const std::vector<machines::TaskFile>& tasks) {
  const ExcavatorProfile& profile = machine.profile;
  const ExcavatorGeometry& geometry = profile.geometry;
  json result = {{"kind", "excavator"},
                 {"name", machine.name},
                 {"hash", machine.hash},
                 {"boom_m", geometry.boom_length_m},
                 {"arm_m", geometry.arm_length_m},
                 {"bucket_m", geometry.bucket_length_m},
                 {"boom_foot_m", vector(geometry.boom_foot_m)},
                 {"has_swing", profile.has_swing()},
                 {"pumps", profile.pump_count},
                 {"relief_pa", profile.pump[0].relief_pa}};
  if (profile.geometry.body.known()) {
    result["bucket_width_m"] = profile.geometry.body.bucket_width_m;
    result["bucket_capacity_m3"] = profile.geometry.body.capacity_m3;
  }
  result["cylinders"] = {{"boom", cylinder_json(geometry.cylinder[kBoom])},
                         {"arm", cylinder_json(geometry.cylinder[kArm])},
                         {"bucket", cylinder_json(geometry.cylinder[kBucket])}};
  result["linkage"] = {{"rocker_pivot_m", vector(geometry.linkage.rocker_pivot_m)},
                       {"rocker_m", geometry.linkage.rocker_m},
                       {"coupler_m", geometry.linkage.coupler_m},
                       {"lug_m", vector(geometry.linkage.lug_m)}};
  result["imus"] = imus_json(profile);
  if (!machine.bus.empty()) {
    result["bus"] = bus_json(machine.bus);
  }
  result["dig"] = dig_json(profile);
  result["assist_window_m"] = profile.assist.window_m;
  result["tasks"] = json::array();
  for (const machines::TaskFile& task : tasks) {
    result["tasks"].push_back(task_json(task, profile));
  }
  return result;
}

json machine_json(const machines::SimulatedExcavator& machine,
                  const std::vector<machines::TaskFile>& tasks) {
  json result = machine_json(static_cast<const machines::ExcavatorMachine&>(machine), tasks);
  result["dig"]["ground_z_m"] =
      machine.plant.digging
          ? machine.plant.digging->level_m
          : machine.experiment.soil.ground_y_m + machine.profile.geometry.boom_foot_m.y();
  return result;
}

json machine_json(const machines::DozerMachine& machine) {
  return dozer_json(machine, machine.profile.grade.end_m());
}

json machine_json(const machines::SimulatedDozer& machine) {
  return dozer_json(machine, machine.experiment.length_m);
}

}  // namespace graben::reports
