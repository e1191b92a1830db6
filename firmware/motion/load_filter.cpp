#include "firmware/motion/load_filter.hpp"

#include <cmath>

namespace graben {
namespace {

/// Weight of the newest value in a first-order low-pass.
double newest_share(double period_s, double time_constant_s, bool afresh) {
  return afresh || !(time_constant_s > 0.0) ? 1.0 : 1.0 - std::exp(-period_s / time_constant_s);
}

}  // namespace

LoadState next_load(const ExcavatorProfile& profile, const LoadState& last,
                    const AxisPressures& cap_pa, const AxisPressures& rod_pa, double period_s,
                    bool afresh) {
  const double share = newest_share(period_s, profile.control.pressure_filter_s, afresh);
  const double mean_share = newest_share(period_s, profile.control.damping_window_s, afresh);
  LoadState load = last;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    const CylinderGeometry& cylinder = profile.geometry.cylinder[i];
    load.cap_pa[i] += share * (cap_pa[i] - last.cap_pa[i]);
    load.rod_pa[i] += share * (rod_pa[i] - last.rod_pa[i]);
    load.force_n[i] = cap_pa[i] * cylinder.cap_area_m2() - rod_pa[i] * cylinder.rod_area_m2();
  }
  load.mean_force_n += mean_share * (load.force_n - last.mean_force_n);
  return load;
}

Eigen::Vector3d damping_velocity(const ControlProfile& control, const LoadState& load) {
  return -control.damping_mpns * (load.force_n - load.mean_force_n);
}

}  // namespace graben
