#pragma once
/// The excavator's controller as a node on its bus.

#include "app/ecu/ecu_node.hpp"
#include "firmware/excavator/excavator_controller.hpp"
#include "hal/buses/excavator_receiver.hpp"
#include "hal/buses/excavator_transmitter.hpp"

namespace graben::ecu {

struct ExcavatorKind {
  using Setup = ExcavatorSetup;
  using Inputs = ExcavatorInputs;
  using Outputs = ExcavatorOutputs;
  using Controller = ExcavatorController;
  using Receiver = ExcavatorReceiver;
  using Transmitter = ExcavatorTransmitter;
  using MemoryAccess = ControllerMemoryAccess;
  [[nodiscard]] static BusParts parts(const Setup& setup) { return {setup.profile.has_swing()}; }
  [[nodiscard]] static bool is_command(std::uint32_t id);
};

extern template class EcuNode<ExcavatorKind>;
using ExcavatorEcu = EcuNode<ExcavatorKind>;

}  // namespace graben::ecu
