// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/safety/dozer_validation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace graben {
namespace {

/// Signals that a dozer can't do without. [-; size: six of the pose, three a track]
constexpr std::size_t kRequiredCount = 6 + 3 * kTrackCount;

/// Errors of what is believed are named when it comes in.
std::array<Required, kRequiredCount> required_signals(const DozerInputs& inputs,
                                                      const DozerValidationState& state,
                                                      DozerValid& valid) {
  const auto pose = [](const Signal<double>& from, double& to) {
    return Required{&from, &to, Fault::kPoseMissing, Fault::kNone};
  };
  const auto transmission = [](const Signal<double>& from, double& to) {
    return Required{&from, &to, Fault::kTransmissionMissing, Fault::kSensorError};
  };
  const TrackInputs& left = inputs.track[kLeft];
  const TrackInputs& right = inputs.track[kRight];
  return {{pose(state.position_m.value.signal, valid.position_m),
           pose(state.height_m.value.signal, valid.height_m),
           pose(state.pitch_rad.value.signal, valid.pitch_rad),
           pose(state.position_m.rate, valid.velocity_mps),
           pose(state.height_m.rate, valid.climb_mps),
           pose(state.pitch_rad.rate, valid.pitch_rate_radps),
           transmission(left.pump_ratio, valid.pump_ratio[kLeft]),
           transmission(right.pump_ratio, valid.pump_ratio[kRight]),
           transmission(left.motor_ratio, valid.motor_ratio[kLeft]),
           transmission(right.motor_ratio, valid.motor_ratio[kRight]),
           transmission(left.speed_mps, valid.track_speed_mps[kLeft]),
           transmission(right.speed_mps, valid.track_speed_mps[kRight])}};
}

BelievedCoordinate believed(const Signal<double>& value, const Signal<double>& rate, double margin,
                            const Freshness& fresh, const BelievedCoordinate& last,
                            FaultSet& faults) {
  const double expected_ps = fresh.number(rate) ? rate.value : 0.0;
  const BelievedResult result = believe(
      value, {kRateMargin_ps, margin, Fault::kPoseImplausible, expected_ps}, fresh, last.value);
  faults.add(result.faults);
  if (rate.validity == Validity::kError) {
    faults.add(Fault::kSensorError);
  }
  return {result.state, result.jumped ? last.rate : rate};
}

/// Of a machine whose blade tilts; a roll is believed as a pitch is.
void read_roll(const BodyInputs& body, const Freshness& fresh, DozerValidationState& state,
               DozerValid& valid) {
  state.roll_rad = believed(body.roll_rad, body.roll_rate_radps, kPitchMargin_rad, fresh,
                            state.roll_rad, valid.faults);
  read_required({&state.roll_rad.value.signal, &valid.roll_rad, Fault::kPoseMissing, Fault::kNone},
                fresh, valid.faults);
  read_required({&state.roll_rad.rate, &valid.roll_rate_radps, Fault::kPoseMissing, Fault::kNone},
                fresh, valid.faults);
}

/// Of a design whose track curves. An offset goes on as the machine drives aslant.
void read_course(const BodyInputs& body, const Freshness& fresh, DozerValidationState& state,
                 DozerValid& valid) {
  state.heading_rad = believed(body.heading_rad, body.yaw_rate_radps, kPitchMargin_rad, fresh,
                               state.heading_rad, valid.faults);
  Signal<double> aslant_mps = body.velocity_mps;
  aslant_mps.value *= std::sin(body.heading_rad.value);
  state.offset_m =
      believed(body.offset_m, aslant_mps, kPositionMargin_m, fresh, state.offset_m, valid.faults);
  const auto demand = [&](const Signal<double>& from, double& to) {
    read_required({&from, &to, Fault::kPoseMissing, Fault::kNone}, fresh, valid.faults);
  };
  demand(state.offset_m.value.signal, valid.course.offset_m);
  demand(state.heading_rad.value.signal, valid.course.heading_rad);
  demand(state.heading_rad.rate, valid.course.yaw_rate_radps);
}

/// What Task::kCommission goes by.
void read_tried(const DozerInputs& inputs, const Freshness& fresh, TimeUs now_us,
                DozerValid& valid) {
  if (valid.task != Task::kCommission) {
    return;
  }
  const DozerTry& tried = inputs.tried.value;
  if (fresh.holds(inputs.tried) && std::isfinite(tried.ratio) && std::isfinite(tried.motor_ratio)) {
    valid.tried = tried;
  } else {
    valid.faults.add(Fault::kOperatorMissing);
  }
  const Freshness lately(kDozerWindowHolds_s, now_us);
  for (unsigned i = 0; i < kTriedCount; ++i) {
    if (lately.holds(inputs.window[i])) {
      valid.window[i] = inputs.window[i].value;
    }
  }
}

void accept_pose(const BodyInputs& body, const Freshness& fresh, DozerValidationState& state,
                 FaultSet& faults) {
  state.position_m = believed(body.position_m, body.velocity_mps, kPositionMargin_m, fresh,
                              state.position_m, faults);
  state.height_m =
      believed(body.height_m, body.climb_mps, kHeightMargin_m, fresh, state.height_m, faults);
  state.pitch_rad = believed(body.pitch_rad, body.pitch_rate_radps, kPitchMargin_rad, fresh,
                             state.pitch_rad, faults);
}

}  // namespace

DozerValid validate(const DozerProfile& profile, DriveRows drives, const DozerInputs& inputs,
                    bool moving, TimeUs now_us, DozerValidationState& state) {
  DozerValid valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);
  read_machine(profile.bus, inputs, {profile.hst.engine_most_radps, profile.safety.idle_radps},
               fresh, now_us, valid);
  read_tried(inputs, fresh, now_us, valid);
  if (!moving) {
    state = {};
  }
  const std::array<DriveInputs, kBladeCount> blade = {
      {{inputs.blade_stroke_m, {}, {}, inputs.blade_spool_ratio},
       {inputs.tilt_stroke_m, {}, {}, inputs.tilt_spool_ratio}}};
  read_drives(drives, blade, moving, fresh, state.stroke_m, valid.drive, valid.faults);
  accept_pose(inputs.body, fresh, state, valid.faults);
  for (const Required& row : required_signals(inputs, state, valid)) {
    read_required(row, fresh, valid.faults);
  }
  if (profile.tilt.present) {
    read_roll(inputs.body, fresh, state, valid);
  }
  if (profile.grade.curves()) {
    read_course(inputs.body, fresh, state, valid);
  }
  for (unsigned i = 0; i < kTrackCount; ++i) {
    const Signal<double>& pressure_pa = inputs.track[i].line_pressure_pa;
    valid.line_pressure_pa[i] = fresh.number(pressure_pa) ? pressure_pa.value : 0.0;
  }
  // What cannot be is no jump to be bridged.
  const bool lies = std::max(std::abs(valid.pitch_rad), std::abs(valid.roll_rad)) > kMostPitch_rad;
  if (lies) {
    valid.faults.add(Fault::kPoseImplausible);
  }
  sort_faults(moving,
              {{Fault::kStrokeJump, Fault::kStrokeMissing},
               {lies ? Fault::kNone : Fault::kPoseImplausible, Fault::kPoseMissing}},
              valid);
  return valid;
}

}  // namespace graben
