#pragma once
/// Regeneration circuit of one spool (Kim 3.2): drain orifice to the tank, check valve back to the
/// pump's line.

#include <cmath>

namespace graben {

/// sqrt of the return gallery's pressure and whether the check valve is open.
struct ReturnGallery {
  double sqrt_pressure = 0.0;  ///< sqrt(P_out), sqrt(Pa)
  bool regenerating = false;
};

/// f(Q_out, P_in) of (18) with P_in = s^2. The check valve opens where the drain alone would need
/// more pressure than the pump's line has. Needs 0 < c_drain < c_check, q_out >= 0, s >= 0.
[[nodiscard]] inline ReturnGallery return_gallery(double q_out_m3ps, double sqrt_pump_pressure,
                                                  double c_drain, double c_check) {
  const double drained = q_out_m3ps / c_drain;
  if (sqrt_pump_pressure >= drained) {
    return {drained, false};
  }
  const double difference = c_check * c_check - c_drain * c_drain;
  const double root =
      std::sqrt(q_out_m3ps * q_out_m3ps + difference * sqrt_pump_pressure * sqrt_pump_pressure);
  return {(c_check * root - c_drain * q_out_m3ps) / difference, true};
}

/// d sqrt(P_out) / d s at s = sqrt(P_in) while the check valve is open.
[[nodiscard]] inline double return_gallery_slope(double q_out_m3ps, double sqrt_pump_pressure,
                                                 double c_drain, double c_check) {
  const double difference = c_check * c_check - c_drain * c_drain;
  return c_check * sqrt_pump_pressure /
         std::sqrt(q_out_m3ps * q_out_m3ps + difference * sqrt_pump_pressure * sqrt_pump_pressure);
}

}  // namespace graben
