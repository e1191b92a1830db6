// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A controller as a node on a bus: receive, step, send. What is deployed and what is simulated run
/// this same cycle.

#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "app/ecu/last_frames.hpp"
#include "can_dbc/generated/common_dbc.hpp"
#include "firmware/core/time.hpp"
#include "firmware/safety/mode.hpp"
#include "firmware/signals/machine_signals.hpp"
#include "hal/buses/bus_table.hpp"
#include "hal/can_port.hpp"
#include "hal/link/challenge.hpp"
#include "hal/link/message_links.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben::ecu {

/// A cycle takes up to two batches, as many frames of 8 bytes as a full 500 kbit/s bus brings in
/// the 50 ms after which it counts as stalled, and throws away up to two more, the capacity of any
/// queue of ours: what waited for the next cycle would be an old frame taken for a fresh one. The
/// messages' counters tell of what is thrown away.
inline constexpr int kFramesPerBatch = 96;
inline constexpr int kBatchesTaken = 2;
inline constexpr int kBatchesRead = 4;

/// Watches a port through a cycle of 10 ms: begin, the port is read, judge, frames are sent, end.
/// A port that is off the bus or down is opened again at most every 200 ms, and that discards what
/// is queued; every such state is seen for one cycle at least. The caller owns the port.
class BusWatch {
 public:
  explicit BusWatch(CanPort& port) : port_(port) {}

  /// True if what is queued is not fresh: it waited through a stall or a lost bus.
  [[nodiscard]] bool begin(TimeUs now_us);
  [[nodiscard]] BusState judge(TimeUs now_us);
  /// May wait for the kernel: what has to be sent must not wait for it.
  void end(TimeUs now_us);

 private:
  CanPort& port_;
  BusState before_ = BusState::kDown;  ///< Before the port was read.
  BusState bus_ = BusState::kDown;
  bool needs_open_ = false;  ///< It was off the bus and has not been opened since.
  TimeUs open_from_us_ = 0;  ///< Not to be opened again before.
  bool stalled_ = false;
  TimeUs last_us_ = 0;
  bool has_begun_ = false;
};

/// One controller on one port. The caller owns the port and the clock.
///
/// `Kind` is a machine kind, as app/ecu/excavator_kind.hpp is one:
///   Setup, Inputs, Outputs, Controller   of firmware;
///   Receiver, Transmitter                of hal;
///   parts(setup)                         what its bus has beyond every machine of its kind;
///   is_command(id)                       true where losing this frame leaves the machine without
///                                        its command;
///   Learnt                               what the controller has learnt of the machine, empty
///                                        where that is nothing: else learnt() and begin() of it;
///   MemoryAccess                         of the tests.
/// What is built around the node needs more: Dbc, the bus's messages; Ecu, the node's own type;
/// Profile, Machine and kHasTasks, to make a setup from files; kName, `kind` in a profile.
template <class Kind>
class EcuNode {
 public:
  using Setup = typename Kind::Setup;
  using Inputs = typename Kind::Inputs;
  using Outputs = typename Kind::Outputs;
  using Receiver = typename Kind::Receiver;

  /// `table` is that of another bus than ours; null or empty: none. It outlives the node.
  EcuNode(const Setup& setup, std::uint32_t profile_hash, CanPort& port,
          const BusTable* table = nullptr)
      : port_(port),
        watch_(port),
        setup_(setup),
        receiver_(with_table(Kind::parts(setup_), table)),
        controller_(setup_),
        transmitter_(with_table(Kind::parts(setup_), table)) {
    diagnosis_.profile_hash = profile_hash;
  }
  /// The controller refers to the node's own setup.
  EcuNode(const EcuNode&) = delete;
  EcuNode& operator=(const EcuNode&) = delete;

  /// One cycle at `now_us`, to be called every 10 ms. After a stall what is queued is discarded: an
  /// old frame must not be taken for a fresh one. `last_cycle_us` is how long the cycle before
  /// took, for the status frame; 0 where time is simulated. A port that is lost is opened again as
  /// BusWatch has it.
  void step(TimeUs now_us, TimeUs last_cycle_us);

  /// What the controller has learnt of the machine, and to begin with that of another run, before
  /// the first step; false if it is not sound.
  [[nodiscard]] typename Kind::Learnt learnt() const {
    if constexpr (std::is_empty_v<typename Kind::Learnt>) {
      return {};
    } else {
      return controller_.learnt();
    }
  }
  [[nodiscard]] bool begin([[maybe_unused]] const typename Kind::Learnt& learnt) {
    if constexpr (std::is_empty_v<typename Kind::Learnt>) {
      return false;
    } else {
      return controller_.begin(learnt);
    }
  }
  /// Of a kind with tasks: the machine is not where their file has it, and to begin so.
  [[nodiscard]] bool site_is_left() const {
    if constexpr (Kind::kHasTasks) {
      return controller_.site_is_left();
    } else {
      return false;
    }
  }
  void begin_left_site() {
    if constexpr (Kind::kHasTasks) {
      controller_.begin_left_site();
    }
  }

  /// From the next cycle on the controller is told to end.
  void request_stop() { stop_requested_ = true; }
  /// For the status frames.
  void set_process_health(const ProcessHealth& health) { diagnosis_.process = health; }

