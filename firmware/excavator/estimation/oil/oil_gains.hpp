// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Gains of observer and feedback for one mode of the linkage on its oil, by the mode's frequency:
/// solved once, at start, looked up in each cycle.

#include <Eigen/Core>
#include <array>

namespace graben {

/// Of a mode with the frequency that the profile makes of it. Lengths and speeds of the mode, see
/// OilModes; compression is force over stiffness.
struct ModeGains {
  /// States of a mode. [-; size: travel, speed, the oil's balance, two lags; or, observed, travel,
  /// speed, compression, load, flow error]
  static constexpr int kStates = 5;
  /// Speed to ask for, per travel (1/s), speed (1), missing balance of the oil (1/s), and the two
  /// lags between a command and its flow (1).
  Eigen::Matrix<double, kStates, 1> feedback = Eigen::Matrix<double, kStates, 1>::Zero();
  /// Corrections of travel, speed, compression, load and flow error, per travel and per compression
  /// seen besides what was expected.
  Eigen::Matrix<double, kStates, 2> observer = Eigen::Matrix<double, kStates, 2>::Zero();
};

/// What an observer or a feedback is computed for.
struct OilDesign {
  double lag_s = 0.018;            ///< Each of the two lags from a command to its flow.
  double travel_ps = 5.0;          ///< Speed asked for per travel that is missing, about.
  double speed_s = 0.001;          ///< Weight of speed against travel.
  double balance = 0.01;           ///< Weight of the missing balance against travel.
  double load_m2ps = 1e-4;         ///< How fast the load may change, as compression squared.
  double flow_m2ps3 = 1e-5;        ///< How fast the flow's error may change.
  double travel_noise_m = 7e-5;    ///< Of a stroke, its resolution included; with 5e-5 the steps of
                                   ///< 0.1 mm move the pilot valves half as much again.
  double pressure_noise_m = 2e-3;  ///< Of a force, as compression; more than the sensors' own, so
                                   ///< that a stiffness that is not known does no harm.
};

/// From discrete Riccati equations, h = 10 ms: p' = v, v' = omega^2 (c + f), c' = w + d - v, w
/// behind two lags of the command. A fixed number of steps.
[[nodiscard]] ModeGains mode_gains(const OilDesign& design, double omega_radps);

/// Looked up, linear in the frequency's root; beyond its ends, 4 and 196 rad/s, the last value.
class OilGains {
 public:
  /// Frequencies in the table. [-; size: evenly over the root, kOilLeastRoot to kOilMostRoot]
  static constexpr int kKnots = 12;

  /// All gains 0: for a machine that does not use them.
  OilGains() = default;
  explicit OilGains(const OilDesign& design);

  [[nodiscard]] ModeGains at(double omega_radps) const;
  [[nodiscard]] double lag_s() const { return lag_s_; }

 private:
  std::array<ModeGains, kKnots> knot_;
  double lag_s_ = 0.0;
};

}  // namespace graben
