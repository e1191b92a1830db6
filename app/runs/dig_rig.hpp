#pragma once
/// The bench of a digging run.

#include "app/ecu/excavator_ecu.hpp"
#include "app/machines/excavator_file.hpp"
#include "app/plant/excavator_node.hpp"
#include "app/plant/operator_node.hpp"
#include "app/runs/loopback_rig.hpp"

namespace graben::runs {

struct DigBench : MachineBench<plant::PlantNode, plant::OperatorNode, ecu::ExcavatorEcu> {
  DigBench(const machines::ExcavatorMachine& machine, const Eigen::Vector3d& start_strokes_m,
           double override_ratio)
      : MachineBench(machine.profile, machine.hash, Task::kDig, override_ratio, machine.plant,
                     plant::ExcavatorPlant::AxisArray{start_strokes_m[0], start_strokes_m[1],
                                                      start_strokes_m[2]}) {}
};

}  // namespace graben::runs
