// SPDX-License-Identifier: Apache-2.0
#include "app/built/built_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

namespace graben::built {
namespace {

/// Two heights of a design that differ by less are one, rounded, m.
constexpr double kSameHeight_m = 1e-3;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Of points by their cells.
class Index {
 public:
  explicit Index(const std::vector<BuiltPoint>& points) {
    for (std::uint32_t n = 0; n < points.size(); ++n) {
      place_.emplace(cell_key(points[n].cell), n);
    }
  }
  [[nodiscard]] std::uint32_t of(const CellPlace& cell) const {
    const auto found = place_.find(cell_key(cell));
    return found == place_.end() ? kNone : found->second;
  }

 private:
  std::unordered_map<std::uint64_t, std::uint32_t> place_;
};

/// Of each square of four neighbours two triangles; of three of them one.
void join(BuiltGround& ground) {
  const Index index(ground.point);
  const auto add = [&ground](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    ground.face.push_back({a, b, c});
  };
  const auto square = [&](const CellPlace& corner) {
    const std::uint32_t a = index.of(corner);
    const std::uint32_t b = index.of({corner.i + 1, corner.j});
    const std::uint32_t c = index.of({corner.i + 1, corner.j + 1});
    const std::uint32_t d = index.of({corner.i, corner.j + 1});
    if (a != kNone && b != kNone && c != kNone && d != kNone) {
      add(a, b, c);
      add(a, c, d);
    } else if (b != kNone && d != kNone && (a != kNone || c != kNone)) {
      a != kNone ? add(a, b, d) : add(b, c, d);
    } else if (a != kNone && c != kNone && (b != kNone || d != kNone)) {
      b != kNone ? add(a, b, c) : add(a, c, d);
    }
  };
  for (const BuiltPoint& point : ground.point) {
    square(point.cell);
    // A square whose first corner is no cell is seen from its second or its fourth.
    if (index.of({point.cell.i - 1, point.cell.j}) == kNone) {
      square({point.cell.i - 1, point.cell.j});
    }
  }
}

}  // namespace

BuiltGround built_ground(const CellGrid& grid, BuiltHeight height) {
  BuiltGround ground;
  ground.grid_m = grid.grid_m();
  for (const auto& [place, cell] : grid.sorted()) {
    BuiltPoint point;
    const bool lowest = height == BuiltHeight::kLowest;
    const Eigen::Vector2d centre_m = grid.centre_m(place);
    point.cell = place;
    point.at_m = {centre_m.x(), centre_m.y(), lowest ? cell.lowest_m : cell.newest_m};
    point.time_s = lowest ? cell.lowest_s : cell.newest_s;
    point.lowest_m = cell.lowest_m;
    point.newest_m = cell.newest_m;
    point.passes = cell.passes;
    ground.point.push_back(point);
  }
  join(ground);
  return ground;
}

std::size_t fallen_in(const BuiltGround& ground) {
  return static_cast<std::size_t>(std::count_if(
      ground.point.begin(), ground.point.end(),
      [](const BuiltPoint& point) { return point.newest_m - point.lowest_m >= kFallen_m; }));
}

void lay_over(const design::Surface& design, BuiltGround& ground) {
  const Index index(ground.point);
  bool any = false;
  for (const auto& face : design.face) {
    ground::over_cells(
        design.point_m[face[0]], design.point_m[face[1]], design.point_m[face[2]], ground.grid_m,
        [&](const CellPlace& cell, double height_m) {
          const std::uint32_t n = index.of(cell);
          if (n == kNone) {
            return;
          }
          BuiltPoint& point = ground.point[n];
          const double off_m = point.at_m.z() - height_m;
          if (std::abs(point.off_m - off_m) > kSameHeight_m) {
            throw std::runtime_error(fmt::format(
                "the design has two heights at x = {:.2f}, y = {:.2f} m: {:.3f} and {:.3f} "
                "m; allowed: one",
                point.at_m.x(), point.at_m.y(), point.at_m.z() - point.off_m, height_m));
          }
          point.off_m = off_m;
          any = true;
        });
  }
  if (!any) {
    Eigen::Vector3d least = design.point_m.front();
    Eigen::Vector3d most = least;
    for (const Eigen::Vector3d& at_m : design.point_m) {
      least = least.cwiseMin(at_m);
      most = most.cwiseMax(at_m);
    }
    Eigen::Vector3d from_m = ground.point.front().at_m;
    Eigen::Vector3d to_m = from_m;
    for (const BuiltPoint& point : ground.point) {
      from_m = from_m.cwiseMin(point.at_m);
      to_m = to_m.cwiseMax(point.at_m);
    }
    throw std::runtime_error(fmt::format(
        "the design does not lie under the machine: it reaches from x = {:.1f}, y = {:.1f} to "
        "{:.1f}, {:.1f} m, the ground that the machine has made from {:.1f}, {:.1f} to {:.1f}, "
        "{:.1f} m of its own frame",
        least.x(), least.y(), most.x(), most.y(), from_m.x(), from_m.y(), to_m.x(), to_m.y()));
  }
}

DesignFigures design_figures(const BuiltGround& ground, double tolerance_m) {
  DesignFigures figures;
  const double cell_m2 = ground.grid_m * ground.grid_m;
  std::vector<double> far_m;
  double square_m2 = 0.0;
  std::size_t within = 0;
  figures.highest_m = -std::numeric_limits<double>::infinity();
  figures.lowest_m = std::numeric_limits<double>::infinity();
  for (const BuiltPoint& point : ground.point) {
    if (!std::isfinite(point.off_m)) {
      figures.outside_m2 += cell_m2;
      continue;
    }
    far_m.push_back(std::abs(point.off_m));
    square_m2 += point.off_m * point.off_m;
    within += far_m.back() <= tolerance_m ? 1 : 0;
    figures.highest_m = std::max(figures.highest_m, point.off_m);
    figures.lowest_m = std::min(figures.lowest_m, point.off_m);
    figures.cut_m3 += cell_m2 * std::max(0.0, point.off_m);
    figures.fill_m3 += cell_m2 * std::max(0.0, -point.off_m);
  }
  figures.cells = far_m.size();
  if (far_m.empty()) {
    figures.highest_m = figures.lowest_m = 0.0;
    return figures;
  }
  const auto count = static_cast<double>(far_m.size());
  figures.area_m2 = cell_m2 * count;
  figures.rms_m = std::sqrt(square_m2 / count);
  figures.within_ratio = static_cast<double>(within) / count;
  const auto at = static_cast<std::ptrdiff_t>(std::ceil(0.95 * count)) - 1;
  std::nth_element(far_m.begin(), far_m.begin() + at, far_m.end());
  figures.p95_m = far_m[static_cast<std::size_t>(at)];
  return figures;
}

}  // namespace graben::built
