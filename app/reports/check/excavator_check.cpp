// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "app/machines/axis_names.hpp"
#include "app/plant/linkage_geometry.hpp"
#include "app/reports/check/warnings.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::reports {
namespace {

using machines::kAxisNames;
using machines::kDriveNames;

constexpr int kDirections = 180;
constexpr int kStrokes = 72;

double to_lpm(double m3ps) { return 6e4 * m3ps; }

FactTable reach_table(const Reach& reach) {
  const auto m = [](double value) { return fmt::format("{:.2f}", value); };
  return {"Reach of the teeth",
          {"", "m", ""},
          {{"farthest", m(reach.most_x_m), "from the swing axis"},
           {"at the ground", m(reach.ground_x_m), "from the swing axis"},
           {"deepest", m(-reach.least_y_m), "below the ground"},
           {"highest", m(reach.most_y_m), "above the ground"}},
          ""};
}

FactTable joint_table(const ExcavatorProfile& profile) {
  const ExcavatorKinematics kinematics(profile.geometry);
  const auto joints = [&](double share) {
    Eigen::Vector3d strokes_m;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      strokes_m[i] = share * profile.geometry.cylinder[i].stroke_m;
    }
    return kinematics.joints_from_strokes(strokes_m).joints_rad;
  };
  const Eigen::Vector3d closed = joints(0.0);
  const Eigen::Vector3d open = joints(1.0);
  FactTable table{"Joints and cylinders",
                  {"", "cylinder closed, deg", "open, deg", "stroke, m", "pin to pin, m"},
                  {},
                  "boom against the horizontal, arm against the boom, bucket against the arm"};
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const CylinderGeometry& cylinder = profile.geometry.cylinder[i];
    table.rows.push_back({kAxisNames[i], fmt::format("{:.1f}", kDegreesPerRad * closed[i]),
                          fmt::format("{:.1f}", kDegreesPerRad * open[i]),
                          fmt::format("{:.3f}", cylinder.stroke_m),
                          fmt::format("{:.3f} .. {:.3f}", cylinder.closed_length_m,
                                      cylinder.closed_length_m + cylinder.stroke_m)});
  }
  return table;
}

FactTable drive_table(const ExcavatorProfile& profile) {
  FactTable table{"Drives at full flow and at relief",
                  {"", "pump", "L/min", "extends, m/s", "retracts, m/s", "pushes, kN", "pulls, kN"},
                  {},
                  "speeds at full swash and speed at work, alone on its pump, without "
                  "regeneration; forces at the pump's relief, no back pressure"};
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    const int pump_index = profile.valve.spool[i].pump;
    const PumpProfile& pump = profile.pump[static_cast<unsigned>(pump_index)];
    const double flow_m3ps = std::min(full_flow_m3ps(pump), profile.valve.section_flow_m3ps);
    if (i == kSwing) {
      const double radps = flow_m3ps / profile.swing.displacement_m3prad;
      const double torque_knm = 1e-3 * pump.relief_pa * profile.swing.displacement_m3prad;
      table.rows.push_back({kDriveNames[i], fmt::format("{}", pump_index + 1),
                            fmt::format("{:.0f}", to_lpm(flow_m3ps)),
                            fmt::format("{:.2f} rad/s", radps), fmt::format("{:.2f} rad/s", radps),
                            fmt::format("{:.1f} kN m", torque_knm),
                            fmt::format("{:.1f} kN m", torque_knm)});
      continue;
    }
    const double extend_m2 = profile.geometry.cylinder[i].cap_area_m2();
    const double retract_m2 = profile.geometry.cylinder[i].rod_area_m2();
    table.rows.push_back({kDriveNames[i], fmt::format("{}", pump_index + 1),
                          fmt::format("{:.0f}", to_lpm(flow_m3ps)),
                          fmt::format("{:.3f}", flow_m3ps / extend_m2),
                          fmt::format("{:.3f}", flow_m3ps / retract_m2),
                          fmt::format("{:.0f}", 1e-3 * pump.relief_pa * extend_m2),
                          fmt::format("{:.0f}", 1e-3 * pump.relief_pa * retract_m2)});
  }
  return table;
}

FactTable pump_table(const ExcavatorProfile& profile) {
  FactTable table{
      "Pumps",
      {"", "full flow, L/min", "at the task's swash, L/min", "relief, MPa", "power at relief, kW"},
      {},
      profile.pump[0].regulator.sets_swash()
          ? "they set their swash themselves: task.swash and task.swash_on_demand are not used"
          : ""};
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    const PumpProfile& pump = profile.pump[j];
    const double flow_m3ps = full_flow_m3ps(pump);
    table.rows.push_back({fmt::format("{}", j + 1), fmt::format("{:.1f}", to_lpm(flow_m3ps)),
                          fmt::format("{:.1f}", to_lpm(flow_m3ps * profile.dig_swash_ratio[j])),
                          fmt::format("{:.1f}", 1e-6 * pump.relief_pa),
                          fmt::format("{:.0f}", 1e-3 * pump.relief_pa * flow_m3ps)});
  }
  return table;
}

