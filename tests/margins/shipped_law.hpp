// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The oil's law as it ships, as a linear system: next_oil(), oil_correction_mps() and led_duty()
/// are stepped about rest at a pose, and what comes out for each state and each input moved a
/// little is a column.

#include "firmware/excavator/estimation/oil/oil_law.hpp"
#include "tests/margins/linkage_on_oil.hpp"

namespace graben::margins {

/// A cycle of the law, in time. The law of rest: what leads back is the whole travel, path or no
/// path, nothing is wanted, lambda is 1, both chambers are under pressure, and the valve's model is
/// right.
class LawInTime {
 public:
  /// Of boom and arm: travel, speed, force, load, flow error, first lags, second lags, what was
  /// last asked, led spools, their speeds. Forces in kForceUnit_n.
  static constexpr int kStates = 20;
  using State = Eigen::Matrix<double, kStates, 1>;

  /// Throws std::runtime_error where the pose is out of reach. `gains` has to outlive it.
  LawInTime(const ExcavatorProfile& profile, const OilGains& gains,
            const Eigen::Vector3d& strokes_m);

  /// Takes strokes (m) and forces (kForceUnit_n) of boom and arm beyond those at rest; steps
  /// `state` and returns the duties beyond rest, as the speeds that they stand for (m/s).
  [[nodiscard]] Eigen::Vector2d step(const Eigen::Vector4d& seen, State& state) const;

  [[nodiscard]] const OilModes& modes() const { return modes_; }

 private:
  const OilGains& gains_;
  OilModes modes_;
  double spool_time_constant_s_;
};

/// The same as matrices, from what is seen to the duties. Throws std::runtime_error where twice as
/// much does not give twice as much.
[[nodiscard]] Discrete as_matrices(const LawInTime& law);

}  // namespace graben::margins
