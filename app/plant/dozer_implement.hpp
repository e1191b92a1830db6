// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The dozer's implement circuit: pump of fixed displacement, load-sensing section, port reliefs.

#include "app/plant/cylinder.hpp"
#include "app/plant/dozer_plant_profile.hpp"
#include "app/plant/hydraulics.hpp"
#include "app/plant/spool.hpp"

namespace graben::plant {

/// What one step did, m^3/s. Chamber flows are positive into the chamber and include its port
/// relief and make-up.
struct ImplementFlows {
  double demand = 0.0;     ///< What the spool's opening asks for.
  double available = 0.0;  ///< What the pump gives.
  double supply = 0.0;     ///< What goes from pump to cylinders; the rest is unloaded.
  double cap_in = 0.0;
  double rod_in = 0.0;
};

/// What makes one section of the valve.
struct ImplementSection {
  SpoolDynamics spool;
  double flow_max_m3ps = 0.0;
  PistonAreas area;
  double extending_back_pressure_pa = 0.0;  ///< Of the chamber that empties.
  double retracting_back_pressure_pa = 0.0;
};
[[nodiscard]] ImplementSection lift_section(const DozerPlantProfile& profile);
[[nodiscard]] ImplementSection tilt_section(const DozerPlantProfile& profile);

/// A pressure-compensated section: its inflow is the spool's opening times the valve's largest
/// flow, whatever the load, as long as the pump can feed that and the load is a margin below the
/// relief; a load check keeps it from flowing back. A brake valve in the return opens with the
/// inflow, not with the spool: what leaves meets the same pressure at any speed, also where the
/// pump cannot feed what the spool asks for. The lines between are short: no volume beside the
/// chambers'.
class ImplementCircuit {
 public:
  ImplementCircuit(const DozerPlantProfile& profile, const ImplementSection& section);

  /// Where the spool is sent, of its travel.
  void set_command(double travel_ratio) { spool_.set_command(travel_ratio); }
  /// With what of the pump's flow it has.
  [[nodiscard]] const ImplementFlows& solve(double available_m3ps, const WavePort& cap,
                                            const WavePort& rod);
  /// Ends the step.
  void step(double step_s) { spool_.step(step_s); }

  [[nodiscard]] const Spool& spool() const { return spool_; }
  [[nodiscard]] const ImplementFlows& flows() const { return flows_; }
  [[nodiscard]] double demand_m3ps() const { return spool_.area_ratio() * flow_max_; }
  [[nodiscard]] double pump_flow_m3ps(double engine_radps) const {
    return pump_m3prad_ * engine_radps;
  }

 private:
  [[nodiscard]] double supply(double k_in, const WavePort& fed) const;

  Spool spool_;
  PortProtection protection_;
  double pump_m3prad_;
  double relief_;
  double flow_max_;
  double k_in_;          ///< Of the edges fully open.
  double k_extending_;   ///< Rod chamber to tank, at the valve's largest inflow.
  double k_retracting_;  ///< Cap chamber to tank, the same.
  ImplementFlows flows_;
};

}  // namespace graben::plant
