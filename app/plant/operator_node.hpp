#pragma once
/// The simulated operator on the bus: deadman, mode, task, speed override.

#include <cstdint>
#include <utility>
#include <vector>

#include "app/plant/frame_sender.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "firmware/core/time.hpp"
#include "firmware/signals/machine_signals.hpp"
#include "hal/can_port.hpp"

namespace graben::plant {

struct OperatorRequest {
  bool enable = false;
  OperatorMode mode = OperatorMode::kManual;
  Task task = Task::kNone;
  double speed_override_ratio = 0.0;
  std::uint8_t task_number = 0;  ///< Of the task file that Task::kProgram means; of an excavator.
};

/// From `from_us` on the operator asks for this.
struct OperatorPhase {
  TimeUs from_us = 0;
  OperatorRequest request;
};

/// Of one request after the other, the one that holds at a time; before the first the default:
/// nothing.
[[nodiscard]] OperatorRequest request_at(const std::vector<OperatorPhase>& schedule, TimeUs now);

/// Sends OperatorCommand, as the machine kind's DBC has it, every 20 ms. The bus port belongs to
/// the caller, who opens it; what it receives is thrown away.
template <class Command>
class OperatorStation {
 public:
  explicit OperatorStation(CanPort& port);

  /// Phases in the order of their times.
  void set_schedule(std::vector<OperatorPhase> schedule) { schedule_ = std::move(schedule); }

  /// To be called every 10 ms; sends in the first and every second call.
  void step(TimeUs now);

  [[nodiscard]] OperatorRequest request_at(TimeUs now) const {
    return plant::request_at(schedule_, now);
  }
  void set_silent(bool silent) { faults_.set_silent(Command::kId, silent); }

 private:
  CanPort& port_;
  FrameSender sender_;
  NodeFaults faults_;
  std::vector<OperatorPhase> schedule_;
  std::uint64_t cycle_ = 0;
};

using OperatorNode = OperatorStation<dbc::excavator::OperatorCommand>;
using DozerOperatorNode = OperatorStation<dbc::dozer::OperatorCommand>;

}  // namespace graben::plant
