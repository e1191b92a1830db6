#pragma once
/// Signals -> machine state: freshness, validity and plausibility, from one table.

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/excavator/excavator_signals.hpp"
#include "firmware/safety/common_inputs.hpp"
#include "firmware/safety/plausibility.hpp"

namespace graben {

/// What the validation needs of the last cycle.
struct ValidationState {
  std::array<Believed, kDriveCount> stroke_m;
};

/// Inputs that may be used, per drive; what the machine hasn't got stays 0. Of the swing motor the
/// left port counts as cap, the right one as rod side.
struct ValidInputs : CommonValid {
  /// Clamped into the cylinders' ranges; of the swing the travel at its lever.
  DriveVector strokes_m = DriveVector::Zero();
  std::array<double, kDriveCount> cap_pressure_pa{};
  std::array<double, kDriveCount> rod_pressure_pa{};
  std::array<bool, kDriveCount> load_known{};  ///< Both pressures of the drive may be used.
  std::array<double, kDriveCount> spool_ratio{};
  bool valve_enabled = false;
  std::array<double, kPumpCount> swash_ratio{};
  double engine_radps = 0.0;  ///< The profile's idle where the measured one is lost.
  ValidationState state;
};

/// A signal is missing when it was never valid or is older than control.sensor_timeout_s. `moving`:
/// the mode of the last cycle was Armed or Active; then what only degrades does not stop, and a
/// stroke that changed faster than its cylinder can is not believed: the last one ages until it is
/// missing, or the strokes come back to it. The swing, where there is one, counts as a stroke;
/// another machine's swing signals are not looked at.
[[nodiscard]] ValidInputs validate(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                                   const ValidationState& last, bool moving, TimeUs now_us);

/// v omega tan(alpha) of (25) for each pump, m^3/s.
[[nodiscard]] std::array<double, kPumpCount> pump_flow_m3ps(
    const ExcavatorProfile& profile, double engine_radps,
    const std::array<double, kPumpCount>& swash_ratio);

}  // namespace graben
