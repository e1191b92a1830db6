// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A pump's own regulator, which sets its swash by what it feels: load sensing or negative flow.

#include "firmware/machine/valve.hpp"

namespace graben::plant {

/// What a regulator feels, Pa above ambient and m^3/s.
struct Felt {
  double line_pa = 0.0;
  double load_pa = 0.0;  ///< Of the heaviest open section, behind its metering edge.
  double bypass_m3ps = 0.0;
};

/// The line that it is built for.
struct RegulatedLine {
  double full_flow_m3ps = 0.0;
  double stiffness_papm3 = 0.0;  ///< Bulk modulus over volume.
  double tank_orifice = 0.0;     ///< Flow coefficient of the bypass' last orifice.
  double relief_pa = 0.0;
};

/// Load sensing: from the line's pressure, which is to be the margin above the load or at most just
/// under the relief's, a part in proportion and an integral. A whole margin that is missing makes
/// the integral go through a whole stroke in `response`, and the part in proportion damps the line.
/// Makers damp theirs by orifices and by the unloading valve, which sheds what lifts the line more
/// than 1 MPa above that.
/// Negative flow: a first-order lag of a third of `response` behind the falling line between both
/// pressures. Neither is faster than a whole stroke in `response`.
class SwashRegulator {
 public:
  SwashRegulator(const PumpRegulator& data, const RegulatedLine& line, double step_s);

  [[nodiscard]] bool sets_swash() const { return data_.sets_swash(); }
  /// Swash after a step from `swash_ratio`.
  [[nodiscard]] double next(double swash_ratio, const Felt& felt);
  /// That negative flow control leads to at this flow through the bypass.
  [[nodiscard]] double settled(double bypass_m3ps) const;
  void start(double swash_ratio) { integral_ = swash_ratio; }
  /// Pressure at which the line is relieved.
  [[nodiscard]] double relief_pa(double load_pa) const;
  [[nodiscard]] double margin_pa() const { return data_.margin_pa; }
  [[nodiscard]] bool senses_load() const { return data_.kind == PumpKind::kLoadSensing; }

 private:
  [[nodiscard]] double by_load(const Felt& felt);

  PumpRegulator data_;
  RegulatedLine line_;
  double step_s_;
  double per_pa_ = 0.0;     ///< Swash in proportion.
  double per_pa_s_ = 0.0;   ///< Of the integral.
  double lag_share_ = 1.0;  ///< Of what is missing, in a step.
  double integral_ = 0.0;
};

}  // namespace graben::plant
