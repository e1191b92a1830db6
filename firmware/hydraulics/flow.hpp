// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flow of pumps, orifices and regeneration circuits. Orifices are flow coefficients c of
/// Q = c sqrt(P) in m^3/(s sqrt(Pa)).

#include <algorithm>
#include <cmath>

#include "firmware/machine/valve.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {

/// v omega tan(alpha) of (25), m^3/s: what a pump gives at zero pressure, at the engine's speed and
/// its share of full swash.
[[nodiscard]] inline double pump_flow_m3ps(const PumpProfile& pump, double engine_radps,
                                           double swash_ratio) {
  return std::max(0.0,
                  pump.displacement_m3prev / kTwoPi * engine_radps * std::min(swash_ratio, 1.0));
}

/// The same at its rated speed and full swash.
[[nodiscard]] inline double rated_flow_m3ps(const PumpProfile& pump) {
  return pump.displacement_m3prev / kTwoPi * pump.rated_speed_radps;
}

/// Part of 1/c^2 of a chain (after (21)): resistances add up.
[[nodiscard]] constexpr double orifice_resistance(double coefficient) {
  return 1.0 / (coefficient * coefficient);
}

/// sqrt of the return gallery's pressure, sqrt(P_out), and its slope over s = sqrt(P_in).
struct GalleryPressure {
  double sqrt_pressure = 0.0;
  double slope = 0.0;
};

/// Regeneration circuit of one spool (3.2): drain orifice to the tank, check valve back to the
/// pump.s line. f(Q_out, s^2) of (18), on the side of the check valve's opening that `open` says:
/// at the opening itself both give the same pressure, but not the same slope. Open needs q_out > 0.
[[nodiscard]] inline GalleryPressure gallery_pressure(double q_out_m3ps, double sqrt_pump_pressure,
                                                      double c_drain, double c_check, bool open) {
  if (!open) {
    return {q_out_m3ps / c_drain, 0.0};
  }
  // (18) over its conjugate: nothing cancels where c_check is near c_drain.
  const double difference = (c_check - c_drain) * (c_check + c_drain);
  const double root =
      std::sqrt(q_out_m3ps * q_out_m3ps + difference * sqrt_pump_pressure * sqrt_pump_pressure);
  const double refilled = c_check * sqrt_pump_pressure;
  return {(q_out_m3ps * q_out_m3ps + refilled * refilled) / (c_check * root + c_drain * q_out_m3ps),
          refilled / root};
}

/// sqrt of the return gallery's pressure and whether the check valve is open.
struct ReturnGallery {
  double sqrt_pressure = 0.0;  ///< sqrt(P_out), sqrt(Pa)
  bool regenerating = false;
};

/// (18) with P_in = s^2. The check valve opens where the drain alone would need more pressure than
/// the pump's line has. Needs 0 < c_drain < c_check, q_out >= 0, s >= 0.
[[nodiscard]] inline ReturnGallery return_gallery(double q_out_m3ps, double sqrt_pump_pressure,
                                                  double c_drain, double c_check) {
  const bool open = sqrt_pump_pressure < q_out_m3ps / c_drain;
  return {gallery_pressure(q_out_m3ps, sqrt_pump_pressure, c_drain, c_check, open).sqrt_pressure,
          open};
}

}  // namespace graben
