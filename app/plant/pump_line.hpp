// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A swash-plate pump, its line, relief and bypass.

#include <cstddef>

#include "app/plant/swash_regulator.hpp"
#include "app/plant/wave_volume.hpp"
#include "firmware/machine/valve.hpp"

namespace graben::plant {

struct PumpLineData {
  PumpProfile pump;
  Oil oil;
  PortProtection protection;
  double volume_m3 = 0.0;
  double swash_ratio = 1.0;  ///< Of full swash, at the start.
  double step_s = 0.0;
};

/// What one step did at the pump's and the bypass' port of the line, m^3/s and Pa.
struct PumpFlows {
  double delivered_m3ps = 0.0;  ///< After leakage, before the relief.
  double line_in_m3ps = 0.0;    ///< After relief and suction make-up.
  double bypass_m3ps = 0.0;     ///< From the line to tank.
  double pump_port_pa = 0.0;
  double bypass_port_pa = 0.0;
};

/// Delivery at the swash that is set, less leakage, (25), into a compressible line. Each valve
/// section on the pump has two ports of the line: supply and regeneration. Relief and suction
/// make-up sit at the pump. The bypass chain is one orifice from line to tank.
class PumpLine {
 public:
  PumpLine(const PumpLineData& data, std::size_t section_count);

  [[nodiscard]] WavePort supply_port(std::size_t section) const {
    return line_.port(2 + 2 * section);
  }
  [[nodiscard]] WavePort recycle_port(std::size_t section) const {
    return line_.port(3 + 2 * section);
  }
  void set_section_flows(std::size_t section, double supply_out_m3ps, double recycle_in_m3ps);

  /// Composite coefficient of fixed orifices and spool bypasses in a row, from
  /// sum(1 / c^2) over the sections, (21), (22).
  void set_bypass(double inverse_square_of_sections);
  /// Of full swash.
  void set_swash(double swash_ratio);
  [[nodiscard]] const SwashRegulator& regulator() const { return regulator_; }
  /// Moves the swash of a pump that sets it itself, by the load that it feels.
  void regulate(double load_pa);
  /// Share of the rated speed that it is driven at; 0: the engine stands.
  void set_speed_ratio(double speed_ratio) { speed_ratio_ = speed_ratio; }
  /// Solves pump and bypass and ends the step.
  void step();
  /// Starts in the standby that the bypass set before gives.
  void start();

  [[nodiscard]] const WaveVolume& line() const { return line_; }
  [[nodiscard]] double pressure_pa() const { return line_.pressure_pa(); }
  [[nodiscard]] double ideal_flow_m3ps() const { return ideal_flow_; }
  /// That at full swash and rated speed.
  [[nodiscard]] double rated_flow_m3ps() const;
  [[nodiscard]] const PumpFlows& flows() const { return flows_; }
  [[nodiscard]] double swash_ratio() const { return swash_; }

 private:
  [[nodiscard]] double delivery(const WavePort& port) const;
  void start_at_margin();

  WaveVolume line_;
  double volume_;
  PortProtection protection_;
  double displacement_m3prev_ = 0.0;
  double speed_radps_ = 0.0;
  double speed_ratio_ = 1.0;
  double ideal_flow_ = 0.0;
  double leak_linear_;
  double leak_quadratic_;
  double swash_ = 0.0;
  double fixed_inverse_square_;
  double k_bypass_ = 0.0;
  SwashRegulator regulator_;
  PumpFlows flows_;
};

}  // namespace graben::plant
