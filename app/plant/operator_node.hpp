#pragma once
/// The simulated operator on the bus: deadman, mode, task, speed override.

#include <cstdint>
#include <utility>
#include <vector>

#include "app/plant/frame_sender.hpp"
#include "firmware/core/time.hpp"
#include "firmware/signals/excavator_signals.hpp"
#include "hal/can_port.hpp"

namespace graben::plant {

struct OperatorRequest {
  bool enable = false;
  OperatorMode mode = OperatorMode::kManual;
  Task task = Task::kNone;
  double speed_override_ratio = 0.0;
};

/// From `from_us` on the operator asks for this.
struct OperatorPhase {
  TimeUs from_us = 0;
  OperatorRequest request;
};

/// Sends OperatorCommand every 20 ms. Before the first phase the request is the default: nothing.
/// The bus port belongs to the caller, who opens it; what it receives is thrown away.
class OperatorNode {
 public:
  explicit OperatorNode(CanPort& port) : port_(port), sender_(port) {}

  /// Phases in the order of their times.
  void set_schedule(std::vector<OperatorPhase> schedule) { schedule_ = std::move(schedule); }

  /// To be called every 10 ms; sends in the first and every second call.
  void step(TimeUs now);

  [[nodiscard]] OperatorRequest request_at(TimeUs now) const;
  void set_silent(bool silent);

 private:
  CanPort& port_;
  FrameSender sender_;
  PlantFaults faults_;
  std::vector<OperatorPhase> schedule_;
  std::uint64_t cycle_ = 0;
};

}  // namespace graben::plant
