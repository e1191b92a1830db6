// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The operator of a simulation: enables when the controller is ready, then gives the task.

#include "app/plant/operator_node.hpp"
#include "firmware/core/codes.hpp"
#include "firmware/core/time.hpp"

namespace graben::scope {

/// Knows nothing of the controller but what its status frame says.
class SimOperator {
 public:
  static constexpr TimeUs kLetsGoFor_us = 200 * kMillisecondUs;
  static constexpr TimeUs kTaskAfter_us = 100 * kMillisecondUs;

  explicit SimOperator(Task task) : task_(task) {}

  /// Lets go, and works from then on: enables once the controller has been ready, 0.2 s from now at
  /// the earliest, and gives the task 0.1 s later. What does not arm is let go and tried again.
  void work(TimeUs now_us);
  /// Lets go.
  void rest() { phase_ = Phase::kResting; }
  /// Share of the task's speed, taken at once.
  void set_speed(double ratio) { speed_ratio_ = ratio; }
  [[nodiscard]] double speed() const { return speed_ratio_; }
  [[nodiscard]] bool works() const { return phase_ != Phase::kResting; }
  /// Armed or Active, as he heard last.
  [[nodiscard]] bool is_under_way() const {
    return phase_ == Phase::kWorking && (heard_ == EcuMode::kArmed || heard_ == EcuMode::kActive);
  }

  void hear(EcuMode mode, TimeUs now_us);
  /// What he asks for in this cycle.
  [[nodiscard]] plant::OperatorRequest request(TimeUs now_us);

 private:
  enum class Phase { kResting, kWaiting, kEnabling, kWorking };

  void go_on(TimeUs now_us);
  [[nodiscard]] bool hears(EcuMode mode, TimeUs now_us) const;

  Task task_;
  double speed_ratio_ = 1.0;
  Phase phase_ = Phase::kResting;
  TimeUs since_us_ = 0;  ///< Of the phase.
  EcuMode heard_ = EcuMode::kSilent;
  TimeUs heard_us_ = 0;
};

}  // namespace graben::scope
