// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Speeds of all cylinders at one moment, by a profile alone: the valve's equations solved for the
/// speeds, at given openings and loads.

#include <array>

#include "firmware/excavator/excavator_profile.hpp"
#include "firmware/mcv/circuit.hpp"

namespace graben::identify {

/// One moment of a machine. SI units; extension is positive.
struct ValveMoment {
  /// Share of the travel outside the dead band, its sign the side.
  std::array<double, kAxisCount> opening{};
  /// True pressures: the sensors' zeros are taken off.
  std::array<double, kAxisCount> cap_pa{};
  std::array<double, kAxisCount> rod_pa{};
  std::array<double, kPumpCount> swash{};
  double engine_radps = 0.0;
};

class SpeedModel {
 public:
  explicit SpeedModel(const ExcavatorProfile& profile);

  /// Speeds that the pumps' lines, the loads and the openings leave: v = c_L(x) sqrt(F), (9) to
  /// (12), and the flow balance (27) of each line, together. A cylinder whose load drives it while
  /// no oil is behind it goes as fast as its draining edge lets it.
  [[nodiscard]] std::array<double, kAxisCount> speeds_mps(const ValveMoment& moment) const;

 private:
  /// An axis that is open.
  struct Open {
    int axis = 0;
    CircuitAxis at_1_mps;       ///< Flows are those of the speed.
    double coefficient = 0.0;   ///< c_L, m/(s sqrt(N)).
    double drained_mps = -1.0;  ///< By its draining edge, where nothing feeds it; else below 0.
  };

  [[nodiscard]] Open open_axis(const McvCircuit& circuit, const ValveMoment& moment,
                               int axis) const;
  [[nodiscard]] double drained_mps(const CircuitAxis& at_1_mps, const ValveMoment& moment, int axis,
                                   double area_ratio) const;

  ExcavatorProfile profile_;
  McvMachine machine_;
};

}  // namespace graben::identify
