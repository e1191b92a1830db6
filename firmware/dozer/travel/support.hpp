// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Stand of the machine on the ground: equilibrium of the half-vehicle (15), (16).

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/dozer_profile.hpp"
#include "firmware/dozer/grade_profile.hpp"
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

/// Steps of stand_at(), at most. [-; size: Newton's method finds any rest that there is by then]
inline constexpr int kMostStandSteps = 8;

/// Towards where (15) and (16) come to rest with the origin at `x_m`: wheels on springs that only
/// push carry the weight and no moment. One bounded step of Newton's method from `stand`.
[[nodiscard]] StandStep step_to_rest(const DozerBody& body, const GroundMap& ground,
                                     const GradeProfile& design, double x_m, const Stand& stand);

/// The rest itself, from `guess`; on a ledge that has none, the last of kMostStandSteps steps.
[[nodiscard]] Stand stand_at(const DozerBody& body, const GroundMap& ground,
                             const GradeProfile& design, double x_m, const Stand& guess);

/// Where the cutting edge would first have to be higher or lower than the blade reaches.
struct GradeReach {
  bool reached = true;
  double position_m = 0.0;  ///< Of the body.
  double edge_m = 0.0;      ///< Height of the edge on the design, in the body frame.
};

/// Walks the machine over the design as already cut, standing on it as its springs carry it at
/// rest, from `from_m` to `to_m` in steps of kGradeReachStep_m. Some millimetres beyond the blade's
/// reach count as reached. The ground before `from_m` is taken as level with the design there.
[[nodiscard]] GradeReach grade_reach(const DozerProfile& profile, double from_m, double to_m);

}  // namespace graben
