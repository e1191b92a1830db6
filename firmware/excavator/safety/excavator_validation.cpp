#include "firmware/excavator/safety/excavator_validation.hpp"

#include <algorithm>

#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// As far as a swing angle is told, either way.
constexpr double kSwingMost_rad = 3.2;

using Drives = std::array<AxisInputs, kDriveCount>;

/// All drives' signals alike: the swing as the travel at its lever, extending to the left.
Drives drives_of(const ExcavatorInputs& inputs, const SwingProfile& profile) {
  Drives drives;
  std::copy(inputs.axis.begin(), inputs.axis.end(), drives.begin());
  const SwingInputs& swing = inputs.swing;
  drives[kSwing] = {swing.angle_rad, swing.left_pressure_pa, swing.right_pressure_pa,
                    swing.spool_ratio};
  drives[kSwing].stroke_m.value *= profile.lever_m;
  return drives;
}

void read_drive(const BusCapabilities& bus, const AxisInputs& drive, unsigned i,
                const Freshness& fresh, ValidInputs& valid) {
  const Required rows[] = {
      {&valid.state.stroke_m[i].signal, &valid.strokes_m[i], Fault::kStrokeMissing, Fault::kNone},
      {&drive.cap_pressure_pa, &valid.cap_pressure_pa[i], Fault::kPressureMissing,
       Fault::kPressureImplausible},
      {&drive.rod_pressure_pa, &valid.rod_pressure_pa[i], Fault::kPressureMissing,
       Fault::kPressureImplausible}};
  for (const Required& row : rows) {
    read_required(row, fresh, valid.faults);
  }
  if (bus.spool_feedback) {
    read_required(
        {&drive.spool_ratio, &valid.spool_ratio[i], Fault::kSpoolMissing, Fault::kSensorError},
        fresh, valid.faults);
  }
  valid.load_known[i] = fresh.number(drive.cap_pressure_pa) && fresh.number(drive.rod_pressure_pa);
}

/// Faster than this no drive moves, m/s.
double fastest_mps(const ExcavatorProfile& profile, int drive) {
  const SpoolProfile& spool = profile.valve.spool[static_cast<unsigned>(drive)];
  const PumpProfile& pump = profile.pump[static_cast<unsigned>(spool.pump)];
  const double flow_m3ps = pump.displacement_m3prev / kTwoPi * pump.rated_speed_radps;
  const double flow_mps = kFasterThanPumps * flow_m3ps / profile.retract_area_m2(drive);
  return drive == kSwing ? std::min(flow_mps, kFasterThanPumps * profile.swing.speed_max_radps *
                                                  profile.swing.lever_m)
                         : flow_mps;
}

/// As kJumpMargin_m: noise, and frames that were lost. 0.1 m at teeth 7 m away.
constexpr double kSwingJumpMargin_rad = 0.015;

double bounded_swing_m(double travel_m, double lever_m, FaultSet& faults) {
  const double most_m = kSwingMost_rad * lever_m;
  if (travel_m < -most_m || travel_m > most_m) {
    faults.add(Fault::kStrokeImplausible);
  }
  return std::clamp(travel_m, -most_m, most_m);
}

void read_drives(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                 const ValidationState& last, const Freshness& fresh, ValidInputs& valid) {
  const Drives drives = drives_of(inputs, profile.swing);
  for (int drive = 0; drive < profile.drive_count; ++drive) {
    const auto i = static_cast<unsigned>(drive);
    const double margin_m =
        drive == kSwing ? kSwingJumpMargin_rad * profile.swing.lever_m : kJumpMargin_m;
    const ChangeLimit change{fastest_mps(profile, drive), margin_m, Fault::kStrokeJump};
    const BelievedResult stroke = believe(drives[i].stroke_m, change, fresh, last.stroke_m[i]);
    valid.state.stroke_m[i] = stroke.state;
    valid.faults.add(stroke.faults);
    read_drive(profile.bus, drives[i], i, fresh, valid);
    valid.strokes_m[drive] =
        drive == kSwing
            ? bounded_swing_m(valid.strokes_m[drive], profile.swing.lever_m, valid.faults)
            : bounded_stroke_m(valid.strokes_m[drive], profile.geometry.cylinder[i].stroke_m,
                               valid.faults);
  }
}

}  // namespace

ValidInputs validate(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                     const ValidationState& last, bool moving, TimeUs now_us) {
  ValidInputs valid;
  const Freshness fresh(profile.control.sensor_timeout_s, now_us);
  read_driver(inputs.driver, fresh, valid);
  read_identity(profile.bus, inputs.same_machine, now_us, valid);
  read_bus(profile.bus, inputs.link, valid);
  read_drives(inputs, profile, moving ? last : ValidationState{}, fresh, valid);
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    if (!profile.bus.swash_feedback) {
      valid.swash_ratio[j] = profile.dig_swash_ratio[j];
    } else {
      read_required({&inputs.swash_ratio[j], &valid.swash_ratio[j], Fault::kSwashMissing,
                     Fault::kSensorError},
                    fresh, valid.faults);
    }
  }
  valid.engine_radps =
      engine_speed_radps(inputs.engine_speed_radps, profile.pump[0].rated_speed_radps,
                         profile.safety.idle_radps, fresh, valid.faults);
  valid.valve_enabled = read_echo(profile.bus, inputs.valve_enabled, fresh, valid.faults);
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
