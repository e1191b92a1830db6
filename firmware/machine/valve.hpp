// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Hydraulics of a machine as data: cylinders' areas, spools, pumps, and how lambda may rise. SI
/// units. Equation numbers are those of Kim et al.

#include <array>
#include <cstdint>

#include "firmware/machine/tuning.hpp"

namespace graben {

/// A_A: cap-side area of parallel cylinders, all of them together, m^2.
constexpr double cap_area_m2(int count, double bore_m) {
  // Area of a circle over its diameter squared. [-; derived: pi / 4]
  constexpr double kQuarterPi = 0.78539816339744830962;
  return count * kQuarterPi * bore_m * bore_m;
}

/// A_B: rod side, m^2.
constexpr double rod_area_m2(int count, double bore_m, double rod_m) {
  return cap_area_m2(count, bore_m) - cap_area_m2(count, rod_m);
}

enum class RegenerationSide : int { kRetract = -1, kNone = 0, kExtend = 1 };

/// Opening of each side at which the bypass is closed: from the dead band's edge on it closes
/// evenly. Both 0: it is closed wherever the spool is open, (20).
struct BypassClosing {
  double extend = 0.0;
  double retract = 0.0;

  [[nodiscard]] bool is_gradual() const { return extend > 0.0; }
  [[nodiscard]] double side(bool extends) const { return extends ? extend : retract; }
};

/// One four-way directional valve with its bypass and regeneration (3.1 - 3.3).
struct SpoolProfile {
  int pump = 0;               ///< Which pump feeds it.
  double extend_in_m2 = 0.0;  ///< Areas at full opening: A_v,in and A_v,out of (4), (5).
  double extend_out_m2 = 0.0;
  double retract_in_m2 = 0.0;
  double retract_out_m2 = 0.0;
  double bypass_open = 0.0;    ///< c_v,by at x = 0 of (20), m^3/(s sqrt(Pa)).
  double bypass_closed = 0.0;  ///< c_v,by at x != 0 of (20).
  BypassClosing bypass_closes_at{};
  RegenerationSide regeneration = RegenerationSide::kNone;
  double c_drain = 0.0;         ///< c_d of (15).
  double c_check = 0.0;         ///< c_r of (16).
  double force_offset_n = 0.0;  ///< F_offset of (38).
  double c_inflow_check = 0.0;  ///< Extra check valve before the spool (Remark 3); 0: none.
};

/// From a spool's travel to flow.
struct SpoolMetering {
  double spool_travel_m = 0.0;    ///< x_m of (13).
  double opening_exponent = 1.0;  ///< Area over travel: (|x| / x_m) ^ exponent.
  double discharge = 0.0;         ///< C_d.
  double density_kgpm3 = 0.0;     ///< rho.
};

/// Who sets a pump's swash.
enum class PumpKind : std::uint8_t {
  kPositive = 0,  ///< The controller, by command (Kim et al.).
  /// Its regulator: the line stays a margin above the heaviest load of its drives, whose valve has
  /// a closed centre.
  kLoadSensing,
  /// Its regulator: the more oil passes the bypass, the less it gives.
  kNegativeFlow,
};

/// What a pump that sets its own swash goes by.
struct PumpRegulator {
  PumpKind kind = PumpKind::kPositive;
  double margin_pa = 0.0;  ///< Load sensing: above the heaviest load; over its metering edge.
  /// Load sensing: each section has a compensator, which keeps the margin over its metering edge
  /// whatever its load.
  bool compensated = false;
  // Negative flow: pressure before the last of the bypass' orifices.
  double full_swash_pa = 0.0;      ///< Up to it the swash is full,
  double least_swash_pa = 0.0;     ///< from here on least; linear between.
  double least_swash_ratio = 0.0;  ///< Of full.
  double response_s = 0.0;         ///< In which the swash goes from least to full.

  [[nodiscard]] bool sets_swash() const { return kind != PumpKind::kPositive; }
};

/// Swash-plate pump of (25): flow = displacement * speed * swash - leak_linear P - leak_quadratic
/// P^2.
struct PumpProfile {
  double displacement_m3prev = 0.0;  ///< Per revolution at full swash.
  double rated_speed_radps = 0.0;
  double leak_linear = 0.0;     ///< m^3/(s Pa)
  double leak_quadratic = 0.0;  ///< m^3/(s Pa^2)
  double relief_pa = 0.0;
  std::array<double, 2> bypass_series{};  ///< Make-up valve and tank orifice of (21), (22).
  PumpRegulator regulator;
};

/// Bounds on lambda's rise from cycle to cycle; it may fall at once.
struct LambdaRise {
  double rate_ps = 0.0;     ///< Per second.
  double reserve_n = 0.0;   ///< Drive force that every moving cylinder must have beyond its need.
  double hold_share = 0.0;  ///< Share of the reserve (0 .. 1) for lambda to stay where it is.
};

}  // namespace graben
