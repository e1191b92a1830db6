// SPDX-License-Identifier: Apache-2.0
#include "app/runs/plant_runs.hpp"

#include <algorithm>
#include <cmath>

#include "app/plant/excavator_node.hpp"
#include "app/runs/path_progress.hpp"
#include "app/runs/plant_faults.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::runs {
namespace {

/// Adds up what the figures speak of.
class PathObserver {
 public:
  PathObserver(const machines::SimulatedExcavator& machine, PlantRunResult& result)
      : path_(machine.profile.dig_path), progress_(path_, 1.0), result_(result) {}

  void see(const plant::ExcavatorNode& node, TimeUs now_us) {
    if (!node.spools_enabled()) {
      return;
    }
    result_.enabled_s += kPlantPeriod_s;
    const plant::TipPose tip = node.plant().tip();
    progress_.update(tip.position_m, near_path(path_, tip.position_m, tip.attitude_rad), now_us);
    if (progress_.on_path()) {
      const double error_m = (path_.closest(tip.position_m).position_m - tip.position_m).norm();
      result_.max_error_m = std::max(result_.max_error_m, error_m);
      squares_m2_ += error_m * error_m;
      result_.on_path_s += kPlantPeriod_s;
      result_.rmse_error_m = std::sqrt(squares_m2_ * kPlantPeriod_s / result_.on_path_s);
      result_.loops = progress_.share();
    }
  }

 private:
  RoundedRectangle path_;
  PathProgress progress_;
  PlantRunResult& result_;
  double squares_m2_ = 0.0;
};

}  // namespace

PlantRunResult run_plant(const machines::SimulatedExcavator& machine,
                         const PlantRunOptions& options, const plant::ExcavatorStart& start) {
  namespace ids = dbc::excavator;
  PlantFaultSchedule faults(excavator_plant_faults(), options.faults);
  PlantBus<ExcavatorSim> bus(options, {ids::SpoolCommand::kId, ids::PumpCommand::kId,
                                       ids::SwingCommand::kId, ids::EcuIdentity::kId});
  plant::ExcavatorNode node(machine.plant, start, bus.port(), machine.hash);
  PlantRunResult result;
  PathObserver observer(machine, result);
  result.bus = bus.run(Task::kDig, [&](TimeUs now_us) {
    faults.apply(now_us, node.faults(), bus.mark_port());
    node.step(now_us);
    observer.see(node, now_us);
  });
  result.spool = node.counters();
  result.peak_chamber_pressure_pa = node.plant().peak_chamber_pressure_pa();
  return result;
}

}  // namespace graben::runs
