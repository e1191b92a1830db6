// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The design surface: a plane, and over it heights: through points with rounded corners, or on a
/// grid.

#include <limits>

#include "firmware/dozer/dozer_profile.hpp"

namespace graben {

/// Height and slope of the design at one place.
struct GradeSample {
  double height_m = 0.0;
  double slope = 0.0;  ///< dz/dx
};

/// Slope of the design across the track at one place, and how that changes along it.
struct CrossSample {
  double slope = 0.0;      ///< dz/dy, y to the left.
  double change_pm = 0.0;  ///< Per metre along x.
};

/// Curvature in plan of a track whose heights are on a grid, 1/m, to the left positive. Straight
/// before the first and after the last, and where the heights have none.
[[nodiscard]] double curvature_at(const GradeHeights& heights, double x_m);

/// Every corner is a parabola over `rounding_m` to either side, so that the slope has no step.
/// Before the first and after the last point the heights go on level; these two have no curve. No
/// two curves overlap: the application's check wants the points that far apart. Of heights on a
/// grid it goes through all of them, with a slope that has no step either.
class GradeProfile {
 public:
  explicit GradeProfile(const GradeDesign& design);

  /// No lower than this over the plane, from now on: what a pass may cut.
  void set_floor(double height_m) { floor_m_ = height_m; }

  /// At x along the grade, m.
  [[nodiscard]] GradeSample at(double x_m) const;
  /// Before the first and after the last height it stays as there. A floor does not change it.
  [[nodiscard]] CrossSample cross_at(double x_m) const;
  [[nodiscard]] double curvature_at(double x_m) const {
    return graben::curvature_at(heights_, x_m);
  }
  [[nodiscard]] bool curves() const { return heights_.count > 1 && heights_.curvature != nullptr; }

 private:
  /// A straight piece, from where the corner before it is.
  struct Line {
    double from_m = 0.0;
    double height_m = 0.0;
    double slope = 0.0;
  };

  /// Over the plane, before the floor.
  [[nodiscard]] GradeSample of_points(double x_m) const;

  double plane_height_m_;
  double plane_slope_;
  double floor_m_ = -std::numeric_limits<double>::infinity();
  GradeHeights heights_;
  int count_;
  std::array<double, GradeDesign::kMostPoints> corner_m_{};
  std::array<double, GradeDesign::kMostPoints> curve_end_m_{};  ///< Of each corner.
  std::array<Line, GradeDesign::kMostPoints + 1> line_{};  ///< Before each, and after the last.
};

/// Height of `x_m`, `z_m` above the design, along the design's normal, m.
[[nodiscard]] double grade_error_m(const GradeProfile& profile, double x_m, double z_m);

}  // namespace graben
