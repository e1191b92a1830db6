// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two oil chambers with what they push between them: a piston, or the rotor of a motor.

#include "app/plant/hydraulics.hpp"
#include "app/plant/wave_volume.hpp"

namespace graben::plant {

/// Displacements are volumes per travel: areas of a piston (m^2), of a motor m^3/rad.
struct ChamberPairData {
  double a_displacement = 0.0;
  double b_displacement = 0.0;
  double leak_m3pspa = 0.0;  ///< From one chamber to the other, laminar.
  Oil oil;
};

/// What one chamber does to the mechanism over one step: `force - damping * mean velocity of the
/// step` from a, `force + damping * mean velocity` against it from b. In N and N s/m, of a motor in
/// N m and N m s/rad.
struct ChamberLoad {
  double force = 0.0;
  double damping = 0.0;
};
struct ChamberLoads {
  ChamberLoad a;
  ChamberLoad b;
};

/// What goes through the chambers in a step, for the energy account.
struct ChamberPower {
  double a_pa = 0.0;  ///< As the piston or rotor saw it.
  double b_pa = 0.0;
  double leak_m3ps = 0.0;
  double viscous_w = 0.0;
};

/// Chamber a grows with positive travel, b with negative. Leakage lags by one step (its time
/// constant is minutes in a cylinder, a tenth of a second in a motor). How much the chambers grow
/// is said by whoever moves: a motor's do not.
class ChamberPair {
 public:
  ChamberPair(const ChamberPairData& data, double step_s);

  void start(double a_volume_m3, double a_pa, double b_volume_m3, double b_pa);

  [[nodiscard]] WavePort a_port() const { return a_.port(kValve); }
  [[nodiscard]] WavePort b_port() const { return b_.port(kValve); }
  /// `velocity` is the last one (m/s, rad/s).
  [[nodiscard]] ChamberLoads load(double velocity) const;
  /// With the step's mean velocity, before `step`.
  [[nodiscard]] ChamberPower power(double velocity, double mean_velocity) const;
  /// Ends the step with the flows from the valve into the chambers and the mean velocity.
  void step(double a_in_m3ps, double b_in_m3ps, double mean_velocity);
  /// Space that opened in a and closed in b.
  void grow(double a_m3, double b_m3) {
    a_.grow(a_m3);
    b_.grow(b_m3);
  }

  [[nodiscard]] const WaveVolume& a() const { return a_; }
  [[nodiscard]] const WaveVolume& b() const { return b_; }

 private:
  static constexpr std::size_t kValve = 0;
  static constexpr std::size_t kWall = 1;

  [[nodiscard]] double leak_m3ps() const { return leak_ * (a_.pressure_pa() - b_.pressure_pa()); }
  /// As the wall sees it: a chamber that boils at the last velocity pulls no harder.
  [[nodiscard]] WavePort wall_port(const WaveVolume& chamber, double last_inflow_m3ps) const;

  WaveVolume a_;
  WaveVolume b_;
  double a_displacement_;
  double b_displacement_;
  double leak_;
  double boiling_;
};

}  // namespace graben::plant
