// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An oil volume as a lossless transmission-line junction with a small numerical loss.

#include <algorithm>
#include <array>
#include <cstddef>

#include "app/plant/hydraulics.hpp"

namespace graben::plant {

/// Volume V with N equal ports. Its state is the surplus e: the oil in it, counted at ambient
/// density, less the space. Flows count at ambient density too, so that what one volume loses
/// another gains; the oil's density is linear in pressure:
///   de = h sum(q),   p = beta e / V.
/// A moving wall is a port whose flow is set, together with `grow` by the same volume.
///
/// Cavitation: below the boiling pressure p stays there, while e goes on: the void has to be
/// refilled before pressure can rise again. Ports show the wave of e even then; what is joined to
/// them sees to it that no pressure below boiling acts (`protected_flow`, `Cylinder::load`).
///
/// Over a step h a port's pressure is p + d_i + Z q_i, with Z = N/2 beta h / (V (1 - a)); after it
///   d_i <- (2 a - 1) d_i - N beta h / V (q_i - mean(q)).
/// That is wave scattering, c_i = p + d_i, with a filter a on the waves. Pressure follows as the
/// trapezoidal rule integrates it; the filter damps the alternation from step to step that a closed
/// port would keep for ever, and shifts the rule's weight from 0.5 to 0.5 / (1 - a). Ports do not
/// see each other within a step.
class WaveVolume {
 public:
  static constexpr std::size_t kMaxPorts = 10;  ///< A pump, its bypass, four sections of two.
  static constexpr double kFilter = 0.1;        ///< a; the alternation decays by 0.8 a step.

  WaveVolume(std::size_t port_count, const Oil& oil, double step_s);

  /// Starts with this pressure everywhere; the flows set before are taken as steady.
  void start(double volume_m3, double pressure_pa);

  [[nodiscard]] WavePort port(std::size_t index) const {
    return {mean_ + deviation_[index], impedance_};
  }
  /// Inflow of a port over this step.
  void set_flow(std::size_t index, double flow_m3ps) { flow_[index] = flow_m3ps; }
  /// Ends the step: pressure and ports are then the next one's.
  void scatter();
  /// Space that a wall gave way to; the surplus stays, as the wall's flow has taken its share.
  void grow(double volume_m3);

  [[nodiscard]] double pressure_pa() const { return std::max(mean_, oil_.boiling_pa); }
  /// Oil in it at ambient density.
  [[nodiscard]] double content_m3() const { return volume_ + surplus_; }
  /// Of compression; a void holds what it took to open it against ambient pressure.
  [[nodiscard]] double energy_j() const {
    return compression_energy_j(oil_, pressure_pa(), volume_) - oil_.boiling_pa * void_m3();
  }
  [[nodiscard]] double volume_m3() const { return volume_; }
  /// Space that no oil fills, 0 unless it boils.
  [[nodiscard]] double void_m3() const {
    return std::max(0.0, (oil_.boiling_pa - mean_) / stiffness_);
  }

 private:
  void set_volume(double volume_m3);

  std::size_t count_;
  Oil oil_;
  double step_;
  double port_share_;               ///< 1 / N.
  double impedance_per_stiffness_;  ///< Z V / beta.
  double volume_ = 0.0;
  double surplus_ = 0.0;
  double stiffness_ = 0.0;  ///< beta / V.
  double impedance_ = 0.0;
  double mean_ = 0.0;  ///< p, going on below the boiling pressure.
  std::array<double, kMaxPorts> deviation_{};
  std::array<double, kMaxPorts> flow_{};
};

// In the header, as a step of the plant calls these twenty times.

inline WaveVolume::WaveVolume(std::size_t port_count, const Oil& oil, double step_s)
    : count_(port_count),
      oil_(oil),
      step_(step_s),
      port_share_(1.0 / static_cast<double>(port_count)),
      impedance_per_stiffness_(0.5 / (1.0 - kFilter) * static_cast<double>(port_count) * step_s) {}

inline void WaveVolume::start(double volume_m3, double pressure_pa) {
  set_volume(volume_m3);
  surplus_ = pressure_pa / stiffness_;
  mean_ = pressure_pa;
  for (std::size_t i = 0; i < count_; ++i) {
    deviation_[i] = -impedance_ * flow_[i];
  }
}

inline void WaveVolume::set_volume(double volume_m3) {
  volume_ = volume_m3;
  stiffness_ = oil_.bulk_modulus_pa / volume_;
  impedance_ = impedance_per_stiffness_ * stiffness_;
}

inline void WaveVolume::scatter() {
  double flow_sum = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    flow_sum += flow_[i];
  }
  const double mean_flow = port_share_ * flow_sum;
  const double gain = 2.0 * (1.0 - kFilter) * impedance_;
  for (std::size_t i = 0; i < count_; ++i) {
    deviation_[i] = (2.0 * kFilter - 1.0) * deviation_[i] - gain * (flow_[i] - mean_flow);
  }
  surplus_ += step_ * flow_sum;
  mean_ = stiffness_ * surplus_;
}

inline void WaveVolume::grow(double volume_m3) {
  set_volume(volume_ + volume_m3);
  mean_ = stiffness_ * surplus_;
}

}  // namespace graben::plant
