// SPDX-License-Identifier: Apache-2.0
#include "app/runs/plant_runs.hpp"

#include <optional>

#include "app/plant/excavator_node.hpp"
#include "app/runs/figures.hpp"
#include "app/runs/plant_faults.hpp"
#include "app/runs/task_listener.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/excavator/motion/dig/layer_pose.hpp"
#include "firmware/excavator/motion/program/line.hpp"

namespace graben::runs {
namespace {

/// Adds up what the figures speak of.
class TaskObserver {
 public:
  TaskObserver(const TaskProgram& program, TaskPlantResult& result)
      : program_(program), result_(result) {}

  void see(const plant::ExcavatorNode& node, const TaskListener& listener) {
    if (!node.spools_enabled()) {
      return;
    }
    result_.enabled_s += kPlantPeriod_s;
    const std::optional<int> step = listener.step();
    const bool begins_again = step && *step < last_step_ && !in_layers(program_);
    result_.finished = result_.finished || listener.is_done() || begins_again;
    if (step && *step < program_.step_count) {
      last_step_ = *step;
      see_step(node, program_.step[static_cast<unsigned>(*step)]);
    }
  }

 private:
  void see_step(const plant::ExcavatorNode& node, const TaskStep& step) {
    result_.in_steps_s += kPlantPeriod_s;
    if (!step.straight) {
      return;
    }
    result_.on_lines_s += kPlantPeriod_s;
    error_.add(line_distance_m(step.line.line, node.plant().teeth().position_m));
    result_.max_error_m = error_.max();
    result_.rmse_error_m = error_.rms();
  }

  const TaskProgram& program_;
  TaskPlantResult& result_;
  int last_step_ = 0;
  Spread error_;
};

plant::ExcavatorStart start_of(const TaskProgram& program) {
  const DriveVector& start = program.start;
  return {{start[kBoom], start[kArm], start[kBucket]}, start[kSwing]};
}

}  // namespace

TaskPlantResult run_task_plant(const machines::SimulatedExcavator& machine,
                               const TaskProgram& program, const PlantRunOptions& options) {
  namespace ids = dbc::excavator;
  PlantFaultSchedule faults(excavator_plant_faults(), options.faults);
  PlantBus<ExcavatorSim> bus(options,
                             {ids::SpoolCommand::kId, ids::PumpCommand::kId, ids::SwingCommand::kId,
                              ids::TaskStatus::kId, ids::EcuIdentity::kId});
  TaskListener listener(bus.port(), options.task_number);
  plant::ExcavatorNode node(machine.plant, start_of(program), listener, machine.hash);
  TaskPlantResult result;
  TaskObserver observer(program, result);
  result.bus = bus.run(Task::kProgram, [&](TimeUs now_us) {
    listener.begin_cycle(now_us);
    faults.apply(now_us, node.faults(), bus.mark_port());
    node.step(now_us);
    observer.see(node, listener);
  });
  if (const plant::BucketSoil* soil = node.plant().digging(); soil != nullptr) {
    result.built = as_built(program, soil->ground());
  }
  result.spool = node.counters();
  result.swing = node.swing_counters();
  result.peak_chamber_pressure_pa = node.plant().peak_chamber_pressure_pa();
  return result;
}

}  // namespace graben::runs
