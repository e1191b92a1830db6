// SPDX-License-Identifier: Apache-2.0
#include "app/runs/plant_runs.hpp"

#include <cmath>

#include "app/plant/dozer_node.hpp"
#include "app/runs/figures.hpp"
#include "app/runs/grade_truth.hpp"
#include "app/runs/plant_faults.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"

namespace graben::runs {
namespace {

/// Adds up what the figures speak of.
class GradeObserver {
 public:
  GradeObserver(const machines::SimulatedDozer& machine, GradePlantResult& result)
      : truth_(machine.profile), length_m_(machine.experiment.length_m), result_(result) {}

  void see(const plant::DozerNode& node) {
    const Eigen::Vector2d edge_m = node.plant().cutting_edge_m();
    result_.edge_x_m = edge_m.x();
    if (!node.spools_enabled()) {
      return;
    }
    result_.enabled_s += kPlantPeriod_s;
    if (edge_m.x() < 0.0 || through()) {
      return;
    }
    result_.over_grade_s += kPlantPeriod_s;
    const plant::DozerPlant& plant = node.plant();
    const BodyPose body = true_pose(plant);
    error_.add(std::abs(plant.tilt() ? truth_.worst_error_m(body, {plant.blade().angle_rad(),
                                                                   plant.tilt()->angle_rad()})
                                     : truth_.error_m(edge_m)));
    result_.max_error_m = error_.max();
    result_.rmse_error_m = error_.rms();
  }

  [[nodiscard]] bool through() const { return result_.edge_x_m > length_m_; }

 private:
  GradeTruth truth_;
  double length_m_;
  GradePlantResult& result_;
  Spread error_;
};

}  // namespace

GradePlantResult run_plant(const machines::SimulatedDozer& machine,
                           const PlantRunOptions& options) {
  namespace ids = dbc::dozer;
  PlantFaultSchedule faults(dozer_plant_faults(), options.faults);
  PlantBus<DozerSim> bus(options, {ids::SpoolCommand::kId, ids::PumpDisplacementCommand::kId,
                                   ids::MotorDisplacementCommand::kId, ids::EcuIdentity::kId});
  plant::DozerNode node(machine.plant, bus.port(), machine.hash);
  GradePlantResult result;
  GradeObserver observer(machine, result);
  bool has_let_go = false;
  result.bus = bus.run(Task::kGrade, [&](TimeUs now_us) {
    faults.apply(now_us, node.faults(), bus.mark_port());
    node.step(now_us);
    observer.see(node);
    if (observer.through() && !has_let_go) {
      bus.let_go();
      has_let_go = true;
    }
  });
  result.spool = node.counters();
  return result;
}

}  // namespace graben::runs
