#pragma once
/// Figures of oil and valves that no source gives, alike in every simulated machine.

#include "app/plant/orifice.hpp"

namespace graben::plant {

/// Each default says why it is what it is. SI units, pressures above ambient.
struct HydraulicDetails {
  /// Laminar leakage past the piston, m^3/(s Pa). 2e-14 is 12 mL/min at 10 MPa: the boom sinks by
  /// about 3 mm in 5 min, within the 5 - 20 mm that makers of the class allow.
  double piston_leak_m3pspa = 2e-14;
  /// Slope of every relief valve above its opening pressure, Pa s/m^3: 1.2 MPa at 138 L/min.
  double relief_override_paspm3 = 5e8;
  /// Slope of the make-up checks from tank, Pa s/m^3: 0.02 MPa below ambient at 400 L/min, so that
  /// the oil does not boil.
  double makeup_paspm3 = 3e6;
  /// Where the oil boils: 0 absolute, its vapour pressure left off. Dissolved air, which comes out
  /// earlier, is not simulated.
  double boiling_pa = -0.1e6;
  /// Pressure of the unloaded chambers at the start.
  double start_back_pressure_pa = 0.5e6;
  /// Contact at the stroke's ends: full system pressure on a boom cap side (0.8 MN) presses in by
  /// 0.4 mm. Damping acts on the way in only; about critical for the boom's 5e4 kg at its cylinder.
  double end_stop_stiffness_npm = 2e9;
  double end_stop_damping_nspm = 1e7;

  /// These alone, of what has them among others.
  [[nodiscard]] const HydraulicDetails& details() const { return *this; }
  [[nodiscard]] PortProtection protection(double relief_pa) const {
    return {relief_pa, relief_override_paspm3, makeup_paspm3, boiling_pa};
  }
};

}  // namespace graben::plant
