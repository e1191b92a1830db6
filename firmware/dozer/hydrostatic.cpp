#include "firmware/dozer/hydrostatic.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

/// Track speed with pump and motor both at full displacement. 2 pi n_e / 60 of (9) is the engine's
/// angular speed.
double full_speed_mps(const HstProfile& hst, double engine_radps) {
  return engine_radps * hst.pump_m3prev / hst.motor_m3prev / hst.gear_ratio * hst.pump_efficiency *
         hst.motor_efficiency * hst.sprocket_radius_m;
}

}  // namespace

double track_speed_mps(const HstProfile& hst, double engine_radps, double pump_ratio,
                       double motor_ratio) {
  return motor_ratio > 0.0 ? full_speed_mps(hst, engine_radps) * pump_ratio / motor_ratio : 0.0;
}

double track_speed_max_mps(const HstProfile& hst, double engine_radps) {
  return track_speed_mps(hst, engine_radps, 1.0, hst.motor_ratio_min);
}

Displacements displacements_for(const HstProfile& hst, double engine_radps, double speed_mps) {
  const double full_mps = full_speed_mps(hst, engine_radps);
  if (!(full_mps > 0.0)) {
    return {};
  }
  const double share = speed_mps / full_mps;
  if (std::abs(share) <= 1.0) {
    return {share, 1.0};
  }
  return {std::copysign(1.0, share), std::max(hst.motor_ratio_min, 1.0 / std::abs(share))};
}

}  // namespace graben
