// SPDX-License-Identifier: Apache-2.0
// Rows that only the excavator has, or has in its own way.

#include <algorithm>
#include <cmath>

#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "tests/faults/row.hpp"
#include "tests/faults/trial.hpp"

namespace graben::faults {
namespace {

void pressure_silent(Trial<Excavator>& trial) {
  const Sensor& sensor = trial.any_sensor(Excavator::slowing());
  slowed_by_silence(trial, sensor.id, sensor.missing);
}

void pressure_wrong(Trial<Excavator>& trial) {
  auto& rig = trial.work();
  // Only in motion can a number that stands still be told from a pressure.
  const unsigned axis =
      trial.odd() ? trial.any_of(kAxisCount) : trial.farthest_place(8 * kSecondUs);
  plant::AxisFaults& faults = rig.plant.faults().axis[axis];
  // A chamber that is nearly empty may stay at one pressure, and a sensor may show 1.2 MPa less.
  constexpr double kFilled_pa = 3e6;
  const double cap_pa = rig.plant.plant().cap_pressures_pa()[axis];
  const double rod_pa = rig.plant.plant().rod_pressures_pa()[axis];
  const bool any_side = std::min(cap_pa, rod_pa) > kFilled_pa;
  const bool cap = any_side ? trial.any_of(2) == 0 : cap_pa > rod_pa;
  // Before the watch has seen 0.06 m of way, to and fro.
  constexpr double kJudged_m = 0.02;
  plant::PressureFault& pressure = cap ? faults.cap : faults.rod;
  Slowing slowing{rig.at_us(), Fault::kPressureImplausible};
  if (trial.odd()) {
    pressure.rail_pa = rig.machine.profile.safety.pressure_rail_pa;
    slowing.detect_us = 400 * kMillisecondUs;
  } else {
    // Until its cylinder has gone a way of 0.06 m.
    pressure.stuck = true;
    slowing.detect_us = 10 * kSecondUs;
    const double from_m = rig.plant.plant().strokes_m()[axis];
    double moved_m = 0.0;
    const bool judged = rig.run_until(slowing.detect_us - kCycle_us, [&] {
      moved_m = std::max(moved_m, std::abs(rig.plant.plant().strokes_m()[axis] - from_m));
      return moved_m > kJudged_m;
    });
    if (!judged && !rig.outputs().status.faults.has(slowing.fault)) {
      // A pressure stuck high takes lambda down so far that the cylinder hardly moves.
      trial.saw("moved < 0.02 m");
      return;
    }
  }
  slowing.cure = [&pressure] { pressure = {}; };
  trial.expect_slower(slowing);
}

/// A pump's feedback is wrong, or the pump itself.
void swash_wrong(Trial<Excavator>& trial) {
  auto& rig = trial.work();
  plant::PumpFaults& pump = rig.plant.faults().pump[trial.any_of(kPumpCount)];
  // Less than any that is asked for, and more than light digging asks for.
  constexpr std::array<double, 3> kRatios = {0.05, 0.15, 1.0};
  const double ratio = kRatios[trial.any_of(kRatios.size())];
  (trial.odd() ? pump.shown_swash_ratio : pump.actual_swash_ratio) = ratio;
  Slowing slowing{rig.at_us(), Fault::kSwashDisagrees, 800 * kMillisecondUs};
  slowing.back_us = 1500 * kMillisecondUs;
  slowing.cure = [&pump] { pump = {}; };
  trial.expect_slower(slowing);
}

TipPose pose_at(const RoundedRectangle& path, double share) {
  const PathPoint point = path.at_share(share - std::floor(share));
  return {point.position_m.x(), point.position_m.y(), point.attitude_rad};
}

/// Where on the path a cylinder comes closest to one of its ends.
struct Closest {
  double share = 0.0;
  double left_m = 1e3;
  bool reachable = true;
};

Closest closest_to_an_end(const ExcavatorProfile& profile, const ExcavatorKinematics& kinematics) {
  constexpr int kPoints = 200;
  const RoundedRectangle path(profile.dig_path);
  Closest closest;
  for (int k = 0; k < kPoints; ++k) {
    const double share = static_cast<double>(k) / kPoints;
    const StrokeResult strokes = kinematics.strokes_from_pose(pose_at(path, share));
    closest.reachable = closest.reachable && strokes.status == ReachStatus::kOk;
    for (unsigned i = 0; i < kAxisCount; ++i) {
      const double left_m = std::min(strokes.strokes_m[i],
                                     profile.geometry.cylinder[i].stroke_m - strokes.strokes_m[i]);
      if (left_m < closest.left_m) {
        closest = {share, left_m, closest.reachable};
      }
    }
  }
  return closest;
}

/// The path is pushed out to one side until a cylinder would no longer reach it, and the machine
/// starts a little before that place.
void runs_at_its_end(Trial<Excavator>& trial) {
  Excavator::Scenery scenery = Excavator::scenery_of(trial.seed());
  machines::SimulatedExcavator& machine = scenery.machine;
  DigPath& path = machine.profile.dig_path;
  const ExcavatorKinematics kinematics(machine.profile.geometry);
  // Towards x_min the field itself is slower at the arm's end than the limit there.
  double& edge_m = trial.any_of(2) == 0 ? path.x_max_m : path.y_max_m;
  constexpr double step_m = 0.005;
  while (closest_to_an_end(machine.profile, kinematics).reachable) {
    edge_m += step_m;
  }
  edge_m -= step_m;
  const Closest closest = closest_to_an_end(machine.profile, kinematics);
  constexpr double kBefore_share = 0.05;
  const StrokeResult start =
      kinematics.strokes_from_pose(pose_at(RoundedRectangle(path), closest.share - kBefore_share));
  scenery.start_strokes_m = start.strokes_m;
  trial.set_up(scenery);
  expect_slowed_at_end(trial, 10 * kSecondUs, machine.plant.port_relief_pa,
                       [&](const Excavator::Plant& plant) {
                         AtEnd now{1.0, plant.peak_chamber_pressure_pa()};
                         for (unsigned i = 0; i < kAxisCount; ++i) {
                           const double most_m = machine.profile.geometry.cylinder[i].stroke_m;
                           const double stroke_m = plant.strokes_m()[i];
                           now.left_m = std::min({now.left_m, stroke_m, most_m - stroke_m});
                         }
                         return now;
                       });
}

}  // namespace

Rows<Excavator> excavator_rows() {
  return {{5, "pressure sensor times out", "D", pressure_silent},
          {37, "pressure stuck or at its rail", "D", pressure_wrong},
          {38, "swash disagrees with its command", "D", swash_wrong},
          {39, "HST displacement runs away", "not of this machine", nullptr},
          {40, "track speeds disagree", "not of this machine", nullptr},
          {49, "cylinder runs towards its end stop", "D", runs_at_its_end},
          {81, "pumps stay open after the stop, unseen", "not of this machine", nullptr}};
}

}  // namespace graben::faults
