#include "firmware/drives/drive_validation.hpp"

#include <algorithm>

namespace graben {
namespace {

/// Into the sensed range; far outside it is implausible.
double bounded_stroke_m(const DriveWatch& bounds, double stroke_m, FaultSet& faults) {
  if (stroke_m < bounds.sensed_least_m - bounds.sensed_margin_m ||
      stroke_m > bounds.sensed_most_m + bounds.sensed_margin_m) {
    faults.add(Fault::kStrokeImplausible);
  }
  return std::clamp(stroke_m, bounds.sensed_least_m, bounds.sensed_most_m);
}

void read_drive(const DriveWatch& bounds, const DriveInputs& inputs, const Freshness& fresh,
                Believed& accepted, ValidDrive& valid, FaultSet& faults) {
  const BelievedResult stroke =
      believe(inputs.stroke_m, {bounds.fastest_mps, bounds.jump_margin_m, Fault::kStrokeJump},
              fresh, accepted);
  valid.stroke_is_new = stroke.state.signal.stamp_us != accepted.signal.stamp_us;
  accepted = stroke.state;
  faults.add(stroke.faults);
  read_required({&accepted.signal, &valid.stroke_m, Fault::kStrokeMissing, Fault::kNone}, fresh,
                faults);
  if (bounds.senses_spool) {
    read_required(
        {&inputs.spool_ratio, &valid.spool_ratio, Fault::kSpoolMissing, Fault::kSensorError}, fresh,
        faults);
  }
  if (bounds.senses_load) {
    read_required({&inputs.cap_pressure_pa, &valid.cap_pressure_pa, Fault::kPressureMissing,
                   Fault::kPressureImplausible},
                  fresh, faults);
    read_required({&inputs.rod_pressure_pa, &valid.rod_pressure_pa, Fault::kPressureMissing,
                   Fault::kPressureImplausible},
                  fresh, faults);
    valid.load_known = fresh.number(inputs.cap_pressure_pa) && fresh.number(inputs.rod_pressure_pa);
  }
  valid.stroke_m = bounded_stroke_m(bounds, valid.stroke_m, faults);
}

}  // namespace

void read_drives(DriveRows drives, Span<const DriveInputs> inputs, bool moving,
                 const Freshness& fresh, Span<Believed> accepted, Span<ValidDrive> valid,
                 FaultSet& faults) {
  if (!moving) {
    std::fill(accepted.begin(), accepted.end(), Believed{});
  }
  for (int i = 0; i < drives.count(); ++i) {
    read_drive(drives[i].watch, inputs[i], fresh, accepted[i], valid[i], faults);
  }
}

}  // namespace graben
