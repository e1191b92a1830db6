// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Boom, arm and bucket as three rigid bodies in the sagittal plane, pushed by their cylinders.

#include <Eigen/Core>
#include <array>
#include <optional>

#include "app/plant/cylinder.hpp"
#include "app/plant/excavator_plant_profile.hpp"
#include "app/plant/linkage_geometry.hpp"
#include "app/plant/rocking_base.hpp"

namespace graben::plant {

/// What boom, arm and bucket are to the swing: their inertia about its axis, and what turning does
/// to them.
///
/// I(q) = sum m r^2 + J cos^2(phi): r is the mass centre's distance from the swing axis, a_1
/// forward of which the boom foot is; J the link's own inertia as of a thin rod along its pins, at
/// phi against the horizontal. Of its width, and of its height where it is bent, nothing is known;
/// the share of J is a tenth of the whole at the most.
class SwingInertia {
 public:
  explicit SwingInertia(const ExcavatorPlantProfile& profile);

  void set_bucket(const LinkBody& bucket) { body_[kBucket] = bucket; }

  /// To these joints, relative as the joint angles.
  void update(const JointRotations& joint);

  [[nodiscard]] double inertia_kgm2() const { return inertia_; }
  /// dI / d(absolute link angle), kg m^2/rad. Half of it, times the swing rate's square, is the
  /// centrifugal moment on the link.
  [[nodiscard]] const JointArray& gradient_kgm2prad() const { return gradient_; }

 private:
  std::array<LinkBody, kAxisCount> body_;
  JointArray link_length_;
  double boom_foot_m_;
  double inertia_ = 0.0;
  JointArray gradient_{};
};

/// M(q) q'' + h(q, q') = Q(q) + G(q) f: joint angles q, mass matrix M, centrifugal terms h, gravity
/// and tip force Q, levers G = diag(dl/dq), piston forces f. On a platform that swings at w the
/// links' inertia I(q) about its axis adds w^2 / 2 dI/dq to Q.
///
/// Scheme: leapfrog. Angles live at the steps, rates between them. Piston damping (with it the
/// impedance of the chambers) acts on the mean rate of the step, implicitly. Coulomb friction is
/// the force up to its limit that brings the piston's velocity closest to 0 at the end of the step,
/// found for all axes together by projected Gauss-Seidel: a piston that sticks stands still, it
/// does not creep.
class LinkageDynamics {
 public:
  explicit LinkageDynamics(const ExcavatorPlantProfile& profile);

  void start(const JointArray& angle_rad, const JointArray& rate_radps);

  /// Force on the bucket tip in the plane's axes, N, and moment about it, N m, constant until
  /// changed.
  void set_tip_force(const Eigen::Vector2d& force_n, double moment_nm) {
    tip_force_ = force_n;
    bucket_moment_nm_ = moment_nm;
  }
  /// What the bucket carries, in the bucket's frame, constant until changed. A change of it changes
  /// no rate: what comes in is taken to move already.
  void carry(const LinkBody& fill);
  /// At the instant of the angles; without a swing drive of no effect.
  void set_swing_rate(double rate_radps) { swing_rate_ = rate_radps; }

  /// Levers at the present angles.
  [[nodiscard]] const std::array<Lever, kAxisCount>& levers() const { return levers_; }
  /// Piston forces that hold the links at rest at the present angles, N.
  [[nodiscard]] JointArray holding_forces() const;

  /// New rates; returns each piston's mean velocity over the step, m/s.
  JointArray accelerate(const std::array<PistonLoad, kAxisCount>& load, double step_s);
  /// New angles.
  void move(double step_s);

  [[nodiscard]] const JointArray& angles() const { return angle_; }
  /// Rates at the instant of the angles (extrapolated by half a step).
  [[nodiscard]] JointArray rates() const;
  /// Of the links about the swing axis; 0 without a swing drive.
  [[nodiscard]] double swing_inertia_kgm2() const { return swing_ ? swing_->inertia_kgm2() : 0.0; }
  /// Kinetic, that of the swing left off, and potential.
  [[nodiscard]] double energy_j() const;
  /// Coulomb friction that acted in the last step, N, positive in extension.
  [[nodiscard]] const JointArray& friction_n() const { return friction_n_; }
  /// Of the force on the tip and the moment about it over the step, between `accelerate` and
  /// `move`.
  [[nodiscard]] double tip_power_w() const;
  [[nodiscard]] TipPose tip() const { return geometry_.tip(angle_); }

  /// What the links stand on is turned by so much, and turns faster; 0 unless told.
  void set_base(double angle_rad, double acceleration_radps2) {
    base_ = Rotation::by(angle_rad);
    base_acceleration_ = acceleration_radps2;
  }
  /// Of the links about the middle of the tracks, as they moved in the last step: inertia, and the
  /// rate of their moment of momentum in the frame of what they stand on.
  [[nodiscard]] BaseLoad base_load() const;
  /// Of the links' weight about the middle of the tracks, N m.
  [[nodiscard]] double weight_moment_nm() const;

 private:
  using Matrix3 = std::array<std::array<double, 3>, 3>;

  /// What the equations need of the present angles, by absolute link angles.
  struct Bodies {
    std::array<Eigen::Vector2d, 3> link;          ///< Pin to next pin (or tip).
    std::array<Eigen::Vector2d, 3> first_moment;  ///< Mass times arm of all that the pin carries.
  };

  void update();
  void set_pivot_inertias();
  [[nodiscard]] Matrix3 mass_matrix() const;
  /// Of each link, where all turn alike: what its own absolute angle feels.
  [[nodiscard]] JointArray links_moments() const;
  [[nodiscard]] double mass_kg() const;
  [[nodiscard]] JointArray generalised_force(const JointArray& rate_radps) const;
  void add_friction(const Matrix3& inverse, const std::array<PistonLoad, kAxisCount>& load,
                    double step_s, JointArray& rate_radps);

  LinkageGeometry geometry_;
  std::array<LinkBody, kAxisCount> body_;
  LinkBody empty_bucket_;
  double fill_kg_ = 0.0;
  JointArray link_length_;
  JointArray pivot_inertia_{};  ///< Of each link about its pin, what it carries as a point mass.
  double gravity_;
  Eigen::Vector2d boom_foot_m_;  ///< From the middle of the tracks.
  Rotation base_;
  double base_acceleration_ = 0.0;
  Eigen::Vector2d tip_force_ = Eigen::Vector2d::Zero();
  double bucket_moment_nm_ = 0.0;

  JointArray angle_{};
  JointRotations joint_;       ///< Of the angles, turned on with them.
  JointArray rate_{};          ///< Half a step before the angles.
  JointArray acceleration_{};  ///< Of the last step.
  JointArray friction_n_{};    ///< Of the last step: where the next search starts.
  double step_ = 0.0;
  Bodies bodies_;
  std::array<Lever, kAxisCount> levers_{};
  std::optional<SwingInertia> swing_;
  double swing_rate_ = 0.0;
};

}  // namespace graben::plant
