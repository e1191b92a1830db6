// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator as a machine kind: what its ECU is made of.

#include <cstdint>

#include "app/ecu/ecu_node.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/excavator/excavator_controller.hpp"
#include "hal/buses/excavator_bus.hpp"

namespace graben::machines {
struct ExcavatorMachine;
}

namespace graben::ecu {

/// Members as EcuNode describes them.
struct ExcavatorKind {
  static constexpr const char* kName = "excavator";
  static constexpr bool kHasTasks = true;
  using Machine = machines::ExcavatorMachine;
  using Dbc = dbc::excavator::Dbc;
  using Profile = ExcavatorProfile;
  using Setup = ExcavatorSetup;
  using Inputs = ExcavatorInputs;
  using Outputs = ExcavatorOutputs;
  using Controller = ExcavatorController;
  using Receiver = ExcavatorReceiver;
  using Transmitter = ExcavatorTransmitter;
  using MemoryAccess = ControllerMemoryAccess;
  using Ecu = EcuNode<ExcavatorKind>;

  [[nodiscard]] static BusParts parts(const Setup& setup) { return {setup.profile.has_swing()}; }
  [[nodiscard]] static constexpr bool is_command(std::uint32_t id) {
    return id == Dbc::SpoolCommand::kId || id == Dbc::SwingCommand::kId;
  }
};

extern template class EcuNode<ExcavatorKind>;

}  // namespace graben::ecu
