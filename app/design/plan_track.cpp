// SPDX-License-Identifier: Apache-2.0
#include "app/design/plan_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace graben::design {
namespace {

constexpr double kStraight_pm = 1e-9;
/// A corner that bends less is none.
constexpr double kNoBend_rad = 1e-6;
/// Back on itself no arc goes.
constexpr double kMostBend_rad = 3.0;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double direction_of(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()); }

}  // namespace

Eigen::Vector2d TrackPiece::at_m(double along_m) const {
  const double half_rad = 0.5 * curvature_pm * along_m;
  const double chord = std::abs(half_rad) > 1e-9 ? std::sin(half_rad) / half_rad : 1.0;
  return from_m + along_m * chord *
                      Eigen::Vector2d(std::cos(direction_rad + half_rad),
                                      std::sin(direction_rad + half_rad));
}

double PlanTrack::length_m() const {
  double length_m = 0.0;
  for (const TrackPiece& one : piece) {
    length_m += one.length_m;
  }
  return length_m;
}

bool PlanTrack::curves() const {
  return std::any_of(piece.begin(), piece.end(), [](const TrackPiece& one) {
    return std::abs(one.curvature_pm) > kStraight_pm;
  });
}

PlanStation station_of(const PlanTrack& track, double station_m) {
  double along_m = station_m;
  for (const TrackPiece& one : track.piece) {
    if (along_m <= one.length_m || &one == &track.piece.back()) {
      return {&one, along_m};
    }
    along_m -= one.length_m;
  }
  return {};
}

PlanTrack rounded_track(const std::vector<double>& corners_m, double radius_m) {
  const auto corner = [&](std::size_t i) {
    return Eigen::Vector2d(corners_m[2 * i], corners_m[2 * i + 1]);
  };
  const std::size_t last = corners_m.size() / 2 - 1;
  PlanTrack track;
  Eigen::Vector2d from_m = corner(0);
  for (std::size_t i = 1; i <= last; ++i) {
    const Eigen::Vector2d way = (corner(i) - from_m);
    const Eigen::Vector2d after = i < last ? corner(i + 1) - corner(i) : way;
    const double bend_rad = std::atan2(cross(way, after), way.dot(after));
    const bool arc = std::abs(bend_rad) > kNoBend_rad;
    const double cut_m = arc ? radius_m * std::tan(0.5 * std::abs(bend_rad)) : 0.0;
    const double next_m = i + 1 < last ? 0.5 * after.norm() : after.norm();
    if (std::abs(bend_rad) > kMostBend_rad || cut_m > way.norm() + 1e-9 ||
        (i < last && cut_m > next_m + 1e-9)) {
      throw std::runtime_error(fmt::format(
          "the track bends by {:.3f} rad at x = {}, y = {} m, where an arc of {} m takes {:.3f} m "
          "before and behind it; allowed: at most half of the way to the next corner, or all of "
          "the "
          "first and the last, {:.3f} and {:.3f} m",
          bend_rad, corner(i).x(), corner(i).y(), radius_m, cut_m, way.norm(), next_m));
    }
    const double straight_m = way.norm() - cut_m;
    if (straight_m > 1e-9) {
      track.piece.push_back({from_m, direction_of(way), 0.0, straight_m});
    }
    from_m = corner(i);
    if (arc) {
      track.piece.push_back({corner(i) - cut_m * way.normalized(), direction_of(way),
                             std::copysign(1.0 / radius_m, bend_rad),
                             radius_m * std::abs(bend_rad)});
      from_m = corner(i) + cut_m * after.normalized();
    }
  }
  return track;
}

}  // namespace graben::design
