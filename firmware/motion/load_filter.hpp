#pragma once
/// What the chambers' pressures say of the load, slowly for the model and quickly for damping.

#include <Eigen/Core>
#include <array>

#include "firmware/machine/excavator_profile.hpp"

namespace graben {

using AxisPressures = std::array<double, kAxisCount>;

/// What one cycle hands to the next.
struct LoadState {
  AxisPressures cap_pa{};  ///< Low-passed: the load that the valve's model compensates.
  AxisPressures rod_pa{};
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();  ///< P_A A_A - P_B A_B of this cycle.
  Eigen::Vector3d mean_force_n = Eigen::Vector3d::Zero();
};

/// First-order low-passes of `pressure_filter_s` and `damping_window_s`. `afresh` starts them at the
/// pressures given. A model that follows every change of load at once takes away the damping that
/// orifices give an oil column; slower than the machine's lowest mode it leaves that damping alone.
[[nodiscard]] LoadState next_load(const ExcavatorProfile& profile, const LoadState& last,
                                  const AxisPressures& cap_pa, const AxisPressures& rod_pa,
                                  double period_s, bool afresh);

/// Dynamic pressure feedback: a cylinder gives way to a force above its mean of late, m/s.
[[nodiscard]] Eigen::Vector3d damping_velocity(const ControlProfile& control,
                                               const LoadState& load);

}  // namespace graben
