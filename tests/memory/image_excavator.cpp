/// An excavator's ECU without an operating system.

#include "firmware/excavator/excavator_controller.hpp"
#include "hal/buses/excavator_receiver.hpp"
#include "hal/buses/excavator_transmitter.hpp"
#include "tests/memory/bare_ecu.hpp"

namespace graben::memory {
namespace {

struct Excavator {
  using Setup = ExcavatorSetup;
  using Inputs = ExcavatorInputs;
  using Outputs = ExcavatorOutputs;
  using Controller = ExcavatorController;
  using Receiver = ExcavatorReceiver;
  using Transmitter = ExcavatorTransmitter;
  [[nodiscard]] static BusParts parts(const Setup& setup) { return {setup.profile.has_swing()}; }
};

}  // namespace

void run_image() { run<Excavator>(held_setup<ExcavatorSetup>()); }

}  // namespace graben::memory
