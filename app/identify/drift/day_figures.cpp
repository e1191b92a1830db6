// SPDX-License-Identifier: Apache-2.0
#include "app/identify/drift/day_figures.hpp"

#include <fmt/format.h>

#include "app/identify/drift/wear.hpp"
#include "app/identify/machine/drive_model.hpp"
#include "app/identify/machine/machine_fit.hpp"
#include "app/identify/machine/prediction_score.hpp"

namespace graben::identify {

DayFigures day_figures(const ExcavatorProfile& profile, const MachineLog& log) {
  const DriveModel model(profile);
  const std::vector<MachineLog> logs = {log};
  const MachineEstimate found =
      identify_machine(model, logs, [](double /*share*/, const std::string& /*what*/) {});
  const std::vector<SteadyPoint> points = steady_points(logs, model);
  DayFigures day;
  day.log = log.name;
  day.time_s = log.segments.front().begin_s;
  const auto add = [&day](Wears what, const std::string& part, const Estimate& value) {
    day.figures.push_back({what, part, value});
  };
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const std::string name = kAxisTexts[axis];
    const DriveEstimate& drive = found.drive[axis];
    add(Wears::kDeadBand, name + ", extending", drive.extend.edge);
    add(Wears::kDeadBand, name + ", retracting", drive.retract.edge);
    add(Wears::kCreep, name, find_creep(log, axis));
    add(Wears::kFriction, name, find_friction(points, profile.geometry, axis));
    add(Wears::kStrokeZero, name, drive.stroke_zero_m);
    add(Wears::kPressureZero, name + ", cap side", drive.cap_zero_pa);
    add(Wears::kPressureZero, name + ", rod side", drive.rod_zero_pa);
  }
  for (int pump = 0; pump < profile.pump_count; ++pump) {
    add(Wears::kPumpFlow, fmt::format("pump {}", pump + 1),
        found.pump_flow_factor[static_cast<std::size_t>(pump)]);
  }
  return day;
}

}  // namespace graben::identify
