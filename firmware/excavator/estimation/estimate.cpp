// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/estimate.hpp"

#include <algorithm>

#include "firmware/excavator/estimation/load/assumed_load.hpp"
#include "firmware/excavator/estimation/tuning.hpp"

namespace graben {
namespace {

/// What comes late is foretold over 20 ms, and shows no more of 10 Hz and beyond: with the feedback
/// of strokes one machine of twenty rings.
OilDesign oil_design(const ExcavatorProfile& profile) {
  OilDesign design;
  if (profile.foretells_joints()) {
    design.lag_s = 0.025;
    design.travel_ps = 4.0;
    design.travel_noise_m = 5e-5;
  }
  return design;
}

/// The links' masses are known.
bool weighs(const ExcavatorProfile& profile) {
  return profile.oil.known() && profile.oil.link[kBoom].mass_kg > 0.0;
}

/// What the servos are owed.
void estimate_owed(const ExcavatorModel& machine, const ExcavatorValid& valid,
                   const InputState& inputs, const MotionUnderWay& motion, const Cycle& cycle,
                   const LastCycle& last, EstimationState& state) {
  const EcuMode mode = cycle.last_mode;
  const double elapsed_s = cycle.elapsed_s;
  for (int i = 0; i < machine.drives.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    const DriveRow& drive = machine.drives[i];
    ServoState& servo = state.servo.drive[k];
    const double stroke_m = valid.drive[k].stroke_m;
    const double expected_mps = last.expected_mps[i];
    const int blocked = inputs.watch.drives.blocked[k].side;
    if (mode == EcuMode::kActive && motion.on_plan) {
      next_servo_on_plan(drive, expected_mps, stroke_m, motion.planned_m[i], motion.new_plan,
                         elapsed_s, servo, blocked);
    } else if (mode == EcuMode::kActive && last.jogs && expected_mps == 0.0) {
      release_servo(drive, stroke_m, elapsed_s, servo);
    } else {
      servo_after(drive, mode, expected_mps, stroke_m, elapsed_s, servo, blocked);
    }
  }
}

/// The payload by the boom's pressures, while nothing moves.
void weigh(const ExcavatorProfile& profile, const OilSeen& seen, EcuMode mode,
           EstimationState& state) {
  if (mode == EcuMode::kActive || !seen.force_known) {
    return;
  }
  const double measured_kg =
      payload_kg(profile.oil, profile.geometry, state.pose, seen.force_n[kBoom]);
  state.payload_kg += kPayloadWeight * (measured_kg - state.payload_kg);
}

/// It moves, not only just, nothing has pushed the teeth lately, and what rings is not an angle of
/// 20 ms ago.
bool is_by_oil(const ExcavatorProfile& profile, bool active, double elapsed_s,
               EstimationState& state) {
  double links_kg = 0.0;
  for (const LinkMass& link : profile.oil.link) {
    links_kg += link.mass_kg;
  }
  const TipLoad& tip = state.load_observer.told;
  double& pushed_s = state.softness.pushed_s;
  const bool pushed = tip.known && tip.force_n.norm() > kFreeTip * links_kg * kStandardGravity_mps2;
  pushed_s = pushed ? kFreeAfter_s : std::max(0.0, pushed_s - elapsed_s);
  if (!active) {
    pushed_s = std::max(pushed_s, kFreeAfterStart_s);
  }
  return tip.known && pushed_s == 0.0 && !profile.foretells_joints();
}

void estimate_oil(const ExcavatorModel& machine, const OilGains& gains, const ExcavatorValid& valid,
                  const InputState& inputs, bool for_oil, const Cycle& cycle, const LastCycle& last,
                  EstimationState& state) {
  const EcuMode mode = cycle.last_mode;
  const ExcavatorProfile& profile = machine.profile;
  if (!is_on_oil(profile)) {
    return;
  }
  HeldLoad& held = state.held;
  held.yield_mpsn = last.flow.yield_mpsn;
  OilSeen seen = oil_seen(machine.drives, valid.drive);
  seen.cycles = cycles_in(cycle.elapsed_s);
  for (int axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<unsigned>(axis);
    seen.asked_mps[axis] = last.commands.asked_mps[k];
    seen.expected_mps[axis] = last.expected_mps[axis];
    seen.stands[axis] = stands_open(inputs.watch.drives.learnt[k]);
  }
  seen.yield_mpsn = held.yield_mpsn;
  seen.opened_for_n = held.leads ? held.force_n : filtered_force_n(machine.drives, state.load);
  const bool reached = state.pose.status == ReachStatus::kOk;
  if (reached) {
    weigh(profile, seen, mode, state);
    next_softness(seen.force_n[kBoom] / profile.geometry.cylinder[kBoom].cap_area_m2(),
                  state.modes.omega_radps[0],
                  profile.control.learns && seen.force_known &&
                      is_by_oil(profile, mode == EcuMode::kActive, cycle.elapsed_s, state),
                  cycle.elapsed_s, state.softness);
    state.modes = oil_modes(profile.oil, profile.geometry, state.pose, state.load, state.payload_kg,
                            state.softness.share);
  }
  const bool leads = reached && seen.force_known && for_oil && are_quick(machine.drives);
  next_oil(gains, state.modes, seen, mode == EcuMode::kActive && reached, leads, state.oil);
  if (reached) {
    next_held_load(state.oil, seen.expected_mps,
                   stroke_inertia_kg(profile.oil, profile.geometry, state.pose, state.payload_kg),
                   seen.cycles, held);
  }
}

/// Tip force and payload.
void estimate_load(const ExcavatorModel& machine, const ExcavatorValid& valid,
                   const InputState& inputs, const MotionUnderWay& motion, const Cycle& cycle,
                   EstimationState& state) {
  const ExcavatorProfile& profile = machine.profile;
  if (!weighs(profile)) {
    return;
  }
  const KinematicState& pose = state.pose;
  LoadSeen seen;
  seen.posed = pose.status == ReachStatus::kOk;
  seen.known = seen.posed;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const ValidDrive& drive = valid.drive[static_cast<unsigned>(axis)];
    const DriveRow& row = machine.drives[axis];
    seen.known = seen.known && drive.load_known;
    seen.stroke_m[axis] = drive.stroke_m;
    seen.force_n[axis] =
        row.extend_area_m2 * drive.cap_pressure_pa - row.retract_area_m2 * drive.rod_pressure_pa;
    // The attitude turns with each joint: its row of the Jacobian is the joints' turn per stroke.
    seen.lever_m[axis] = 1.0 / pose.jacobian(2, axis);
  }
  seen.joints_rad = pose.joints_rad;
  if (profile.has_swing()) {
    seen.swing_radps = inputs.accepted[kSwing].speed_mps / profile.swing.lever_m;
  }
  next_load(profile, seen, motion.kind, motion.share, pose.tip, cycle.elapsed_s,
            cycle.last_mode == EcuMode::kActive, state.load_observer);
}

}  // namespace

