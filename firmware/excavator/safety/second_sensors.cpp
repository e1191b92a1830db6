// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "firmware/excavator/safety/excavator_validation.hpp"
#include "firmware/excavator/safety/tuning.hpp"
#include "firmware/numeric/triangle.hpp"

namespace graben {
namespace {

/// As the drive's travel; the swing's turned by whole turns to beside what the first shows.
Signal<double> second_travel(const ExcavatorProfile& profile, const ExcavatorInputs& inputs,
                             int drive, double first_m) {
  if (drive != kSwing) {
    return inputs.second_stroke_m[static_cast<unsigned>(drive)];
  }
  const double lever_m = profile.swing.lever_m;
  Signal<double> second = inputs.second_swing_rad;
  second.value = lever_m * wrap_near(second.value, first_m / lever_m);
  return second;
}

WitnessBand band_of(const ExcavatorProfile& profile, const DriveRow& row, int drive) {
  const SecondSensors& second = profile.second;
  const bool swings = drive == kSwing;
  const double lever_m = profile.swing.lever_m;
  return {swings ? second.swing_offset_rad * lever_m : second.offset_m,
          swings ? second.swing_play_rad * lever_m : second.play_m,
          second.scale,
          second.least_age_s,
          second.most_age_s,
          row.watch.fastest_mps};
}

}  // namespace

void watch_seconds(const ExcavatorProfile& profile, DriveRows drives, const ExcavatorInputs& inputs,
                   bool moving, TimeUs now_us, SecondStates& states, ExcavatorValid& valid) {
  bool missing = false;
  FaultSet stops;
  for (int i = 0; i < drives.count(); ++i) {
    const auto at = static_cast<unsigned>(i);
    if (!profile.second.has[at]) {
      continue;
    }
    const ValidDrive& first = valid.drive[at];
    const Freshness fresh(i == kSwing ? kSecondSwingSilent_s : kSecondStrokeSilent_s, now_us);
    const Signal<double> second = second_travel(profile, inputs, i, first.stroke_m);
    if (!fresh.number(second)) {
      missing = true;
      states[at] = {};
    } else if (first.stroke_known && contradicts(band_of(profile, drives[i], i), first.stroke_m,
                                                 second, !moving, now_us, states[at])) {
      stops.add(Fault::kWitnessDisagrees);
    }
  }
  if (missing && moving) {
    degrade(Fault::kWitnessMissing, valid);
  } else if (missing && profile.second.arms_without) {
    warn(Fault::kWitnessMissing, valid);
  } else if (missing) {
    stops.add(Fault::kWitnessMissing);
  }
  stop(stops, valid);
}

}  // namespace graben
