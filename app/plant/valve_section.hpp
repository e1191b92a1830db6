// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One section of the main control valve: metering edges, return gallery, regeneration, bypass.

#include "app/plant/hydraulics.hpp"
#include "app/plant/spool.hpp"
#include "firmware/machine/valve.hpp"

namespace graben::plant {

struct SectionData {
  SpoolProfile edges;
  SpoolMetering metering;
  SpoolDynamics spool;
  PortProtection ports;
  double hose_linear_paspm3 = 0.0;  ///< Between valve and cylinder; laminar share.
  double hose_quadratic_pas2pm6 = 0.0;
  /// What a compensator before the in-flow edge leaves of the pressure over it, whatever pump and
  /// load are at; 0: there is none.
  double compensator_pa = 0.0;
  bool load_check = false;  ///< Nothing flows back from the fed chamber; without loss.
};

/// The four ports that a section joins during a step.
struct SectionPorts {
  WavePort cap;
  WavePort rod;
  WavePort supply;   ///< Pump line, towards the in-flow edge.
  WavePort recycle;  ///< Pump line, behind the regeneration check.
  /// Of the cushions, on the way out of the chamber only: 1 / K^2, 0 where there is none.
  double cap_cushion_pas2pm6 = 0.0;
  double rod_cushion_pas2pm6 = 0.0;
};

/// What flows, m^3/s. Chamber flows are positive into the chamber and include its port relief and
/// make-up, hose flows do not; the other two are at the pump line.
struct SectionFlows {
  double cap_in_m3ps = 0.0;
  double rod_in_m3ps = 0.0;
  double cap_hose_m3ps = 0.0;
  double rod_hose_m3ps = 0.0;
  double supply_out_m3ps =
      0.0;  ///< Negative is back-flow, where the circuit has no load check (Kim 3.1).
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
/// The gallery's volume is small against the chambers': its pressure is algebraic. The hoses'
/// resistance is in series with the edges; port relief and make-up sit at the chamber, as their
/// slopes are far larger than the hose's. Of the swing's section the cap side is the left port, the
/// rod side the right one.
class ValveSection {
 public:
  explicit ValveSection(const SectionData& data);

  void set_command(double travel_ratio) { spool_.set_command(travel_ratio); }
  [[nodiscard]] SectionFlows solve(const SectionPorts& ports) const;
  /// Returns whether the spool moved.
  bool step(double step_s);

  /// Pressure at the valve's end of a hose less that in the chamber.
  [[nodiscard]] double hose_drop_pa(double hose_m3ps, double cushion_pas2pm6) const;

  [[nodiscard]] const Spool& spool() const { return spool_; }
  /// An edge is open; `extends` then says which.
  [[nodiscard]] bool is_open() const { return k_in_ > 0.0; }
  /// The section's part of the bypass, 1 / K^2 of its coefficient K, m^3/(s sqrt(Pa)).
  [[nodiscard]] double bypass_inverse_square() const { return bypass_inverse_square_; }

 private:
  [[nodiscard]] ReturnFlow return_flow(double k_out, bool regenerates, const WavePort& chamber,
                                       const WavePort& recycle) const;
  [[nodiscard]] WavePort behind_hose(const WavePort& chamber) const {
    return {chamber.wave_pa, chamber.impedance_paspm3 + hose_linear_};
  }
  void update_openings();
  [[nodiscard]] double checked(double supply_m3ps) const;

  Spool spool_;
  PortProtection protection_;
  RegenerationSide regeneration_;
  double k_extend_in_, k_extend_out_, k_retract_in_, k_retract_out_;  // at full opening
  double k_drain_, k_check_;
  double hose_linear_, hose_quadratic_;
  double k_in_ = 0.0;  ///< Of the edges as they are open, hose included.
  double k_out_ = 0.0;
  double bypass_inverse_square_ = 0.0;
  double compensator_;
  bool load_check_;
  double most_in_ = 0.0;  ///< That the compensator lets through the edge.
  double k_bypass_open_, k_bypass_closed_;
};

/// Gallery pressure and flows with drain and check, (14) - (16), joined to a chamber by an orifice.
/// The check's flow is 0 unless the gallery is above the pump line.
[[nodiscard]] ReturnFlow solve_gallery(double k_out, double k_drain, double k_check,
                                       const WavePort& chamber, const WavePort& recycle);

}  // namespace graben::plant
