// SPDX-License-Identifier: Apache-2.0
#pragma once
/// All that a receiver has put into its inputs, to be compared as a whole.

#include <tuple>
#include <vector>

#include "firmware/dozer/dozer_signals.hpp"
#include "firmware/excavator/excavator_signals.hpp"

namespace graben::test {

using Seen = std::vector<std::tuple<double, Validity, TimeUs>>;

template <class... Signals>
void see(Seen& seen, const Signals&... signals) {
  (seen.emplace_back(static_cast<double>(signals.value), signals.validity, signals.stamp_us), ...);
}

template <std::size_t count>
void see_all(Seen& seen, const Signal<std::array<double, count>>& signal) {
  for (const double each : signal.value) {
    seen.emplace_back(each, signal.validity, signal.stamp_us);
  }
}

inline void see_driver(Seen& seen, const OperatorInputs& driver) {
  see(seen, driver.enable, driver.mode, driver.task, driver.speed_override_ratio,
      driver.task_number);
  for (const int each :
       {int{driver.touch.value.number}, static_cast<int>(driver.touch.value.kind)}) {
    seen.emplace_back(each, driver.touch.validity, driver.touch.stamp_us);
  }
}

inline Seen seen_in(const ExcavatorInputs& in) {
  Seen seen;
  see(seen, in.engine_speed_radps, in.swash_ratio[0], in.swash_ratio[1], in.valve_enabled);
  see_driver(seen, in.driver);
  see(seen, in.swing.angle_rad, in.swing.left_pressure_pa, in.swing.right_pressure_pa,
      in.swing.spool_ratio);
  for (const AxisInputs& axis : in.axis) {
    see(seen, axis.stroke_m, axis.cap_pressure_pa, axis.rod_pressure_pa, axis.spool_ratio);
  }
  see_all(seen, in.lever_ratio);
  see_all(seen, in.tried_ratio);
  for (const Signal<StrokeWindow>& window : in.window) {
    for (const double each : {window.value.least_m, window.value.most_m, window.value.most_mps}) {
      seen.emplace_back(each, window.validity, window.stamp_us);
    }
  }
  return seen;
}

inline Seen seen_in(const DozerInputs& in) {
  Seen seen;
  see(seen, in.engine_speed_radps, in.blade_stroke_m, in.blade_spool_ratio, in.valve_enabled);
  see_driver(seen, in.driver);
  see(seen, in.body.position_m, in.body.height_m, in.body.pitch_rad, in.body.velocity_mps,
      in.body.climb_mps, in.body.pitch_rate_radps);
  for (const TrackInputs& track : in.track) {
    see(seen, track.pump_ratio, track.motor_ratio, track.speed_mps);
  }
  seen.emplace_back(in.tried.value.ratio, in.tried.validity, in.tried.stamp_us);
  seen.emplace_back(in.tried.value.motor_ratio, in.tried.validity, in.tried.stamp_us);
  for (const Signal<StrokeWindow>& window : in.window) {
    for (const double each : {window.value.least_m, window.value.most_m, window.value.most_mps}) {
      seen.emplace_back(each, window.validity, window.stamp_us);
    }
  }
  return seen;
}

template <class Receiver>
Seen seen_by(const Receiver& receiver) {
  Seen seen = seen_in(receiver.inputs());
  see(seen, receiver.identity().profile_hash, receiver.identity().dbc_version);
  return seen;
}

}  // namespace graben::test
