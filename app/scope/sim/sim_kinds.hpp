// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The kinds of machine, as the simulation's faults need them.

#include "app/runs/dozer_rig.hpp"
#include "app/runs/excavator_rig.hpp"

namespace graben::scope {

struct SimExcavator : runs::ExcavatorSim {
  using Rig = runs::ExcavatorRig;
  using Stroke = Dbc::BoomStroke;
  /// One more message of the machine's that is protected.
  using Other = Dbc::ArmStroke;
  static constexpr dbc::Field kStroke = Stroke::kBoomStroke;
  static constexpr const char* kStrokeWords = "the boom stroke";
  static constexpr const char* kOtherWords = "the arm stroke";

  /// The one whose spool is open most.
  [[nodiscard]] static unsigned moving_axis(const Rig& nodes);
  [[nodiscard]] static double spool_ratio(const Rig& nodes, unsigned axis) {
    return nodes.plant.plant().spool_travels_ratio()[axis];
  }
  [[nodiscard]] static plant::AxisFaults& axis(Rig& nodes, unsigned axis) {
    return nodes.plant.faults().axis[axis];
  }
};

struct SimDozer : runs::DozerSim {
  using Rig = runs::DozerRig;
  using Stroke = Dbc::BladeStroke;
  using Other = Dbc::BodyPitch;
  static constexpr dbc::Field kStroke = Stroke::kBladeStroke;
  static constexpr const char* kStrokeWords = "the blade's stroke";
  static constexpr const char* kOtherWords = "the body's pitch";

  [[nodiscard]] static unsigned moving_axis(const Rig& /*nodes*/) { return 0; }
  [[nodiscard]] static double spool_ratio(const Rig& nodes, unsigned /*axis*/) {
    return nodes.plant.plant().spool_travel_ratio();
  }
  [[nodiscard]] static plant::DozerFaults& axis(Rig& nodes, unsigned /*axis*/) {
    return nodes.plant.faults();
  }
};

}  // namespace graben::scope
