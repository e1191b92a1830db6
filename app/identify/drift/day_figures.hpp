// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What one log of a machine says of what wears: edges of the dead bands, creep, friction, pumps'
/// flow, zeros of the sensors. Each with its deviation, so that logs of many days can be compared.

#include <string>
#include <vector>

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/machine_log.hpp"
#include "firmware/excavator/excavator_profile.hpp"

namespace graben::identify {

enum class Wears { kDeadBand, kCreep, kFriction, kPumpFlow, kStrokeZero, kPressureZero };

struct WearFigure {
  Wears what = Wears::kDeadBand;
  std::string part;  ///< "arm, retracting", "pump 1".
  /// Ratio of the travel; m/(s Pa); N; of the displacement in the profile; m; Pa.
  Estimate value;
};

struct DayFigures {
  std::string log;
  double time_s = 0.0;              ///< Of the log's first frame, by its own clock.
  std::vector<WearFigure> figures;  ///< Of the same machine always the same ones, in one order.
};

/// Throws std::runtime_error where nothing moves steadily in it.
[[nodiscard]] DayFigures day_figures(const ExcavatorProfile& profile, const MachineLog& log);

}  // namespace graben::identify
