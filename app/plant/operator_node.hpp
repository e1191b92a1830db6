// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The simulated operator on the bus: deadman, mode, task, speed override; levers, duties to try.

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/plant/command_link.hpp"
#include "app/plant/frame_sender.hpp"
#include "firmware/core/time.hpp"
#include "firmware/dozer/dozer_signals.hpp"
#include "firmware/excavator/excavator_signals.hpp"
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

/// What the operator's hands do in the tasks that go by them: Jog, Coordinated, Commission.
struct OperatorHands {
  std::array<double, kDriveCount> lever_ratio{};  ///< -1 .. 1.
  std::array<double, kAxisCount> tried_ratio{};   ///< Duties of Commission, -1 .. 1.
  /// Windows of Commission; without one no frame says anything of the drive.
  std::array<std::optional<StrokeWindow>, kAxisCount> window;
  /// As graben operate: in every second frame the levers are told a little less.
  bool alive = false;
};

/// The same of a dozer's Commission.
struct DozerHands {
  DozerTry tried;
  /// Of lift, tilt and tracks; without one no frame says anything of the drive.
  std::array<std::optional<StrokeWindow>, kTriedCount> window;
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

namespace detail {

template <class Dbc, class = void>
inline constexpr bool kHasTasks = false;
template <class Dbc>
inline constexpr bool kHasTasks<Dbc, std::void_t<typename Dbc::TaskStatus>> = true;

template <class Dbc, class = void>
inline constexpr bool kHasHands = false;
template <class Dbc>
inline constexpr bool kHasHands<Dbc, std::void_t<typename Dbc::OperatorAxes>> = true;

template <class Dbc, class = void>
inline constexpr bool kHasTries = false;
template <class Dbc>
inline constexpr bool kHasTries<Dbc, std::void_t<typename Dbc::DozerTry>> = true;

constexpr dbc::Physical said(double value) { return {value, dbc::RawState::kValid}; }

/// `less`: 3 % of each, a step or some of the message.
template <class Dbc>
auto operator_axes(const OperatorHands& hands, bool less) {
  const double share = less ? 0.97 : 1.0;
  typename Dbc::OperatorAxes axes;
  axes.boom_or_up_ratio = said(share * hands.lever_ratio[0]);
  axes.arm_or_forward_ratio = said(share * hands.lever_ratio[1]);
  axes.bucket_or_attitude_ratio = said(share * hands.lever_ratio[2]);
  axes.swing_ratio = said(share * hands.lever_ratio[3]);
  return axes;
}

template <class Dbc>
auto commission_duty(const OperatorHands& hands) {
  typename Dbc::CommissionDuty duty;
  duty.boom_duty_ratio = said(hands.tried_ratio[0]);
  duty.arm_duty_ratio = said(hands.tried_ratio[1]);
  duty.bucket_duty_ratio = said(hands.tried_ratio[2]);
  return duty;
}

template <class Dbc>
auto commission_window(std::size_t axis, const StrokeWindow& window) {
  typename Dbc::CommissionWindow message;
  message.drive = {static_cast<typename Dbc::CommissionWindow::Drive>(axis), dbc::RawState::kValid};
  message.least_stroke_m = said(window.least_m);
  message.most_stroke_m = said(window.most_m);
  message.most_speed_mps = said(window.most_mps);
  return message;
}

template <class Dbc>
auto dozer_try(const DozerTry& tried) {
  typename Dbc::DozerTry message;
  message.drive = {static_cast<typename Dbc::DozerTry::Drive>(tried.drive), dbc::RawState::kValid};
  message.ratio_ratio = said(tried.ratio);
  message.motor_ratio = said(tried.motor_ratio);
  return message;
}

template <class Dbc>
auto dozer_window(std::size_t drive, const StrokeWindow& window) {
  typename Dbc::DozerWindow message;
  message.drive = {static_cast<typename Dbc::DozerWindow::Drive>(drive), dbc::RawState::kValid};
  message.least_m = said(window.least_m);
  message.most_m = said(window.most_m);
  message.most_speed_mps = said(window.most_mps);
  return message;
}

}  // namespace detail

/// Sends OperatorCommand of the machine kind's DBC every 20 ms; where the kind has them and
/// set_hands(), of a dozer set_tries(), was called, OperatorAxes and CommissionDuty, or DozerTry,
/// as often, and CommissionWindow or DozerWindow every 100 ms, of all drives that have one by
/// turns. The bus port belongs to the caller, who opens it; of what it receives only EcuIdentity
/// counts, whose stamp is repeated.
template <class Dbc>
class OperatorNode {
 public:
  explicit OperatorNode(CanPort& port) : port_(port), sender_(port, Dbc::kMessages) {}

