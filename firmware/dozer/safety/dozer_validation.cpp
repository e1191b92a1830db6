#include "firmware/dozer/safety/dozer_validation.hpp"

#include <cmath>
#include <cstddef>

#include "firmware/dozer/blade.hpp"

namespace graben {
namespace {

constexpr std::size_t kRequiredCount = 7 + 3 * kTrackCount;

/// Errors of what is believed are named when it comes in.
std::array<Required, kRequiredCount> required_signals(const DozerInputs& inputs,
                                                      ValidDozerInputs& valid) {
  const auto pose = [](const Signal<double>& from, double& to) {
    return Required{&from, &to, Fault::kPoseMissing, Fault::kNone};
  };
  const auto transmission = [](const Signal<double>& from, double& to) {
    return Required{&from, &to, Fault::kTransmissionMissing, Fault::kSensorError};
  };
  const DozerValidationState& state = valid.state;
  const TrackInputs& left = inputs.track[kLeft];
  const TrackInputs& right = inputs.track[kRight];
  return {
      {{&state.blade_stroke_m.signal, &valid.blade_stroke_m, Fault::kStrokeMissing, Fault::kNone},
       pose(state.position_m.value.signal, valid.position_m),
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

/// Faster than this no blade cylinder moves, m/s.
double fastest_mps(const DozerProfile& profile) {
  return kFasterThanPumps * profile.implement.valve_flow_max_m3ps / profile.blade.rod_area_m2();
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

void believe_motion(const DozerInputs& inputs, const DozerProfile& profile,
                    const DozerValidationState& last, const Freshness& fresh,
                    ValidDozerInputs& valid) {
  const BelievedResult stroke =
      believe(inputs.blade_stroke_m, {fastest_mps(profile), kJumpMargin_m, Fault::kStrokeJump},
              fresh, last.blade_stroke_m);
  valid.state.blade_stroke_m = stroke.state;
  valid.faults.add(stroke.faults);
  const BodyInputs& body = inputs.body;
  valid.state.position_m = believed(body.position_m, body.velocity_mps, kPositionMargin_m, fresh,
                                    last.position_m, valid.faults);
  valid.state.height_m =
      believed(body.height_m, body.climb_mps, kHeightMargin_m, fresh, last.height_m, valid.faults);
  valid.state.pitch_rad = believed(body.pitch_rad, body.pitch_rate_radps, kPitchMargin_rad, fresh,
                                   last.pitch_rad, valid.faults);
}

}  // namespace

ValidDozerInputs validate(const DozerInputs& inputs, const DozerProfile& profile,
                          const DozerValidationState& last, bool moving, TimeUs now_us) {
  ValidDozerInputs valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);
  read_driver(inputs.driver, fresh, valid);
  read_identity(profile.bus, inputs.same_machine, now_us, valid);
  read_bus(profile.bus, inputs.link, valid);
  believe_motion(inputs, profile, moving ? last : DozerValidationState{}, fresh, valid);
  for (const Required& row : required_signals(inputs, valid)) {
    read_required(row, fresh, valid.faults);
  }
  if (profile.bus.spool_feedback) {
    read_required({&inputs.blade_spool_ratio, &valid.blade_spool_ratio, Fault::kSpoolMissing,
                   Fault::kSensorError},
                  fresh, valid.faults);
  }
  valid.engine_radps = engine_speed_radps(inputs.engine_speed_radps, profile.hst.engine_most_radps,
                                          profile.safety.idle_radps, fresh, valid.faults);
  valid.valve_enabled = read_echo(profile.bus, inputs.valve_enabled, fresh, valid.faults);
  valid.blade_stroke_m =
      bounded_stroke_m(valid.blade_stroke_m, blade_stroke_max_m(profile.blade), valid.faults);
  // What cannot be is no jump to be bridged.
  const bool lies = std::abs(valid.pitch_rad) > kMostPitch_rad;
  if (lies) {
    valid.faults.add(Fault::kPoseImplausible);
  }
  judge(moving,
        {{Fault::kStrokeJump, Fault::kStrokeMissing},
         {lies ? Fault::kNone : Fault::kPoseImplausible, Fault::kPoseMissing}},
        valid);
  return valid;
}

}  // namespace graben
