// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Moments of a log in which a cylinder moves steadily, or its spool stands steadily: what a
/// valve's curve is found from.

#include <array>
#include <vector>

#include "app/identify/machine/drive_model.hpp"
#include "app/identify/machine/machine_log.hpp"

namespace graben::identify {

/// Means over a short window; in SI units, extension is positive. Pressures as a sensor would show
/// them whose range does not end at 0.
struct SteadyPoint {
  int axis = 0;
  double spool = 0.0;  ///< Of the travel; its sign is the side.
  double speed_mps = 0.0;
  double speed_spread_mps = 0.0;  ///< What speed and sensor leave open.
  std::array<double, kDriveCount> all_spool{};
  std::array<double, kDriveCount> all_speed_mps{};
  std::array<double, kDriveCount> cap_pa{};
  std::array<double, kDriveCount> rod_pa{};
  std::array<double, kPumpCount> swash{};
  double engine_radps = 0.0;
  double stroke_m = 0.0;
  double spool_rise_ps = 0.0;
  double cap_rise_paps = 0.0;  ///< Of its own pressures.
  double rod_rise_paps = 0.0;
  std::size_t block = 0;  ///< Stretch of the logs whose errors hang together.
};

/// All of them, of every axis. Not near the ends of a stroke, where cushions and stops are.
[[nodiscard]] std::vector<SteadyPoint> steady_points(const std::vector<MachineLog>& logs,
                                                     const DriveModel& model);

}  // namespace graben::identify
