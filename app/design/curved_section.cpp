// SPDX-License-Identifier: Apache-2.0
#include "app/design/curved_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace graben::design {
namespace {

/// Two triangles that share an edge differ in height by rounding alone.
constexpr double kOneHeight_m = 1e-3;
/// On an edge counts as inside; so does what files' rounding leaves outside of all.
constexpr double kOnEdge_m = 1e-7;
constexpr double kRounding_m = 1e-3;
constexpr int kMostCells = 2000;
constexpr double kLengthGrid_m = 1e-4;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Triangles by the cells of a grid that they reach over.
class HeightField {
 public:
  explicit HeightField(const Surface& surface) : surface_(surface) {
    least_ = surface.point_m.front().head<2>();
    Eigen::Vector2d most = least_;
    for (const Eigen::Vector3d& at : surface.point_m) {
      least_ = least_.cwiseMin(at.head<2>());
      most = most.cwiseMax(at.head<2>());
    }
    const double side = std::sqrt(static_cast<double>(surface.face.size()));
    count_ = std::clamp(static_cast<int>(side), 1, kMostCells);
    cell_m_ = ((most - least_) / count_).cwiseMax(1e-3);
    cell_.resize(static_cast<std::size_t>(count_) * static_cast<std::size_t>(count_));
    for (std::uint32_t i = 0; i < surface.face.size(); ++i) {
      enter(i);
    }
  }

  /// None where there is no triangle. Throws where there are two heights.
  [[nodiscard]] std::optional<double> height_m(const Eigen::Vector2d& at_m) const {
    const auto inside_m = height_m(at_m, kOnEdge_m);
    return inside_m ? inside_m : height_m(at_m, kRounding_m);
  }

 private:
  [[nodiscard]] std::optional<double> height_m(const Eigen::Vector2d& at_m,
                                               double outside_m) const {
    std::optional<double> height_m;
    for (const std::uint32_t i : cell_[cell_of(index(at_m.x(), 0), index(at_m.y(), 1))]) {
      const auto here_m = height_on(surface_.face[i], at_m, outside_m);
      if (here_m && height_m && std::abs(*here_m - *height_m) > kOneHeight_m) {
        throw std::runtime_error(fmt::format(
            "the surface is {:.3f} and {:.3f} m high at x = {:.3f}, y = {:.3f} m; allowed: one "
            "height a place",
            *height_m, *here_m, at_m.x(), at_m.y()));
      }
      height_m = here_m ? here_m : height_m;
    }
    return height_m;
  }

  [[nodiscard]] int index(double at_m, unsigned axis) const {
    return static_cast<int>(std::clamp((at_m - least_[axis]) / cell_m_[axis], 0.0, count_ - 1.0));
  }
  [[nodiscard]] std::size_t cell_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(count_) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] Eigen::Vector2d corner(std::uint32_t point) const {
    return surface_.point_m[point].head<2>();
  }

  void enter(std::uint32_t number) {
    const auto& face = surface_.face[number];
    const Eigen::Vector2d least =
        corner(face[0]).cwiseMin(corner(face[1])).cwiseMin(corner(face[2]));
    const Eigen::Vector2d most =
        corner(face[0]).cwiseMax(corner(face[1])).cwiseMax(corner(face[2]));
    for (int y = index(least.y(), 1); y <= index(most.y(), 1); ++y) {
      for (int x = index(least.x(), 0); x <= index(most.x(), 0); ++x) {
        cell_[cell_of(x, y)].push_back(number);
      }
    }
  }

  [[nodiscard]] std::optional<double> height_on(const std::array<std::uint32_t, 3>& face,
                                                const Eigen::Vector2d& at_m,
                                                double outside_m) const {
    const Eigen::Vector2d a = corner(face[0]);
    const Eigen::Vector2d along = corner(face[1]) - a;
    const Eigen::Vector2d beside = corner(face[2]) - a;
    const double area = cross(along, beside);
    if (std::abs(area) < 1e-12) {
      return std::nullopt;
    }
    const double second = cross(at_m - a, beside) / area;
    const double third = cross(along, at_m - a) / area;
    const double per_m = outside_m / std::abs(area);
    if (second < -per_m * beside.norm() || third < -per_m * along.norm() ||
        second + third > 1.0 + per_m * (beside - along).norm()) {
      return std::nullopt;
    }
    const auto z = [&](unsigned i) { return surface_.point_m[face[i]].z(); };
    return z(0) + second * (z(1) - z(0)) + third * (z(2) - z(0));
  }

