#include "firmware/safety/validation.hpp"

#include <algorithm>

namespace graben {
namespace {

constexpr double kTwoPi = 6.28318530717958647693;

constexpr std::size_t kRequiredCount = 4 * kAxisCount;

std::array<Required, kRequiredCount> required_signals(const ExcavatorInputs& inputs,
                                                      ValidInputs& valid) {
  const auto stroke = [&](unsigned i) {
    return Required{&valid.state.stroke_m[i].signal, &valid.strokes_m[i], Fault::kStrokeMissing,
                    Fault::kNone};
  };
  const auto cap = [&](unsigned i) {
    return Required{&inputs.axis[i].cap_pressure_pa, &valid.cap_pressure_pa[i],
                    Fault::kPressureMissing, Fault::kPressureImplausible};
  };
  const auto rod = [&](unsigned i) {
    return Required{&inputs.axis[i].rod_pressure_pa, &valid.rod_pressure_pa[i],
                    Fault::kPressureMissing, Fault::kPressureImplausible};
  };
  const auto spool = [&](unsigned i) {
    return Required{&inputs.axis[i].spool_ratio, &valid.spool_ratio[i], Fault::kSpoolMissing,
                    Fault::kSensorError};
  };
  return {{stroke(0), stroke(1), stroke(2), cap(0), cap(1), cap(2), rod(0), rod(1), rod(2),
           spool(0), spool(1), spool(2)}};
}

/// Faster than this no cylinder moves, m/s.
double fastest_mps(const ExcavatorProfile& profile, unsigned axis) {
  const auto pump = static_cast<unsigned>(profile.valve.spool[axis].pump);
  const double flow_m3ps =
      profile.pump[pump].displacement_m3prev / kTwoPi * profile.pump[pump].rated_speed_radps;
  return kFasterThanPumps * flow_m3ps / profile.geometry.cylinder[axis].rod_area_m2();
}

void believe_strokes(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                     const ValidationState& last, const Freshness& fresh, ValidInputs& valid) {
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const ChangeLimit change{fastest_mps(profile, i), kJumpMargin_m, Fault::kStrokeJump};
    const BelievedResult stroke = believe(inputs.axis[i].stroke_m, change, fresh, last.stroke_m[i]);
    valid.state.stroke_m[i] = stroke.state;
    valid.faults.add(stroke.faults);
  }
}

}  // namespace

ValidInputs validate(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                     const ValidationState& last, bool moving, TimeUs now_us) {
  ValidInputs valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);
  read_driver(inputs.driver, fresh, valid);
  read_identity(inputs.same_machine, now_us, valid);
  read_bus(inputs.link, valid);
  believe_strokes(inputs, profile, moving ? last : ValidationState{}, fresh, valid);
  for (const Required& row : required_signals(inputs, valid)) {
    read_required(row, fresh, valid.faults);
  }
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    read_required(
        {&inputs.swash_ratio[j], &valid.swash_ratio[j], Fault::kSwashMissing, Fault::kSensorError},
        fresh, valid.faults);
  }
  valid.engine_radps =
      engine_speed_radps(inputs.engine_speed_radps, profile.pump[0].rated_speed_radps,
                         profile.safety.idle_radps, fresh, valid.faults);
  valid.valve_enabled = read_echo(inputs.valve_enabled, fresh, valid.faults);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    valid.load_known[i] = fresh.number(inputs.axis[i].cap_pressure_pa) &&
                          fresh.number(inputs.axis[i].rod_pressure_pa);
    valid.strokes_m[i] =
        bounded_stroke_m(valid.strokes_m[i], profile.geometry.cylinder[i].stroke_m, valid.faults);
  }
  judge(moving, {{Fault::kStrokeJump, Fault::kStrokeMissing}}, valid);
  return valid;
}

std::array<double, kPumpCount> pump_flow_m3ps(const ExcavatorProfile& profile, double engine_radps,
                                              const std::array<double, kPumpCount>& swash_ratio) {
  std::array<double, kPumpCount> flow_m3ps{};
  for (unsigned j = 0; j < kPumpCount; ++j) {
    flow_m3ps[j] = std::max(0.0, profile.pump[j].displacement_m3prev / kTwoPi * engine_radps *
                                     std::min(swash_ratio[j], 1.0));
  }
  return flow_m3ps;
}

}  // namespace graben
