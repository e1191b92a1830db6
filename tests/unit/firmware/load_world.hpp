// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A machine on paper for the load observer: what its cylinders push, by differences of its
/// potential energy and of where its links' centres go, which know nothing of moments.

#include <Eigen/Geometry>
#include <array>

#include "firmware/excavator/estimation/load/load_observer.hpp"
#include "firmware/numeric/constants.hpp"
#include "tests/unit/firmware/fixture.hpp"

namespace graben::test {

class LoadWorld {
 public:
  Eigen::Vector2d teeth_n = Eigen::Vector2d::Zero();  ///< Of the ground.
  double load_kg = 0.0;
  Eigen::Vector3d offset_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d coulomb_n = Eigen::Vector3d::Zero();
  Eigen::Vector3d viscous_nspm = Eigen::Vector3d::Zero();
  std::array<double, 3> mass_factor = {1.0, 1.0, 1.0};
  bool active = true;
  bool blind = false;       ///< A pressure is missing.
  double elapsed_s = 0.01;  ///< Of each cycle.
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
      sum_j += 9.80665 * mass_factor[i] * link.mass_kg *
               (pin_m + link.centre_m.x() * along + link.centre_m.y() * across).y();
      if (i == kBucket) {
        sum_j += 9.80665 * load_kg * (pin_m + length_m[i] * (0.55 * along + 0.2 * across)).y();
      }
      pin_m += length_m[i] * along;
    }
    return sum_j - teeth_n.dot(pin_m);
  }

  struct Place {
    Eigen::Vector2d centre_m;
    double angle_rad;
  };

  [[nodiscard]] std::array<Place, 3> places(const Eigen::Vector3d& strokes_m) const {
    const ExcavatorGeometry& geometry = machine().geometry;
    const std::array<double, 3> length_m = {geometry.boom_length_m, geometry.arm_length_m, 0.0};
    const JointResult joints = kinematics_.joints_from_strokes(strokes_m);
    std::array<Place, 3> places{};
    Eigen::Vector2d pin_m = Eigen::Vector2d::Zero();
    double angle_rad = 0.0;
    for (unsigned i = 0; i < 3; ++i) {
      angle_rad += joints.joints_rad[i];
      const Eigen::Rotation2Dd turn(angle_rad);
      places[i] = {pin_m + turn * machine().oil.link[i].centre_m, angle_rad};
      pin_m += turn * Eigen::Vector2d(length_m[i], 0.0);
    }
    return places;
  }

  /// d'Alembert: what each link's acceleration takes, by how its place changes with each stroke.
  /// The load has none.
  [[nodiscard]] Eigen::Vector3d inertia_n(const Eigen::Vector3d& strokes_m,
                                          const Eigen::Vector3d& speed_mps,
                                          const Eigen::Vector3d& change_mps2) const {
    constexpr double kStep_s = 1e-3;
    constexpr double kStep_m = 1e-4;
    const auto at = [&](double time_s) {
      return places(strokes_m + time_s * speed_mps + 0.5 * time_s * time_s * change_mps2);
    };
    const std::array<Place, 3> before = at(-kStep_s);
    const std::array<Place, 3> now = at(0.0);
    const std::array<Place, 3> after = at(kStep_s);
    Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(axis);
      const std::array<Place, 3> more = places(strokes_m + step);
      for (unsigned i = 0; i < 3; ++i) {
        const LinkMass& link = machine().oil.link[i];
        const Eigen::Vector2d pull_mps2 =
            (after[i].centre_m - 2.0 * now[i].centre_m + before[i].centre_m) / (kStep_s * kStep_s);
        const double turn_radps2 =
            (after[i].angle_rad - 2.0 * now[i].angle_rad + before[i].angle_rad) /
            (kStep_s * kStep_s);
        force_n[axis] +=
            (mass_factor[i] * link.mass_kg * pull_mps2.dot(more[i].centre_m - now[i].centre_m) +
             link.inertia_kgm2 * turn_radps2 * (more[i].angle_rad - now[i].angle_rad)) /
            kStep_m;
      }
    }
    return force_n;
  }

  [[nodiscard]] Eigen::Vector3d forces_n(const Eigen::Vector3d& strokes_m,
                                         const Eigen::Vector3d& speed_mps) const {
    constexpr double kStep_m = 1e-4;
    Eigen::Vector3d force_n = offset_n;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep_m * Eigen::Vector3d::Unit(i);
      force_n[i] += (potential_j(strokes_m + step) - potential_j(strokes_m - step)) / (2 * kStep_m);
      force_n[i] += viscous_nspm[i] * speed_mps[i];
      force_n[i] += speed_mps[i] == 0.0 ? 0.0 : std::copysign(coulomb_n[i], speed_mps[i]);
    }
    return force_n;
  }

  void cycle(StepKind kind, double share, const Eigen::Vector3d& strokes_m,
             const Eigen::Vector3d& speed_mps,
             const Eigen::Vector3d& change_mps2 = Eigen::Vector3d::Zero()) {
    const KinematicState now = kinematics_.state(strokes_m);
    LoadSeen seen;
    seen.posed = now.status == ReachStatus::kOk;
    seen.known = seen.posed && !blind;
    seen.stroke_m = strokes_m;
    seen.force_n = forces_n(strokes_m, speed_mps) + inertia_n(strokes_m, speed_mps, change_mps2);
    for (int i = 0; i < 3; ++i) {
      seen.lever_m[i] = 1.0 / now.jacobian(2, i);
    }
    seen.joints_rad = now.joints_rad;
    next_load(machine(), seen, kind, share, now.tip, elapsed_s, active, observer);
  }

  void stand(StepKind kind, const TipPose& pose, double seconds) {
    const Eigen::Vector3d strokes_m = strokes_at(pose);
    for (int n = 0; n < std::lround(100.0 * seconds); ++n) {
      cycle(kind, 0.5, strokes_m, Eigen::Vector3d::Zero());
    }
  }

  /// In strokes, from rest to rest: half of the time it gets faster, then slower.
  void move(StepKind kind, const TipPose& from, const TipPose& to, double seconds) {
    const Eigen::Vector3d from_m = strokes_at(from);
    const Eigen::Vector3d way_m = strokes_at(to) - from_m;
    const long cycles = std::lround(100.0 * seconds);
    for (long n = 0; n < cycles; ++n) {
      const double share = static_cast<double>(n) / static_cast<double>(cycles);
      const double turn = kTwoPi * share;
      cycle(kind, share, from_m + (share - std::sin(turn) / kTwoPi) * way_m,
            (1.0 - std::cos(turn)) / seconds * way_m,
            kTwoPi * std::sin(turn) / (seconds * seconds) * way_m);
    }
  }

 private:
  ExcavatorKinematics kinematics_{machine().geometry};
};

}  // namespace graben::test
