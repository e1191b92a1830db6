#pragma once
/// The bench of a grading run.

#include "app/ecu/dozer_ecu.hpp"
#include "app/machines/dozer_file.hpp"
#include "app/plant/dozer_node.hpp"
#include "app/plant/operator_node.hpp"
#include "app/runs/loopback_rig.hpp"

namespace graben::runs {

struct GradeBench : MachineBench<plant::DozerNode, plant::DozerOperatorNode, ecu::DozerEcu> {
  GradeBench(const machines::DozerMachine& machine, double override_ratio)
      : MachineBench(machine.profile, machine.hash, Task::kGrade, override_ratio, machine.plant) {}
};

}  // namespace graben::runs
