// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Simulated machines in real time on a CAN interface, valve side and all, and figures of what the
/// controller there did with them. All throw std::runtime_error where the interface is not there.

#include <cstdint>

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/plant/command_link.hpp"
#include "app/plant/excavator_node.hpp"
#include "app/runs/as_built.hpp"
#include "app/runs/plant_bus.hpp"
#include "firmware/excavator/motion/program/task_program.hpp"

namespace graben::runs {

/// Figures of an excavator on its path. Errors are of the true tip, while it was on the path and
/// the spools enabled.
struct PlantRunResult {
  PlantBusFigures bus;
  double on_path_s = 0.0;
  double loops = 0.0;  ///< Times round the path.
  double max_error_m = 0.0;
  double rmse_error_m = 0.0;
  double enabled_s = 0.0;  ///< Time that the valve side let spools open.
  plant::CommandCounters spool;
  double peak_chamber_pressure_pa = 0.0;
};

[[nodiscard]] PlantRunResult run_plant(const machines::SimulatedExcavator& machine,
                                       const PlantRunOptions& options,
                                       const plant::ExcavatorStart& start);

/// Figures of a dozer on its grade. Errors are of the true cutting edge, while it was over the
/// grade and the valve side let the spool open.
struct GradePlantResult {
  PlantBusFigures bus;
  double enabled_s = 0.0;  ///< Time that the valve side let the spool open.
  double over_grade_s = 0.0;
  double edge_x_m = 0.0;  ///< Where it ended.
  double max_error_m = 0.0;
  double rmse_error_m = 0.0;
  plant::CommandCounters spool;  ///< The blade's.
};

/// The operator lets go once the edge has come to the grade's length.
[[nodiscard]] GradePlantResult run_plant(const machines::SimulatedDozer& machine,
                                         const PlantRunOptions& options);

/// Figures of a task. Errors are of the true teeth from a step's straight line, while the
/// controller's TaskStatus said that it was in this step and the valve side let spools open.
struct TaskPlantResult {
  PlantBusFigures bus;
  double enabled_s = 0.0;   ///< Time that the valve side let spools open.
  double in_steps_s = 0.0;  ///< Of it; the approach is none.
  double on_lines_s = 0.0;  ///< Of it, in straight steps.
  /// The last step was left, of a task that repeats for the first time; an area is dug.
  bool finished = false;
  AsBuilt built;  ///< Of an area, in ground that is cut.
  double max_error_m = 0.0;
  double rmse_error_m = 0.0;
  plant::CommandCounters spool;
  plant::CommandCounters swing;
  double peak_chamber_pressure_pa = 0.0;
};

/// The machine, which has a swing drive, stands where `program` begins, and the operator asks for
/// the task with the options' number, which has to be that program.
[[nodiscard]] TaskPlantResult run_task_plant(const machines::SimulatedExcavator& machine,
                                             const TaskProgram& program,
                                             const PlantRunOptions& options);

}  // namespace graben::runs
