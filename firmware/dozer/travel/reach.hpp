#pragma once
/// Whether the blade can cut a design all the way.

#include "firmware/dozer/blade.hpp"
#include "firmware/dozer/grade_profile.hpp"

namespace graben {

/// Where the cutting edge would first have to be higher or lower than the blade reaches.
struct GradeReach {
  bool reached = true;
  double position_m = 0.0;  ///< Of the body.
  double edge_m = 0.0;      ///< Height of the edge on the design, in the body frame.
};

/// Walks the machine over the design as already cut, standing on it as its springs carry it at
/// rest, from `from_m` to `to_m` in steps of 20 cm. Some millimetres beyond the blade's reach count
/// as reached. The ground before `from_m` is taken as level with the design there.
[[nodiscard]] GradeReach grade_reach(const DozerProfile& profile, double from_m, double to_m);

}  // namespace graben
