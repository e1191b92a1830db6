// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The excavator as a machine kind: what its ECU is made of.

#include <cstddef>
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
  using Learnt = LearntDrives;
  using MemoryAccess = ControllerMemoryAccess;
  using Ecu = EcuNode<ExcavatorKind>;

  [[nodiscard]] static BusParts parts(const Setup& setup) {
    BusParts parts{setup.profile.has_swing()};
    for (std::size_t i = 0; i < parts.imu.size(); ++i) {
      parts.imu[i] = setup.profile.imu.mount[i].address;
    }
    parts.second_strokes = setup.profile.second.strokes();
    parts.second_swing = setup.profile.second.has[kSwing];
    return parts;
  }
  /// Of the bus that the machine is on, if that is not ours.
  template <class AnyMachine>
  [[nodiscard]] static const BusTable& table(const AnyMachine& machine) {
    return machine.bus;
  }
  /// Beside those of the receiver; 0 is none.
  [[nodiscard]] static auto sensor_ids(const Setup& setup) { return imu_ids(parts(setup).imu); }
  [[nodiscard]] static constexpr bool is_command(std::uint32_t id) {
    return id == Dbc::SpoolCommand::kId || id == Dbc::SwingCommand::kId;
  }
};

extern template class EcuNode<ExcavatorKind>;

}  // namespace graben::ecu
