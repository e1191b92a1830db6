#pragma once
/// The load as the valve's model compensates it.

#include <array>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben {

/// What one cycle hands to the next.
struct LoadState {
  std::array<double, kDriveCount> cap_pa{};
  std::array<double, kDriveCount> rod_pa{};
};

/// Chamber pressures through a first-order low-pass of `pressure_filter_s`; `afresh` starts it at
/// what is measured. Oil columns are damped by orifices that give way to pressure; a spool that
/// answers every change of load at once takes that damping away, one that answers slower than the
/// machine's lowest mode leaves it. It takes most of the transducers' noise out as well.
[[nodiscard]] LoadState next_load(double pressure_filter_s, const LoadState& last,
                                  const LoadState& measured, double period_s, bool afresh);

}  // namespace graben
