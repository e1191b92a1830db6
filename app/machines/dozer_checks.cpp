// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/machines/dozer_sections.hpp"
#include "app/machines/tilt_section.hpp"

#include "firmware/dozer/travel/course.hpp"
#include "firmware/dozer/travel/preview.hpp"
#include "firmware/dozer/travel/support.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::machines {
namespace {

/// L11 is documentation; off by more than this, a pin is wrong.
constexpr double kPinTolerance_m = 2e-3;
/// The cylinder's lever fails where rod eye, pivot and base come into line; this near to it at
/// most.
constexpr double kLeastLeverAngle_rad = 0.15;
/// Deeper in its springs than this no machine of the class sits.
constexpr double kMostSag_m = 0.10;
/// Steeper ground carries no dozer.
constexpr double kMostSlope = 0.6;

double angle_rad(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

/// The triangle of pivot, cylinder base and rod eye; written for the check alone, as the controller
/// solves it for strokes.
class Triangle {
 public:
  explicit Triangle(const BladeGeometry& blade) : blade_(blade) {
    const Eigen::Vector2d to_base = blade.base_m - blade.pivot_m;
    l11_m_ = to_base.norm();
    const double along_m = to_base.dot(blade.arm_m.normalized());
    const double root =
        along_m * along_m - l11_m_ * l11_m_ + blade.length_home_m * blade.length_home_m;
    l12_m_ = root >= 0.0 ? along_m + std::sqrt(root) : 0.0;
  }

  [[nodiscard]] double l11_m() const { return l11_m_; }
  /// 0 or less where the home length does not reach from the base to the arm's line.
  [[nodiscard]] double l12_m() const { return l12_m_; }

  /// At the pivot, from the rod eye to the base; falls as the edge rises.
  [[nodiscard]] double lever_rad(double edge_m) const {
    const double raised_rad = std::asin((edge_m - blade_.pivot_m.y()) / blade_.cutting_edge_m) +
                              std::asin(blade_.pivot_m.y() / blade_.cutting_edge_m);
    return angle_rad(blade_.base_m - blade_.pivot_m) - angle_rad(blade_.arm_m) - raised_rad;
  }

  [[nodiscard]] double length_m(double edge_m) const {
    return std::sqrt(l11_m_ * l11_m_ + l12_m_ * l12_m_ -
                     2.0 * l11_m_ * l12_m_ * std::cos(lever_rad(edge_m)));
  }

 private:
  const BladeGeometry& blade_;
  double l11_m_ = 0.0;
  double l12_m_ = 0.0;
};

void check_body(TomlReader& reader, const DozerBody& body) {
  const double sag_m = body.mass_kg * kStandardGravity_mps2 / (body.wheels * body.suspension_npm);
  if (sag_m > kMostSag_m) {
    reader.fail("body.suspension.stiffness",
                fmt::format("{} N/m; {} wheels sag by {:.3f} m under the mass; allowed: at most "
                            "{} m",
                            body.suspension_npm, body.wheels, sag_m, kMostSag_m));
  }
}

/// Whether the edge can be at this height at all, and the cylinder's lever holds there.
bool check_reach(TomlReader& reader, const Triangle& triangle, const BladeGeometry& blade,
                 double edge_m) {
  if (std::abs(edge_m - blade.pivot_m.y()) >= blade.cutting_edge_m) {
    reader.fail("blade.range", fmt::format("{} m is out of the cutting edge's reach of {} m about "
                                           "the pivot",
                                           edge_m, blade.cutting_edge_m));
    return false;
  }
  const double lever_rad = triangle.lever_rad(edge_m);
  if (lever_rad < kLeastLeverAngle_rad || lever_rad > kPi - kLeastLeverAngle_rad) {
    reader.fail("blade.range",
                fmt::format("with the edge at {} m, rod eye and cylinder base are {:.3f} rad apart "
                            "at the pivot; allowed: {} .. {:.3f} rad",
                            edge_m, lever_rad, kLeastLeverAngle_rad, kPi - kLeastLeverAngle_rad));
    return false;
  }
  return true;
}

void check_blade(TomlReader& reader, const BladeGeometry& blade, double l11_m) {
  const Triangle triangle(blade);
  if (std::abs(l11_m - triangle.l11_m()) > kPinTolerance_m) {
    reader.fail("blade.L11", fmt::format("{} m; pivot and cylinder base are {:.4f} m apart; "
                                         "allowed: within {} m of that",
                                         l11_m, triangle.l11_m(), kPinTolerance_m));
    return;
  }
  if (!(blade.edge_min_m < 0.0 && blade.edge_max_m > 0.0)) {
    reader.fail("blade.range", "must have home, an edge at 0 m, within");
    return;
  }
  if (triangle.l12_m() <= 0.0 || triangle.l12_m() > blade.arm_m.norm()) {
    reader.fail("blade.cylinder.length_home",
                fmt::format("{} m; no rod eye between the pivot and the blade's foot is that far "
                            "from the cylinder's base",
                            blade.length_home_m));
    return;
  }
  if (!check_reach(reader, triangle, blade, blade.edge_min_m) ||
      !check_reach(reader, triangle, blade, blade.edge_max_m)) {
    return;
  }
  const double closed_m = triangle.length_m(blade.edge_max_m);
  const double stroke_m = triangle.length_m(blade.edge_min_m) - closed_m;
  if (stroke_m >= closed_m) {
    reader.fail("blade.range", fmt::format("asks for a stroke of {:.3f} m; allowed: less than the "
                                           "closed length of {:.3f} m",
                                           stroke_m, closed_m));
  }
}

void check_engine(TomlReader& reader, const DozerProfile& profile) {
  const HstProfile& hst = profile.hst;
  if (hst.engine_radps < hst.engine_least_radps || hst.engine_radps > hst.engine_most_radps) {
    reader.fail("hst.engine_speed",
                fmt::format("{} rad/s; allowed: engine_range, {} .. {} rad/s", hst.engine_radps,
                            hst.engine_least_radps, hst.engine_most_radps));
  }
  if (profile.safety.idle_radps > hst.engine_radps) {
    reader.fail("safety.idle", fmt::format("{} rad/s; allowed: at most hst.engine_speed, {} rad/s",
                                           profile.safety.idle_radps, hst.engine_radps));
  }
}

using DesignErrors = std::vector<DesignError>;

std::string too_steep(double slope, const std::string& where) {
  return fmt::format("a slope of {:.3f} {}; allowed: {} .. {}", slope, where, -kMostSlope,
                     kMostSlope);
}

/// From each corner to the next: rising in x, room for both roundings, not too steep.
DesignErrors errors_of_corners(const GradeDesign& grade) {
  DesignErrors errors;
  for (unsigned i = 1; i < static_cast<unsigned>(grade.count); ++i) {
    const GradePoint& from = grade.point[i - 1];
    const GradePoint& to = grade.point[i];
    const double apart_m = to.x_m - from.x_m;
    const std::string key = fmt::format("grade.profile[{}]", i);
    if (!(apart_m > 0.0)) {
      errors.push_back({key, fmt::format("x = {} m; allowed: more than the point before, {} m",
                                         to.x_m, from.x_m)});
      continue;
    }
    // As the corners' numbers are rounded in binary, so is their distance.
    if (apart_m < 2.0 * grade.rounding_m - 1e-9) {
      errors.push_back({key, fmt::format("{:.3f} m after the point before; allowed: at least twice "
                                         "the rounding, {:.3f} m",
                                         apart_m, 2.0 * grade.rounding_m)});
    }
    const double slope = (to.z_m - from.z_m) / apart_m + grade.plane_slope;
    if (std::abs(slope) > kMostSlope) {
      errors.push_back({key, too_steep(slope, "from the point before")});
    }
  }
  return errors;
}

/// The steepest place alone: a wall is steep at many.
DesignErrors errors_of_heights(const GradeDesign& grade) {
  constexpr double kStep_m = GradeHeights::kStep_m;
  int steepest = 0;
  double most = 0.0;
  for (int i = 0; i + 1 < grade.heights.count; ++i) {
    const double* const at = grade.heights.height_m + i;
    const double slope = (at[1] - at[0]) / kStep_m + grade.plane_slope;
    if (std::abs(slope) > std::abs(most)) {
      most = slope;
      steepest = i;
    }
  }
  if (std::abs(most) <= kMostSlope) {
    return {};
  }
  const double x_m = grade.heights.from_m + (steepest + 0.5) * kStep_m;
  return {{kDesignKey, too_steep(most, fmt::format("at x = {:.2f} m", x_m))}};
}

const char* whole_key(const GradeDesign& grade) {
  return grade.heights.count > 0 ? kDesignKey : "grade.profile";
}

DesignErrors errors_of_reach(const DozerProfile& profile) {
  const GradeDesign& grade = profile.grade;
  const GradeReach reach = grade_reach(profile, grade.begin_m(), grade.end_m());
  if (reach.reached) {
    return {};
  }
  return {
      {whole_key(grade),
       fmt::format("with the body at x = {:.2f} m the cutting edge would have to be at {:.3f} m "
                   "against the tracks' ground line; allowed: the blade's reach, {} .. {} m",
                   reach.position_m, reach.edge_m, profile.blade.edge_min_m,
                   profile.blade.edge_max_m)}};
}

/// Over some crests the body tips faster than the blade's flow follows, however slow it drives.
DesignErrors errors_of_keeping(const DozerProfile& profile) {
  const GradeDesign& grade = profile.grade;
  const GradeKept kept = grade_kept(profile, grade.begin_m(), grade.end_m());
  if (kept.kept) {
    return {};
  }
  return {{whole_key(grade),
           fmt::format("with the body at x = {:.2f} m, where it tips, the ground would come out "
                       "{:.3f} m off the design at any speed; allowed: grade.tolerance, {} m",
                       kept.position_m, kept.off_m, grade.tolerance_m)}};
}

/// Between the body's ends, of the springs' sag at a corner of its tracks: with more twist below it
/// the body stands on two corners, and its height is not that of the ground's middle.
constexpr double kMostTwist = 1.5;

/// Of a track that curves: a blade that tilts, and how tight.
DesignErrors errors_of_curves(const DozerProfile& profile) {
  const GradeDesign& grade = profile.grade;
  if (!grade.curves()) {
    return {};
  }
  if (!profile.tilt.present) {
    return {
        {kDesignKey,
         "has a track that curves in plan; allowed: a straight one, this machine's blade has no "
         "[tilt], and its edge lies askew to a curve"}};
  }
  const double reach_m = BladeKinematics(profile.blade).edge_m(0.0).x();
  const double most_pm = kMostAskew_rad / reach_m;
  for (int i = 0; i < grade.heights.count; ++i) {
    const double curvature_pm = grade.heights.curvature[i];
    if (std::abs(curvature_pm) > most_pm) {
      return {{kDesignKey,
               fmt::format("at x = {:.2f} m the track has a radius of {:.2f} m; allowed: at least "
                           "{:.2f} m, on which the edge, {:.2f} m ahead, lies askew by {} rad",
                           grade.heights.from_m + i * GradeHeights::kStep_m,
                           1.0 / std::abs(curvature_pm), 1.0 / most_pm, reach_m, kMostAskew_rad)}};
    }
  }
  return {};
}

/// Of a slope across: a blade that tilts, how far, and ground that twists below the tracks.
DesignErrors errors_of_tilt(const DozerProfile& profile) {
  const GradeDesign& grade = profile.grade;
  if (grade.heights.cross == nullptr) {
    return {};
  }
  if (!profile.tilt.present) {
    return {{kDesignKey,
             "has a slope across the track; allowed: none, this machine's blade has no "
             "[tilt]"}};
  }
  const DozerBody& body = profile.body;
  const GradeProfile design(grade);
  const double reach_m = BladeKinematics(profile.blade).edge_m(0.0).x();
  const double sag_m = body.mass_kg * kStandardGravity_mps2 / (body.wheels * body.suspension_npm);
  const double twist_most = 2.0 * kMostTwist * sag_m / body.half_gauge_m;
  const double begin_m = grade.begin_m() - reach_m;
  const auto steps = static_cast<int>((grade.end_m() - begin_m) / GradeHeights::kStep_m);
  for (int i = 0; i <= steps; ++i) {
    const double x_m = begin_m + i * GradeHeights::kStep_m;
    const double angle_rad = tilt_on_rad(body, design, x_m, reach_m);
    if (std::abs(angle_rad) > profile.tilt.angle_most_rad) {
      return {
          {kDesignKey,
           fmt::format("with the body at x = {:.2f} m the blade would have to be tilted by "
                       "{:.3f} rad; allowed: tilt.range, {} .. {} rad",
                       x_m, angle_rad, -profile.tilt.angle_most_rad, profile.tilt.angle_most_rad)}};
    }
    const double twist = design.cross_at(x_m + 0.5 * body.track_contact_m).slope -
                         design.cross_at(x_m - 0.5 * body.track_contact_m).slope;
    if (std::abs(twist) > twist_most) {
      return {{kDesignKey,
               fmt::format("with the body at x = {:.2f} m the slope across changes by {:.3f} from "
                           "end to end of its tracks, which then stand on two corners; allowed: "
                           "{:.3f} .. {:.3f}",
                           x_m, twist, -twist_most, twist_most)}};
    }
  }
  return {};
}

}  // namespace

double lowest_point_m(const GradeDesign& grade) {
  if (grade.heights.count > 0) {
    return *std::min_element(grade.heights.height_m, grade.heights.height_m + grade.heights.count);
  }
  const auto* const end = grade.point.begin() + grade.count;
  return std::min_element(grade.point.begin(), end,
                          [](const GradePoint& a, const GradePoint& b) { return a.z_m < b.z_m; })
      ->z_m;
}

std::vector<DesignError> design_errors(const DozerProfile& profile) {
  DesignErrors errors = profile.grade.heights.count > 0 ? errors_of_heights(profile.grade)
                                                        : errors_of_corners(profile.grade);
  if (errors.empty()) {
    errors = errors_of_curves(profile);
  }
  if (errors.empty()) {
    errors = errors_of_tilt(profile);
  }
  if (errors.empty()) {
    errors = errors_of_reach(profile);
  }
  return errors.empty() ? errors_of_keeping(profile) : errors;
}

void check_dozer_across_keys(TomlReader& reader, const DozerProfile& profile) {
  const double l11_m =
      reader.number("blade.L11", {0.05, 5.0, "m"},
                    "pivot to cylinder base; says again what the two pins give, within 2 mm");
  if (!reader.is_sound()) {
    return;
  }
  check_body(reader, profile.body);
  check_blade(reader, profile.blade, l11_m);
  check_tilt(reader, profile.tilt);
  check_engine(reader, profile);
  const GradeDesign& grade = profile.grade;
  if (!reader.errors().empty() || (grade.count < 2 && grade.heights.count < 2)) {
    return;  // A design in a file of its own may not have been read.
  }
  for (const DesignError& error : design_errors(profile)) {
    reader.fail(error.key, error.what);
  }
}

}  // namespace graben::machines
