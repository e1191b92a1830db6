#pragma once
/// Signals -> machine state: freshness, validity and plausibility, from one table.

#include <Eigen/Core>

#include "firmware/machine/excavator_profile.hpp"
#include "firmware/signals/excavator_signals.hpp"

namespace graben {

/// Inputs that may be used. With a fault, only `enable` and the fault itself mean anything.
struct ValidInputs {
  Fault fault = Fault::kNone;  ///< First thing that is missing or implausible.
  bool enable = false;         ///< Fresh, valid and given.
  bool automatic = false;
  Task task = Task::kNone;
  double speed_override_ratio = 0.0;
  Eigen::Vector3d strokes_m = Eigen::Vector3d::Zero();  ///< Clamped into the cylinders' ranges.
  std::array<double, kAxisCount> cap_pressure_pa{};
  std::array<double, kAxisCount> rod_pressure_pa{};
  std::array<double, kPumpCount> pump_flow_m3ps{};  ///< v omega tan(alpha) of (25).
};

/// How far a measured stroke may lie outside its cylinder's range: bias and mounting.
inline constexpr double kStrokeMargin_m = 0.010;

/// The machine names itself every second; it may miss one time.
inline constexpr double kIdentityTimeout_s = 2.5;

/// A signal is missing when it was never valid or is older than control.sensor_timeout_s.
[[nodiscard]] ValidInputs validate(const ExcavatorInputs& inputs, const ExcavatorProfile& profile,
                                   TimeUs now_us);

}  // namespace graben
