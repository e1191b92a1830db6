#pragma once
/// What comes into and goes out of the excavator's controller. SI units; axes in the order boom,
/// arm, bucket. Extension is positive for strokes, velocities, spools and duties; a stroke counts
/// from the closed cylinder.

#include <array>
#include <cstdint>

#include "firmware/core/codes.hpp"
#include "firmware/signals/signal.hpp"

namespace graben {

inline constexpr int kAxisCount = 3;
inline constexpr int kPumpCount = 2;

/// What the operator lets the controller do.
enum class OperatorMode : std::uint8_t { kManual = 0, kAutomatic = 1 };

/// What the controller is to do.
enum class Task : std::uint8_t { kNone = 0, kDig = 1 };

struct AxisInputs {
  Signal<double> stroke_m;
  Signal<double> cap_pressure_pa;
  Signal<double> rod_pressure_pa;
};

struct OperatorInputs {
  Signal<bool> enable;  ///< Deadman: motion only while it is given.
  Signal<OperatorMode> mode;
  Signal<Task> task;
  Signal<double> speed_override_ratio;  ///< 0 .. 1 of the task's speed.
};

struct ExcavatorInputs {
  std::array<AxisInputs, kAxisCount> axis;
  std::array<Signal<double>, kPumpCount> swash_ratio;  ///< tan(alpha) / tan(alpha at full swash).
  Signal<double> engine_speed_radps;
  OperatorInputs driver;
  /// Whether the machine's end runs with our profile hash and DBC version.
  Signal<bool> same_machine;
};

/// What the controller says of itself; nothing of it moves metal.
struct ExcavatorStatus {
  EcuMode mode = EcuMode::kSilent;
  Fault fault = Fault::kNone;
  Limit limit;
  double lambda = 0.0;
  std::array<double, kAxisCount> wanted_velocity_mps{};  ///< V_L^d before scaling by lambda.
  std::array<double, kPumpCount> pump_pressure_pa{};     ///< P_p that the solution expects.
  double path_error_m = 0.0;  ///< Distance of the measured tip from the path.
};

struct ExcavatorOutputs {
  bool enable = false;                          ///< The valve side closes every spool without it.
  std::array<double, kAxisCount> duty_ratio{};  ///< -1 .. 1; 0 is neutral.
  ExcavatorStatus status;
};

}  // namespace graben
