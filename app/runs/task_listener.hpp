// SPDX-License-Identifier: Apache-2.0
#pragma once
/// TaskStatus of a controller, read beside the machine.

#include <cstdint>
#include <optional>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/core/time.hpp"
#include "hal/can_port.hpp"

namespace graben::runs {

/// The machine's port, whose owner keeps it, with a listener for TaskStatus: all that is received
/// and sent passes through unchanged.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): final, and CanPort deletes nothing.
class TaskListener final : public CanPort {
 public:
  /// A controller that has not spoken for so long is at no task.
  static constexpr TimeUs kHeldFor_us = 100 * kMillisecondUs;

  /// Only what is said of the task with this number counts.
  TaskListener(CanPort& port, std::uint8_t number) : port_(port), number_(number) {}

  /// Before anything is received at this time.
  void begin_cycle(TimeUs now_us) { now_us_ = now_us; }

  /// Number of the step that is being done, from 0; the approach is none.
  [[nodiscard]] std::optional<int> step() const;
  [[nodiscard]] bool is_done() const;

  [[nodiscard]] bool open() override { return port_.open(); }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override;
  [[nodiscard]] bool send(const CanFrame& frame) override { return port_.send(frame); }
  [[nodiscard]] CanPortState state() const override { return port_.state(); }

 private:
  void read(const CanFrame& frame);
  [[nodiscard]] bool is_at_task() const;

  CanPort& port_;
  std::uint32_t number_;
  TimeUs now_us_ = 0;
  TimeUs said_us_ = 0;
  std::optional<dbc::excavator::TaskStatus> said_;
};

}  // namespace graben::runs
