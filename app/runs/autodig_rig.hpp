#pragma once
/// The bench of a task's run.

#include "app/ecu/excavator_ecu.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/plant/excavator_node.hpp"
#include "app/plant/operator_node.hpp"
#include "app/runs/loopback_rig.hpp"

namespace graben::runs {

struct AutodigBench : MachineBench<plant::PlantNode, plant::OperatorNode, ecu::ExcavatorEcu> {
  AutodigBench(const machines::ExcavatorMachine& machine, const TaskBook& book,
               const DriveVector& start, double override_ratio)
      : MachineBench(
            ExcavatorSetup(machine.profile, book), machine.hash, Task::kProgram, override_ratio,
            machine.plant,
            plant::PlantStart({start[kBoom], start[kArm], start[kBucket]}, start[kSwing])) {}
};

}  // namespace graben::runs
