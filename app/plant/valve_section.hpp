#pragma once
/// One section of the main control valve: metering edges, return gallery, regeneration, bypass.

#include "app/plant/orifice.hpp"
#include "app/plant/plant_profile.hpp"
#include "app/plant/spool.hpp"

namespace graben::plant {

/// The four ports that a section joins during a step.
struct SectionPorts {
  WavePort cap;
  WavePort rod;
  WavePort supply;   ///< Pump line, towards the in-flow edge.
  WavePort recycle;  ///< Pump line, behind the regeneration check.
};

/// What flows, m^3/s. Chamber flows are positive into the chamber and include its port relief and
/// make-up; the other two are at the pump line.
struct SectionFlows {
  double cap_in_m3ps = 0.0;
  double rod_in_m3ps = 0.0;
  double supply_out_m3ps =
      0.0;  ///< Negative is back-flow: the circuit has no load check (Kim 3.1).
  double recycle_in_m3ps = 0.0;  ///< Q_rgn of (14).
};

/// Out-flow of a chamber.
struct ReturnFlow {
  double out_m3ps = 0.0;
  double regenerated_m3ps = 0.0;
  double gallery_pa = 0.0;
};

/// Kim 3.1 - 3.3 with a spool that takes time. On the regenerating side the return passes a gallery
/// with a drain orifice c_d to tank and a check c_r to the pump line, elsewhere it goes to tank.
/// The gallery's volume is small against the chambers': its pressure is algebraic.
class ValveSection {
 public:
  ValveSection(const PlantProfile& profile, int axis);

  void set_command(double travel_ratio) { spool_.set_command(travel_ratio); }
  [[nodiscard]] SectionFlows solve(const SectionPorts& ports) const;
  void step(double step_s) { spool_.step(step_s); }

  [[nodiscard]] const Spool& spool() const { return spool_; }
  /// Coefficient of the section's part of the bypass, m^3/(s sqrt(Pa)), always above 0.
  [[nodiscard]] double bypass_coefficient() const;

 private:
  [[nodiscard]] ReturnFlow return_flow(double k_out, bool regenerates, const WavePort& chamber,
                                       const WavePort& recycle) const;

  Spool spool_;
  PortProtection protection_;
  RegenerationSide regeneration_;
  double k_extend_in_, k_extend_out_, k_retract_in_, k_retract_out_;  // at full opening
  double k_drain_, k_check_;
  double k_bypass_open_, k_bypass_closed_;
};

/// Gallery pressure and flows with drain and check, (14) - (16), joined to a chamber by an orifice.
/// The check's flow is 0 unless the gallery is above the pump line.
[[nodiscard]] ReturnFlow solve_gallery(double k_out, double k_drain, double k_check,
                                       const WavePort& chamber, const WavePort& recycle);

}  // namespace graben::plant