FactTable mode_table(const machines::SimulatedExcavator* simulated) {
  FactTable table{"Lowest modes of the linkage on its oil", {"", "Hz", "Hz", "Hz"}, {}, ""};
  if (simulated == nullptr) {
    table.columns.clear();
    table.note = "need masses and oil: there is no NAME.sim.toml beside the profile";
    return table;
  }
  const RoundedRectangle path(simulated->profile.dig_path);
  const ExcavatorKinematics kinematics(simulated->profile.geometry);
  const DigPath& dig = simulated->profile.dig_path;
  const double middle_m = 0.5 * (dig.x_min_m + dig.x_max_m);
  for (const auto& [name, at_m] :
       {std::pair{"far on the path", Eigen::Vector2d(dig.x_max_m, dig.y_max_m)},
        std::pair{"middle of its bottom", Eigen::Vector2d(middle_m, dig.y_min_m)},
        std::pair{"near on the path", Eigen::Vector2d(dig.x_min_m, dig.y_min_m)}}) {
    const PathPoint point = path.closest(at_m);
    const StrokeResult strokes = kinematics.strokes_from_pose(
        {point.position_m.x(), point.position_m.y(), point.attitude_rad});
    const Eigen::Vector3d hz = linkage_modes_hz(simulated->plant, strokes.strokes_m);
    table.rows.push_back({name, fmt::format("{:.2f}", hz[0]), fmt::format("{:.2f}", hz[1]),
                          fmt::format("{:.1f}", hz[2])});
  }
  table.note = "valves shut, bucket empty, no friction";
  return table;
}

}  // namespace

double full_flow_m3ps(const PumpProfile& pump) {
  return pump.displacement_m3prev * pump.rated_speed_radps / kTwoPi;
}

