// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine on paper for the load observer: what its cylinders push, by differences of its
/// potential energy, which know nothing of moments.

#include <array>

#include "firmware/excavator/load/load_observer.hpp"
#include "tests/unit/firmware/fixture.hpp"

namespace graben::test {

class LoadWorld {
 public:
  Eigen::Vector2d teeth_n = Eigen::Vector2d::Zero();  ///< Of the ground.
  double load_kg = 0.0;
  Eigen::Vector3d offset_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d coulomb_n = Eigen::Vector3d::Zero();
  std::array<double, 3> mass_factor = {1.0, 1.0, 1.0};
  bool active = true;
  LoadObserver observer;

  [[nodiscard]] static const ExcavatorProfile& machine() { return excavator().profile; }
  [[nodiscard]] const TipLoad& told() const { return observer.told; }

  [[nodiscard]] Eigen::Vector3d strokes_at(const TipPose& pose) const {
    const StrokeResult strokes = kinematics_.strokes_from_pose(pose);
    assert_int_equal(strokes.status, ReachStatus::kOk);
    return strokes.strokes_m;
  }

  /// Of all that weighs and pushes.
  [[nodiscard]] double potential_j(const Eigen::Vector3d& strokes_m) const {
    const ExcavatorGeometry& geometry = machine().geometry;
    const std::array<double, 3> length_m = {geometry.boom_length_m, geometry.arm_length_m,
                                            geometry.bucket_length_m};
    const JointResult joints = kinematics_.joints_from_strokes(strokes_m);
    Eigen::Vector2d pin_m = Eigen::Vector2d::Zero();
    double angle_rad = 0.0;
    double sum_j = 0.0;
    for (unsigned i = 0; i < 3; ++i) {
      angle_rad += joints.joints_rad[i];
      const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
      const Eigen::Vector2d across(-along.y(), along.x());
      const LinkMass& link = machine().oil.link[i];
      sum_j += 9.81 * mass_factor[i] * link.mass_kg *
               (pin_m + link.centre_m.x() * along + link.centre_m.y() * across).y();
      if (i == kBucket) {
        sum_j += 9.81 * load_kg * (pin_m + length_m[i] * (0.55 * along + 0.2 * across)).y();
      }
      pin_m += length_m[i] * along;
    }
    return sum_j - teeth_n.dot(pin_m);
  }

  [[nodiscard]] Eigen::Vector3d forces_n(const Eigen::Vector3d& strokes_m,
                                         const Eigen::Vector3d& speed_mps) const {
    constexpr double kStep_m = 1e-4;
    Eigen::Vector3d force_n = offset_n;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(i);
      force_n[i] += (potential_j(strokes_m + step) - potential_j(strokes_m - step)) / (2 * kStep_m);
      force_n[i] += speed_mps[i] == 0.0 ? 0.0 : std::copysign(coulomb_n[i], speed_mps[i]);
    }
    return force_n;
  }

  void cycle(StepKind kind, double share, const Eigen::Vector3d& strokes_m,
             const Eigen::Vector3d& speed_mps) {
    const KinematicState now = kinematics_.state(strokes_m);
    LoadSeen seen;
    seen.known = now.status == ReachStatus::kOk;
    seen.stroke_m = strokes_m;
    seen.force_n = forces_n(strokes_m, speed_mps);
    for (int i = 0; i < 3; ++i) {
      seen.lever_m[i] = 1.0 / now.jacobian(2, i);
    }
    seen.joints_rad = now.joints_rad;
    next_load(machine(), seen, kind, share, now.tip, 0.01, active, observer);
  }

  void stand(StepKind kind, const TipPose& pose, double seconds) {
    const Eigen::Vector3d strokes_m = strokes_at(pose);
    for (int n = 0; n < std::lround(100.0 * seconds); ++n) {
      cycle(kind, 0.5, strokes_m, Eigen::Vector3d::Zero());
    }
  }

  /// Evenly, in strokes.
  void move(StepKind kind, const TipPose& from, const TipPose& to, double seconds) {
    const Eigen::Vector3d from_m = strokes_at(from);
    const Eigen::Vector3d way_m = strokes_at(to) - from_m;
    const long cycles = std::lround(100.0 * seconds);
    for (long n = 0; n < cycles; ++n) {
      const double share = static_cast<double>(n) / static_cast<double>(cycles);
      cycle(kind, share, from_m + share * way_m, way_m / seconds);
    }
  }

 private:
  ExcavatorKinematics kinematics_{machine().geometry};
};

}  // namespace graben::test
