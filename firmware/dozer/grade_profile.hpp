// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The design surface: a plane, and over it heights through points with rounded corners.

#include <limits>

#include "firmware/dozer/dozer_profile.hpp"

namespace graben {

/// Height and slope of the design at one place.
struct GradeSample {
  double height_m = 0.0;
  double slope = 0.0;  ///< dz/dx
};

/// Every corner is a parabola over `rounding_m` to either side, so that the slope has no step.
/// Before the first and after the last point the heights go on level; these two have no curve. No
/// two curves overlap: the application's check wants the points that far apart.
class GradeProfile {
 public:
  explicit GradeProfile(const GradeDesign& design);

  /// No lower than this over the plane, from now on: what a pass may cut.
  void set_floor(double height_m) { floor_m_ = height_m; }

  /// At x along the grade, m.
  [[nodiscard]] GradeSample at(double x_m) const;

 private:
  /// A straight piece, from where the corner before it is.
  struct Line {
    double from_m = 0.0;
    double height_m = 0.0;
    double slope = 0.0;
  };

  double plane_height_m_;
  double plane_slope_;
  double floor_m_ = -std::numeric_limits<double>::infinity();
  int count_;
  std::array<double, GradeDesign::kMostPoints> corner_m_{};
  std::array<double, GradeDesign::kMostPoints> curve_end_m_{};  ///< Of each corner.
  std::array<Line, GradeDesign::kMostPoints + 1> line_{};  ///< Before each, and after the last.
};

/// Height of `x_m`, `z_m` above the design, along the design's normal, m.
[[nodiscard]] double grade_error_m(const GradeProfile& profile, double x_m, double z_m);

}  // namespace graben
