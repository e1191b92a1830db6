// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator as a simulated machine kind, and the rigs of its runs.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>

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

/// An operator gives IMUs so long to learn their biases before he enables.
inline constexpr TimeUs kImusLearn_us = 10 * kSecondUs;

/// Strokes as the controller takes them; none until it knows all of them.
[[nodiscard]] inline std::optional<Eigen::Vector3d> measured_strokes_m(
    const ExcavatorProfile& profile, const ecu::ExcavatorKind::Ecu& ecu) {
  const JointAngles& by_imus = ecu.outputs().status.joints;
  const bool by_estimate = profile.imu.known() || profile.bus.joint_angles;
  bool known = !by_estimate || by_imus.known;
  Eigen::Vector3d strokes_m;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const Signal<double>& stroke_m = ecu.inputs().axis[i].stroke_m;
    known = known && (by_estimate || stroke_m.validity == Validity::kValid);
    const double shown_m =
        by_estimate ? by_imus.stroke_m[i] : stroke_m.value - profile.sensor_zero.stroke_m[i];
    strokes_m[i] = std::clamp(shown_m, 0.0, profile.geometry.cylinder[i].stroke_m);
  }
  return known ? std::optional(strokes_m) : std::nullopt;
}

/// Of a digging run.
struct DigRig : ExcavatorRig {
  DigRig(const machines::SimulatedExcavator& machine, const Eigen::Vector3d& start_strokes_m,
         double override_ratio)
      : LoopbackRig(machine, machine.profile, start_at(start_strokes_m), Task::kDig,
                    override_ratio) {
    if (machine.profile.imu.known()) {
      enable_from(kImusLearn_us);
    }
  }
};

/// Of a task's run.
struct AutodigRig : ExcavatorRig {
  AutodigRig(const machines::SimulatedExcavator& machine, const TaskBook& book,
             const DriveVector& start, double override_ratio)
      : LoopbackRig(machine, ExcavatorSetup(machine.profile, book), start_at(start), Task::kProgram,
                    override_ratio) {
    if (machine.profile.imu.known()) {
      enable_from(kImusLearn_us);
    }
  }
};

}  // namespace graben::runs
