// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator's sensors: readings of the true state, faults included.

#include <array>
#include <optional>

#include "app/plant/excavator_faults.hpp"
#include "app/plant/excavator_plant_profile.hpp"
#include "app/plant/node_faults.hpp"
#include "app/plant/random.hpp"
#include "can_dbc/codec.hpp"

namespace graben::plant {

/// Strokes and the swing in steps of the encoder's resolution, pressures within the transducer's
/// range, strokes and pressures off by their zeros. With a seed each stroke, the swing and each
/// pressure also has a constant bias, uniform within the profile's bounds, and each pressure
/// reading white noise of the profile's standard deviation (Kim 5). The CAN codec quantises and
/// saturates by itself.
class SensorModel {
 public:
  SensorModel(const SensorErrors& errors, std::optional<std::uint64_t> seed);

  [[nodiscard]] double stroke_m(std::size_t axis, double true_stroke_m) const;
  /// In -pi .. pi: the sensor does not count turns.
  [[nodiscard]] double swing_rad(double true_swing_rad) const;
  /// One reading: noise is drawn anew. Of the swing cap is the left port, rod the right one.
  [[nodiscard]] double cap_pressure_pa(std::size_t drive, double true_pressure_pa);
  [[nodiscard]] double rod_pressure_pa(std::size_t drive, double true_pressure_pa);

 private:
  [[nodiscard]] double pressure_pa(double true_pressure_pa, double bias_pa);

  SensorErrors errors_;
  std::optional<Random> noise_;
  // With the zeros.
  std::array<double, kAxisCount> stroke_bias_m_{};
  double swing_bias_rad_ = 0.0;
  std::array<double, kDriveCount> cap_bias_pa_{};
  std::array<double, kDriveCount> rod_bias_pa_{};
};

/// Sensors that can fail. A reading is taken once a cycle.
class FaultySensors {
 public:
  explicit FaultySensors(const ExcavatorPlantProfile& profile);

  [[nodiscard]] dbc::Physical stroke(std::size_t axis, double true_stroke_m,
                                     const StrokeFault& fault);
  [[nodiscard]] dbc::Physical swing(double true_swing_rad, const AngleFault& fault);
  /// Of the swing cap is the left port, rod the right one.
  [[nodiscard]] dbc::Physical cap_pressure(std::size_t drive, double true_pressure_pa,
                                           const PressureFault& fault);
  [[nodiscard]] dbc::Physical rod_pressure(std::size_t drive, double true_pressure_pa,
                                           const PressureFault& fault);

 private:
  static dbc::Physical pressure(double reading_pa, const PressureFault& fault, double& shown_pa);

  SensorModel sensors_;
  std::array<FaultyReading, kAxisCount> stroke_;
  FaultyReading swing_;
  // What was shown last: a stuck sensor goes on showing it.
  std::array<double, kDriveCount> cap_pa_{};
  std::array<double, kDriveCount> rod_pa_{};
};

}  // namespace graben::plant
