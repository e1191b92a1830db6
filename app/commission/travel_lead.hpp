// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tracks' steps of a dozer's commissioning: displacements of both pumps, then of both motors,
/// within a way that is kept here too. Pure, as CommissionSequence.

#include <optional>

#include "app/commission/dozer_plan.hpp"

namespace graben::commission {

class TravelLead {
 public:
  explicit TravelLead(const Window& way) : way_(way) {}

  /// How fast the tracks were in a step of an earlier run, as if it had been led here.
  void remember(const TravelStep& step, const StepResult& result);
  /// A step, from its beginning.
  void begin(const TravelStep& step);
  /// Every 10 ms from then on, with the measured position along the track and its rate; true once
  /// the step is over and the machine stands.
  [[nodiscard]] bool step(double position_m, double velocity_mps);

  [[nodiscard]] double pump_ratio() const { return pump_; }
  [[nodiscard]] double motor_ratio() const { return motor_; }
  [[nodiscard]] const StepResult& result() const { return result_; }

 private:
  enum class Phase { kWait, kRun, kRest };

  void observe(double position_m, double velocity_mps);
  void to_phase(Phase phase);
  void run();
  void finish(StepEnd end);
  [[nodiscard]] double room_m() const;
  [[nodiscard]] double level_ratio() const;

  Window way_;
  TravelStep step_;
  StepResult result_;
  Phase phase_ = Phase::kWait;
  double phase_s_ = 0.0;
  double pump_ = 0.0;
  double motor_ = 1.0;
  std::optional<double> from_m_;  ///< Where the machine stood before it was tried.
  double at_m_ = 0.0;
  double speed_mps_ = 0.0;  ///< Low-passed.
  double stands_s_ = 0.0;
  double moving_s_ = 0.0;       ///< Since it has begun to move.
  double most_gain_mps_ = 0.0;  ///< Largest speed for a whole displacement that was seen.
};

}  // namespace graben::commission
