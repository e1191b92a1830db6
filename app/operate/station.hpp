// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From the operator's hands to what is asked for on the bus.

#include <array>
#include <optional>

#include "app/operate/deadman.hpp"
#include "app/operate/hands.hpp"
#include "firmware/core/codes.hpp"
#include "firmware/core/time.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben::operate {

/// What OperatorCommand and OperatorAxes say. The default asks for nothing.
struct Request {
  bool enable = false;
  OperatorMode mode = OperatorMode::kManual;
  Task task = Task::kNone;
  double speed_override_ratio = 0.0;
  Axes axes;
};

struct StationOptions {
  double speed_override_ratio = 0.1;
  /// A deadman that is held counts for so long after the last sign of life of the gamepad.
  TimeUs silent_after_us = 5 * kSecondUs;
};

/// What the station knows of the rest in a cycle.
struct Surroundings {
  Trouble trouble = Trouble::kNone;  ///< Of the bus, the ECU, or this process.
  std::optional<EcuMode> ecu_mode;   ///< As heard last.
};

/// Armed, or active.
[[nodiscard]] bool is_armed(const std::optional<EcuMode>& mode);

/// What the hands' device adds to it: that comes first.
[[nodiscard]] Trouble trouble_with(const Hands& hands, Trouble around, TimeUs silent_after_us);

/// Begins in Manual, with Jog chosen. A task is asked for only once the controller says that it is
/// armed: it arms with none. Another one is chosen only with the deadman released. Levers count
/// only with enable.
class Station {
 public:
  static constexpr double kSpeedStep = 0.1;

  explicit Station(const StationOptions& options = {});

  /// Once a cycle.
  [[nodiscard]] Request step(const Hands& hands, const Surroundings& around);

  [[nodiscard]] Task chosen_task() const { return task_; }
  [[nodiscard]] const Deadman& deadman() const { return deadman_; }

 private:
  StationOptions options_;
  Deadman deadman_;
  OperatorMode mode_ = OperatorMode::kManual;
  Task task_ = Task::kJog;
  double speed_ratio_;
};

}  // namespace graben::operate
