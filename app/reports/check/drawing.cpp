// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/reports/check/machine_check.hpp"
#include "firmware/dozer/blade.hpp"
#include "firmware/excavator/kinematics/excavator_kinematics.hpp"
#include "firmware/excavator/motion/field/rounded_rectangle.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::reports {
namespace {

using Point = Eigen::Vector2d;
using Points = std::vector<Point>;

/// A side view in m, y up, as SVG with a pixel size of its own.
class Sheet {
 public:
  Sheet(Point least_m, Point most_m, double width_px)
      : least_m_(std::move(least_m)),
        most_m_(std::move(most_m)),
        scale_(width_px / (most_m_.x() - least_m_.x())) {
    text_ =
        fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"side view\">\n",
                    width_px, scale_ * (most_m_.y() - least_m_.y()));
  }

  void area(const char* style, const Points& points) { path(style, points, "Z"); }
  void line(const char* style, const Points& points) { path(style, points, ""); }
  void circle(const char* style, const Point& at, double radius_px) {
    text_ += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", style,
                         x(at), y(at), radius_px);
  }
  void label(const char* style, const Point& at, double dx_px, double dy_px,
             const std::string& words) {
    text_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", style,
                         x(at) + dx_px, y(at) + dy_px, words);
  }
  /// A line each metre, stronger each fifth.
  void grid() {
    for (int i = static_cast<int>(std::ceil(least_m_.x())); i <= most_m_.x(); ++i) {
      line(i % 5 == 0 ? "grid five" : "grid", {{i, least_m_.y()}, {i, most_m_.y()}});
      if (i % 5 == 0) {
        label("tick", {i, least_m_.y()}, 4.0, -5.0, fmt::format("{} m", i));
      }
    }
    for (int i = static_cast<int>(std::ceil(least_m_.y())); i <= most_m_.y(); ++i) {
      line(i % 5 == 0 ? "grid five" : "grid", {{least_m_.x(), i}, {most_m_.x(), i}});
      if (i % 5 == 0) {
        label("tick", {least_m_.x(), i}, 4.0, -4.0, fmt::format("{} m", i));
      }
    }
  }
  void ground() {
    area("soil", {{least_m_.x(), 0.0}, {most_m_.x(), 0.0}, {most_m_.x(), least_m_.y()}, least_m_});
    line("ground", {{least_m_.x(), 0.0}, {most_m_.x(), 0.0}});
  }
  void dimension(const Point& from, const Point& to, double dx_px, double dy_px,
                 const std::string& words) {
    line("dimension", {from, to});
    const Point across = Point(from.y() - to.y(), to.x() - from.x()).normalized() * 5.0 / scale_;
    for (const Point& end : {from, to}) {
      line("dimension", {end - across, end + across});
    }
    label("measure", 0.5 * (from + to), dx_px, dy_px, words);
  }
  [[nodiscard]] std::string end() const { return text_ + "</svg>\n"; }

 private:
  [[nodiscard]] double x(const Point& at) const { return scale_ * (at.x() - least_m_.x()); }
  [[nodiscard]] double y(const Point& at) const { return scale_ * (most_m_.y() - at.y()); }
  void path(const char* style, const Points& points, const char* close) {
    text_ += fmt::format("<path class=\"{}\" d=\"", style);
    for (std::size_t i = 0; i < points.size(); ++i) {
      text_ += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x(points[i]), y(points[i]));
    }
    text_ += fmt::format("{}\"/>\n", close);
  }

  Point least_m_;
  Point most_m_;
  double scale_;
  std::string text_;
};

Point turned(double angle_rad, const Point& point) {
  return {std::cos(angle_rad) * point.x() - std::sin(angle_rad) * point.y(),
          std::sin(angle_rad) * point.x() + std::cos(angle_rad) * point.y()};
}

/// Least of three neighbours: the inner bound is met by few of the poses that were tried.
double nearest_about(const Reach& reach, std::size_t i) {
  double least_m = reach.nearest_m[i];
  for (const std::size_t j : {i - 1, i + 1}) {
    if (j < reach.nearest_m.size() && reach.nearest_m[j] > 0.0) {
      least_m = std::min(least_m, reach.nearest_m[j]);
    }
  }
  return least_m;
}

