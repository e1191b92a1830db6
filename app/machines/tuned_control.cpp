// SPDX-License-Identifier: Apache-2.0
#include "app/machines/tuned_control.hpp"

#include <algorithm>

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::machines {
namespace {

/// Periods of the mode after which a correction no longer damps it, and after which it is wholly of
/// the kind that feeds it. Between them all values change over.
constexpr double kDamps = 0.15;
constexpr double kFeeds = 0.3;
constexpr double kConvergence_s = 0.25 / 0.6;
constexpr double kLateConvergence_s = 1.0;
constexpr double kGain_ps = 2.0;
constexpr double kLateGain_ps = 1.0;
constexpr double kDamping = 0.4;
constexpr double kLateDamping = 0.8;
constexpr double kPressureFilter_s = 0.15;
constexpr double kLatePressureFilter_s = 0.4;

}  // namespace

double latest_answer_s(const ExcavatorProfile& profile) {
  double latest_s = 0.0;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    for (const bool extends : {true, false}) {
      const SpoolAnswer answer = answer_of(profile, axis, extends);
      latest_s = std::max(latest_s, answer.dead_time_s + answer.lag_s);
    }
  }
  return latest_s;
}

TunedControl tuned_control(double late_s, double lowest_mode_hz, double speed_mps) {
  const double late = std::clamp((late_s * lowest_mode_hz - kDamps) / (kFeeds - kDamps), 0.0, 1.0);
  const auto between = [late](double soon, double later) { return soon + late * (later - soon); };
  TunedControl control;
  control.convergence_length_m = speed_mps * between(kConvergence_s, kLateConvergence_s);
  control.servo_frequency_hz = kBelowMode * lowest_mode_hz;
  control.servo_damping = between(kDamping, kLateDamping);
  control.pressure_filter_s = between(kPressureFilter_s, kLatePressureFilter_s);
  // What changes slowly passes the low-pass later by this.
  const double filter_s = 2.0 * control.servo_damping / (kTwoPi * control.servo_frequency_hz);
  control.servo_gain_ps = std::min(between(kGain_ps, kLateGain_ps), 0.5 / (late_s + filter_s));
  return control;
}

}  // namespace graben::machines
