#pragma once
/// The kinds of machine, as the simulation's faults need them.

#include "app/ecu/dozer_ecu.hpp"
#include "app/ecu/excavator_ecu.hpp"
#include "app/plant/dozer_node.hpp"
#include "app/plant/excavator_node.hpp"
#include "app/plant/operator_node.hpp"
#include "app/runs/loopback_rig.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::scope {

struct SimExcavator {
  using Bench = runs::MachineBench<plant::PlantNode, plant::OperatorNode, ecu::ExcavatorEcu>;
  using Status = dbc::excavator::EcuStatus;
  using Command = dbc::excavator::SpoolCommand;
  using Engine = dbc::excavator::EEC1;
  using Stroke = dbc::excavator::BoomStroke;
  /// One more message of the machine's that is protected.
  using Other = dbc::excavator::ArmStroke;
  static constexpr const auto& kMessages = dbc::excavator::kMessages;
  static constexpr dbc::Field kStroke = Stroke::kBoomStroke;
  static constexpr const char* kStrokeWords = "the boom stroke";
  static constexpr const char* kOtherWords = "the arm stroke";

  /// The one whose spool is open most.
  [[nodiscard]] static unsigned moving_axis(const Bench& nodes);
  [[nodiscard]] static double spool_ratio(const Bench& nodes, unsigned axis) {
    return nodes.plant.plant().spool_travels_ratio()[axis];
  }
  [[nodiscard]] static plant::AxisFaults& axis(Bench& nodes, unsigned axis) {
    return nodes.plant.faults().axis[axis];
  }
};

struct SimDozer {
  using Bench = runs::MachineBench<plant::DozerNode, plant::DozerOperatorNode, ecu::DozerEcu>;
  using Status = dbc::dozer::EcuStatus;
  using Command = dbc::dozer::SpoolCommand;
  using Engine = dbc::dozer::EEC1;
  using Stroke = dbc::dozer::BladeStroke;
  using Other = dbc::dozer::BodyPitch;
  static constexpr const auto& kMessages = dbc::dozer::kMessages;
  static constexpr dbc::Field kStroke = Stroke::kBladeStroke;
  static constexpr const char* kStrokeWords = "the blade's stroke";
  static constexpr const char* kOtherWords = "the body's pitch";

  [[nodiscard]] static unsigned moving_axis(const Bench& /*nodes*/) { return 0; }
  [[nodiscard]] static double spool_ratio(const Bench& nodes, unsigned /*axis*/) {
    return nodes.plant.plant().spool_travel_ratio();
  }
  [[nodiscard]] static plant::DozerFaults& axis(Bench& nodes, unsigned /*axis*/) {
    return nodes.plant.faults();
  }
};

}  // namespace graben::scope
