// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a profile alone predicts of the cylinders' speeds in a log: from the duties that the valves
/// were sent, the chambers' pressures, swash and engine speed. No measured stroke, spool or speed
/// is in it.
///
/// duty -> dead time of its side -> the spool's two equal lags -> that side's table -> opening ->
/// DriveModel::speeds_mps() -> the rest of that side's lag (oil, hoses).

#include <functional>
#include <vector>

#include "app/identify/machine/drive_model.hpp"
#include "app/identify/machine/machine_log.hpp"

namespace graben::identify {

/// Of one cylinder, a value each grid point.
struct PredictedAxis {
  std::vector<double> predicted_mps;
  /// Of the measured stroke: slope of the straight line through a window of kSpeedWindow_s;
  /// predicted speeds are averaged in the same way.
  std::vector<double> measured_mps;
  /// Judged: its duty has not been neutral for longer than kSwings_s, away from the stroke's ends,
  /// and the window lies within the log. How it swings on its oil with its valve shut, no valve
  /// says.
  std::vector<bool> judged;
};

struct PredictedSegment {
  /// Of drives that the machine has not: empty.
  std::array<PredictedAxis, kDriveCount> axis;
};

inline constexpr double kSpeedWindow_s = 0.10;
/// Longer than any dead time and lag.
inline constexpr double kSwings_s = 0.6;

/// Of each segment of each log.
[[nodiscard]] std::vector<std::vector<PredictedSegment>> predict_logs(
    const DriveModel& model, const std::vector<MachineLog>& logs);

}  // namespace graben::identify
