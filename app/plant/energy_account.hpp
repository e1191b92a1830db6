// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where the simulated machine's energy goes: a check of the plant, not a part of its physics.

#include "app/plant/cylinder.hpp"
#include "app/plant/hydraulics.hpp"
#include "app/plant/pump_line.hpp"
#include "app/plant/valve_section.hpp"

namespace graben::plant {

/// Work since the account was opened, J. Hydraulic powers are flows (at ambient density) times
/// `flow_energy_w` at the ports' pressures. `pump_j` and `tip_j` come in from outside, the rest is
/// lost; end stops lend what their springs hold.
struct EnergyAccount {
  double pump_j = 0.0;  ///< Of the ideal displacement.
  double tip_j = 0.0;   ///< Of the force on the bucket tip.

  double pump_leak_j = 0.0;
  double pump_relief_j = 0.0;  ///< With the suction make-up.
  double bypass_j = 0.0;
  double valve_j = 0.0;        ///< Edges, galleries, regeneration checks, hoses, cushions.
  double port_relief_j = 0.0;  ///< With the make-up.
  double piston_leak_j = 0.0;  ///< With that of motors.
  double friction_j = 0.0;     ///< Coulomb and viscous.
  double end_stop_j = 0.0;

  [[nodiscard]] double in_j() const { return pump_j + tip_j; }
  [[nodiscard]] double lost_j() const {
    return pump_leak_j + pump_relief_j + bypass_j + valve_j + port_relief_j + piston_leak_j +
           friction_j + end_stop_j;
  }

  /// Over bypass and reliefs.
  [[nodiscard]] double spilled_j() const { return bypass_j + pump_relief_j + port_relief_j; }

  void add_pump(const Oil& oil, const PumpLine& pump, double step_s);
  void add_section(const Oil& oil, const SectionPorts& ports, const SectionFlows& flows,
                   double step_s);
  /// `coulomb_n` is the friction force that acted, positive in extension.
  void add_piston(const Oil& oil, const PistonPower& power, double coulomb_n, double velocity_mps,
                  double step_s);
  /// Of a motor and what it turns; `coulomb_nm` positive in the direction of a's pressure.
  void add_motor(const Oil& oil, const ChamberPower& power, double coulomb_nm, double rate_radps,
                 double step_s);

 private:
  void add_chambers(const Oil& oil, const ChamberPower& power, double coulomb_w, double step_s);
};

}  // namespace graben::plant