  /// Where each cycle leaves the neutral commands that would come after its own; the caller's, who
  /// keeps it as long as the node.
  void set_last_frames(LastFrames& last) { last_ = &last; }

  [[nodiscard]] const Outputs& outputs() const { return outputs_; }
  [[nodiscard]] const Inputs& inputs() const { return inputs_; }
  [[nodiscard]] const LinkCounters& link() const { return receiver_.total(); }
  [[nodiscard]] NodeEmergency emergency() const { return receiver_.emergency(); }
  /// Frames that the port did not take; none of them is sent again.
  [[nodiscard]] std::uint32_t dropped() const { return diagnosis_.dropped_frames; }

 private:
  using Transmitter = typename Kind::Transmitter;

  /// Lets tests flip a bit of what the controller stores.
  friend typename Kind::MemoryAccess;

  void receive(TimeUs now_us, bool stale);
  void gather_inputs(TimeUs now_us, BusState bus);
  void leave_last_frames(TimeUs now_us);
  void send(const typename Transmitter::Frames& frames, int count);
  void count_cycle(bool command_sent);

  CanPort& port_;
  BusWatch watch_;
  Setup setup_;
  Receiver receiver_;
  typename Kind::Controller controller_;
  Transmitter transmitter_;
  Challenge challenge_;
  EcuDiagnosis diagnosis_;
  std::array<CanFrame, kFramesPerBatch> frames_{};  ///< Of one batch.
  Inputs inputs_;
  Outputs outputs_;
  LastFrames* last_ = nullptr;
  int dropped_cycles_ = 0;
  bool stop_requested_ = false;
};

template <class Kind>
void EcuNode<Kind>::receive(TimeUs now_us, bool stale) {
  for (int batch = 0; batch < kBatchesRead; ++batch) {
    const int count = port_.receive(frames_.data(), kFramesPerBatch);
    for (int i = 0; i < count && !stale && batch < kBatchesTaken; ++i) {
      receiver_.accept(frames_[static_cast<unsigned>(i)], now_us);
    }
    if (count < kFramesPerBatch) {
      break;
    }
  }
  receiver_.finish(now_us);
}

template <class Kind>
void EcuNode<Kind>::gather_inputs(TimeUs now_us, BusState bus) {
  inputs_ = receiver_.inputs();
  inputs_.same_machine = receiver_.same_machine(diagnosis_.profile_hash);
  inputs_.link.bus = bus;
  inputs_.link.message_faults = receiver_.message_faults(now_us);
  challenge_.hear(receiver_.echoes(), now_us);
  if (challenge_.is_late(in_motion(outputs_.status.mode))) {
    inputs_.link.message_faults.add(Fault::kStreamLate);
  }
  inputs_.link.cannot_answer = challenge_.cannot_answer();
  inputs_.link.out_of_range = receiver_.take_out_of_range();
  inputs_.link.dropped_cycles = dropped_cycles_;
  inputs_.link.stop_requested = stop_requested_;
}

template <class Kind>
void EcuNode<Kind>::leave_last_frames(TimeUs now_us) {
  if (last_ == nullptr) {
    return;
  }
  Outputs neutral;
  // What holds the pilot pressure off must not be undone by the end of the process.
  neutral.pilot_cut = outputs_.pilot_cut;
  neutral.pilot_known = outputs_.pilot_known;
  typename Transmitter::Frames frames;
  const int count = transmitter_.next_frames(neutral, &Kind::is_command, now_us, frames);
  last_->put(frames, static_cast<std::size_t>(count));
}

template <class Kind>
void EcuNode<Kind>::send(const typename Transmitter::Frames& frames, int count) {
  bool has_command = false;
  bool all_taken = true;
  for (int i = 0; i < count; ++i) {
    const CanFrame& frame = frames[static_cast<unsigned>(i)];
    const bool taken = port_.send(frame);
    diagnosis_.dropped_frames += taken ? 0U : 1U;
    if (taken && frame.id == dbc::common::EcuIdentity::kId) {
      challenge_.sent(frame.stamp_us);
    }
    if (Kind::is_command(frame.id) || transmitter_.is_table_command(frame.id)) {
      has_command = true;
      all_taken = all_taken && taken;
    }
  }
  if (has_command) {
    count_cycle(all_taken);
  }
}

template <class Kind>
void EcuNode<Kind>::count_cycle(bool command_sent) {
  const bool at_end = dropped_cycles_ == std::numeric_limits<int>::max();
  dropped_cycles_ = command_sent ? 0 : dropped_cycles_ + (at_end ? 0 : 1);
}

template <class Kind>
void EcuNode<Kind>::step(TimeUs now_us, TimeUs last_cycle_us) {
  // What is not fresh is thrown away; the controller has stopped then anyway.
  receive(now_us, watch_.begin(now_us));
  gather_inputs(now_us, watch_.judge(now_us));
  outputs_ = controller_.step(inputs_, now_us);
  diagnosis_.cycle_time_us = last_cycle_us;
  diagnosis_.stamp = challenge_.next_stamp();
  diagnosis_.rejected_frames = rejected(receiver_.total());
  transmitter_.start_node(receiver_.take_start(now_us));
  typename Transmitter::Frames frames;
  const int count = transmitter_.frames(outputs_, diagnosis_, now_us, frames);
  leave_last_frames(now_us);
  send(frames, count);
  watch_.end(now_us);
}

}  // namespace graben::ecu