OilGains oil_gains(const ExcavatorProfile& profile) {
  return profile.control.law == ControlLaw::kOil ? OilGains(oil_design(profile)) : OilGains();
}

bool is_on_oil(const ExcavatorProfile& profile) {
  return profile.control.law == ControlLaw::kOil && profile.oil.known();
}

void estimate(const ExcavatorModel& machine, const OilGains& gains, const ExcavatorValid& valid,
              const InputState& inputs, const MotionUnderWay& motion, const Cycle& cycle,
              const LastCycle& last, EstimationState& state) {
  const ExcavatorProfile& profile = machine.profile;
  next_loads(profile.control.pressure_filter_s, valid.drive, cycle.elapsed_s,
             cycle.last_mode != EcuMode::kActive, state.load);
  next_swing_push(valid.drive[kSwing], cycle.elapsed_s, state.swing_push);
  estimate_owed(machine, valid, inputs, motion, cycle, last, state);
  state.pose = machine.kinematics.planar().state(valid.strokes_m().head<kAxisCount>());
  if (!profile.bus.pressures) {
    state.load = links_alone(profile, state.pose);
  }
  estimate_oil(machine, gains, valid, inputs, motion.for_oil, cycle, last, state);
  estimate_load(machine, valid, inputs, motion, cycle, state);
}

}  // namespace graben
