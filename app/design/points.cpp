// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "app/design/surface.hpp"
#include "app/machines/number_lines.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::design {
namespace {

using GridPoint = boost::polygon::point_data<int>;

/// Finer than any survey, coarse enough for whole numbers over 400 km.
constexpr double kGrid_m = 1e-4;
constexpr double kMostExtent_m = 2e5;

std::vector<Eigen::Vector3d> points_of(const std::filesystem::path& file) {
  std::vector<Eigen::Vector3d> points;
  machines::read_number_lines(
      file, {3, "x, y and z, m", kMostPoints}, [&](std::size_t, const machines::LineOfNumbers& at) {
        for (unsigned i = 0; i < 3; ++i) {
          const double most_m = i == 2 ? kMostHeight_m : kMostPlan_m;
          if (std::abs(at[i]) > most_m) {
            return fmt::format("{} = {} m; allowed: {} .. {} m", "xyz"[i], at[i], -most_m, most_m);
          }
        }
        points.emplace_back(at[0], at[1], at[2]);
        return std::string();
      });
  return points;
}

/// On the grid about their middle, each place once.
std::vector<GridPoint> on_grid(const std::filesystem::path& file, Surface& surface) {
  Eigen::Vector3d least = surface.point_m.front();
  Eigen::Vector3d most = least;
  for (const Eigen::Vector3d& at : surface.point_m) {
    least = least.cwiseMin(at);
    most = most.cwiseMax(at);
  }
  if ((most - least).head<2>().maxCoeff() > kMostExtent_m) {
    throw machines::ProfileError(file.string(),
                                 {fmt::format("reaches over {:.0f} m; allowed: at most {:.0f} m",
                                              (most - least).head<2>().maxCoeff(), kMostExtent_m)});
  }
  const Eigen::Vector3d middle = 0.5 * (least + most);
  std::map<std::pair<int, int>, double> height_m;
  for (const Eigen::Vector3d& at : surface.point_m) {
    const auto line = [&](unsigned i) {
      return static_cast<int>(std::lround((at[i] - middle[i]) / kGrid_m));
    };
    const auto [there, is_new] = height_m.try_emplace({line(0), line(1)}, at.z());
    if (!is_new && std::abs(there->second - at.z()) > kGrid_m) {
      throw machines::ProfileError(
          file.string(), {fmt::format("two points at x = {}, y = {} m, {} and {} m high; allowed: "
                                      "one height a place",
                                      at.x(), at.y(), there->second, at.z())});
    }
  }
  std::vector<GridPoint> grid;
  surface.point_m.clear();
  for (const auto& [at, z_m] : height_m) {
    grid.emplace_back(at.first, at.second);
    surface.point_m.emplace_back(middle.x() + at.first * kGrid_m, middle.y() + at.second * kGrid_m,
                                 z_m);
  }
  return grid;
}

/// Each corner of Voronoi's diagram is the centre of a circle through three points or more with
/// none inside: a fan of Delaunay's triangles.
void triangulate(const std::vector<GridPoint>& grid, Surface& surface) {
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(grid.begin(), grid.end(), &diagram);
  std::vector<std::uint32_t> about;
  for (const auto& corner : diagram.vertices()) {
    about.clear();
    const auto* edge = corner.incident_edge();
    do {
      about.push_back(static_cast<std::uint32_t>(edge->cell()->source_index()));
      edge = edge->rot_next();
    } while (edge != corner.incident_edge());
    for (std::size_t i = 2; i < about.size(); ++i) {
      surface.face.push_back({about[0], about[i - 1], about[i]});
    }
  }
}

}  // namespace

Surface read_points(const std::filesystem::path& file) {
  Surface surface{points_of(file), {}};
  if (!surface.point_m.empty()) {
    triangulate(on_grid(file, surface), surface);
  }
  if (surface.face.empty()) {
    throw machines::ProfileError(
        file.string(), {fmt::format("{} points make no triangle; allowed: 3 and more, not in line",
                                    surface.point_m.size())});
  }
  return surface;
}

}  // namespace graben::design
