#pragma once
/// What comes into and goes out of the excavator's controller. SI units; axes in the order boom,
/// arm, bucket. Extension is positive for strokes, velocities, spools and duties; a stroke counts
/// from the closed cylinder.

#include <array>

#include "firmware/signals/machine_signals.hpp"

namespace graben {

inline constexpr int kAxisCount = 3;
inline constexpr int kPumpCount = 2;  ///< At most; a machine may have one.

struct AxisInputs {
  Signal<double> stroke_m;
  Signal<double> cap_pressure_pa;
  Signal<double> rod_pressure_pa;
  Signal<double> spool_ratio;  ///< Measured spool over its travel, deadband and all, -1 .. 1.
};

struct ExcavatorInputs {
  std::array<AxisInputs, kAxisCount> axis;
  std::array<Signal<double>, kPumpCount> swash_ratio;  ///< tan(alpha) / tan(alpha at full swash).
  Signal<double> engine_speed_radps;
  Signal<bool> valve_enabled;  ///< The valve side's echo of our enable.
  OperatorInputs driver;
  /// Whether the machine's end runs with our profile hash and DBC version.
  Signal<bool> same_machine;
  LinkInputs link;
};

/// What the excavator's controller says of itself.
struct ExcavatorStatus : MachineStatus {
  std::array<double, kAxisCount> wanted_velocity_mps{};  ///< V_L^d before scaling by lambda.
  std::array<double, kPumpCount> pump_pressure_pa{};     ///< P_p that the solution expects.
  double path_error_m = 0.0;  ///< Distance of the measured tip from the path.
};

struct ExcavatorOutputs {
  bool enable = false;     ///< The valve side closes every spool without it.
  bool pilot_cut = false;  ///< Asks for the pilot pressure to be cut: the valve does not obey.
  /// Without it the controller does not know whether an earlier one has asked for a cut, and says
  /// so: a restart must not give the pressure back to a spool that is stuck.
  bool pilot_known = false;
  std::array<double, kAxisCount> duty_ratio{};   ///< -1 .. 1; 0 is neutral.
  std::array<double, kPumpCount> swash_ratio{};  ///< Wanted of each pump; only with enable.
  ExcavatorStatus status;
};

}  // namespace graben