/// The ring of all directions that the teeth can have from the boom foot.
Points ring(const Reach& reach) {
  const auto count = static_cast<double>(reach.farthest_m.size());
  Points outer;
  Points inner;
  for (std::size_t i = 0; i < reach.farthest_m.size(); ++i) {
    if (reach.farthest_m[i] > 0.0) {
      const double angle = kTwoPi * ((static_cast<double>(i) + 0.5) / count - 0.5);
      const Point direction(std::cos(angle), std::sin(angle));
      outer.emplace_back(reach.foot_m + reach.farthest_m[i] * direction);
      inner.emplace_back(reach.foot_m + nearest_about(reach, i) * direction);
    }
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  return outer;
}

void draw_links(Sheet& sheet, const ExcavatorGeometry& geometry, const Eigen::Vector3d& joints) {
  const Point foot = geometry.boom_foot_m;
  const double arm_rad = joints[0] + joints[1];
  const double bucket_rad = arm_rad + joints[2];
  const Point arm = foot + turned(joints[0], {geometry.boom_length_m, 0.0});
  const Point bucket = arm + turned(arm_rad, {geometry.arm_length_m, 0.0});
  const Point teeth = bucket + turned(bucket_rad, {geometry.bucket_length_m, 0.0});
  const auto on_boom = [&](const Point& p) -> Point { return foot + turned(joints[0], p); };
  const auto on_arm = [&](const Point& p) -> Point { return arm + turned(arm_rad, p); };
  const CylinderGeometry& boom = geometry.cylinder[kBoom];
  const CylinderGeometry& stick = geometry.cylinder[kArm];
  sheet.line("cylinder", {foot + boom.base_m, on_boom(boom.eye_m)});
  sheet.line("cylinder", {on_boom(stick.base_m), on_arm(stick.eye_m)});
  const Point lug = bucket + turned(bucket_rad, geometry.linkage.lug_m);
  // The rocker's end: on its circle about the pivot, a coupler's length from the lug, on the side
  // of the cylinder.
  const Point pivot = on_arm(geometry.linkage.rocker_pivot_m);
  const Point way = lug - pivot;
  const double apart = way.norm();
  const double along = (apart * apart + geometry.linkage.rocker_m * geometry.linkage.rocker_m -
                        geometry.linkage.coupler_m * geometry.linkage.coupler_m) /
                       (2.0 * apart);
  const double across = std::sqrt(
      std::max(0.0, geometry.linkage.rocker_m * geometry.linkage.rocker_m - along * along));
  const Point unit = way / apart;
  const Point rocker = pivot + along * unit + across * Point(-unit.y(), unit.x());
  sheet.line("link thin", {pivot, rocker, lug});
  sheet.line("cylinder", {on_arm(geometry.cylinder[kBucket].base_m), rocker});
  // Boom and arm as plates through their pins.
  sheet.area("link", {foot, on_boom(boom.eye_m), on_boom(stick.base_m), arm});
  sheet.area("link", {on_arm(stick.eye_m), on_arm(geometry.cylinder[kBucket].base_m), bucket,
                      on_arm({0.0, -0.12 * geometry.arm_length_m})});
  const double depth = 0.42 * geometry.bucket_length_m;
  sheet.area("link bucket",
             {bucket, lug, bucket + turned(bucket_rad, {0.55 * geometry.bucket_length_m, depth}),
              bucket + turned(bucket_rad, {0.9 * geometry.bucket_length_m, 0.6 * depth}), teeth});
  for (const Point& pin : {foot, arm, bucket}) {
    sheet.circle("pin", pin, 4.0);
  }
  sheet.circle("teeth", teeth, 4.0);
}

}  // namespace

std::string excavator_drawing(const ExcavatorProfile& profile, const Reach& reach) {
  const ExcavatorGeometry& geometry = profile.geometry;
  const Point foot = geometry.boom_foot_m;
  Sheet sheet({-2.6, std::min(reach.least_y_m, 0.0) - 0.9},
              {reach.most_x_m + 1.5, reach.most_y_m + 0.9}, 900.0);
  sheet.ground();
  sheet.grid();
  sheet.area("reach", ring(reach));
  sheet.area("body", {{-2.2, 0.35 * foot.y()},
                      {-2.2, 1.35 * foot.y()},
                      {-0.7, 1.45 * foot.y()},
                      {-0.6, 1.9 * foot.y()},
                      {0.5, 1.9 * foot.y()},
                      {0.9, 0.35 * foot.y()}});
  sheet.area("body track", {{-1.7, 0.0},
                            {-2.1, 0.15 * foot.y()},
                            {-1.8, 0.33 * foot.y()},
                            {1.4, 0.33 * foot.y()},
                            {1.7, 0.15 * foot.y()},
                            {1.3, 0.0}});
  const RoundedRectangle path(profile.dig_path);
  Points way;
  for (int i = 0; i < 120; ++i) {
    way.emplace_back(foot + path.at_share(i / 120.0).position_m);
  }
  sheet.area("path", way);
  sheet.label("measure", way.front(), 8.0, -8.0, "task.path");
  const DigPath& dig = profile.dig_path;
  const PathPoint at = path.closest({dig.x_max_m - dig.corner_radius_m, dig.y_max_m});
  const ExcavatorKinematics kinematics(geometry);
  const JointResult joints =
      kinematics.joints_from_pose({at.position_m.x(), at.position_m.y(), at.attitude_rad});
  if (joints.status == ReachStatus::kOk) {
    draw_links(sheet, geometry, joints.joints_rad);
  }
  sheet.line("axis", {{0.0, 0.0}, {0.0, reach.most_y_m}});
  const double above_m = reach.most_y_m + 0.35;
  sheet.dimension({0.0, above_m}, {reach.most_x_m, above_m}, -30.0, -7.0,
                  fmt::format("reach {:.2f} m", reach.most_x_m));
  sheet.dimension({0.0, -0.35}, {reach.ground_x_m, -0.35}, 150.0, 17.0,
                  fmt::format("at the ground {:.2f} m", reach.ground_x_m));
  const double beside_m = reach.most_x_m + 0.5;
  sheet.dimension({beside_m, 0.0}, {beside_m, reach.most_y_m}, 8.0, 0.0,
                  fmt::format("{:.2f} m", reach.most_y_m));
  sheet.dimension({beside_m, 0.0}, {beside_m, reach.least_y_m}, 8.0, 0.0,
                  fmt::format("{:.2f} m", -reach.least_y_m));
  return sheet.end();
}

