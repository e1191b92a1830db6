// SPDX-License-Identifier: Apache-2.0
#include "app/design/track_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

namespace graben::design {
namespace {

constexpr double kLeastLength_m = 1.0;
constexpr double kMostLength_m = 1000.0;
constexpr double kMostBend_rad = 1e-3;
/// Two corners that are nearer are one; a hole that is narrower is none.
constexpr double kSame_m = 1e-5;
constexpr double kHole_m = 1e-3;
/// Two triangles that share an edge differ in height by rounding alone.
constexpr double kOneHeight_m = 1e-3;

/// A piece of the section, over one triangle.
struct Piece {
  GradePoint from;
  GradePoint to;
};

/// Straight lines along and across the track.
class Frame {
 public:
  Frame(const Track& track, double across_m)
      : from_m_(track.from_m),
        along_((track.to_m - track.from_m).normalized()),
        left_(-along_.y(), along_.x()),
        across_m_(across_m) {}

  [[nodiscard]] double along_m(const Eigen::Vector3d& at) const {
    return along_.dot(at.head<2>() - from_m_);
  }
  [[nodiscard]] double across_m(const Eigen::Vector3d& at) const {
    return left_.dot(at.head<2>() - from_m_) - across_m_;
  }

 private:
  Eigen::Vector2d from_m_;
  Eigen::Vector2d along_;
  Eigen::Vector2d left_;
  double across_m_;
};

/// Where the line cuts the triangle; its ends are one where it only touches it.
bool cut(const Surface& surface, const std::array<std::uint32_t, 3>& face, const Frame& frame,
         Piece& piece) {
  std::array<double, 3> off_m{};
  for (unsigned i = 0; i < 3; ++i) {
    off_m[i] = frame.across_m(surface.point_m[face[i]]);
  }
  if ((off_m[0] > 0.0 && off_m[1] > 0.0 && off_m[2] > 0.0) ||
      (off_m[0] < 0.0 && off_m[1] < 0.0 && off_m[2] < 0.0)) {
    return false;
  }
  bool found = false;
  const auto take = [&](const Eigen::Vector3d& at) {
    const GradePoint corner{frame.along_m(at), at.z()};
    piece.from = !found || corner.x_m < piece.from.x_m ? corner : piece.from;
    piece.to = !found || corner.x_m > piece.to.x_m ? corner : piece.to;
    found = true;
  };
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned j = (i + 1) % 3;
    const Eigen::Vector3d& from = surface.point_m[face[i]];
    const Eigen::Vector3d& to = surface.point_m[face[j]];
    if (off_m[i] == 0.0) {
      take(from);
    }
    if ((off_m[i] > 0.0 && off_m[j] < 0.0) || (off_m[i] < 0.0 && off_m[j] > 0.0)) {
      take(from + off_m[i] / (off_m[i] - off_m[j]) * (to - from));
    }
  }
  return found && piece.to.x_m - piece.from.x_m > kSame_m;
}

double height_on(const Piece& piece, double x_m) {
  const double share = (x_m - piece.from.x_m) / (piece.to.x_m - piece.from.x_m);
  return piece.from.z_m + share * (piece.to.z_m - piece.from.z_m);
}

/// What lies over the track's length, in order.
std::vector<Piece> pieces_of(const Surface& surface, const Track& track, double across_m) {
  const Frame frame(track, across_m);
  const double length_m = track.length_m();
  std::vector<Piece> pieces;
  for (const auto& face : surface.face) {
    Piece piece;
    if (!cut(surface, face, frame, piece) || piece.to.x_m < kSame_m ||
        piece.from.x_m > length_m - kSame_m) {
      continue;
    }
    const Piece whole = piece;
    const double from_m = std::max(whole.from.x_m, 0.0);
    const double to_m = std::min(whole.to.x_m, length_m);
    pieces.push_back({{from_m, height_on(whole, from_m)}, {to_m, height_on(whole, to_m)}});
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.from.x_m < b.from.x_m; });
  return pieces;
}

