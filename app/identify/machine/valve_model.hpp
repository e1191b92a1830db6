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
  double coefficient_factor = 1.0;
  double out_area_factor = 1.0;
  double cap_zero_pa = 0.0;
  double rod_zero_pa = 0.0;
  double pump_flow_factor = 1.0;
};

struct SpeedError {
  double error_mps = 0.0;
  double per_force_mpspn = 0.0;  ///< What a force of 1 N changes of it.
};

/// A point with its circuit, prepared once.
class PreparedPoint {
 public:
  /// `drive` has the pressure zeros as far as they are known by then.
  PreparedPoint(const DriveModel& model, const SteadyPoint& point, const DriveEstimate& drive);

  [[nodiscard]] const SteadyPoint& point() const { return point_; }
  [[nodiscard]] bool extends() const { return point_.spool > 0.0; }
  [[nodiscard]] int pump() const { return pump_; }
  [[nodiscard]] double fed_area_m2() const { return axis_.inlet_area_m2; }
  /// Speed along its side, of the model less measured; to first order that of a model that moves at
  /// its own speed, not the measured one.
  [[nodiscard]] SpeedError speed_error(const ValveTry& tried) const;
  /// The same by the draining side.
  [[nodiscard]] double out_error_mps(const ValveTry& tried) const;
  /// What its speed says its velocity coefficient is, of the profile's at full opening; below 0
  /// where nothing feeds it or too little force is left to say so.
  [[nodiscard]] double coefficient_share(const ValveTry& tried) const;
  /// The pump feeds it: without pressure there its load drives it, and oil comes from the tank.
  [[nodiscard]] bool is_fed() const { return fed_; }
  /// The draining side says something: it has pressure, and no gallery decides.
  [[nodiscard]] bool drains() const { return drains_; }

 private:
  [[nodiscard]] double force_n(const ValveTry& tried, double speed_mps) const;
  [[nodiscard]] double sqrt_line(double flow_factor, double speed_mps) const;

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
};

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
