#pragma once
/// A task on the simulated excavator in real time, as the controller on the CAN interface does it.

#include <cstdint>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/plant/command_link.hpp"
#include "app/runs/plant_bus.hpp"
#include "firmware/excavator/tasks/task_program.hpp"

namespace graben::runs {

/// What the run saw. Errors are of the true teeth from a step's straight line, while the
/// controller's TaskStatus said that it was in this step and the valve side let spools open.
struct TaskPlantResult {
  PlantBusFigures bus;
  double enabled_s = 0.0;   ///< That the valve side let spools open.
  double in_steps_s = 0.0;  ///< Of them; the approach is none.
  double on_lines_s = 0.0;  ///< Of them, in straight steps.
  bool finished = false;    ///< The last step was left, of a task that repeats for the first time.
  double max_error_m = 0.0;
  double rmse_error_m = 0.0;
  plant::CommandCounters spool;
  plant::CommandCounters swing;
  double peak_chamber_pressure_pa = 0.0;
};

/// The machine, which has a swing drive, stands where `program` begins, and the operator asks for
/// the task with the options' number, which has to be that program. Throws std::runtime_error where
/// the interface is not there.
[[nodiscard]] TaskPlantResult run_task_plant(const machines::SimulatedExcavator& machine,
                                             const TaskProgram& program,
                                             const PlantRunOptions& options);

}  // namespace graben::runs
