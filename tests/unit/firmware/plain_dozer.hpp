// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A dozer in round numbers, made without a file, as plain_machine.hpp has the excavator; and
/// complete, fresh inputs for it.

#include "firmware/dozer/safety/dozer_validation.hpp"
#include "firmware/numeric/constants.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/inputs.hpp"

namespace graben::test {

/// The blade's cylinder goes 0.5 m/s with all that its valve lets through; a track 2 m/s at
/// 40 rad/s with both displacements full. The blade's legs are 1 m and turn between 60 and 120 deg
/// against each other.
inline DozerProfile plain_dozer() {
  DozerProfile profile;
  profile.blade.arm_m = {1.0, 0.0};
  profile.blade.cutting_edge_m = 1.0;
  profile.blade.base_m = {0.0, 1.0};
  profile.blade.length_home_m = std::sqrt(2.0);
  profile.blade.edge_min_m = -0.5;
  profile.blade.edge_max_m = 0.5;
  profile.blade.cylinder_count = 1;
  profile.blade.bore_m = 0.12;
  profile.blade.rod_m = 0.08;  // A_B = 0.002 pi
  profile.implement.valve_flow_max_m3ps = 0.001 * kPi;
  const double opening[] = {0.0, 1.0};
  const double duty[] = {0.25, 1.0};
  const MonotoneTable::Fill filled = profile.implement.spool_to_duty.fill(opening, duty, 2);
  assert_int_equal(filled, MonotoneTable::Fill::kOk);
  profile.hst.engine_most_radps = 50.0;
  profile.hst.pump_m3prev = 1e-4;
  profile.hst.motor_m3prev = 1e-4;
  profile.hst.motor_ratio_min = 0.25;
  profile.hst.gear_ratio = 10.0;
  profile.hst.pump_efficiency = 1.0;
  profile.hst.motor_efficiency = 1.0;
  profile.hst.sprocket_radius_m = 0.5;
  profile.hst.pump_rate_ps = 4.0;
  profile.hst.motor_rate_ps = 2.0;
  profile.control.spool_rate_ps = 3.125;
  profile.control.spool_threshold = 0.03125;
  profile.control.sensor_timeout_s = 0.045;
  profile.control.dead_time_s = 0.0;
  profile.safety.degraded_speed_ratio = 0.25;
  profile.safety.idle_radps = 20.0;
  profile.safety.settle_s = 0.1;
  profile.safety.spool_tolerance = 0.125;
  profile.safety.uncommanded_m = 0.0625;
  profile.safety.stuck_m = 0.0625;
  profile.safety.displacement_tolerance = 0.125;
  profile.safety.displacement_settle_s = 0.5;
  profile.safety.track_speed_tolerance_mps = 0.375;
  return profile;
}

/// The inputs that may be used, with the state after them.
struct ValidatedDozer : DozerValid {
  DozerValidationState state;
};

inline ValidatedDozer validate(const DozerInputs& inputs, const DozerProfile& profile,
                               const DozerValidationState& last, bool moving, TimeUs now_us) {
  const DozerBank bank = dozer_bank(profile);
  ValidatedDozer valid;
  valid.state = last;
  static_cast<DozerValid&>(valid) =
      graben::validate(profile, bank.rows(), inputs, moving, now_us, valid.state);
  return valid;
}

/// Level and driving at 1 m/s with its blade in the middle, enabled for the task, everything
/// stamped now.
inline DozerInputs complete_dozer_inputs(TimeUs now_us) {
  DozerInputs inputs;
  inputs.blade_stroke_m = fresh(0.5, now_us);
  inputs.blade_spool_ratio = fresh(0.0, now_us);
  inputs.valve_enabled = fresh(false, now_us);
  inputs.body.position_m = fresh(2.0, now_us);
  inputs.body.height_m = fresh(0.25, now_us);
  inputs.body.pitch_rad = fresh(0.125, now_us);
  inputs.body.velocity_mps = fresh(1.0, now_us);
  inputs.body.climb_mps = fresh(0.0625, now_us);
  inputs.body.pitch_rate_radps = fresh(0.03125, now_us);
  for (TrackInputs& track : inputs.track) {
    track.pump_ratio = fresh(0.5, now_us);
    track.motor_ratio = fresh(1.0, now_us);
    track.speed_mps = fresh(1.0, now_us);
  }
  inputs.engine_speed_radps = fresh(40.0, now_us);
  inputs.driver.enable = fresh(true, now_us);
  inputs.driver.mode = fresh(OperatorMode::kAutomatic, now_us);
  inputs.driver.task = fresh(Task::kGrade, now_us);
  inputs.driver.speed_override_ratio = fresh(1.0, now_us);
  inputs.same_machine = fresh(true, now_us);
  inputs.link.bus = BusState::kActive;
  return inputs;
}

}  // namespace graben::test
