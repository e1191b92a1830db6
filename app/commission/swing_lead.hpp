// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The swing's steps of a commissioning: duties on its spool while the links rest, within a sector
/// that is kept here. A platform is heavy: it is told to stop in time for what it still turns.
/// Pure, as CommissionSequence.

#include <array>
#include <cstddef>
#include <vector>

#include "app/commission/commission_plan.hpp"

namespace graben::commission {

/// What the bus says of the swing in a cycle.
struct SwingSeen {
  double angle_rad = 0.0;
  double sent_ratio = 0.0;  ///< Its duty as the controller sent it last.
};

class SwingLead {
 public:
  /// `brakes_radps2`: what surely stops the platform once its spool is closed.
  SwingLead(const Sector& sector, double brakes_radps2);

  /// A step, from its beginning.
  void begin(const SequenceStep& step);
  /// Every 10 ms from then on; true once the step is over and the platform stands.
  [[nodiscard]] bool step(const SwingSeen& seen);
  /// What an earlier run has found.
  void know(const SequenceStep& step, const StepResult& result);

  [[nodiscard]] double duty() const { return duty_; }
  [[nodiscard]] const StepResult& result() const { return result_; }

 private:
  enum class Phase { kWait, kGo, kRun, kRest };
  static constexpr std::size_t kHistory = 16;
  struct Driven {
    double duty = 0.0;
    double speed_radps = 0.0;
  };
  struct Side {
    double edge = 0.0;           ///< Duty at which it moved; 0: not known.
    std::vector<Driven> driven;  ///< By rising duty.
  };

  void observe(double angle_rad);
  void to_phase(Phase phase);
  void wait();
  void go();
  void run();
  void run_ramp(double along_radps);
  void run_step(double along_radps);
  void finish(StepEnd end);
  [[nodiscard]] double room_rad(int sign) const;
  [[nodiscard]] double speed_radps(std::size_t from = 0) const;
  [[nodiscard]] double stops_in_rad(int sign) const;
  [[nodiscard]] double duty_for(int sign, double speed_radps) const;
  [[nodiscard]] double start_rad() const;
  Side& side(int sign) { return side_[sign > 0 ? 0 : 1]; }
  [[nodiscard]] const Side& side(int sign) const { return side_[sign > 0 ? 0 : 1]; }

  Sector sector_;
  double brakes_radps2_;
  std::array<Side, 2> side_;
  SequenceStep step_;
  StepResult result_;
  Phase phase_ = Phase::kWait;
  double phase_s_ = 0.0;
  double duty_ = 0.0;
  double sent_ = 0.0;
  double angle_rad_ = 0.0;
  std::array<double, kHistory> history_rad_{};
  std::size_t seen_ = 0;
  double stands_s_ = 0.0;
  double from_rad_ = 0.0;  ///< Where the run began.
  double target_rad_ = 0.0;
  double ramp_ = 0.0;
  double moves_s_ = 0.0;   ///< For so long in a row a ramp has moved it.
  double moving_s_ = 0.0;  ///< Since it has begun to move.
};

}  // namespace graben::commission
