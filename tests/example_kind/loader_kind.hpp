// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The loader as a machine kind: its frames' signals, its ECU's parts, and what simulates it.

#include <cmath>

#include "app/ecu/ecu_node.hpp"
#include "app/plant/operator_node.hpp"
#include "hal/buses/common_messages.hpp"
#include "hal/link/message_receiver.hpp"
#include "loader_dbc.hpp"
#include "tests/example_kind/loader_controller.hpp"
#include "tests/example_kind/loader_plant.hpp"

namespace graben {

struct LoaderStore : CommonStore<LoaderInputs, Task::kDig> {
  using CommonStore::store;

  template <class Cylinder>
  static void store(const Cylinder& message, TimeUs now, To& to) {
    constexpr bool kIsLift = std::is_same_v<Cylinder, dbc::loader::LiftCylinder>;
    DriveInputs& drive = to.inputs.drive[kIsLift ? kLift : kTilt];
    put(drive.stroke_m, message.stroke_m, now);
    put(drive.cap_pressure_pa, message.cap_pressure_pa, now);
    put(drive.rod_pressure_pa, message.rod_pressure_pa, now);
  }
  static void store(const dbc::loader::ValveState& message, TimeUs now, To& to) {
    put(to.inputs.drive[kLift].spool_ratio, message.lift_spool_ratio, now);
    put(to.inputs.drive[kTilt].spool_ratio, message.tilt_spool_ratio, now);
    put(to.inputs.valve_enabled, message.enabled, now);
  }
};

inline dbc::loader::SpoolCommand loader_command(const LoaderOutputs& outputs, const EcuDiagnosis&) {
  dbc::loader::SpoolCommand message;  // starts as Off, neutral and no cut
  set_pilot_cut(message, outputs);
  const auto& [lift, tilt] = outputs.duty_ratio;
  if (outputs.enable && std::isfinite(lift) && std::isfinite(tilt)) {
    message.enable = coded<dbc::loader::SpoolCommand::Enable>(true);
    message.lift_duty_ratio = physical(lift);
    message.tilt_duty_ratio = physical(tilt);
  }
  return message;
}

inline constexpr auto kLoaderReceives = receive_table<LoaderInputs, LoaderStore>(
    dbc::MessageList<dbc::loader::LiftCylinder, dbc::loader::TiltCylinder,
                     dbc::loader::ValveState>{},
    CommonReceived{}, kBusMessages<dbc::loader::kMessages>, dbc::loader::kDbcVersion);
inline constexpr auto kLoaderSends =
    bus_send_table(send_row<LoaderOutputs, dbc::loader::SpoolCommand, loader_command>(0),
                   ecu_status_row<LoaderOutputs>(), ecu_health_row<LoaderOutputs>(),
                   ecu_identity_row<LoaderOutputs, dbc::loader::kDbcVersion>());

/// Members as EcuNode and LoopbackRig describe them.
struct LoaderKind {
  using Dbc = dbc::loader::Dbc;
  using Setup = LoaderSetup;
  using Inputs = LoaderInputs;
  using Outputs = LoaderOutputs;
  using Controller = LoaderController;
  using Receiver = MessageReceiver<ReceptionOf<kLoaderReceives>>;
  using Transmitter = MessageTransmitter<TransmissionOf<kLoaderSends>>;
  struct Learnt {};
  struct MemoryAccess;
  using Ecu = ecu::EcuNode<LoaderKind>;
  struct Machine : LoaderProfile {
    std::uint32_t hash = 0x10ADE4;
  };
  using Node = plant::LoaderNode;
  using Operator = plant::OperatorNode<Dbc>;
  using Start = plant::LoaderPlant::Pair;  ///< Strokes.

  [[nodiscard]] static BusParts parts(const Setup&) { return {}; }
  [[nodiscard]] static BusTable table(const Machine&) { return {}; }
  [[nodiscard]] static constexpr bool is_command(std::uint32_t id) {
    return id == Dbc::SpoolCommand::kId;
  }
  [[nodiscard]] static Node node(const Machine& machine, const Start& start, CanPort& port) {
    return {machine, start, port, machine.hash};
  }
};

}  // namespace graben
