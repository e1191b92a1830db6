#pragma once
/// An oil volume as a lossless transmission-line junction with a small numerical loss.

#include <array>
#include <cstddef>

#include "app/plant/orifice.hpp"

namespace graben::plant {

/// Volume V with N equal ports. Over a step h a port's pressure is p = c + Z q, with q its inflow
/// and Z = N/2 beta h / (V (1 - a)); then the waves scatter:
///   c_i <- a c_i + (1 - a) (2 mean(c + 2 Z q) - c_i - 2 Z q_i).
/// The mean pressure then follows dp/dt = beta / V sum(q), as the trapezoidal rule integrates it;
/// the filter a damps the alternation from step to step that a closed port would keep for ever, and
/// shifts the rule's weight from 0.5 to 0.5 / (1 - a). Ports do not see each other within a step.
class WaveVolume {
 public:
  static constexpr std::size_t kMaxPorts = 8;
  static constexpr double kFilter = 0.1;  ///< a; the alternation decays by 0.8 a step.

  WaveVolume(std::size_t port_count, double bulk_modulus_pa, double step_s);

  /// Takes effect on the port impedances at once; pressures stay.
  void set_volume(double volume_m3) { impedance_ = impedance_volume_ / volume_m3; }

  [[nodiscard]] WavePort port(std::size_t index) const { return {wave_[index], impedance_}; }
  /// Inflow of a port over this step.
  void set_flow(std::size_t index, double flow_m3ps) { flow_[index] = flow_m3ps; }
  /// Ends the step: the ports are then the next one's.
  void scatter();

  /// Mean over the ports as the last step solved them: at its beginning, one step before the ports.
  [[nodiscard]] double pressure_pa() const { return pressure_; }
  /// The same at port 0.
  [[nodiscard]] double first_port_pressure_pa() const { return first_port_pressure_; }

  /// Starts with this pressure everywhere; the flows set before are taken as steady.
  void start(double pressure_pa);

 private:
  std::size_t count_;
  double impedance_volume_;  ///< Z V
  double impedance_ = 0.0;
  double pressure_ = 0.0;
  double first_port_pressure_ = 0.0;
  std::array<double, kMaxPorts> wave_{};
  std::array<double, kMaxPorts> flow_{};
};

}  // namespace graben::plant