Reach reach_of(const ExcavatorGeometry& geometry) {
  const ExcavatorKinematics kinematics(geometry);
  Reach reach;
  reach.foot_m = geometry.boom_foot_m;
  reach.nearest_m.assign(kDirections, 0.0);
  reach.farthest_m.assign(kDirections, 0.0);
  reach.least_y_m = geometry.boom_foot_m.y();
  const auto stroke_m = [&](unsigned i, int step) {
    return geometry.cylinder[i].stroke_m * step / kStrokes;
  };
  for (int boom = 0; boom <= kStrokes; ++boom) {
    for (int arm = 0; arm <= kStrokes; ++arm) {
      for (int bucket = 0; bucket <= kStrokes; ++bucket) {
        const JointResult joints = kinematics.joints_from_strokes(
            {stroke_m(kBoom, boom), stroke_m(kArm, arm), stroke_m(kBucket, bucket)});
        if (joints.status != ReachStatus::kOk) {
          continue;
        }
        const TipPose tip = kinematics.pose_from_joints(joints.joints_rad);
        const double x_m = tip.x_m + reach.foot_m.x();
        const double y_m = tip.y_m + reach.foot_m.y();
        const double radius_m = std::hypot(tip.x_m, tip.y_m);
        const double turn = std::atan2(tip.y_m, tip.x_m) / kTwoPi + 0.5;
        const auto bin = static_cast<std::size_t>(
            std::min(kDirections - 1, static_cast<int>(turn * kDirections)));
        reach.farthest_m[bin] = std::max(reach.farthest_m[bin], radius_m);
        if (reach.nearest_m[bin] == 0.0 || radius_m < reach.nearest_m[bin]) {
          reach.nearest_m[bin] = radius_m;
        }
        reach.most_x_m = std::max(reach.most_x_m, x_m);
        reach.least_y_m = std::min(reach.least_y_m, y_m);
        reach.most_y_m = std::max(reach.most_y_m, y_m);
      }
    }
  }
  // Where the outer bound crosses the ground.
  for (std::size_t i = 0; i + 1 < reach.farthest_m.size(); ++i) {
    const auto at = [&](std::size_t bin) {
      const double angle = kTwoPi * ((static_cast<double>(bin) + 0.5) / kDirections - 0.5);
      return Eigen::Vector2d(reach.foot_m + reach.farthest_m[bin] *
                                                Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    };
    const Eigen::Vector2d a = at(i);
    const Eigen::Vector2d b = at(i + 1);
    if (reach.farthest_m[i] > 0.0 && reach.farthest_m[i + 1] > 0.0 && a.y() * b.y() <= 0.0 &&
        a.y() != b.y()) {
      reach.ground_x_m =
          std::max(reach.ground_x_m, a.x() + (b.x() - a.x()) * a.y() / (a.y() - b.y()));
    }
  }
  return reach;
}

Eigen::Vector3d linkage_modes_hz(const plant::ExcavatorPlantProfile& plant,
                                 const Eigen::Vector3d& strokes_m) {
  const ExcavatorGeometry& geometry = plant.machine.geometry;
  const plant::LinkageGeometry linkage(geometry);
  const plant::JointArray angle = linkage.angles_at({strokes_m[0], strokes_m[1], strokes_m[2]});
  const auto lever = linkage.levers(plant::rotations_of(angle));
  Eigen::Matrix3d mass = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  std::array<Eigen::Vector2d, kAxisCount> pin;
  Eigen::Vector2d next = Eigen::Vector2d::Zero();
  double direction_rad = 0.0;
  for (unsigned b = 0; b < kAxisCount; ++b) {
    direction_rad += angle[b];
    pin[b] = next;
    const Eigen::Rotation2Dd turn(direction_rad);
    const plant::LinkBody& body = plant.link[b];
    const Eigen::Vector2d centre = pin[b] + turn * body.mass_centre_m;
    Eigen::Matrix<double, 2, 3> moves = Eigen::Matrix<double, 2, 3>::Zero();
    Eigen::Vector3d turns = Eigen::Vector3d::Zero();
    for (unsigned j = 0; j <= b; ++j) {
      const Eigen::Vector2d arm = centre - pin[j];
      moves.col(j) << -arm.y(), arm.x();
      turns[j] = 1.0;
    }
    mass +=
        body.mass_kg * moves.transpose() * moves + body.inertia_kgm2 * turns * turns.transpose();
    const double length_m = b == kBoom ? geometry.boom_length_m : geometry.arm_length_m;
    next = pin[b] + turn * Eigen::Vector2d(length_m, 0.0);
    const plant::CylinderData cylinder = plant.cylinder(static_cast<int>(b));
    const double cap_m3 = cylinder.dead_volume_m3 + cylinder.area.cap_m2 * strokes_m[b];
    const double rod_m3 =
        cylinder.dead_volume_m3 + cylinder.area.rod_m2 * (cylinder.stroke_m - strokes_m[b]);
    const double spring_npm =
        plant.bulk_modulus_pa * (cylinder.area.cap_m2 * cylinder.area.cap_m2 / cap_m3 +
                                 cylinder.area.rod_m2 * cylinder.area.rod_m2 / rod_m3);
    stiffness(b, b) = spring_npm * lever[b].stroke_per_angle_m * lever[b].stroke_per_angle_m;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> solver(stiffness, mass);
  return solver.eigenvalues().cwiseSqrt() / kTwoPi;
}

double lowest_mode_hz(const machines::SimulatedExcavator& machine) {
  constexpr int kPlaces = 40;
  const RoundedRectangle path(machine.profile.dig_path);
  const ExcavatorKinematics kinematics(machine.profile.geometry);
  double lowest_hz = 1e9;
  for (int i = 0; i < kPlaces; ++i) {
    const PathPoint point = path.at_share(static_cast<double>(i) / kPlaces);
    const StrokeResult strokes = kinematics.strokes_from_pose(
        {point.position_m.x(), point.position_m.y(), point.attitude_rad});
    if (strokes.status == ReachStatus::kOk) {
      lowest_hz = std::min(lowest_hz, linkage_modes_hz(machine.plant, strokes.strokes_m)[0]);
    }
  }
  return lowest_hz;
}

MachineCheck check_machine(const machines::ExcavatorMachine& machine,
                           const machines::SimulatedExcavator* simulated) {
  const Reach reach = reach_of(machine.profile.geometry);
  MachineCheck check;
  check.name = machine.name;
  check.kind = "excavator";
  check.hash = machine.hash;
  check.tables = {reach_table(reach),
                  joint_table(machine.profile),
                  drive_table(machine.profile),
                  pump_table(machine.profile),
                  mode_table(simulated),
                  capability_table(machine.profile),
                  lie_table(machine.profile),
                  answer_table(machine),
                  provenance_table(machine.provenance)};
  if (machine.profile.mark.known()) {
    check.tables.push_back(mark_table(machine.profile));
  }
  check.warnings = excavator_warnings(machine, simulated);
  check.drawing = excavator_drawing(machine.profile, reach);
  return check;
}

}  // namespace graben::reports
