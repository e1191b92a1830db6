// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator as a simulated machine kind, and the rigs of its runs.

#include <cstddef>
#include <numeric>

#include "app/ecu/excavator_kind.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/plant/excavator_node.hpp"
#include "app/plant/operator_node.hpp"
#include "app/runs/loopback_rig.hpp"

namespace graben::runs {

/// Members as LoopbackRig describes them.
struct ExcavatorSim : ecu::ExcavatorKind {
  using Machine = machines::SimulatedExcavator;
  using Node = plant::ExcavatorNode;
  using Operator = plant::OperatorNode<Dbc>;
  using Start = plant::ExcavatorStart;

  [[nodiscard]] static Node node(const Machine& machine, const Start& start, CanPort& port) {
    return {machine.plant, start, port, machine.hash};
  }
};

/// Of the pumps that the machine has, of full swash.
[[nodiscard]] inline double mean_swash(const plant::ExcavatorPlant& plant) {
  const plant::ExcavatorPlant::PumpArray swash = plant.swash_ratios();
  const auto pumps = static_cast<std::ptrdiff_t>(plant.profile().machine.pump_count);
  return std::accumulate(swash.begin(), swash.begin() + pumps, 0.0) / static_cast<double>(pumps);
}

using ExcavatorRig = LoopbackRig<ExcavatorSim>;

[[nodiscard]] inline plant::ExcavatorStart start_at(const Eigen::Vector3d& strokes_m) {
  return plant::ExcavatorPlant::AxisArray{strokes_m[0], strokes_m[1], strokes_m[2]};
}
/// Strokes and swing angle.
[[nodiscard]] inline plant::ExcavatorStart start_at(const DriveVector& drives) {
  return {{drives[kBoom], drives[kArm], drives[kBucket]}, drives[kSwing]};
}

/// Of a digging run.
struct DigRig : ExcavatorRig {
  DigRig(const machines::SimulatedExcavator& machine, const Eigen::Vector3d& start_strokes_m,
         double override_ratio)
      : LoopbackRig(machine, machine.profile, start_at(start_strokes_m), Task::kDig,
                    override_ratio) {}
};

/// Of a task's run.
struct AutodigRig : ExcavatorRig {
  AutodigRig(const machines::SimulatedExcavator& machine, const TaskBook& book,
             const DriveVector& start, double override_ratio)
      : LoopbackRig(machine, ExcavatorSetup(machine.profile, book), start_at(start), Task::kProgram,
                    override_ratio) {}
};

}  // namespace graben::runs
