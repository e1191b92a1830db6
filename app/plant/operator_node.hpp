#pragma once
/// The simulated operator on the bus: deadman, mode, task, speed override.

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/plant/command_link.hpp"
#include "app/plant/frame_sender.hpp"
#include "firmware/core/time.hpp"
#include "firmware/signals/machine_signals.hpp"
#include "hal/can_port.hpp"
#include "hal/link/stamp_echo.hpp"

namespace graben::plant {

struct OperatorRequest {
  bool enable = false;
  OperatorMode mode = OperatorMode::kManual;
  Task task = Task::kNone;
  double speed_override_ratio = 0.0;
  /// Of the task file that Task::kProgram means, where the machine kind has tasks.
  std::uint8_t task_number = 0;
};

/// From `from_us` on the operator asks for this.
struct OperatorPhase {
  TimeUs from_us = 0;
  OperatorRequest request;
};

/// Of one request after the other, the one that holds at a time; before the first the default:
/// nothing.
[[nodiscard]] inline OperatorRequest request_at(const std::vector<OperatorPhase>& schedule,
                                                TimeUs now) {
  OperatorRequest request;
  for (const OperatorPhase& phase : schedule) {
    if (phase.from_us <= now) {
      request = phase.request;
    }
  }
  return request;
}

/// OperatorCommand of a machine kind's DBC; with a task number where the kind reports on tasks.
template <class Dbc>
[[nodiscard]] typename Dbc::OperatorCommand operator_command(const OperatorRequest& request,
                                                             dbc::Count echo);

/// Sends OperatorCommand of the machine kind's DBC every 20 ms. The bus port belongs to the caller,
/// who opens it; of what it receives only EcuIdentity counts, whose stamp is repeated.
template <class Dbc>
class OperatorNode {
 public:
  explicit OperatorNode(CanPort& port) : port_(port), sender_(port, Dbc::kMessages) {}

  /// Phases in the order of their times.
  void set_schedule(std::vector<OperatorPhase> schedule) { schedule_ = std::move(schedule); }

  /// To be called every 10 ms; sends in the first and every second call.
  void step(TimeUs now) {
    constexpr std::uint64_t kSendCycles = Command::kCycleTimeMs / 10;
    receive_frames(port_, [this](const CanFrame& frame) { echo_.hear(frame); });
    if (cycle_++ % kSendCycles == 0) {
      sender_.send(operator_command<Dbc>(request_at(now), echo_.said()), faults_, now);
    }
    sender_.send_late(faults_, now);
  }

  [[nodiscard]] OperatorRequest request_at(TimeUs now) const {
    return plant::request_at(schedule_, now);
  }
  void set_silent(bool silent) { faults_.set_silent(Command::kId, silent); }
  [[nodiscard]] FrameFaults& faults() { return faults_; }
  /// An old station knows nothing of stamps.
  void set_mute(bool mute) { echo_.set_mute(mute); }

 private:
  using Command = typename Dbc::OperatorCommand;

  CanPort& port_;
  FrameSender sender_;
  FrameFaults faults_;
  StampEcho<typename Dbc::EcuIdentity> echo_;
  std::vector<OperatorPhase> schedule_;
  std::uint64_t cycle_ = 0;
};

namespace detail {

template <class Dbc, class = void>
inline constexpr bool kHasTasks = false;
template <class Dbc>
inline constexpr bool kHasTasks<Dbc, std::void_t<typename Dbc::TaskStatus>> = true;

}  // namespace detail

template <class Dbc>
typename Dbc::OperatorCommand operator_command(const OperatorRequest& request, dbc::Count echo) {
  using Command = typename Dbc::OperatorCommand;
  constexpr auto kValid = dbc::RawState::kValid;
  using Enable = typename Command::Enable;
  Command command;
  command.enable = {request.enable ? Enable::kOn : Enable::kOff, kValid};
  command.operator_mode = {static_cast<typename Command::OperatorMode>(request.mode), kValid};
  command.task = {static_cast<typename Command::Task>(request.task), kValid};
  command.speed_override_ratio = {request.speed_override_ratio, kValid};
  command.task_number = {request.task_number,
                         detail::kHasTasks<Dbc> ? kValid : dbc::RawState::kNotAvailable};
  command.echo = echo;
  return command;
}

}  // namespace graben::plant
