// SPDX-License-Identifier: Apache-2.0
#include "app/design/surface_grid.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace graben::design {
namespace {

/// Of two faces at one place: more is no rounding of a file's numbers.
constexpr double kOneHeight_m = 2e-3;
constexpr double kNoData = -9999.0;

/// Lowest and highest index of cells in a range, within a grid.
struct Cells {
  int first = 0;
  int last = -1;

  Cells(double from_m, double to_m, double begin_m, double step_m, int count)
      : first(static_cast<int>(std::max(0.0, std::ceil((from_m - begin_m) / step_m - kDust)))),
        last(static_cast<int>(
            std::min(count - 1.0, std::floor((to_m - begin_m) / step_m + kDust)))) {}

 private:
  static constexpr double kDust = 1e-9;
};

class Rasteriser {
 public:
  explicit Rasteriser(machines::HeightGrid& grid) : grid_(grid) {}

  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const double area_m2 = cross(b - a, c - a);
    const Eigen::Vector2d low = a.head<2>().cwiseMin(b.head<2>()).cwiseMin(c.head<2>());
    const Eigen::Vector2d high = a.head<2>().cwiseMax(b.head<2>()).cwiseMax(c.head<2>());
    const Cells columns(low.x(), high.x(), grid_.first_m.x(), grid_.step_m, grid_.columns);
    const Cells rows(low.y(), high.y(), grid_.first_m.y(), grid_.step_m, grid_.rows);
    // A place on an edge belongs to both faces.
    constexpr double kOnEdge = -1e-9;
    for (int row = rows.first; row <= rows.last; ++row) {
      for (int column = columns.first; column <= columns.last; ++column) {
        const Eigen::Vector2d at_m = grid_.first_m + grid_.step_m * Eigen::Vector2d(column, row);
        const Eigen::Vector3d at(at_m.x(), at_m.y(), 0.0);
        const double of_c = cross(b - a, at - a) / area_m2;
        const double of_b = cross(at - a, c - a) / area_m2;
        const double of_a = 1.0 - of_b - of_c;
        if (of_a >= kOnEdge && of_b >= kOnEdge && of_c >= kOnEdge) {
          put(column, row, of_a * a.z() + of_b * b.z() + of_c * c.z());
        }
      }
    }
  }

 private:
  static double cross(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    return u.x() * v.y() - u.y() * v.x();
  }

  void put(int column, int row, double height_m) {
    double& known_m = grid_.at(column, row);
    if (!std::isnan(known_m) && std::abs(known_m - height_m) > kOneHeight_m) {
      const Eigen::Vector2d at_m = grid_.first_m + grid_.step_m * Eigen::Vector2d(column, row);
      throw std::runtime_error(fmt::format(
          "the surface is {:.3f} and {:.3f} m high at {:.2f} m east, {:.2f} m north; allowed: one "
          "height a place",
          known_m, height_m, at_m.x(), at_m.y()));
    }
    known_m = std::isnan(known_m) ? height_m : std::max(known_m, height_m);
  }

  machines::HeightGrid& grid_;
};

}  // namespace

machines::HeightGrid grid_of(const Surface& surface, const GridCut& cut) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const auto& face : surface.face) {
    for (const std::uint32_t corner : face) {
      low = low.cwiseMin(surface.point_m[corner].head<2>());
      high = high.cwiseMax(surface.point_m[corner].head<2>());
    }
  }
  const Eigen::Vector2d whole_low = low;
  const Eigen::Vector2d whole_high = high;
  if (cut.around_m) {
    low = low.cwiseMax((cut.around_m->array() - cut.half_m).matrix());
    high = high.cwiseMin((cut.around_m->array() + cut.half_m).matrix());
  }
  if (!((high - low).minCoeff() > cut.step_m)) {
    throw std::runtime_error(fmt::format(
        "nothing of the surface is there; it reaches from {:.2f} m east, {:.2f} m north to {:.2f}, "
        "{:.2f}",
        whole_low.x(), whole_low.y(), whole_high.x(), whole_high.y()));
  }
  machines::HeightGrid grid;
  grid.step_m = cut.step_m;
  // On whole steps, so that two cuts of a surface have the same places.
  grid.first_m = ((low / cut.step_m).array().ceil() * cut.step_m).matrix();
  const Eigen::Vector2d count = ((high - grid.first_m) / cut.step_m).array().floor() + 1.0;
  if (!(count.x() * count.y() <= static_cast<double>(machines::kMostCells))) {
    throw std::runtime_error(
        fmt::format("{:.0f} by {:.0f} heights; allowed: {} in all; --around and --half cut a part "
                    "out, a larger "
                    "--step makes fewer",
                    count.x(), count.y(), machines::kMostCells));
  }
  grid.columns = static_cast<int>(count.x());
  grid.rows = static_cast<int>(count.y());
  grid.height_m.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                       std::numeric_limits<double>::quiet_NaN());
  Rasteriser rasteriser(grid);
  for (const auto& face : surface.face) {
    rasteriser.add(surface.point_m[face[0]], surface.point_m[face[1]], surface.point_m[face[2]]);
  }
  return grid;
}

double height_at(const Surface& surface, const Eigen::Vector2d& place_m) {
  for (const auto& face : surface.face) {
    const Eigen::Vector3d& a = surface.point_m[face[0]];
    Eigen::Matrix2d sides;
    sides.col(0) = (surface.point_m[face[1]] - a).head<2>();
    sides.col(1) = (surface.point_m[face[2]] - a).head<2>();
    const Eigen::Vector2d share = sides.inverse() * (place_m - a.head<2>());
    if (share.minCoeff() >= 0.0 && share.sum() <= 1.0) {
      return a.z() + share.x() * (surface.point_m[face[1]].z() - a.z()) +
             share.y() * (surface.point_m[face[2]].z() - a.z());
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string ascii_grid_text(const machines::HeightGrid& grid) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to,
                 "ncols {}\nnrows {}\nxllcenter {:.4f}\nyllcenter {:.4f}\ncellsize {}\n"
                 "NODATA_value {}\n",
                 grid.columns, grid.rows, grid.first_m.x(), grid.first_m.y(), grid.step_m, kNoData);
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double height_m = grid.at(column, row);
      if (std::isnan(height_m)) {
        fmt::format_to(to, "{}{}", column == 0 ? "" : " ", kNoData);
      } else {
        fmt::format_to(to, "{}{:.4f}", column == 0 ? "" : " ", height_m);
      }
    }
    fmt::format_to(to, "\n");
  }
  return fmt::to_string(text);
}

}  // namespace graben::design
