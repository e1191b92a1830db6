// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Slope sensors on the links: joint angles as differences of what two of them show.
///
///   boom    boom's slope - platform's, which is 0 where it has no sensor
///   arm     arm's slope - boom's
///   bucket  bucket's slope - arm's
///
/// The whole turn is the one that a joint of an excavator can have: a quarter of it about
/// kMiddle_rad either way, and more. As valid as the worse of both, as old as the older.

#include <array>

#include "firmware/excavator/excavator_signals.hpp"
#include "hal/buses/bus_table.hpp"

namespace graben {

struct LinkSlopes {
  /// rad; what a sensor lets stand as 0 is the profile's, by its offset.
  std::array<Signal<double>, kSlopeCount> link;

  /// Of boom, arm, bucket: a joint angle is within half a turn of these.
  static constexpr std::array<double, kAxisCount> kMiddle_rad = {0.0, -1.5, -1.2};

  void to_joints(bool has_body, ExcavatorInputs& to) const;
};

}  // namespace graben