/// What a message calls a line beside the track.
std::string line_text(double across_m) {
  return across_m == 0.0 ? "under the track"
                         : fmt::format("{:.2f} m {} of the track, under an end of the blade",
                                       std::abs(across_m), across_m > 0.0 ? "left" : "right");
}

std::vector<GradePoint> section(const Surface& surface, const Track& track, double across_m) {
  std::vector<GradePoint> corners;
  Piece last;
  const auto demand_reached = [&](double x_m) {
    const double have_m = corners.empty() ? 0.0 : corners.back().x_m;
    if (x_m > have_m + kHole_m) {
      throw std::runtime_error(fmt::format(
          "the surface has a hole at x = {:.3f} .. {:.3f} m, {}; allowed: none over the track's "
          "{:.3f} m",
          have_m, x_m, line_text(across_m), track.length_m()));
    }
  };
  for (const Piece& piece : pieces_of(surface, track, across_m)) {
    demand_reached(piece.from.x_m);
    if (corners.empty()) {
      corners.push_back({0.0, piece.from.z_m});
    } else {
      const double other_m = height_on(last, piece.from.x_m);
      if (std::abs(piece.from.z_m - other_m) > kOneHeight_m) {
        throw std::runtime_error(
            fmt::format("the surface is {:.3f} and {:.3f} m high at x = {:.3f} m, {}; allowed: one "
                        "height a place",
                        other_m, piece.from.z_m, piece.from.x_m, line_text(across_m)));
      }
    }
    if (piece.to.x_m > corners.back().x_m + kSame_m) {
      corners.push_back(piece.to);
      last = piece;
    }
  }
  demand_reached(track.length_m());
  return corners;
}

double height_at(const std::vector<GradePoint>& line, double x_m) {
  const auto after = std::upper_bound(line.begin() + 1, line.end() - 1, x_m,
                                      [](double x, const GradePoint& at) { return x < at.x_m; });
  return height_on({*(after - 1), *after}, x_m);
}

/// Of all lines, which are straight between their corners: every place where one has a corner.
std::vector<double> all_corners_m(std::initializer_list<const std::vector<GradePoint>*> lines) {
  std::vector<double> corners_m;
  for (const std::vector<GradePoint>* line : lines) {
    for (const GradePoint& at : *line) {
      corners_m.push_back(at.x_m);
    }
  }
  std::sort(corners_m.begin(), corners_m.end());
  corners_m.erase(std::unique(corners_m.begin(), corners_m.end(),
                              [](double a, double b) { return b - a < kSame_m; }),
                  corners_m.end());
  return corners_m;
}

/// The largest difference, and its place; only a corner can be farthest off.
template <class OffAt>
GradePoint worst_of(const std::vector<double>& corners_m, const OffAt& off_at) {
  GradePoint worst;
  for (const double x_m : corners_m) {
    const double off_m = off_at(x_m);
    if (std::abs(off_m) > std::abs(worst.z_m)) {
      worst = {x_m, off_m};
    }
  }
  return worst;
}

void demand_level(const std::vector<GradePoint>& middle, const std::vector<GradePoint>& end,
                  double across_m, double most_m) {
  const GradePoint worst = worst_of(all_corners_m({&middle, &end}), [&](double x_m) {
    return height_at(end, x_m) - height_at(middle, x_m);
  });
  if (std::abs(worst.z_m) > most_m) {
    throw std::runtime_error(fmt::format(
        "the surface is {:.3f} m {} than under the track at x = {:.2f} m, {}; allowed: {} .. {} m "
        "(grade.tolerance): this machine's blade has no tilt",
        std::abs(worst.z_m), worst.z_m > 0.0 ? "higher" : "lower", worst.x_m, line_text(across_m),
        -most_m, most_m));
  }
}

