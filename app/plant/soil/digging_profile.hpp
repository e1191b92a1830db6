// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A bucket and the soil that it digs in.

#include "app/plant/soil/soil_kind.hpp"

namespace graben::plant {

/// A bucket by what soil sees of it. Its floor goes from the edge, which is at the teeth, to the
/// heel; the opening lies along the line from the edge to the bucket pin.
struct BucketShape {
  double width_m = 0.0;
  double floor_m = 0.0;      ///< Edge to heel.
  double floor_rad = 0.0;    ///< From the line edge to pin down to the floor.
  double edge_m = 0.015;     ///< Thickness of the edge with its teeth.
  double capacity_m3 = 0.0;  ///< Of loose soil, heaped.
  /// Middle of the fill, of the line pin to edge: along it, and below it. Chosen: of a bucket about
  /// as deep as two fifths of that line.
  double middle_along = 0.55;
  double middle_below = 0.20;
};

struct DiggingProfile {
  SoilKind soil;
  BucketShape bucket;
  double pin_m = 0.0;         ///< Edge to bucket pin.
  double level_m = 0.0;       ///< Of the ground before it is cut, over the ground frame.
  double half_side_m = 12.0;  ///< Of the ground that can be cut.
  double gravity_mps2 = 9.80665;
};

}  // namespace graben::plant
