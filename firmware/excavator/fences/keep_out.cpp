// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/fences/keep_out.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/excavator/fences/tuning.hpp"

namespace graben {
namespace {

/// A corner of a part.
struct Corner {
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();  ///< From the keep-out's centre.
  Eigen::Vector3d moves_mps = Eigen::Vector3d::Zero();
  MachinePoint point = MachinePoint::kTeeth;
};

Eigen::Vector3d across(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

/// Most corners of a part. [-; size: the bucket's prism]
constexpr int kCornerMost = 6;
/// Most edges of a part in the links' plane, by direction. [-; size: the bucket's triangle]
constexpr int kSideMost = 3;
/// Most edges of a part. [-; size: the bucket's prism]
constexpr int kEdgeMost = 9;

/// Steps of the search for the nearest place of an edge. [-; size: halvings or better, to some 1e-3
/// of its length]
constexpr int kNearestSteps = 8;

/// From corner to corner.
struct Edge {
  std::uint8_t from = 0;
  std::uint8_t to = 0;
};

/// A convex part: corners, edges, and the directions of those edges that lie in the links' plane;
/// the others go across the machine.
struct Hull {
  std::array<Corner, kCornerMost> corner;
  int corner_count = 0;
  std::array<Eigen::Vector3d, kSideMost> side;
  int side_count = 0;
  std::array<Edge, kEdgeMost> edge;
  int edge_count = 0;
  double radius_m = 0.0;

  void add(const Fence& keep_out, const MachineMotion& motion, MachinePoint point,
           double above_m = 0.0) {
    const PointMotion& at = motion.at(point);
    corner[static_cast<unsigned>(corner_count++)] = {
        at.position_m - keep_out.centre_m + above_m * Eigen::Vector3d::UnitZ(), at.velocity_mps,
        point};
  }
  void add_edge(unsigned from, unsigned to) {
    edge[static_cast<unsigned>(edge_count++)] = {static_cast<std::uint8_t>(from),
                                                 static_cast<std::uint8_t>(to)};
  }
  void add_side(unsigned from, unsigned to) {
    side[static_cast<unsigned>(side_count++)] = corner[to].at_m - corner[from].at_m;
    add_edge(from, to);
  }
};

void add_bucket(const Fence& keep_out, const MachineMotion& motion, Hull& hull) {
  for (const MachinePoint point :
       {MachinePoint::kEdgeLeft, MachinePoint::kPinLeft, MachinePoint::kHeelLeft,
        MachinePoint::kEdgeRight, MachinePoint::kPinRight, MachinePoint::kHeelRight}) {
    hull.add(keep_out, motion, point);
  }
  /// Corners of the bucket seen from the side. [-; size: edge, pin, heel]
  constexpr unsigned kCorners = 3;
  for (unsigned i = 0; i < kCorners; ++i) {
    const unsigned next = (i + 1) % kCorners;
    hull.add_side(i, next);
    hull.add_edge(kCorners + i, kCorners + next);
    hull.add_edge(i, kCorners + i);
  }
}

void add_counterweight(const Fence& keep_out, const Counterweight& weight,
                       const MachineMotion& motion, Hull& hull) {
  for (const MachinePoint tail : {MachinePoint::kTailLeft, MachinePoint::kTailRight}) {
    hull.add(keep_out, motion, tail);
    hull.add(keep_out, motion, tail, weight.high_m - weight.low_m);
  }
  hull.add_side(0, 1);
  hull.add_edge(2, 3);
  hull.add_edge(0, 2);
  hull.add_edge(1, 3);
  hull.radius_m = weight.corner_m;
}

void add_link(const Fence& keep_out, const MachineMotion& motion, MachinePoint from,
              MachinePoint to, double radius_m, Hull& hull) {
  hull.add(keep_out, motion, from);
  hull.add(keep_out, motion, to);
  hull.add_side(0, 1);
  hull.radius_m = radius_m;
}

/// Not inlined: one body of code, once for every part.
[[gnu::noinline]] Hull hull_of(const Fence& keep_out, const ExcavatorBody& body,
                               const MachineMotion& motion, MachinePart part) {
  Hull hull;
  switch (part) {
    case MachinePart::kBucketPart:
      add_bucket(keep_out, motion, hull);
      break;
    case MachinePart::kArmPart:
      add_link(keep_out, motion, MachinePoint::kArmPin, MachinePoint::kBucketPin, body.arm_radius_m,
               hull);
      break;
    case MachinePart::kBoomFootPart:
      add_link(keep_out, motion, MachinePoint::kBoomFoot, MachinePoint::kBoomBend,
               body.boom_radius_m, hull);
      break;
    case MachinePart::kBoomEndPart:
      add_link(keep_out, motion, MachinePoint::kBoomBend, MachinePoint::kArmPin, body.boom_radius_m,
               hull);
      break;
    case MachinePart::kTailPart:
      add_counterweight(keep_out, body.counterweight, motion, hull);
      break;
  }
  return hull;
}

/// Tries planes between a part and a keep-out, and keeps that which leaves most.
class Separation {
 public:
  Separation(const Fence& keep_out, const Hull& hull) : keep_out_(keep_out), hull_(hull) {}

  /// Planes across `axis`, of any length; one of none says nothing.
  void try_axis(const Eigen::Vector3d& axis) {
    const double square = axis.squaredNorm();
    if (square < kNoAxisSquared) {
      return;
    }
    const Eigen::Vector3d unit = axis / std::sqrt(square);
    const double out_m = reach_m(unit) + hull_.radius_m;
    double low_m = 0.0;
    double high_m = 0.0;
    int lowest = -1;
    int highest = -1;
    for (int i = 0; i < hull_.corner_count; ++i) {
      const double at_m = unit.dot(corner(i).at_m);
      if (lowest < 0 || at_m < low_m) {
        low_m = at_m;
        lowest = i;
      }
      if (highest < 0 || at_m > high_m) {
        high_m = at_m;
        highest = i;
      }
    }
    take(low_m - out_m, unit, lowest);
    take(-high_m - out_m, -unit, highest);
  }

  void try_faces(const std::array<Eigen::Vector3d, 3>& frame, const Eigen::Vector3d& left) {
    for (const Eigen::Vector3d& axis : frame) {
      try_axis(axis);
    }
    try_axis(left);
  }

  void try_edges(const std::array<Eigen::Vector3d, 3>& frame, const Eigen::Vector3d& left) {
    for (const Eigen::Vector3d& axis : frame) {
      try_axis(across(left, axis));
    }
    for (int i = 0; i < hull_.side_count; ++i) {
      const Eigen::Vector3d& side = hull_.side[static_cast<unsigned>(i)];
      try_axis(across(left, side));
      for (const Eigen::Vector3d& axis : frame) {
        try_axis(across(side, axis));
      }
    }
  }

  /// From the keep-out to where the part's edges are nearest to it.
  void try_nearest() {
    for (int i = 0; i < hull_.edge_count; ++i) {
      const Edge& edge = hull_.edge[static_cast<unsigned>(i)];
      try_axis(away_from_nearest(corner(edge.from).at_m, corner(edge.to).at_m));
    }
  }

  [[nodiscard]] double distance_m() const { return best_m_; }
  /// Of corners that are as near, an edge's or a face's, the one that closes fastest.
  [[nodiscard]] FenceGap gap() const {
    FenceGap gap{best_m_, 0.0, corner(nearest_).point};
    const double nearest_m = away_.dot(corner(nearest_).at_m);
    bool is_first = true;
    for (int i = 0; i < hull_.corner_count; ++i) {
      const double closing_mps = -away_.dot(corner(i).moves_mps);
      if (away_.dot(corner(i).at_m) < nearest_m + kAsNearCorner_m &&
          (is_first || closing_mps > gap.closing_mps)) {
        is_first = false;
        gap.closing_mps = closing_mps;
        gap.point = corner(i).point;
      }
    }
    return gap;
  }

 private:
  [[nodiscard]] const Corner& corner(int i) const { return hull_.corner[static_cast<unsigned>(i)]; }

  /// A point before the keep-out.
  struct Before {
    double distance_m = 0.0;                         ///< Below 0 inside.
    Eigen::Vector3d away = Eigen::Vector3d::Zero();  ///< Direction in which it grows, of length 1.
  };

  /// Of the keep-out's own frame: beyond its sides, which side that is, and out of it.
  [[nodiscard]] Before before(const Eigen::Vector3d& at_m) const {
    const Eigen::Vector3d& half_m = keep_out_.half_m;
    std::array<Eigen::Vector3d, 3> out = {keep_out_.normal,
                                          {-keep_out_.normal.y(), keep_out_.normal.x(), 0.0},
                                          Eigen::Vector3d::UnitZ()};
    int sides = 3;
    std::array<double, 3> beyond_m{};
    if (keep_out_.shape == FenceShape::kCylinder) {
      const double from_axis_m = at_m.head<2>().norm();
      out[0] = Eigen::Vector3d::UnitX();
      if (from_axis_m > 0.0) {
        out[0] = {at_m.x() / from_axis_m, at_m.y() / from_axis_m, 0.0};
      }
      out[1] = out[2];
      sides = 2;
      beyond_m[0] = from_axis_m - half_m.x();
      beyond_m[1] = std::abs(at_m.z()) - half_m.z();
    } else {
      for (unsigned i = 0; i < 3; ++i) {
        beyond_m[i] = std::abs(out[i].dot(at_m)) - half_m[i];
      }
    }
    unsigned deepest = 0;
    Eigen::Vector3d off_m = Eigen::Vector3d::Zero();
    for (unsigned i = 0; i < static_cast<unsigned>(sides); ++i) {
      out[i] = out[i].dot(at_m) < 0.0 ? Eigen::Vector3d(-out[i]) : out[i];
      off_m += std::max(0.0, beyond_m[i]) * out[i];
      deepest = beyond_m[i] > beyond_m[deepest] ? i : deepest;
    }
    const double apart_m = off_m.norm();
    return apart_m > 0.0 ? Before{apart_m, off_m / apart_m}
                         : Before{beyond_m[deepest], out[deepest]};
  }

  /// The distance along an edge is convex: where its tangents from both sides meet comes near to
  /// where it is least.
  [[nodiscard]] Eigen::Vector3d away_from_nearest(const Eigen::Vector3d& from_m,
                                                  const Eigen::Vector3d& to_m) const {
    const Eigen::Vector3d way_m = to_m - from_m;
    double low = 0.0;
    double high = 1.0;
    Before at_low = before(from_m);
    Before at_high = before(to_m);
    if (at_low.away.dot(way_m) >= 0.0) {
      return at_low.away;
    }
    if (at_high.away.dot(way_m) <= 0.0) {
      return at_high.away;
    }
    for (int i = 0; i < kNearestSteps; ++i) {
      const double falls = -at_low.away.dot(way_m);
      const double rises = at_high.away.dot(way_m);
      const double meet =
          (at_low.distance_m - at_high.distance_m + falls * low + rises * high) / (falls + rises);
      const double share = std::clamp(meet, low, high);
      const Before at_share = before(from_m + share * way_m);
      const bool rising = at_share.away.dot(way_m) > 0.0;
      (rising ? high : low) = share;
      (rising ? at_high : at_low) = at_share;
    }
    // Across the edge, as the direction to the nearest point is.
    return at_high.away.dot(way_m) * at_low.away - at_low.away.dot(way_m) * at_high.away;
  }

  /// Of the keep-out, from its centre along a direction of length 1.
  [[nodiscard]] double reach_m(const Eigen::Vector3d& unit) const {
    const Eigen::Vector3d& half_m = keep_out_.half_m;
    const double up_m = half_m.z() * std::abs(unit.z());
    if (keep_out_.shape == FenceShape::kCylinder) {
      return up_m + half_m.x() * unit.head<2>().norm();
    }
    const Eigen::Vector3d& along = keep_out_.normal;
    return up_m + half_m.x() * std::abs(along.x() * unit.x() + along.y() * unit.y()) +
           half_m.y() * std::abs(along.x() * unit.y() - along.y() * unit.x());
  }

  void take(double distance_m, const Eigen::Vector3d& away, int nearest) {
    if (is_new_ || distance_m > best_m_) {
      is_new_ = false;
      best_m_ = distance_m;
      away_ = away;
      nearest_ = nearest;
    }
  }

  const Fence& keep_out_;
  const Hull& hull_;
  bool is_new_ = true;
  double best_m_ = 0.0;
  Eigen::Vector3d away_ = Eigen::Vector3d::UnitZ();
  int nearest_ = 0;
};

}  // namespace

FenceGap keep_out_gap(const Fence& keep_out, const ExcavatorBody& body, const MachineMotion& motion,
                      MachinePart part, double far_m) {
  const Hull hull = hull_of(keep_out, body, motion, part);
  // A cylinder has no sides of its own: those that the machine would meet it with.
  const bool round = keep_out.shape == FenceShape::kCylinder;
  const Eigen::Vector3d first = round ? motion.left : keep_out.normal;
  const std::array<Eigen::Vector3d, 3> frame = {
      first, {-first.y(), first.x(), 0.0}, Eigen::Vector3d::UnitZ()};
  Separation separation(keep_out, hull);
  separation.try_faces(frame, motion.left);
  if (separation.distance_m() < far_m) {
    separation.try_edges(frame, motion.left);
    separation.try_nearest();
  }
  return separation.gap();
}

}  // namespace graben
