// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A controller without an operating system: what the main loop of such an ECU calls, and what it
/// asks of its board. Linked with firmware and hal alone, it is what flash, RAM and stack are
/// counted of (report.py).

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>

#include "can_dbc/generated/common_dbc.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/challenge.hpp"
#include "hal/link/message_transmitter.hpp"
#include "tests/memory/setup.hpp"

namespace graben::memory {

/// What the board does.
struct Board {
  /// Waits for the next cycle, every 10 ms; false: there is none, and the loop ends.
  [[nodiscard]] static bool next_cycle(TimeUs& now_us);
  /// The oldest frame that is pending; false without one.
  [[nodiscard]] static bool take(CanFrame& frame);
  static void send(const CanFrame& frame);
  /// Of the bus controller.
  [[nodiscard]] static BusState bus();
};

/// A 500 kbit/s bus brings some 75 of the shortest frames in a cycle. As many more are thrown away:
/// in the next cycle an old frame would be taken for a fresh one.
inline constexpr int kFramesPerCycle = 96;

/// As app/ecu/ecu_node.hpp, but for what a process has: no port that is lost and opened again, no
/// request to end. `Kind` is a machine kind: Setup, Controller, Receiver, Transmitter, Inputs,
/// Outputs, parts(setup).
template <class Kind>
class BareEcu {
 public:
  explicit BareEcu(const HeldSetup<typename Kind::Setup>& held)
      : receiver_(Kind::parts(held.setup)),
        controller_(held.setup),
        transmitter_(Kind::parts(held.setup)) {
    diagnosis_.profile_hash = held.profile_hash;
  }

  /// By itself, so that calls.toml can name it.
  [[gnu::noinline]] void step(TimeUs now_us) {
    receive(now_us);
    inputs_ = receiver_.inputs();
    inputs_.same_machine = receiver_.same_machine(diagnosis_.profile_hash);
    inputs_.link.bus = Board::bus();
    inputs_.link.message_faults = receiver_.message_faults(now_us);
    challenge_.hear(receiver_.echoes(), now_us);
    if (challenge_.is_late(in_motion(outputs_.status.mode))) {
      inputs_.link.message_faults.add(Fault::kStreamLate);
    }
    inputs_.link.cannot_answer = challenge_.cannot_answer();
    inputs_.link.out_of_range = receiver_.take_out_of_range();
    outputs_ = controller_.step(inputs_, now_us);
    diagnosis_.stamp = challenge_.next_stamp();
    diagnosis_.rejected_frames = rejected(receiver_.total());
    send(now_us);
  }

 private:
  using Transmitter = typename Kind::Transmitter;

  void receive(TimeUs now_us) {
    CanFrame frame;
    for (int n = 0; n < kFramesPerCycle && Board::take(frame); ++n) {
      receiver_.accept(frame, now_us);
    }
    receiver_.finish(now_us);
    for (int n = 0; n < kFramesPerCycle && Board::take(frame); ++n) {
    }
  }

  void send(TimeUs now_us) {
    typename Transmitter::Frames frames;
    const int count = transmitter_.frames(outputs_, diagnosis_, now_us, frames);
    for (int n = 0; n < count; ++n) {
      const CanFrame& frame = frames[static_cast<unsigned>(n)];
      Board::send(frame);
      if (frame.id == dbc::common::EcuIdentity::kId) {
        challenge_.sent(now_us);
      }
    }
  }

  typename Kind::Receiver receiver_;
  typename Kind::Controller controller_;
  Transmitter transmitter_;
  Challenge challenge_;
  EcuDiagnosis diagnosis_;
  typename Kind::Inputs inputs_;
  typename Kind::Outputs outputs_;
};

/// The main loop, of the image's kind of machine.
void run_image();

/// The same of any. The ECU lies in static memory, and nobody has to look whether it is there yet.
template <class Kind>
void run(const HeldSetup<typename Kind::Setup>& held) {
  alignas(BareEcu<Kind>) static std::array<std::byte, sizeof(BareEcu<Kind>)> room;
  BareEcu<Kind>& ecu = *new (room.data()) BareEcu<Kind>(held);
  for (TimeUs now_us = 0; Board::next_cycle(now_us);) {
    ecu.step(now_us);
  }
}

}  // namespace graben::memory
