// SPDX-License-Identifier: Apache-2.0
#include "firmware/drives/drive_validation.hpp"

#include <algorithm>

#include "firmware/core/whole.hpp"
#include "firmware/drives/tuning.hpp"

namespace graben {
namespace {

/// Speed by the frame that came, and the one before.
double next_speed_mps(const AcceptedStroke& last, const Believed& newest) {
  const Signal<double>& from = last.believed.signal;
  const Signal<double>& to = newest.signal;
  // Of what was never believed the stamp may be any number.
  if (from.validity != Validity::kValid || to.validity != Validity::kValid ||
      to.stamp_us <= from.stamp_us) {
    return last.speed_mps;
  }
  const double period_s = as_double(to.stamp_us - from.stamp_us) / kMicrosecondsPerSecond;
  const double share = std::min(1.0, period_s / kStrokeSpeed_s);
  return last.speed_mps + share * ((to.value - from.value) / period_s - last.speed_mps);
}

/// Since the frame that was believed last.
double gone_m(const AcceptedStroke& accepted, const Freshness& fresh) {
  const Signal<double>& stroke = accepted.believed.signal;
  return fresh.holds(stroke)
             ? accepted.speed_mps * std::min(fresh.age_s(stroke.stamp_us), kStrokeFramePeriod_s)
             : 0.0;
}

/// Into the sensed range; far outside it is implausible.
double bounded_stroke_m(const DriveWatch& bounds, double stroke_m, FaultSet& faults) {
  if (stroke_m < bounds.sensed_least_m - bounds.sensed_margin_m ||
      stroke_m > bounds.sensed_most_m + bounds.sensed_margin_m) {
    faults.add(Fault::kStrokeImplausible);
  }
  return std::clamp(stroke_m, bounds.sensed_least_m, bounds.sensed_most_m);
}

void read_drive(const DriveWatch& bounds, const DriveInputs& inputs, const Freshness& fresh,
                AcceptedStroke& accepted, ValidDrive& valid, FaultSet& faults) {
  const BelievedResult stroke =
      believe(inputs.stroke_m, {bounds.fastest_mps, bounds.jump_margin_m, Fault::kStrokeJump},
              fresh, accepted.believed);
  valid.stroke_is_new = stroke.state.signal.stamp_us != accepted.believed.signal.stamp_us;
  accepted = {stroke.state, next_speed_mps(accepted, stroke.state)};
  faults.add(stroke.faults);
  read_required({&accepted.believed.signal, &valid.stroke_m, Fault::kStrokeMissing, Fault::kNone},
                fresh, faults);
  valid.stroke_known = fresh.number(accepted.believed.signal);
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
  valid.stroke_m =
      std::clamp(bounded_stroke_m(bounds, valid.stroke_m, faults) + gone_m(accepted, fresh),
                 bounds.sensed_least_m, bounds.sensed_most_m);
}

}  // namespace

void read_drives(DriveRows drives, Span<const DriveInputs> inputs, bool moving,
                 const Freshness& fresh, Span<AcceptedStroke> accepted, Span<ValidDrive> valid,
                 FaultSet& faults) {
  if (!moving) {
    std::fill(accepted.begin(), accepted.end(), AcceptedStroke{});
  }
  for (int i = 0; i < drives.count(); ++i) {
    read_drive(drives[i].watch, inputs[i], fresh, accepted[i], valid[i], faults);
  }
}

}  // namespace graben
