#pragma once
/// The simulated dozer in real time on a CAN interface.

#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/plant/command_link.hpp"
#include "app/runs/plant_bus.hpp"

namespace graben::runs {

/// What the run saw. Errors are of the true cutting edge, while it was over the grade and the valve
/// side let the spool open.
struct GradePlantResult {
  PlantBusFigures bus;
  double enabled_s = 0.0;  ///< That the valve side let the spool open.
  double over_grade_s = 0.0;
  double edge_x_m = 0.0;  ///< Where it ended.
  double max_error_m = 0.0;
  double rmse_error_m = 0.0;
  plant::CommandCounters spool;  ///< The blade's.
};

/// The operator lets go once the edge has come to the grade's length. Throws std::runtime_error
/// where the interface is not there.
[[nodiscard]] GradePlantResult run_plant(const machines::SimulatedDozer& machine,
                                         const PlantRunOptions& options);

}  // namespace graben::runs