  const Surface& surface_;
  Eigen::Vector2d least_;
  Eigen::Vector2d cell_m_;
  int count_ = 1;
  std::vector<std::vector<std::uint32_t>> cell_;
};

/// Height so far left of the track.
double height_beside(const HeightField& field, const PlanStation& at, double station_m,
                     double left_m) {
  const double direction = at.piece->direction_at_rad(at.along_m);
  const Eigen::Vector2d place = at.piece->at_m(at.along_m) +
                                left_m * Eigen::Vector2d(-std::sin(direction), std::cos(direction));
  const auto height_m = field.height_m(place);
  if (!height_m) {
    throw std::runtime_error(
        fmt::format("the surface has a hole at station {:.2f} m, {:.2f} m left of the track, x = "
                    "{:.3f}, y = {:.3f} m; allowed: none under track and blade",
                    station_m, left_m, place.x(), place.y()));
  }
  return *height_m;
}

void demand_makeable(double station_m, double crown_m, double slope, const BladeAcross& blade) {
  if (std::abs(crown_m) > blade.tolerance_m) {
    throw std::runtime_error(fmt::format(
        "under the track the surface is {:.3f} m {} than straight between the ends of the blade at "
        "station {:.2f} m; allowed: {} .. {} m (grade.tolerance): the cutting edge is straight",
        std::abs(crown_m), crown_m > 0.0 ? "higher" : "lower", station_m, -blade.tolerance_m,
        blade.tolerance_m));
  }
  if (std::abs(slope) > machines::kMostCross) {
    throw std::runtime_error(
        fmt::format("the surface has a slope of {:.3f} across the track at station {:.2f} m; "
                    "allowed: {} .. {}",
                    slope, station_m, -machines::kMostCross, machines::kMostCross));
  }
}

void demand_driveable(const PlanTrack& track, const BladeAcross& blade) {
  const double length_m = track.length_m();
  demand_track_length(length_m);
  double station_m = 0.0;
  for (const TrackPiece& piece : track.piece) {
    if (std::abs(piece.curvature_pm) > machines::kMostCurvature_pm) {
      throw std::runtime_error(fmt::format(
          "the track has a radius of {:.2f} m from station {:.2f} m on; allowed: at least {} m",
          1.0 / std::abs(piece.curvature_pm), station_m, 1.0 / machines::kMostCurvature_pm));
    }
    if (!blade.tilts && piece.curvature_pm != 0.0) {
      throw std::runtime_error(fmt::format(
          "the track curves from station {:.2f} m on; allowed: a straight one, this machine's "
          "blade has no tilt, and its edge lies askew to a curve",
          station_m));
    }
    station_m += piece.length_m;
  }
}

}  // namespace

machines::DesignLine along_curved_track(const Surface& surface, const PlanTrack& track,
                                        double datum_m, const BladeAcross& blade) {
  demand_driveable(track, blade);
  const HeightField field(surface);
  const double half_m = 0.5 * blade.width_m;
  // Files round their numbers; what the design's own has is as long.
  const double length_m = std::round(track.length_m() / kLengthGrid_m) * kLengthGrid_m;
  const int steps = std::max(1, static_cast<int>(std::lround(length_m / kSectionStep_m)));
  machines::DesignLine line;
  for (int i = 0; i <= steps; ++i) {
    const double station_m = length_m * i / steps;
    const PlanStation at = station_of(track, station_m);
    const double middle_m = height_beside(field, at, station_m, 0.0);
    const double left_m = height_beside(field, at, station_m, half_m);
    const double right_m = height_beside(field, at, station_m, -half_m);
    const double slope = (left_m - right_m) / blade.width_m;
    demand_makeable(station_m, middle_m - 0.5 * (left_m + right_m), slope, blade);
    line.corners.push_back({station_m, middle_m - datum_m});
    line.cross.push_back(slope);
    line.curvature.push_back(at.piece->curvature_pm);
  }
  return line;
}

}  // namespace graben::design
