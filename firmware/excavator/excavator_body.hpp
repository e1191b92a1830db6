#pragma once
/// The machine's outline, as its controller keeps it away from fences; and what it may be off by
/// while it does so. SI units; link frames as in excavator_profile.hpp.

#include <Eigen/Core>

namespace graben {

/// A level bar across the machine's rear, its ends rounded, as high as it is.
struct Counterweight {
  double radius_m = 0.0;      ///< Swing axis to its farthest point; 0: none is known.
  double half_width_m = 0.0;  ///< To either side of the machine's plane.
  double corner_m = 0.0;      ///< Radius of its corners, seen from above.
  double low_m = 0.0;         ///< From here over the ground
  double high_m = 0.0;        ///< to here.

  [[nodiscard]] bool known() const { return radius_m > 0.0; }
};

/// All 0: teeth and pins are all that is known, as points.
struct ExcavatorBody {
  double bucket_width_m = 0.0;
  double floor_m = 0.0;        ///< Of the bucket, edge to heel.
  double floor_rad = 0.0;      ///< From the line edge to bucket pin down to the floor.
  double boom_radius_m = 0.0;  ///< Round its pins' line and the bend, cylinders and hoses in it.
  double arm_radius_m = 0.0;   ///< Round its pins' line.
  Eigen::Vector2d boom_bend_m = Eigen::Vector2d::Zero();  ///< Boom frame; at its foot: straight.
  Counterweight counterweight;

  [[nodiscard]] bool known() const { return bucket_width_m > 0.0; }
};

/// What fences allow for, see fence_margin.hpp. All 0: the machine is where it is measured.
struct FenceProfile {
  double stroke_error_m = 0.0;   ///< Of a stroke as it is measured, at most.
  double swing_error_rad = 0.0;  ///< The same of the swing, and what it swings about its place.
  double give_m = 0.0;           ///< So far a point goes on where its drives are to stop.
  double room_m = 0.0;           ///< So much more is left to a planned way, beside
  double room_s = 0.0;           ///< this for each m/s of a point's planned speed.
};

}  // namespace graben
