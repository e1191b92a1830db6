// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/excavator_controller.hpp"
#include "firmware/excavator/estimation/load/assumed_load.hpp"

namespace graben {
namespace {

/// The links' masses are known.
bool weighs(const ExcavatorProfile& profile) {
  return profile.oil.known() && profile.oil.link[kBoom].mass_kg > 0.0;
}

}  // namespace

void ExcavatorController::estimate_load(const ExcavatorValid& valid, const TaskAim& aim,
                                        const KinematicState& now, const Cycle& cycle) {
  if (!weighs(profile_)) {
    return;
  }
  LoadSeen seen;
  seen.known = now.status == ReachStatus::kOk;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const ValidDrive& drive = valid.drive[static_cast<unsigned>(axis)];
    const DriveRow& row = drives()[axis];
    seen.known = seen.known && drive.load_known;
    seen.stroke_m[axis] = drive.stroke_m;
    seen.force_n[axis] =
        row.extend_area_m2 * drive.cap_pressure_pa - row.retract_area_m2 * drive.rod_pressure_pa;
    // The attitude turns with each joint: its row of the Jacobian is the joints' turn per stroke.
    seen.lever_m[axis] = 1.0 / now.jacobian(2, axis);
  }
  seen.joints_rad = now.joints_rad;
  if (profile_.has_swing()) {
    seen.swing_radps = memory_.accepted[kSwing].speed_mps / profile_.swing.lever_m;
  }
  next_load(profile_, seen, aim.kind, aim.share, now.tip, cycle.period_s,
            cycle.last_mode == EcuMode::kActive, memory_.load_observer);
  memory_.tip_load = memory_.load_observer.told;
}

McvInput ExcavatorController::input_for(const DriveVector& wanted_mps,
                                        const ExcavatorValid& valid) const {
  const auto load = profile_.bus.pressures
                        ? memory_.load
                        : worst_loads(profile_, drives(), memory_.load, wanted_mps);
  return mcv_input(span_of(wanted_mps), load, valid.pump_flow_m3ps);
}

void ExcavatorController::demand_pumps(const ExcavatorValid& valid, const Motion& motion,
                                       bool active, double period_s) {
  next_pump_demand(
      profile_, setup_.valve,
      {input_for(motion.wanted_mps, valid), memory_.line_pa, valid.engine_radps,
       active && !motion.tries,
       any_blocked(memory_.watch.drives.blocked) || any_wary(memory_.watch.drives.blocked)},
      period_s, memory_.pumps);
  if (active && motion.tries && profile_.demand_swash.most_ratio > 0.0) {
    // With less, a load that takes all that a line has hides how its valve opens.
    for (unsigned j = 0; j < static_cast<unsigned>(profile_.pump_count); ++j) {
      memory_.pumps.swash_ratio[j] = profile_.demand_swash.most_ratio;
    }
  }
}

}  // namespace graben
