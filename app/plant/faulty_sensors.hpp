#pragma once
/// What the bus is told of strokes, swing and pressures, faults included.

#include <array>

#include "app/plant/excavator_faults.hpp"
#include "app/plant/faulty_reading.hpp"
#include "app/plant/sensor_model.hpp"
#include "can_dbc/codec.hpp"

namespace graben::plant {

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
