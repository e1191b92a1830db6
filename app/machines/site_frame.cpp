// SPDX-License-Identifier: Apache-2.0
#include "app/machines/site_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/machines/toml_reader.hpp"

namespace graben::machines {
namespace {

constexpr Range kOfSite{-2e7, 2e7, "m"};
constexpr Range kOfMachine{-30.0, 30.0, "m"};
constexpr int kMostTouched = 8;

Eigen::Vector3d turned(const Eigen::Vector3d& of, double angle_rad) {
  const double cosine = std::cos(angle_rad);
  const double sine = std::sin(angle_rad);
  return {cosine * of.x() - sine * of.y(), sine * of.x() + cosine * of.y(), of.z()};
}

Eigen::Vector3d three(TomlReader& reader, const std::string& key, const Range& range,
                      const char* help) {
  const std::vector<double> values = reader.numbers(key, range, 3, help);
  return {values[0], values[1], values[2]};
}

double apart_m(const std::vector<TouchedPoint>& points) {
  double most_m = 0.0;
  for (const TouchedPoint& one : points) {
    for (const TouchedPoint& other : points) {
      most_m = std::max(most_m, std::min((one.site_m - other.site_m).head<2>().norm(),
                                         (one.machine_m - other.machine_m).head<2>().norm()));
    }
  }
  return most_m;
}

/// Benchmark and second point can be touched at run time.
void can_touch(TomlReader& reader, const char* key, const Eigen::Vector3d& second_m,
               SiteSection& site) {
  const double far_m = (second_m - site.frame.benchmark_m).head<2>().norm();
  if (far_m < kLeastApart_m) {
    reader.fail(key, fmt::format("{:.2f} m from the benchmark, seen from above; allowed: {} m and "
                                 "more, or the heading is not known",
                                 far_m, kLeastApart_m));
    return;
  }
  site.points.can_touch = true;
  site.points.benchmark_m = site.frame.touched_m;
  site.points.second_m = site.frame.to_machine(second_m);
}

/// The touched points; the farthest from the benchmark is the second one.
SiteSection read_points(TomlReader& reader) {
  SiteSection site;
  const int count = reader.table_count("site.point", 2, kMostTouched,
                                       "touched points, a table each, the benchmark first");
  std::vector<TouchedPoint> points;
  for (int i = 0; i < (reader.lists() ? 1 : count); ++i) {
    const std::string at = fmt::format("site.point[{}]", i);
    points.push_back({three(reader, at + ".place", kOfSite, "east, north and height of a point"),
                      three(reader, at + ".touched", kOfMachine,
                            "x, y and z of the teeth as they stood on it")});
  }
  const double bound_m = reader.number_or(kUsualBound_m, "site.bound", {0.002, 0.5, "m"},
                                          "so far the touched points may contradict each other");
  if (!reader.is_sound() || reader.lists()) {
    return site;
  }
  try {
    site.frame = fit_site(points, bound_m).frame;
  } catch (const std::runtime_error& error) {
    reader.fail("site.point", error.what());
    return site;
  }
  const Eigen::Vector3d first_m = points.front().site_m;
  const auto far_m = [&first_m](const TouchedPoint& point) {
    return (point.site_m - first_m).head<2>().norm();
  };
  const auto second = std::max_element(points.begin(), points.end(),
                                       [&](const TouchedPoint& one, const TouchedPoint& other) {
                                         return far_m(one) < far_m(other);
                                       });
  if (far_m(*second) >= kLeastApart_m) {
    can_touch(reader, "site.point", second->site_m, site);
  }
  return site;
}

}  // namespace

Eigen::Vector3d SiteFrame::to_site(const Eigen::Vector3d& machine_m) const {
  return benchmark_m + turned(machine_m - touched_m, heading_rad);
}

Eigen::Vector3d SiteFrame::to_machine(const Eigen::Vector3d& site_m) const {
  return touched_m + turned(site_m - benchmark_m, -heading_rad);
}

Eigen::Vector3d SiteFrame::turned_to_machine(const Eigen::Vector3d& direction) const {
  return turned(direction, -heading_rad);
}

SiteFit fit_site(const std::vector<TouchedPoint>& points, double bound_m) {
  if (points.size() < 2) {
    throw std::runtime_error(fmt::format(
        "{} touched points; allowed: 2 and more, the first of them the benchmark", points.size()));
  }
  const double far_m = apart_m(points);
  if (far_m < kLeastApart_m) {
    throw std::runtime_error(
        fmt::format("the touched points lie {:.2f} m apart, seen from above; allowed: {} m and "
                    "more, or the heading is not known",
                    far_m, kLeastApart_m));
  }
  SiteFit fit;
  fit.frame.benchmark_m = points.front().site_m;
  fit.frame.touched_m = points.front().machine_m;
  double along = 0.0;
  double across = 0.0;
  for (const TouchedPoint& point : points) {
    const Eigen::Vector3d there = point.site_m - fit.frame.benchmark_m;
    const Eigen::Vector3d here = point.machine_m - fit.frame.touched_m;
    along += here.x() * there.x() + here.y() * there.y();
    across += here.x() * there.y() - here.y() * there.x();
  }
  fit.frame.heading_rad = std::atan2(across, along);
  fit.heading_off_rad = bound_m / far_m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d off_m = fit.frame.to_machine(points[i].site_m) - points[i].machine_m;
    const double plan_m = off_m.head<2>().norm();
    const double most_m = std::max(plan_m, std::abs(off_m.z()));
    if (!(most_m <= bound_m)) {
      throw std::runtime_error(
          fmt::format("touched point {}: {:.3f} m in plan and {:+.3f} m in height from where the "
                      "others have it; allowed: {} m",
                      i + 1, plan_m, -off_m.z(), bound_m));
    }
    fit.most_off_m = std::max(fit.most_off_m, most_m);
  }
  return fit;
}

