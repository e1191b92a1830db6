// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer as a simulated machine kind, and the rig of its runs.

#include "app/ecu/dozer_kind.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/plant/dozer_node.hpp"
#include "app/plant/operator_node.hpp"
#include "app/runs/loopback_rig.hpp"

namespace graben::runs {

/// Members as LoopbackRig describes them.
struct DozerSim : ecu::DozerKind {
  using Machine = machines::SimulatedDozer;
  using Node = plant::DozerNode;
  using Operator = plant::OperatorNode<Dbc>;
  /// Its plant's profile says where it starts.
  struct Start {};

  [[nodiscard]] static Node node(const Machine& machine, const Start&, CanPort& port) {
    return {machine.plant, port, machine.hash};
  }
};

using DozerRig = LoopbackRig<DozerSim>;

/// Of a grading run.
struct GradeRig : DozerRig {
  GradeRig(const machines::SimulatedDozer& machine, double override_ratio)
      : LoopbackRig(machine, machine.profile, {}, Task::kGrade, override_ratio) {}
};

}  // namespace graben::runs
