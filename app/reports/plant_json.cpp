// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "app/reports/plant_json.hpp"

namespace graben::reports {
namespace {

/// Frames of a command, with `of` before the names if it is not the cylinders'.
void add_command(nlohmann::ordered_json& figures, const std::string& of,
                 const plant::CommandCounters& command) {
  figures[of + "commands_accepted"] = command.accepted;
  figures[of + "commands_rejected"] = command.rejected + command.wrong_format;
  figures[of + "command_timeouts"] = command.timeouts;
}

/// Figures that all runs have at their end.
void add_bus(nlohmann::ordered_json& figures, const runs::PlantBusFigures& bus) {
  figures["late_cycles"] = bus.late_cycles;
  figures["frames_dropped"] = bus.frames_dropped;
}

}  // namespace

nlohmann::ordered_json plant_json(const runs::PlantRunResult& result) {
  nlohmann::ordered_json figures = {
      {"simulated_s", result.bus.simulated_s},  {"enabled_s", result.enabled_s},
      {"on_path_s", result.on_path_s},          {"loops", result.loops},
      {"max_error_true_m", result.max_error_m}, {"rmse_error_true_m", result.rmse_error_m}};
  add_command(figures, "", result.spool);
  add_bus(figures, result.bus);
  figures["peak_chamber_pressure_pa"] = result.peak_chamber_pressure_pa;
  return figures;
}

nlohmann::ordered_json plant_json(const runs::GradePlantResult& result) {
  nlohmann::ordered_json figures = {
      {"simulated_s", result.bus.simulated_s},  {"enabled_s", result.enabled_s},
      {"over_grade_s", result.over_grade_s},    {"edge_x_m", result.edge_x_m},
      {"max_error_true_m", result.max_error_m}, {"rmse_error_true_m", result.rmse_error_m}};
  add_command(figures, "", result.spool);
  add_bus(figures, result.bus);
  return figures;
}

nlohmann::ordered_json plant_json(const runs::TaskPlantResult& result) {
  nlohmann::ordered_json figures = {{"simulated_s", result.bus.simulated_s},
                                    {"enabled_s", result.enabled_s},
                                    {"in_steps_s", result.in_steps_s},
                                    {"on_lines_s", result.on_lines_s},
                                    {"finished", result.finished},
                                    {"built_within_ratio", result.built.within_ratio},
                                    {"built_low_m", result.built.low_m},
                                    {"max_error_true_m", result.max_error_m},
                                    {"rmse_error_true_m", result.rmse_error_m}};
  add_command(figures, "", result.spool);
  add_command(figures, "swing_", result.swing);
  add_bus(figures, result.bus);
  figures["peak_chamber_pressure_pa"] = result.peak_chamber_pressure_pa;
  return figures;
}

}  // namespace graben::reports
