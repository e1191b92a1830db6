#pragma once
/// The dozer's controller as a node on its bus.

#include "app/ecu/ecu_node.hpp"
#include "firmware/dozer/dozer_controller.hpp"
#include "hal/buses/dozer_receiver.hpp"
#include "hal/buses/dozer_transmitter.hpp"

namespace graben::ecu {

struct DozerKind {
  using Setup = DozerSetup;
  using Inputs = DozerInputs;
  using Outputs = DozerOutputs;
  using Controller = DozerController;
  using Receiver = DozerReceiver;
  using Transmitter = DozerTransmitter;
  using MemoryAccess = DozerMemoryAccess;
  [[nodiscard]] static BusParts parts(const Setup&) { return {}; }
  [[nodiscard]] static bool is_command(std::uint32_t id);
};

extern template class EcuNode<DozerKind>;
using DozerEcu = EcuNode<DozerKind>;

}  // namespace graben::ecu
