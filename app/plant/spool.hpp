// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From a duty to a spool's travel and what it opens: dead time, pilot valves, spool.

#include <algorithm>
#include <cmath>
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

/// From a duty to the spool's first movement, on the side that the duty asks for.
struct SideDelay {
  SideDelay() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): most valves are as late on both sides.
  SideDelay(double both_s) : extend_s(both_s), retract_s(both_s) {}
  SideDelay(double extend, double retract) : extend_s(extend), retract_s(retract) {}

  double extend_s = 0.0;
  double retract_s = 0.0;
};

/// What sends a spool where its duty asks, and what can be wrong with it. A pilot on either end
/// presses the spool to its side, each with a dead time of its own, and the spool is sent by their
/// difference; behind them the pilot pressure lags in first order.
class PilotValve {
 public:
  PilotValve(const SideDelay& dead_time, double lag_s, double step_s)
      : extend_(dead_time.extend_s, step_s),
        retract_(dead_time.retract_s, step_s),
        lag_share_(lag_s > 0.0 ? -std::expm1(-step_s / lag_s) : 1.0) {}

  /// Sends its spool to `held_ratio` whatever the duty, or `offset_ratio` beyond what it asks for.
  void set_fault(std::optional<double> held_ratio, double offset_ratio) {
    held_ratio_ = held_ratio;
    offset_ratio_ = offset_ratio;
  }

  /// Takes this step's duty, gives where the spool is sent, of its travel. Without pilot pressure
  /// (`cut`) the spool centres by its springs, with neither dead time nor lag, whatever the pilot
  /// valves do.
  double step(double duty_ratio, bool cut) {
    const double wanted =
        extend_.step(std::max(0.0, duty_ratio)) + retract_.step(std::min(0.0, duty_ratio));
    if (cut) {
      pressure_ratio_ = 0.0;
      return 0.0;
    }
    follow(wanted);
    return held_ratio_ ? *held_ratio_ : pressure_ratio_ + offset_ratio_;
  }

 private:
  /// Closer than this the lag has arrived, so that a spool comes to rest.
  static constexpr double kArrived = 1e-9;

  void follow(double wanted) {
    const double missing = wanted - pressure_ratio_;
    const bool arrives = lag_share_ == 1.0 || std::abs(missing) < kArrived;
    pressure_ratio_ = arrives ? wanted : pressure_ratio_ + lag_share_ * missing;
  }

  DeadTime extend_;
  DeadTime retract_;
  double lag_share_;  ///< Of what is missing, in a step.
  double pressure_ratio_ = 0.0;
  std::optional<double> held_ratio_;
  double offset_ratio_ = 0.0;
};

/// One side of a spool: how its metering edges open. Ratios are of the full travel.
struct SpoolSide {
  double deadband_ratio = 0.0;  ///< Its edge: where a sharp one would begin to open.
  /// Over so much of the travel, half of it before the edge and half behind, the way out of the
  /// deadband grows from nothing by a parabola instead of a corner; behind, it is as of a sharp
  /// edge. 0: sharp. At most twice the deadband, and twice what lies behind it.
  double softness_ratio = 0.0;
  double opening_exponent = 1.0;  ///< Area over the way out of the deadband, both of their full.

  /// Where it begins to open.
  [[nodiscard]] double start_ratio() const { return deadband_ratio - 0.5 * softness_ratio; }
  /// Share of the full metering areas that is open at this travel towards the side.
  [[nodiscard]] double area_ratio(double travel_ratio) const {
    const double way = way_out(travel_ratio - deadband_ratio) / (1.0 - deadband_ratio);
    return way > 0.0 ? std::pow(way, opening_exponent) : 0.0;
  }

 private:
  [[nodiscard]] double way_out(double beyond_edge) const {
    const double half = 0.5 * softness_ratio;
    if (std::abs(beyond_edge) >= half) {
      return std::max(0.0, beyond_edge);
    }
    return (beyond_edge + half) * (beyond_edge + half) / (4.0 * half);
  }
};

/// A spool's lag and its openings.
struct SpoolDynamics {
  double time_constant_s = 0.0;  ///< 1 / natural frequency.
  double damping = 1.0;
  SpoolSide extend;
  SpoolSide retract;
  /// Travel, in units of the full travel, over which the bypass goes from open to closed; it ends
  /// where that side's metering edges begin to open: so (20), with the deadband collapsed, holds
  /// wherever the cylinder can move. (20) itself switches; a land edge takes some way. Wider than
  /// what lies before that, it would leave the bypass partly closed at neutral.
  double bypass_closing_travel = 1.0;
  /// Share of the way from where the edges begin to open to full travel at which the bypass is
  /// closed instead, evenly; 0: as above.
  double bypass_closes_at = 0.0;
  /// 1 / natural frequency while it is sent nearer to neutral, or past it; 0: as on the way out.
  double closing_time_constant_s = 0.0;
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
  /// How far the bypass has closed: 0 at neutral, 1 from where the metering edges begin to open or
  /// from `bypass_closes_at`.
  [[nodiscard]] double bypass_closed_ratio() const { return bypass_closed_; }

 private:
  void update_openings();

  double opens_radps_;   ///< Natural frequency on the way out ...
  double closes_radps_;  ///< ... and on the way home.
  double damping_;
  SpoolSide extend_;
  SpoolSide retract_;
  double bypass_closing_;
  double bypass_closes_at_;
  double command_ = 0.0;
  double travel_ = 0.0;
  double speed_ps_ = 0.0;
  double area_ratio_ = 0.0;
  double bypass_closed_ = 0.0;
};

}  // namespace graben::plant
