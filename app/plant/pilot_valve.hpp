#pragma once
/// What sends a spool where its duty asks, and what can be wrong with it.

#include <optional>

#include "app/plant/dead_time.hpp"

namespace graben::plant {

class PilotValve {
 public:
  PilotValve(double dead_time_s, double step_s) : dead_time_(dead_time_s, step_s) {}

  /// Sends its spool to `held_ratio` whatever the duty, or `offset_ratio` beyond what it asks for.
  void set_fault(std::optional<double> held_ratio, double offset_ratio) {
    held_ratio_ = held_ratio;
    offset_ratio_ = offset_ratio;
  }

  /// Takes this step's duty, gives where the spool is sent, of its travel. Without pilot pressure
  /// (`cut`) the spool centres by its springs, with no dead time, whatever the pilot valve does.
  double step(double duty_ratio, bool cut) {
    const double delayed = dead_time_.step(duty_ratio);
    if (cut) {
      return 0.0;
    }
    return held_ratio_ ? *held_ratio_ : delayed + offset_ratio_;
  }

 private:
  DeadTime dead_time_;
  std::optional<double> held_ratio_;
  double offset_ratio_ = 0.0;
};

}  // namespace graben::plant
