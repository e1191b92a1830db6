// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The two equations of valve_fit.hpp at one steady point.

#include "app/identify/machine/estimate.hpp"
#include "app/identify/machine/steady_points.hpp"
#include "firmware/mcv/circuit.hpp"

namespace graben::identify {

/// What both equations ask of a side, a drive and a pump.
struct ValveTry {
  OpeningCurve curve;
  double coefficient_factor = 1.0;  ///< With load sensing, of the feeding area instead.
  double out_area_factor = 1.0;
  double cap_zero_pa = 0.0;
  double rod_zero_pa = 0.0;
  double pump_flow_factor = 1.0;
  // With negative flow, of the profile's.
  double closes_at_factor = 1.0;
  double felt_factor = 1.0;  ///< Of both pressures.
};

struct SpeedError {
  double error_mps = 0.0;
  double per_force_mpspn = 0.0;  ///< What a force of 1 N changes of it.
};

/// A point with its circuit, prepared once.
class PreparedPoint {
 public:
  /// `drives` have the pressure zeros as far as they are known by then.
  PreparedPoint(const DriveModel& model, const SteadyPoint& point, const DriveEstimates& drives);

  [[nodiscard]] const SteadyPoint& point() const { return point_; }
  [[nodiscard]] bool extends() const { return point_.spool > 0.0; }
  /// Where its side's edge is, were `travel` the first that moves it: with negative flow a load is
  /// not moved before the bypass is so far closed.
  [[nodiscard]] double edge_before(double travel) const;
  [[nodiscard]] int pump() const { return pump_; }
  [[nodiscard]] double fed_area_m2() const { return axis_.inlet_area_m2; }
  /// Speed along its side, of the model less measured; to first order that of a model that moves at
  /// its own speed, not the measured one.
  [[nodiscard]] SpeedError speed_error(const ValveTry& tried) const;
  /// The same by the draining side.
  [[nodiscard]] double out_error_mps(const ValveTry& tried) const;
  /// What its speed says its velocity coefficient is, of the profile's at full opening, with load
  /// sensing its feeding area; below 0 where nothing feeds it or too little force is left to say
  /// so.
  [[nodiscard]] double coefficient_share(const ValveTry& tried) const;
  /// The pump feeds it: without pressure there its load drives it, and oil comes from the tank.
  [[nodiscard]] bool is_fed() const { return fed_; }
  /// Its speed says something of what feeds it. What a margin meters comes even where its load
  /// takes more: then the speed is the most of it, and an error below 0 is none.
  [[nodiscard]] bool says_speed() const { return fed_ || bounds_; }
  /// The draining side says something: it has pressure, and no gallery decides.
  [[nodiscard]] bool drains() const { return drains_; }

 private:
  /// The fed oil: what goes into its pressure moves nothing.
  [[nodiscard]] bool is_at_rest() const;
  void sense_loads(const DriveModel& model, const DriveEstimates& drives);
  /// With load sensing: what the margin presses through the feeding edge, and the most that the
  /// pump has left for it.
  [[nodiscard]] double metered_mps(const ValveTry& tried, double area_ratio) const;
  [[nodiscard]] double most_mps(const ValveTry& tried) const;
  [[nodiscard]] FlowBalance line_at(double flow_factor, double speed_mps) const;
  /// Of the line, with its own closed so far behind its start.
  [[nodiscard]] double bypass_with(double behind_start, double closes_at) const;
  /// Speed at which v = c_L sqrt(F(v)); looked for about `near_mps`.
  [[nodiscard]] double settled_mps(const ValveTry& tried, double coefficient,
                                   double near_mps) const;
  [[nodiscard]] double force_n(const ValveTry& tried, double speed_mps) const;
  [[nodiscard]] double sqrt_line(const ValveTry& tried, double speed_mps) const;

  SteadyPoint point_;
  CircuitAxis axis_;    ///< At 1 m/s: flows are those of the speed.
  FlowBalance others_;  ///< The line of its pump, without itself.
  int pump_ = 0;
  double full_mps_ = 0.0;  ///< c_L at full opening, m/(s sqrt(N)).
  double out_m3ps_ = 0.0;  ///< C_d A_out sqrt(2 / rho) at full opening, m^3/(s sqrt(Pa)).
  double cap_m2_ = 0.0;
  double rod_m2_ = 0.0;
  bool fed_ = false;
  bool drains_ = false;
  // With load sensing.
  bool senses_load_ = false;
  bool compensated_ = false;
  bool bounds_ = false;   ///< Its load takes more than the margin meters.
  double in_m3ps_ = 0.0;  ///< C_d A_in sqrt(2 / rho) at full opening, m^3/(s sqrt(Pa)).
  double margin_pa_ = 0.0;
  bool returns_ = false;  ///< Oil comes back, and with it the pump is not the limit.
  // With negative flow.
  const McvActuator* actuator_ = nullptr;
  double closes_at_ = 0.0;    ///< Share of the travel behind the edge, by the profile.
  double bypass_rest_ = 0.0;  ///< Resistance of the line's bypass without its own.
  double others_pa_ = 0.0;    ///< Heaviest load of the line's others; 0: none moves.
};

/// Share of the travel behind a side's edge at which the profile has its bypass closed.
[[nodiscard]] double closing_share(const DriveModel& model, int axis, bool extends);

/// Velocity coefficient of a side, of the profile's, whose areas are these factors of the
/// profile's.
[[nodiscard]] double coefficient_of(const DriveModel& model, int axis, bool extends,
                                    double in_factor, double out_factor);

/// A steady point as one of its side's curve.
struct CurvePoint {
  int axis = 0;
  bool extends = false;
  double travel = 0.0;  ///< Of the spool, 0 .. 1.
  double share = 0.0;   ///< Velocity coefficient, of the profile's at full opening.
};

/// All that say something, with what was found of pumps and zeros.
[[nodiscard]] std::vector<CurvePoint> curve_points(const DriveModel& model,
                                                   const std::vector<MachineLog>& logs,
                                                   const MachineEstimate& found);

}  // namespace graben::identify
