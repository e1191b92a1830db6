// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The engine, as far as its pumps pull its speed down.

#include <cmath>

namespace graben::plant {

struct EngineSag {
  double share = 0.0;  ///< Of its speed that is lost at full pump power.
  double lag_s = 0.5;  ///< First order, from power to speed.
};

/// Runs at the share of its rated speed that it is set to, less what the pumps' power takes away.
class Engine {
 public:
  Engine(const EngineSag& data, double step_s)
      : sag_(data.share), step_share_(-std::expm1(-step_s / data.lag_s)) {}

  /// Of the rated speed, without load; 0: it stands.
  void set_ratio(double ratio) { ratio_ = ratio; }
  /// As after a long time at this share of the full pump power.
  void start(double power_share) { load_ = power_share; }
  void step(double power_share) { load_ += step_share_ * (power_share - load_); }

  [[nodiscard]] bool sags() const { return sag_ > 0.0; }
  [[nodiscard]] double speed_ratio() const { return ratio_ * (1.0 - sag_ * load_); }

 private:
  double sag_;
  double step_share_;  ///< Of the way to the load's share, in a step.
  double ratio_ = 1.0;
  double load_ = 0.0;
};

}  // namespace graben::plant