std::string dozer_drawing(const DozerProfile& profile) {
  const BladeGeometry& blade = profile.blade;
  const BladeKinematics kinematics(blade);
  const double half_m = 0.5 * profile.body.track_contact_m;
  const Point farthest = kinematics.edge_m(0.0);
  const double front_m = farthest.x() + 1.0;
  Sheet sheet({-half_m - 1.2, std::min(blade.edge_min_m, 0.0) - 0.6}, {front_m, 2.6}, 900.0);
  sheet.ground();
  sheet.grid();
  sheet.area("body", {{-half_m, 0.55},
                      {-half_m, 1.35},
                      {-0.6, 1.4},
                      {-0.5, 2.35},
                      {0.35, 2.35},
                      {0.45, 1.4},
                      {half_m + 0.1, 1.3},
                      {half_m + 0.1, 0.55}});
  sheet.area("body track", {{-half_m, 0.0},
                            {-half_m - 0.35, 0.2},
                            {-half_m - 0.2, 0.6},
                            {half_m + 0.2, 0.6},
                            {half_m + 0.35, 0.2},
                            {half_m, 0.0}});
  Points sweep;
  for (int i = 0; i <= 40; ++i) {
    const double angle = kinematics.angle_min_rad() +
                         (kinematics.angle_max_rad() - kinematics.angle_min_rad()) * i / 40.0;
    sweep.emplace_back(kinematics.edge_m(angle));
  }
  const double arm_m = blade.arm_m.norm();
  const double arm_rad = std::atan2(blade.arm_m.y(), blade.arm_m.x());
  for (const double angle : {kinematics.angle_min_rad(), kinematics.angle_max_rad(), 0.0}) {
    const char* style = angle == 0.0 ? "link" : "link ghost";
    const Point foot = blade.pivot_m + turned(arm_rad + angle, {arm_m, 0.0});
    const Point edge = kinematics.edge_m(angle);
    const Point eye = blade.pivot_m + turned(arm_rad + angle, {kinematics.eye_radius_m(), 0.0});
    sheet.line(angle == 0.0 ? "cylinder" : "cylinder ghost", {blade.base_m, eye});
    sheet.line("link thin", {blade.pivot_m, foot});
    Points plate;
    for (const Point& at :
         {Point(0.0, 0.0), Point(-0.13, 0.28), Point(-0.14, 0.62), Point(0.02, 0.95),
          Point(-0.07, 0.99), Point(-0.24, 0.64), Point(-0.23, 0.26)}) {
      plate.emplace_back(edge + turned(angle, at));
    }
    sheet.area(style, plate);
    sheet.circle("teeth", edge, angle == 0.0 ? 4.0 : 2.5);
  }
  sheet.line("path", sweep);
  sheet.circle("pin", blade.pivot_m, 4.0);
  sheet.circle("pin", blade.base_m, 4.0);
  sheet.circle("centre", {0.0, profile.body.mass_centre_height_m}, 6.0);
  sheet.label("measure", {0.0, profile.body.mass_centre_height_m}, 10.0, 4.0, "mass centre");
  const double beside_m = farthest.x() + 0.35;
  sheet.dimension({beside_m, 0.0}, {beside_m, blade.edge_max_m}, 8.0, 0.0,
                  fmt::format("{:.2f} m", blade.edge_max_m));
  sheet.dimension({beside_m, 0.0}, {beside_m, blade.edge_min_m}, 8.0, 4.0,
                  fmt::format("{:.2f} m", -blade.edge_min_m));
  sheet.dimension({-half_m, -0.25}, {half_m, -0.25}, -60.0, 17.0,
                  fmt::format("track contact {:.2f} m", 2.0 * half_m));
  return sheet.end();
}

}  // namespace graben::reports
