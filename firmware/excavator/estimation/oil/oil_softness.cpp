// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/estimation/oil/oil_softness.hpp"

#include <algorithm>

#include "firmware/excavator/estimation/oil/tuning.hpp"

namespace graben {

void next_softness(double pressure_pa, double omega_radps, bool judges, double elapsed_s,
                   OilSoftness& state) {
  if (!judges || !(elapsed_s > 0.0)) {
    const OilSoftness before = state;
    state = {};
    state.share = before.share;
    state.pushed_s = before.pushed_s;
    state.smooth_pa = pressure_pa;
    state.smoother_pa = pressure_pa;
    state.slow_pa = pressure_pa;
    return;
  }
  const auto newest = [elapsed_s](double constant_s) {
    return std::min(1.0, elapsed_s / constant_s);
  };
  state.smooth_pa += newest(kSwingSmooth_s) * (pressure_pa - state.smooth_pa);
  state.smoother_pa += newest(kSwingSmooth_s) * (state.smooth_pa - state.smoother_pa);
  state.slow_pa += newest(kSwingSlow_s) * (state.smoother_pa - state.slow_pa);
  const double swing_pa = state.smoother_pa - state.slow_pa;
  const double rate_paps = (swing_pa - state.swing_pa) / elapsed_s;
  state.swing_pa = swing_pa;
  state.power_pa2 += newest(kSwingMean_s) * (swing_pa * swing_pa - state.power_pa2);
  state.rate_pa2ps2 += newest(kSwingMean_s) * (rate_paps * rate_paps - state.rate_pa2ps2);
  if (state.power_pa2 < kRings_pa * kRings_pa) {
    return;
  }
  // Squares of frequencies go as stiffness does.
  const double mode = omega_radps * omega_radps * state.power_pa2;
  if (state.rate_pa2ps2 < kRingsSlower * mode) {
    state.share = std::max(kSoftOilLeast, state.share - kSoftens_ps * elapsed_s);
  } else if (state.rate_pa2ps2 > kRingsFaster * mode) {
    state.share = std::min(kStiffOilMost, state.share + kSoftens_ps * elapsed_s);
  }
}

}  // namespace graben
