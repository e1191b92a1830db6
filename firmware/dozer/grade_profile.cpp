// SPDX-License-Identifier: Apache-2.0
#include "firmware/dozer/grade_profile.hpp"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

double slope_after(const GradeDesign& design, int count, int i) {
  if (i + 1 >= count) {
    return 0.0;
  }
  const GradePoint& from = design.point[static_cast<unsigned>(i)];
  const GradePoint& to = design.point[static_cast<unsigned>(i) + 1];
  return (to.z_m - from.z_m) / (to.x_m - from.x_m);
}

/// Between two heights a parabola, of the curvature that there is about both; its slope goes over
/// from the one at the first to the one at the second. So are cross slopes.
GradeSample on_grid(const GradeHeights& heights, const double* values, double x_m) {
  const int last = heights.count - 1;
  const double place = (x_m - heights.from_m) / GradeHeights::kStep_m;
  if (!(place > 0.0)) {
    return {values[0], 0.0};
  }
  if (place >= last) {
    return {values[last], 0.0};
  }
  const int index = static_cast<int>(place);
  const double* const here = values + index;
  const double before_m = here[index > 0 ? -1 : 0];
  const double after_m = here[index + 2 <= last ? 2 : 1];
  // Twice the rise from one to the next.
  const double rise_m = here[1] - before_m;
  const double bend_m = after_m - here[0] - rise_m;
  const double share = place - index;
  return {here[0] + share * (here[1] - here[0]) - 0.25 * bend_m * share * (1.0 - share),
          (rise_m + share * bend_m) / (2.0 * GradeHeights::kStep_m)};
}

}  // namespace

double curvature_at(const GradeHeights& heights, double x_m) {
  const double along_m = x_m - heights.from_m;
  const bool beside = along_m > 0.0 && along_m < (heights.count - 1) * GradeHeights::kStep_m;
  return heights.curvature != nullptr && beside ? on_grid(heights, heights.curvature, x_m).height_m
                                                : 0.0;
}

GradeProfile::GradeProfile(const GradeDesign& design)
    : plane_height_m_(design.plane_height_m),
      plane_slope_(design.plane_slope),
      heights_(design.heights),
      count_(std::clamp(design.count, 0, GradeDesign::kMostPoints)) {
  line_[0].height_m = count_ > 0 ? design.point[0].z_m : 0.0;
  for (int i = 0; i < count_; ++i) {
    const auto n = static_cast<unsigned>(i);
    const bool is_end = i == 0 || i + 1 == count_;
    corner_m_[n] = design.point[n].x_m;
    curve_end_m_[n] = corner_m_[n] + (is_end ? 0.0 : design.rounding_m);
    line_[n + 1] = {corner_m_[n], design.point[n].z_m, slope_after(design, count_, i)};
  }
}

GradeSample GradeProfile::of_points(double x_m) const {
  const auto end = curve_end_m_.begin() + count_;
  const auto n = static_cast<unsigned>(std::upper_bound(curve_end_m_.begin(), end, x_m) -
                                       curve_end_m_.begin());
  const Line& line = line_[n];
  GradeSample sample{line.height_m + line.slope * (x_m - line.from_m), line.slope};
  if (static_cast<int>(n) < count_) {
    const double half_m = curve_end_m_[n] - corner_m_[n];
    const double along_m = x_m - (corner_m_[n] - half_m);
    if (along_m > 0.0 && half_m > 0.0) {
      const double kink = line_[n + 1].slope - line.slope;
      sample.height_m += kink * along_m * along_m / (4.0 * half_m);
      sample.slope += kink * along_m / (2.0 * half_m);
    }
  }
  return sample;
}

GradeSample GradeProfile::at(double x_m) const {
  const GradeSample over =
      heights_.count > 1 ? on_grid(heights_, heights_.height_m, x_m) : of_points(x_m);
  const double plane_m = plane_height_m_ + plane_slope_ * x_m;
  return over.height_m < floor_m_ ? GradeSample{plane_m + floor_m_, plane_slope_}
                                  : GradeSample{plane_m + over.height_m, plane_slope_ + over.slope};
}

CrossSample GradeProfile::cross_at(double x_m) const {
  if (heights_.count < 2 || heights_.cross == nullptr) {
    return {};
  }
  const GradeSample sample = on_grid(heights_, heights_.cross, x_m);
  return {sample.height_m, sample.slope};
}

double grade_error_m(const GradeProfile& profile, double x_m, double z_m) {
  const GradeSample design = profile.at(x_m);
  return (z_m - design.height_m) / std::sqrt(1.0 + design.slope * design.slope);
}

}  // namespace graben
