// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Outputs to the frames of a bus that a table describes.
///
/// Without enable, and if any duty is not finite, every duty is sent as 0 and enable as 0. A value
/// beyond what its bits can say is saturated. A message with enable goes out at once where that
/// changes, beside its period. Where the pilot pressure is to be cut and no signal says so,
/// neutral is sent for 100 ms, then nothing any more: the machine's own time-outs cut it.

#include <array>
#include <cstddef>

#include "firmware/excavator/excavator_signals.hpp"
#include "hal/buses/bus_table.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben {

class TableTransmitter {
 public:
  static constexpr std::size_t kMostFrames = kMostTableSent + 1;  ///< With a node's start.
  using Frames = std::array<CanFrame, kMostFrames>;

  /// Null: there is none. The table outlives it.
  explicit TableTransmitter(const BusTable* table) : table_(table) {}

  [[nodiscard]] bool active() const { return table_ != nullptr; }
  static constexpr int kNeutralCycles = 10;

  /// The next frames begin with this node's start (CiA 301, NMT), if it is one.
  void start_node(const NodeStart& start) { start_ = start; }

  /// Writes the frames due at `now`; returns how many. To be called every 10 ms.
  [[nodiscard]] std::size_t frames(const ExcavatorOutputs& outputs, TimeUs now, Frames& out);
  /// The next frame of each command, due or not; nothing is remembered of them.
  [[nodiscard]] std::size_t next_commands(const ExcavatorOutputs& outputs, TimeUs now,
                                          Frames& out) const;
  [[nodiscard]] bool is_command(std::uint32_t id) const;

 private:
  [[nodiscard]] CanFrame frame_of(std::size_t message, const ExcavatorOutputs& outputs, TimeUs now,
                                  SendState& state) const;
  [[nodiscard]] bool falls_silent(const ExcavatorOutputs& outputs);

  const BusTable* table_;
  bool started_ = false;
  bool enabled_ = false;  ///< As it was sent last.
  NodeStart start_;
  int cut_cycles_ = 0;  ///< For so many a cut has been due.
  std::array<SendState, kMostTableSent> state_{};
};

}  // namespace graben
