/// A dozer's ECU without an operating system.

#include "firmware/dozer/dozer_controller.hpp"
#include "hal/buses/dozer_receiver.hpp"
#include "hal/buses/dozer_transmitter.hpp"
#include "tests/memory/bare_ecu.hpp"

namespace graben::memory {
namespace {

struct Dozer {
  using Setup = DozerSetup;
  using Inputs = DozerInputs;
  using Outputs = DozerOutputs;
  using Controller = DozerController;
  using Receiver = DozerReceiver;
  using Transmitter = DozerTransmitter;
  [[nodiscard]] static BusParts parts(const Setup&) { return {}; }
};

}  // namespace

void run_image() { run<Dozer>(held_setup<DozerSetup>()); }

}  // namespace graben::memory
