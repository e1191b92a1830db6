// SPDX-License-Identifier: Apache-2.0
#include "firmware/excavator/motion/program/line.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace graben {
namespace {

bool blind(const DriveMotion& motion) { return motion.blind.kind != BlindKind::kNone; }

/// The attitude's equivalent nearest to what the joints add up to there.
double attitude_of_joints_rad(const SwingKinematics& kinematics, const TeethPose& teeth) {
  const DriveResult joints = kinematics.joints_from_teeth(teeth);
  if (joints.blind.kind != BlindKind::kNone) {
    return teeth.attitude_rad;
  }
  const double sum_rad = kinematics.teeth_from_joints(joints.value).attitude_rad;
  return wrap_near(teeth.attitude_rad, sum_rad);
}

/// Looks at one line.
class Walk {
 public:
  Walk(const SwingKinematics& kinematics, const TeethLine& line)
      : kinematics_(kinematics), line_(line) {}

  [[nodiscard]] BlindPlace run() const;

 private:
  struct Sample {
    double share = 0.0;
    DriveMotion motion;
  };

  [[nodiscard]] Sample sample(double share) const {
    return {share, line_motion(kinematics_, line_, share)};
  }
  [[nodiscard]] BlindPlace begins_between(double seen, const Sample& blind_at) const;
  [[nodiscard]] Sample turning_point(const Sample& from, const Sample& to, int drive) const;
  [[nodiscard]] BlindPlace between(const Sample& from, const Sample& to) const;
  [[nodiscard]] double nearest_to_swing_axis() const;

  const SwingKinematics& kinematics_;
  const TeethLine& line_;
};

BlindPlace Walk::begins_between(double seen, const Sample& blind_at) const {
  Sample first = blind_at;
  for (int i = 0; i < kWalkHalvings; ++i) {
    const Sample middle = sample(0.5 * (seen + first.share));
    if (blind(middle.motion)) {
      first = middle;
    } else {
      seen = middle.share;
    }
  }
  return {first.motion.blind, first.share, line_.at(first.share)};
}

/// Where the stroke of `drive` is farthest out or in; a blind spot met on the way serves as well.
Walk::Sample Walk::turning_point(const Sample& from, const Sample& to, int drive) const {
  double before = from.share;
  double after = to.share;
  Sample middle = from;
  for (int i = 0; i < kWalkHalvings; ++i) {
    middle = sample(0.5 * (before + after));
    if (blind(middle.motion)) {
      break;
    }
    const bool same_way = (middle.motion.rate[drive] > 0.0) == (from.motion.rate[drive] > 0.0);
    (same_way ? before : after) = middle.share;
  }
  return middle;
}

double Walk::nearest_to_swing_axis() const {
  const Eigen::Vector2d from_m = line_.from.position_m.head<2>();
  const Eigen::Vector2d change_m = line_.change.position_m.head<2>();
  const double square_m2 = change_m.squaredNorm();
  return square_m2 > 0.0 ? -from_m.dot(change_m) / square_m2 : 0.0;
}

BlindPlace Walk::between(const Sample& from, const Sample& to) const {
  BlindPlace first;
  const auto look_at = [&](const Sample& place) {
    if (!blind(place.motion)) {
      return;
    }
    const BlindPlace found = begins_between(from.share, place);
    if (first.blind.kind == BlindKind::kNone || found.share < first.share) {
      first = found;
    }
  };
  const double nearest = nearest_to_swing_axis();
  if (nearest > from.share && nearest < to.share) {
    look_at(sample(nearest));
  }
  look_at(to);
  if (blind(to.motion)) {
    return first;
  }
  for (int drive = 0; drive < kAxisCount; ++drive) {
    if (from.motion.rate[drive] * to.motion.rate[drive] < 0.0) {
      look_at(turning_point(from, to, drive));
    }
  }
  return first;
}

BlindPlace Walk::run() const {
  Sample last = sample(0.0);
  if (blind(last.motion)) {
    return {last.motion.blind, 0.0, line_.from};
  }
  for (int i = 1; i <= kWalkSteps; ++i) {
    const Sample next = sample(static_cast<double>(i) / kWalkSteps);
    const BlindPlace place = between(last, next);
    if (place.blind.kind != BlindKind::kNone) {
      return place;
    }
    last = next;
  }
  return {};
}

}  // namespace

TeethPose TeethLine::at(double share) const {
  return {from.position_m + share * change.position_m,
          from.attitude_rad + share * change.attitude_rad};
}

TeethLine line_between(const SwingKinematics& kinematics, const TeethPose& from,
                       const TeethPose& to) {
  const double from_rad = attitude_of_joints_rad(kinematics, from);
  const double to_rad = attitude_of_joints_rad(kinematics, to);
  return {{from.position_m, from_rad}, {to.position_m - from.position_m, to_rad - from_rad}};
}

double line_distance_m(const TeethLine& line, const Eigen::Vector3d& teeth_m) {
  const Eigen::Vector3d& way_m = line.change.position_m;
  const double length_m = way_m.norm();
  const Eigen::Vector3d off_m = teeth_m - line.from.position_m;
  return length_m > 0.0 ? off_m.cross(way_m).norm() / length_m : off_m.norm();
}

double way_m(const SwingKinematics& kinematics, const TeethLine& line) {
  return std::max(line.change.position_m.norm(),
                  kinematics.geometry().bucket_length_m * std::abs(line.change.attitude_rad));
}

DriveMotion line_motion(const SwingKinematics& kinematics, const TeethLine& line, double share) {
  const Eigen::Vector2d from_m = line.from.position_m.head<2>();
  // A line that does not meet the swing axis turns by less than half a turn about it.
  return kinematics.motion_from_teeth(line.at(share), line.change, {},
                                      std::atan2(from_m.y(), from_m.x()));
}

BlindPlace first_blind_place(const SwingKinematics& kinematics, const TeethLine& line) {
  return Walk(kinematics, line).run();
}

}  // namespace graben
