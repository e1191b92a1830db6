// SPDX-License-Identifier: Apache-2.0
#include "app/plant/excavator_sensors.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/numeric/constants.hpp"

namespace graben::plant {
namespace {

double in_steps(double shown, double resolution) {
  return resolution > 0.0 ? std::round(shown / resolution) * resolution : shown;
}

}  // namespace

SensorModel::SensorModel(const SensorErrors& errors, std::optional<std::uint64_t> seed)
    : errors_(errors),
      stroke_bias_m_(errors.stroke_zero_m),
      cap_bias_pa_(errors.cap_zero_pa),
      rod_bias_pa_(errors.rod_zero_pa) {
  if (!seed) {
    return;
  }
  noise_.emplace(*seed, Draw::kSensorNoise);
  Random bias(*seed, Draw::kSensorBias);
  const double pressure_bias_pa = errors.pressure_bias_ratio * errors.pressure_range_pa;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    stroke_bias_m_[i] += bias.symmetric(errors.stroke_bias_m);
    cap_bias_pa_[i] += bias.symmetric(pressure_bias_pa);
    rod_bias_pa_[i] += bias.symmetric(pressure_bias_pa);
  }
  swing_bias_rad_ = bias.symmetric(errors.swing_bias_rad);
  cap_bias_pa_[kSwing] += bias.symmetric(pressure_bias_pa);
  rod_bias_pa_[kSwing] += bias.symmetric(pressure_bias_pa);
}

double SensorModel::stroke_m(std::size_t axis, double true_stroke_m) const {
  return in_steps(true_stroke_m + stroke_bias_m_[axis], errors_.stroke_resolution_m);
}

double SensorModel::swing_rad(double true_swing_rad) const {
  const double shown = std::remainder(true_swing_rad + swing_bias_rad_, kTwoPi);
  return in_steps(shown, errors_.swing_resolution_rad);
}

double SensorModel::cap_pressure_pa(std::size_t drive, double true_pressure_pa) {
  return pressure_pa(true_pressure_pa, cap_bias_pa_[drive]);
}

double SensorModel::rod_pressure_pa(std::size_t drive, double true_pressure_pa) {
  return pressure_pa(true_pressure_pa, rod_bias_pa_[drive]);
}

double SensorModel::pressure_pa(double true_pressure_pa, double bias_pa) {
  double shown = true_pressure_pa + bias_pa;
  if (noise_) {
    shown += errors_.pressure_noise_ratio * errors_.pressure_range_pa * noise_->normal();
  }
  // A transducer shows nothing below ambient and nothing above its range.
  shown = std::max(0.0, shown);
  return errors_.pressure_range_pa > 0.0 ? std::min(shown, errors_.pressure_range_pa) : shown;
}

FaultySensors::FaultySensors(const ExcavatorPlantProfile& profile)
    : sensors_(profile.sensors,
               profile.sensor_errors ? std::optional(profile.seed) : std::nullopt) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    stroke_[i] = FaultyReading(profile.sensors.stroke_age_s[i]);
  }
}

dbc::Physical FaultySensors::stroke(std::size_t axis, double true_stroke_m,
                                    const StrokeFault& fault) {
  return stroke_[axis].show(sensors_.stroke_m(axis, true_stroke_m), ReadingFault(fault));
}

dbc::Physical FaultySensors::swing(double true_swing_rad, const AngleFault& fault) {
  return swing_.show(sensors_.swing_rad(true_swing_rad), ReadingFault(fault));
}

dbc::Physical FaultySensors::pressure(double reading_pa, const PressureFault& fault,
                                      double& shown_pa) {
  if (!fault.stuck) {
    shown_pa = fault.scale * reading_pa;
  }
  return {fault.rail_pa ? *fault.rail_pa : shown_pa, dbc::RawState::kValid};
}

dbc::Physical FaultySensors::cap_pressure(std::size_t drive, double true_pressure_pa,
                                          const PressureFault& fault) {
  return pressure(sensors_.cap_pressure_pa(drive, true_pressure_pa), fault, cap_pa_[drive]);
}

dbc::Physical FaultySensors::rod_pressure(std::size_t drive, double true_pressure_pa,
                                          const PressureFault& fault) {
  return pressure(sensors_.rod_pressure_pa(drive, true_pressure_pa), fault, rod_pa_[drive]);
}

}  // namespace graben::plant
