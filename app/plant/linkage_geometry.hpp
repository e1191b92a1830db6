// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the plant's links and pins are: own vector geometry, no formula shared with the
/// controller. Sagittal plane, x forward, y up, origin at the boom foot pin. Joint angles (rad):
/// boom against the horizontal, arm against the boom, bucket against the arm.

#include <Eigen/Core>
#include <array>

#include "firmware/excavator/excavator_profile.hpp"

namespace graben::plant {

using JointArray = std::array<double, kAxisCount>;

/// A rotation by a joint angle.
struct Rotation {
  double cosine = 1.0;
  double sine = 0.0;

  static Rotation by(double angle_rad);
  /// For at most 0.01 rad, to 1e-15, at a tenth of the cost.
  static Rotation by_little(double angle_rad) {
    const double square = angle_rad * angle_rad;
    return {1.0 - 0.5 * square * (1.0 - square / 12.0),
            angle_rad * (1.0 - square / 6.0 * (1.0 - square / 20.0))};
  }
  /// Brought back to length 1 from where rounding left it.
  [[nodiscard]] Rotation normalised() const {
    const double scale = 1.5 - 0.5 * (cosine * cosine + sine * sine);
    return {scale * cosine, scale * sine};
  }
  [[nodiscard]] Rotation then(const Rotation& next) const {
    return {cosine * next.cosine - sine * next.sine, sine * next.cosine + cosine * next.sine};
  }
  [[nodiscard]] Eigen::Vector2d apply(const Eigen::Vector2d& v) const {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
  }
};

/// The vector turned by +90 deg: the velocity of a point at unit angular velocity.
inline Eigen::Vector2d turned(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

using JointRotations = std::array<Rotation, kAxisCount>;  ///< Relative, as the joint angles.
JointRotations rotations_of(const JointArray& angle_rad);

/// A cylinder as its joint sees it.
struct Lever {
  double stroke_m = 0.0;
  double stroke_per_angle_m = 0.0;  ///< dl / d(joint angle); negative where extension folds in.
};

struct TipPose {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double attitude_rad = 0.0;  ///< Joint angles' sum + pi: direction from the tip to the bucket pin.
};

class LinkageGeometry {
 public:
  explicit LinkageGeometry(const ExcavatorGeometry& geometry) : geometry_(geometry) {}

  [[nodiscard]] std::array<Lever, kAxisCount> levers(const JointRotations& joint) const;
  /// Joint angles at the strokes. Of each triangle the branch on which extension raises the boom,
  /// folds the arm in and curls the bucket in.
  [[nodiscard]] JointArray angles_at(const JointArray& stroke_m) const;
  [[nodiscard]] TipPose tip(const JointArray& angle_rad) const;

 private:
  [[nodiscard]] Lever bucket_lever(const Rotation& bucket) const;
  [[nodiscard]] double bucket_angle_at(double stroke_m) const;

  ExcavatorGeometry geometry_;
};

}  // namespace graben::plant
