#pragma once
/// From a duty to a spool's travel and what it opens: dead time, pilot valve, spool.

#include <cstddef>
#include <optional>
#include <vector>

namespace graben::plant {

/// A pure delay of a signal that is given once a step.
class DeadTime {
 public:
  /// Rounded to whole steps.
  DeadTime(double dead_time_s, double step_s);

  /// Takes this step's value, gives that of `dead_time_s` ago; 0 before.
  double step(double value);

 private:
  std::vector<double> past_;
  std::size_t next_ = 0;
};

/// What sends a spool where its duty asks, and what can be wrong with it.
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

/// A spool's lag and its openings.
struct SpoolDynamics {
  double time_constant_s = 0.0;  ///< 1 / natural frequency.
  double damping = 1.0;
  double extend_deadband_ratio = 0.0;  ///< Of the full travel, on the side that extends.
  double retract_deadband_ratio = 0.0;
  double opening_exponent = 1.0;
  /// Travel, in units of the full travel, over which the bypass goes from open to closed; it ends
  /// at that side's edge of the deadband, where the metering edges begin to open: so (20), with the
  /// deadband collapsed, holds wherever the cylinder can move. (20) itself switches; a land edge
  /// takes some way. Wider than a deadband, it would leave the bypass partly closed at neutral.
  double bypass_closing_travel = 1.0;
};

/// Second-order lag from duty to travel with mechanical limits at full travel (Kim 5). Travel is in
/// units of the full travel x_m, -1 .. 1, positive extends the cylinder. Integrated by the
/// trapezoidal rule, stable at any step.
class Spool {
 public:
  explicit Spool(const SpoolDynamics& dynamics);

  void set_command(double travel_ratio);
  /// Returns whether the spool moved.
  bool step(double step_s);

  [[nodiscard]] double travel_ratio() const { return travel_; }
  /// Share of the full metering areas that is open, 0 within the deadband.
  [[nodiscard]] double area_ratio() const { return area_ratio_; }
  /// How far the bypass has closed: 0 at neutral, 1 from the deadband's edge on.
  [[nodiscard]] double bypass_closed_ratio() const { return bypass_closed_; }

 private:
  void update_openings();

  double natural_frequency_radps_;
  double damping_;
  double extend_deadband_;
  double retract_deadband_;
  double exponent_;
  double bypass_closing_;
  double command_ = 0.0;
  double travel_ = 0.0;
  double speed_ps_ = 0.0;
  double area_ratio_ = 0.0;
  double bypass_closed_ = 0.0;
};

}  // namespace graben::plant
