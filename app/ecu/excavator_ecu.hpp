#pragma once
/// The controller as a node on a bus: receive, step, send. What is deployed and what is simulated
/// run this same cycle.

#include <cstdint>

#include "firmware/excavator_controller.hpp"
#include "hal/can_port.hpp"
#include "hal/excavator_receiver.hpp"
#include "hal/excavator_transmitter.hpp"

namespace graben::ecu {

/// One excavator controller on one port. The caller owns the port and the clock.
class ExcavatorEcu {
 public:
  ExcavatorEcu(const ExcavatorProfile& profile, std::uint32_t profile_hash, CanPort& port);

  /// One cycle at `now_us`, to be called every 10 ms. After a stall what is queued is discarded: an
  /// old frame must not be taken for a fresh one. `last_cycle_us` is how long the cycle before
  /// took, for the status frame; 0 where time is simulated. A port that is off the bus or down is
  /// opened again at most every 200 ms, and that discards what is queued; the controller sees every
  /// such state for one cycle at least.
  void step(TimeUs now_us, TimeUs last_cycle_us);

  /// From the next cycle on the controller is told to end.
  void request_stop() { stop_requested_ = true; }
  /// For the status frames.
  void set_process_health(const ProcessHealth& health) { diagnosis_.process = health; }

  [[nodiscard]] const ExcavatorOutputs& outputs() const { return outputs_; }
  [[nodiscard]] const ExcavatorInputs& inputs() const { return inputs_; }
  [[nodiscard]] const LinkCounters& link() const { return receiver_.total(); }
  /// Frames that the port did not take; none of them is sent again.
  [[nodiscard]] std::uint32_t dropped() const { return diagnosis_.dropped_frames; }

 private:
  /// Lets tests flip a bit of what the controller stores.
  friend struct graben::ControllerMemoryAccess;

  void receive(TimeUs now_us, bool stale);
  [[nodiscard]] bool is_stalled(TimeUs now_us);
  void watch_bus(TimeUs now_us, BusState before);
  void open_again(TimeUs now_us, bool stalled);
  void gather_inputs(TimeUs now_us);
  void send(const ExcavatorTransmitter::Frames& frames, int count);

  CanPort& port_;
  ExcavatorReceiver receiver_;
  ExcavatorController controller_;
  ExcavatorTransmitter transmitter_;
  EcuDiagnosis diagnosis_;
  ExcavatorInputs inputs_;
  ExcavatorOutputs outputs_;
  BusState bus_ = BusState::kDown;
  bool needs_open_ = false;  ///< It was off the bus and has not been opened since.
  TimeUs open_from_us_ = 0;  ///< Not to be opened again before.
  int dropped_cycles_ = 0;
  bool stop_requested_ = false;
  TimeUs last_us_ = 0;
  bool has_stepped_ = false;
};

}  // namespace graben::ecu