bool SiteSection::is_like(const SiteSection& other) const {
  constexpr double kSame = 1e-6;
  return (frame.benchmark_m - other.frame.benchmark_m).norm() < kSame &&
         (frame.touched_m - other.frame.touched_m).norm() < kSame &&
         std::abs(frame.heading_rad - other.frame.heading_rad) < kSame &&
         points.can_touch == other.points.can_touch && points.by_touch == other.points.by_touch &&
         (points.second_m - other.points.second_m).norm() < kSame;
}

SiteSection read_site(TomlReader& reader) {
  if (reader.lists()) {
    static_cast<void>(read_points(reader));
  } else if (reader.has("site.point")) {
    return read_points(reader);
  }
  SiteSection site;
  SiteFrame& frame = site.frame;
  frame.benchmark_m =
      three(reader, "site.benchmark", kOfSite, "east, north and height of a place of the site");
  const bool has_second = reader.has("site.second");
  site.points.by_touch = has_second && !reader.has("site.touched") && !reader.has("site.heading");
  if (!site.points.by_touch || reader.lists()) {
    frame.touched_m = three(reader, "site.touched", kOfMachine,
                            "x, y and z of the teeth as they stood on the benchmark");
    frame.heading_rad =
        reader.number("site.heading", {-6.3, 6.3, "rad"},
                      "of the machine's x axis (swing 0) against east, to the left");
  }
  if (has_second || reader.lists()) {
    const Eigen::Vector3d second_m =
        three(reader, "site.second", kOfSite,
              "east, north and height of another place, for touching the heading at run time");
    if (reader.is_sound()) {
      can_touch(reader, "site.second", second_m, site);
    }
  }
  return site;
}

std::string site_text(const SiteFrame& frame) {
  const auto list = [](const Eigen::Vector3d& of) {
    return fmt::format("[{:.4f}, {:.4f}, {:.4f}]", of.x(), of.y(), of.z());
  };
  return fmt::format("[site]\nbenchmark = {}\ntouched = {}\nheading = {:.6f}\n",
                     list(frame.benchmark_m), list(frame.touched_m), frame.heading_rad);
}

}  // namespace graben::machines
