// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The upper structure's turning about the vertical, and the hydraulic motor that turns it.

#include "app/plant/chamber_pair.hpp"

namespace graben::plant {

/// About the swing axis, reduction included; the left port's pressure turns to the left, which is
/// positive.
struct SwingMotorData {
  double displacement_m3prad = 0.0;
  double chamber_volume_m3 = 0.0;  ///< Each side, with hose.
  double leak_m3pspa = 0.0;        ///< From port to port.
  double start_pa = 0.0;           ///< On both sides.
  Oil oil;
};

/// What the motor gives to the platform over one step: `torque_nm - damping_nmsprad * mean rate of
/// the step`.
struct MotorLoad {
  double torque_nm = 0.0;
  double damping_nmsprad = 0.0;
};

/// Two chambers of constant volume. Oil that goes through expands on its way, so that the torque is
/// the displacement times the difference of what the flow carries (`flow_energy_w`), some 1 % less
/// than that of the pressures at 30 MPa. With the whole of it the motor would make energy.
class SwingMotor {
 public:
  SwingMotor(const SwingMotorData& data, double step_s);

  [[nodiscard]] WavePort left_port() const { return chambers_.a_port(); }
  [[nodiscard]] WavePort right_port() const { return chambers_.b_port(); }
  /// Before the step: how fast it last turned.
  void set_rate(double rate_radps) { rate_ = rate_radps; }
  [[nodiscard]] MotorLoad load() const;
  /// With the step's mean rate, before `step`; chamber a is the left one.
  [[nodiscard]] ChamberPower power(double mean_rate_radps) const {
    return chambers_.power(rate_, mean_rate_radps);
  }
  /// Ends the step with its chamber flows (into the chambers) and mean rate.
  void step(double left_in_m3ps, double right_in_m3ps, double mean_rate_radps) {
    chambers_.step(left_in_m3ps, right_in_m3ps, mean_rate_radps);
  }

  [[nodiscard]] const WaveVolume& left() const { return chambers_.a(); }
  [[nodiscard]] const WaveVolume& right() const { return chambers_.b(); }

 private:
  ChamberPair chambers_;
  Oil oil_;
  double rate_ = 0.0;
};

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
