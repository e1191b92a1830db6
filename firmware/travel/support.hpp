#pragma once
/// How the machine stands on the ground: equilibrium of the half-vehicle (15), (16).

#include "firmware/machine/dozer_profile.hpp"
#include "firmware/travel/ground_map.hpp"

namespace graben {

/// Height of the body frame's origin and pitch (nose up is positive).
struct Stand {
  double height_m = 0.0;
  double pitch_rad = 0.0;
};

/// Where (15) and (16) come to rest with the origin at `x_m`: wheels on springs that only push
/// carry the weight and no moment. Newton's method from `guess`, with a fixed number of bounded
/// steps; on a ledge that has no rest it returns the last of them.
[[nodiscard]] Stand stand_at(const DozerBody& body, const GroundMap& ground,
                             const GradeProfile& design, double x_m, const Stand& guess);

}  // namespace graben
