#pragma once
/// The hydraulic motor that turns the platform, with its reduction.

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

}  // namespace graben::plant
