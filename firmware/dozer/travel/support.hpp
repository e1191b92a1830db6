#pragma once
/// How the machine stands on the ground: equilibrium of the half-vehicle (15), (16).

#include "firmware/dozer/dozer_profile.hpp"
#include "firmware/dozer/travel/ground_map.hpp"

namespace graben {

/// Height of the body frame's origin and pitch (nose up is positive).
struct Stand {
  double height_m = 0.0;
  double pitch_rad = 0.0;
};

/// One step on the way to a rest.
struct StandStep {
  Stand stand;
  bool at_rest = false;  ///< Another step would change nothing that counts.
};

/// So many steps find any rest that there is.
inline constexpr int kMostStandSteps = 8;

/// Towards where (15) and (16) come to rest with the origin at `x_m`: wheels on springs that only
/// push carry the weight and no moment. One bounded step of Newton's method from `stand`.
[[nodiscard]] StandStep step_to_rest(const DozerBody& body, const GroundMap& ground,
                                     const GradeProfile& design, double x_m, const Stand& stand);

/// The rest itself, from `guess`; on a ledge that has none, the last of kMostStandSteps steps.
[[nodiscard]] Stand stand_at(const DozerBody& body, const GroundMap& ground,
                             const GradeProfile& design, double x_m, const Stand& guess);

}  // namespace graben