/// What a blade that tilts makes of it: the middle's height, and the slope between the ends.
machines::DesignLine sloped(const std::vector<GradePoint>& middle,
                            const std::vector<GradePoint>& left,
                            const std::vector<GradePoint>& right, const BladeAcross& blade) {
  const std::vector<double> corners_m = all_corners_m({&middle, &left, &right});
  const GradePoint crown = worst_of(corners_m, [&](double x_m) {
    return height_at(middle, x_m) - 0.5 * (height_at(left, x_m) + height_at(right, x_m));
  });
  if (std::abs(crown.z_m) > blade.tolerance_m) {
    throw std::runtime_error(fmt::format(
        "under the track the surface is {:.3f} m {} than straight between the ends of the blade at "
        "x = {:.2f} m; allowed: {} .. {} m (grade.tolerance): the cutting edge is straight",
        std::abs(crown.z_m), crown.z_m > 0.0 ? "higher" : "lower", crown.x_m, -blade.tolerance_m,
        blade.tolerance_m));
  }
  machines::DesignLine line;
  for (const double x_m : corners_m) {
    const double slope = (height_at(left, x_m) - height_at(right, x_m)) / blade.width_m;
    if (std::abs(slope) > machines::kMostCross) {
      throw std::runtime_error(fmt::format(
          "the surface has a slope of {:.3f} across the track at x = {:.2f} m; allowed: "
          "{} .. {}",
          slope, x_m, -machines::kMostCross, machines::kMostCross));
    }
    line.corners.push_back({x_m, height_at(middle, x_m)});
    line.cross.push_back(slope);
  }
  return line;
}

}  // namespace

void demand_corners(const std::vector<double>& corners_m) {
  if (corners_m.size() < 4 || corners_m.size() % 2 != 0) {
    throw std::runtime_error(
        fmt::format("the track has {} numbers; allowed: x and y of its start and of its end, m",
                    corners_m.size()));
  }
}

Track straight_track(const std::vector<double>& corners_m) {
  demand_corners(corners_m);
  const auto corner = [&](std::size_t i) {
    return Eigen::Vector2d(corners_m[2 * i], corners_m[2 * i + 1]);
  };
  const std::size_t last = corners_m.size() / 2 - 1;
  for (std::size_t i = 1; i < last; ++i) {
    const Eigen::Vector2d before = corner(i) - corner(i - 1);
    const Eigen::Vector2d after = corner(i + 1) - corner(i);
    const double bend_rad =
        std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    if (std::abs(bend_rad) > kMostBend_rad) {
      throw std::runtime_error(fmt::format(
          "the track bends by {:.3f} rad at x = {}, y = {} m; allowed: {} .. {} rad, or more with "
          "--radius of its curves",
          bend_rad, corner(i).x(), corner(i).y(), -kMostBend_rad, kMostBend_rad));
    }
  }
  const Track track{corner(0), corner(last)};
  demand_track_length(track.length_m());
  return track;
}

void demand_track_length(double length_m) {
  if (!(length_m >= kLeastLength_m && length_m <= kMostLength_m)) {
    throw std::runtime_error(fmt::format("the track is {:.3f} m long; allowed: {} .. {} m",
                                         length_m, kLeastLength_m, kMostLength_m));
  }
}

Track middle_track(const Surface& surface) {
  Eigen::Vector2d least = surface.point_m.front().head<2>();
  Eigen::Vector2d most = least;
  for (const Eigen::Vector3d& at : surface.point_m) {
    least = least.cwiseMin(at.head<2>());
    most = most.cwiseMax(at.head<2>());
  }
  const double y_m = 0.5 * (least.y() + most.y());
  return straight_track({least.x(), y_m, most.x(), y_m});
}

machines::DesignLine along_track(const Surface& surface, const Track& track, double datum_m,
                                 const BladeAcross& blade) {
  machines::DesignLine line = section(surface, track, 0.0);
  const double half_m = 0.5 * blade.width_m;
  if (half_m > 0.0) {
    const std::vector<GradePoint> left = section(surface, track, half_m);
    const std::vector<GradePoint> right = section(surface, track, -half_m);
    if (blade.tilts) {
      line = sloped(line.corners, left, right, blade);
    } else {
      demand_level(line.corners, left, half_m, blade.tolerance_m);
      demand_level(line.corners, right, -half_m, blade.tolerance_m);
    }
  }
  for (GradePoint& at : line.corners) {
    at.z_m -= datum_m;
  }
  return line;
}

}  // namespace graben::design
