#pragma once
/// Regeneration circuit of one spool (Kim 3.2): drain orifice to the tank, check valve back to the
/// pump's line.

#include <cmath>

namespace graben {

/// sqrt of the return gallery's pressure, sqrt(P_out), and its slope over s = sqrt(P_in).
struct GalleryPressure {
  double sqrt_pressure = 0.0;
  double slope = 0.0;
};

/// f(Q_out, s^2) of (18), on the side of the check valve's opening that `open` says: at the opening
/// itself both give the same pressure, but not the same slope. Open needs q_out > 0.
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
