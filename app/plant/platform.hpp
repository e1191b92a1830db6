#pragma once
/// The upper structure's turning about the vertical.

#include "app/plant/swing_motor.hpp"

namespace graben::plant {

/// About the swing axis.
struct PlatformData {
  double inertia_kgm2 = 0.0;  ///< Without the links.
  double coulomb_nm = 0.0;
  double viscous_nmsprad = 0.0;
};

/// d/dt (I w) = torque - friction, with the inertia of platform and links at their present pose.
///
/// Scheme: leapfrog, as in `LinkageDynamics`. The angle lives at the steps, the angular momentum
/// between them, where the inertia is the mean of the two steps': without torque it stays, however
/// the links move. Damping (with it the impedance of the chambers) acts on the
/// mean rate of the step, implicitly; Coulomb friction is the torque up to its limit that brings
/// the rate closest to 0 at the end of the step: a platform that sticks stands still.
class Platform {
 public:
  /// At rest. `links_kgm2` as in `accelerate`.
  Platform(const PlatformData& data, double angle_rad, double links_kgm2);

  /// New rate. `links_kgm2` is the links' inertia at the end of the step. Returns the step's mean
  /// rate.
  double accelerate(const MotorLoad& load, double links_kgm2, double step_s);
  /// New angle.
  void move(double step_s) { angle_ += step_s * rate_; }

  /// Left is positive; goes on beyond whole turns.
  [[nodiscard]] double angle_rad() const { return angle_; }
  /// At the instant of the angle (extrapolated by half a step).
  [[nodiscard]] double rate_radps() const { return rate_ + 0.5 * change_; }
  /// With the links'.
  [[nodiscard]] double inertia_kgm2() const { return inertia_; }
  [[nodiscard]] double energy_j() const { return 0.5 * inertia_ * rate_radps() * rate_radps(); }
  /// Coulomb friction that acted in the last step, positive to the left.
  [[nodiscard]] double friction_nm() const { return friction_; }
  [[nodiscard]] double viscous_w(double rate_radps) const {
    return data_.viscous_nmsprad * rate_radps * rate_radps;
  }

 private:
  PlatformData data_;
  double angle_;
  double inertia_;          ///< At the angle's instant.
  double between_inertia_;  ///< At the rate's.
  double rate_ = 0.0;       ///< Half a step before the angle.
  double change_ = 0.0;     ///< Of the rate in the last step.
  double friction_ = 0.0;
};

}  // namespace graben::plant
