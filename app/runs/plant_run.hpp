#pragma once
/// The simulated excavator in real time on a CAN interface.

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/plant/excavator_node.hpp"
#include "app/runs/plant_bus.hpp"

namespace graben::runs {

/// What the run saw. Errors are of the true tip, while it was on the path and the spools enabled.
struct PlantRunResult {
  PlantBusFigures bus;
  double on_path_s = 0.0;
  double loops = 0.0;  ///< Times round the path.
  double max_error_m = 0.0;
  double rmse_error_m = 0.0;
  double enabled_s = 0.0;  ///< That the valve side let spools open.
  plant::CommandCounters spool;
  double peak_chamber_pressure_pa = 0.0;
};

/// Throws std::runtime_error where the interface is not there.
[[nodiscard]] PlantRunResult run_plant(const machines::SimulatedExcavator& machine,
                                       const PlantRunOptions& options,
                                       const plant::ExcavatorStart& start);

}  // namespace graben::runs
