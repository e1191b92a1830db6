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

/// sqrt(Q_out^2 + (c_r^2 - c_d^2) P_in), the root in (18).
[[nodiscard]] inline double gallery_root(double q_out_m3ps, double sqrt_pump_pressure,
                                         double c_drain, double c_check) {
  const double difference = (c_check - c_drain) * (c_check + c_drain);
  return std::sqrt(q_out_m3ps * q_out_m3ps + difference * sqrt_pump_pressure * sqrt_pump_pressure);
}

/// f(Q_out, P_in) of (18) with P_in = s^2. The check valve opens where the drain alone would need
/// more pressure than the pump's line has. Needs 0 < c_drain < c_check, q_out >= 0, s >= 0.
[[nodiscard]] inline ReturnGallery return_gallery(double q_out_m3ps, double sqrt_pump_pressure,
                                                  double c_drain, double c_check) {
  const double drained = q_out_m3ps / c_drain;
  if (sqrt_pump_pressure >= drained) {
    return {drained, false};
  }
  // (18) over its conjugate: nothing cancels where c_check is near c_drain.
  const double root = gallery_root(q_out_m3ps, sqrt_pump_pressure, c_drain, c_check);
  const double refilled = c_check * sqrt_pump_pressure;
  return {(q_out_m3ps * q_out_m3ps + refilled * refilled) / (c_check * root + c_drain * q_out_m3ps),
          true};
}

/// d sqrt(P_out) / d s at s = sqrt(P_in) while the check valve is open.
[[nodiscard]] inline double return_gallery_slope(double q_out_m3ps, double sqrt_pump_pressure,
                                                 double c_drain, double c_check) {
  return c_check * sqrt_pump_pressure /
         gallery_root(q_out_m3ps, sqrt_pump_pressure, c_drain, c_check);
}

}  // namespace graben
