#include "firmware/motion/grade_profile.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

double slope_after(const GradeDesign& design, int i) {
  if (i < 0 || i + 1 >= design.count) {
    return 0.0;
  }
  const GradePoint& from = design.point[static_cast<unsigned>(i)];
  const GradePoint& to = design.point[static_cast<unsigned>(i) + 1];
  return (to.z_m - from.z_m) / (to.x_m - from.x_m);
}

/// A ramp that begins at 0 with slope 1, its corner rounded over `half_m` to either side.
GradeSample rounded_ramp(double from_corner_m, double half_m) {
  if (from_corner_m >= half_m) {
    return {from_corner_m, 1.0};
  }
  if (from_corner_m <= -half_m) {
    return {};
  }
  const double along_m = from_corner_m + half_m;
  return {along_m * along_m / (4.0 * half_m), along_m / (2.0 * half_m)};
}

}  // namespace

GradeProfile::GradeProfile(const GradeDesign& design) : design_(design) {
  design_.count = std::clamp(design_.count, 0, GradeDesign::kMostPoints);
  for (int i = 0; i < design_.count; ++i) {
    kink_[static_cast<unsigned>(i)] = slope_after(design_, i) - slope_after(design_, i - 1);
  }
}

GradeSample GradeProfile::at(double x_m) const {
  GradeSample sample{design_.plane_height_m + design_.plane_slope * x_m, design_.plane_slope};
  if (design_.count > 0) {
    sample.height_m += design_.point[0].z_m;
  }
  for (int i = 0; i < design_.count; ++i) {
    const bool is_end = i == 0 || i + 1 == design_.count;
    const auto n = static_cast<unsigned>(i);
    const GradeSample ramp =
        rounded_ramp(x_m - design_.point[n].x_m, is_end ? 0.0 : design_.rounding_m);
    sample.height_m += kink_[n] * ramp.height_m;
    sample.slope += kink_[n] * ramp.slope;
  }
  return sample;
}

double grade_error_m(const GradeProfile& profile, double x_m, double z_m) {
  const GradeSample design = profile.at(x_m);
  return (z_m - design.height_m) / std::sqrt(1.0 + design.slope * design.slope);
}

}  // namespace graben
