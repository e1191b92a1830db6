#include "firmware/drives/load_filter.hpp"

#include <cmath>

namespace graben {

LoadState next_load(double pressure_filter_s, const LoadState& last, const LoadState& measured,
                    double period_s, bool afresh) {
  if (afresh || !(pressure_filter_s > 0.0)) {
    return measured;
  }
  const double newest = 1.0 - std::exp(-period_s / pressure_filter_s);
  LoadState load = last;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    load.cap_pa[i] += newest * (measured.cap_pa[i] - last.cap_pa[i]);
    load.rod_pa[i] += newest * (measured.rod_pa[i] - last.rod_pa[i]);
  }
  return load;
}

}  // namespace graben