  /// Phases in the order of their times.
  void set_schedule(std::vector<OperatorPhase> schedule) { schedule_ = std::move(schedule); }

  /// From now on, until it is called again; may be called every cycle.
  void set_hands(const OperatorHands& hands) { hands_ = hands; }

  void set_tries(const DozerHands& hands) { tries_ = hands; }

  /// From the next step on, for 1 s: the tool is at the mark.
  void touch_mark() { touch(Touch::Kind::kMark); }
  /// Or at another point.
  void touch(typename Dbc::TouchedPoint::Kind kind) {
    touch_kind_ = kind;
    constexpr std::uint8_t kNumbers = 251;
    touch_number_ = static_cast<std::uint8_t>((touch_number_ + 1) % kNumbers);
    touch_cycles_ = kTouchCycles;
  }

  /// To be called every 10 ms; sends in the first and every second call.
  void step(TimeUs now) {
    constexpr std::uint64_t kSendCycles = Command::kCycleTimeMs / 10;
    receive_frames(port_, [this](const CanFrame& frame) { echo_.hear(frame); });
    if (cycle_ % kSendCycles == 0) {
      sender_.send(operator_command<Dbc>(request_at(now), echo_.said()), faults_, now);
    }
    if constexpr (detail::kHasHands<Dbc>) {
      send_hands(now);
    }
    if constexpr (detail::kHasTries<Dbc>) {
      send_tries(now);
    }
    send_touch(now);
    ++cycle_;
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
  using Touch = typename Dbc::TouchedPoint;
  static constexpr int kTouchCycles = 100;

  void send_touch(TimeUs now) {
    if (touch_cycles_ == 0) {
      return;
    }
    if (touch_cycles_ % static_cast<int>(Touch::kCycleTimeMs / 10) == 0) {
      Touch touch;
      touch.number = {touch_number_, dbc::RawState::kValid};
      touch.kind = {touch_kind_, dbc::RawState::kValid};
      sender_.send(touch, faults_, now);
    }
    --touch_cycles_;
  }

  void send_hands(TimeUs now) {
    if (!hands_) {
      return;
    }
    if (cycle_ % (Dbc::OperatorAxes::kCycleTimeMs / 10) == 0) {
      less_ = hands_->alive && !less_;
      sender_.send(detail::operator_axes<Dbc>(*hands_, less_), faults_, now);
      sender_.send(detail::commission_duty<Dbc>(*hands_), faults_, now);
    }
    if (cycle_ % (Dbc::CommissionWindow::kCycleTimeMs / 10) == 0) {
      send_next_window(now);
    }
  }

  void send_tries(TimeUs now) {
    if (!tries_) {
      return;
    }
    if (cycle_ % (Dbc::DozerTry::kCycleTimeMs / 10) == 0) {
      sender_.send(detail::dozer_try<Dbc>(tries_->tried), faults_, now);
    }
    if (cycle_ % (Dbc::DozerWindow::kCycleTimeMs / 10) == 0) {
      for (std::size_t n = 0; n < kTriedCount; ++n) {
        turn_ = (turn_ + 1) % kTriedCount;
        if (tries_->window[turn_]) {
          sender_.send(detail::dozer_window<Dbc>(turn_, *tries_->window[turn_]), faults_, now);
          return;
        }
      }
    }
  }

  void send_next_window(TimeUs now) {
    for (std::size_t n = 0; n < kAxisCount; ++n) {
      turn_ = (turn_ + 1) % kAxisCount;
      if (hands_->window[turn_]) {
        sender_.send(detail::commission_window<Dbc>(turn_, *hands_->window[turn_]), faults_, now);
        return;
      }
    }
  }

  CanPort& port_;
  FrameSender sender_;
  FrameFaults faults_;
  StampEcho<typename Dbc::EcuIdentity> echo_;
  std::vector<OperatorPhase> schedule_;
  std::optional<OperatorHands> hands_;
  std::optional<DozerHands> tries_;
  std::size_t turn_ = kAxisCount - 1;  ///< Whose window was sent last.
  bool less_ = false;                  ///< The last levers were told so.
  typename Dbc::TouchedPoint::Kind touch_kind_ = {};
  std::uint8_t touch_number_ = 0;
  int touch_cycles_ = 0;  ///< Left of the one that is said.
  std::uint64_t cycle_ = 0;
};

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
