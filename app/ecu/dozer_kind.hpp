// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer as a machine kind: what its ECU is made of.

#include <array>
#include <cstdint>

#include "app/ecu/ecu_node.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "firmware/dozer/dozer_controller.hpp"
#include "hal/buses/dozer_bus.hpp"

namespace graben::machines {
struct DozerMachine;
}

namespace graben::ecu {

/// Members as EcuNode describes them.
struct DozerKind {
  static constexpr const char* kName = "dozer";
  static constexpr bool kHasTasks = false;
  using Machine = machines::DozerMachine;
  using Dbc = dbc::dozer::Dbc;
  using Profile = DozerProfile;
  using Setup = DozerSetup;
  using Inputs = DozerInputs;
  using Outputs = DozerOutputs;
  using Controller = DozerController;
  using Receiver = DozerReceiver;
  using Transmitter = DozerTransmitter;
  /// Nothing that is worth keeping: its flow share and its tracks' slip are of the ground.
  struct Learnt {};
  using MemoryAccess = DozerMemoryAccess;
  using Ecu = EcuNode<DozerKind>;

  [[nodiscard]] static std::array<std::uint32_t, 0> sensor_ids(const Setup&) { return {}; }
  [[nodiscard]] static BusParts parts(const Setup&) { return {}; }
  /// It is on ours.
  template <class AnyMachine>
  [[nodiscard]] static BusTable table(const AnyMachine&) {
    return {};
  }
  [[nodiscard]] static constexpr bool is_command(std::uint32_t id) {
    return id == Dbc::SpoolCommand::kId || id == Dbc::PumpDisplacementCommand::kId ||
           id == Dbc::MotorDisplacementCommand::kId;
  }
};

extern template class EcuNode<DozerKind>;

}  // namespace graben::ecu
