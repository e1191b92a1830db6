// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Oil, orifices, reliefs: laws and figures that are alike in every simulated machine. Resistive
/// elements between transmission-line ports are solved in closed form together with the ports that
/// they join, so that no step length can make one unstable.

#include <algorithm>
#include <cmath>

namespace graben::plant {

/// Density is linear in pressure above ambient, rho = rho_0 (1 + p / beta); below the boiling
/// pressure there is vapour of no stiffness.
struct Oil {
  double bulk_modulus_pa = 0.0;
  double boiling_pa = 0.0;
};

/// Share of the pressure that a flow at ambient density carries as energy: it was more space before
/// it was compressed. beta / p ln(1 + p / beta), to third order: 1e-5 off at 35 MPa.
inline double flow_energy_share(const Oil& oil, double pressure_pa) {
  const double strain = pressure_pa / oil.bulk_modulus_pa;
  return 1.0 - strain * (1.0 / 2.0 - strain * (1.0 / 3.0));
}

/// Energy that a flow of one m^3/s (at ambient density) carries at this pressure, W: the integral
/// of dp rho_0 / rho = beta ln(1 + p / beta).
inline double flow_energy_w(const Oil& oil, double pressure_pa) {
  return pressure_pa * flow_energy_share(oil, pressure_pa);
}

/// Energy of compression of a volume at this pressure, J:
/// V ((beta + p) ln(1 + p / beta) - p), to the same order. Above the boiling pressure.
inline double compression_energy_j(const Oil& oil, double pressure_pa, double volume_m3) {
  const double strain = pressure_pa / oil.bulk_modulus_pa;
  return volume_m3 * pressure_pa * strain * (1.0 / 2.0 - strain * (1.0 / 6.0 - strain / 12.0));
}

/// What a volume shows to whatever is joined to it during one step (a Thevenin source): the port's
/// pressure is `wave_pa + impedance_paspm3 * flow into the volume`. Tank is {0, 0}.
struct WavePort {
  double wave_pa = 0.0;
  double impedance_paspm3 = 0.0;

  [[nodiscard]] double pressure_pa(double inflow_m3ps) const {
    return wave_pa + impedance_paspm3 * inflow_m3ps;
  }
};

inline constexpr WavePort kTank{};

/// K = C_d A sqrt(2 / rho): the flow is K sqrt(dp), m^3/(s sqrt(Pa)).
inline double orifice_coefficient(double area_m2, double discharge, double density_kgpm3) {
  return discharge * area_m2 * std::sqrt(2.0 / density_kgpm3);
}

/// Coefficient of two orifices in a row; 0 if one of them is closed.
inline double series_coefficient(double k_1, double k_2) {
  return k_1 > 0.0 && k_2 > 0.0 ? k_1 * k_2 / std::sqrt(k_1 * k_1 + k_2 * k_2) : 0.0;
}

/// Flow from one port through a square-root orifice to the other, m^3/s. With d the difference of
/// the waves and Z the sum of the impedances, q |q| = K^2 (d - Z q), hence
/// q = K d / (sqrt(|d| + (K Z / 2)^2) + K Z / 2): the slope at zero is 1 / Z.
inline double orifice_flow(double k, const WavePort& from, const WavePort& to) {
  if (k <= 0.0) {
    return 0.0;
  }
  const double d = from.wave_pa - to.wave_pa;
  const double h = 0.5 * k * (from.impedance_paspm3 + to.impedance_paspm3);
  const double s = std::sqrt(std::abs(d) + h * h) + h;
  return s > 0.0 ? k * d / s : 0.0;
}

/// The port together with a laminar path to a source of constant pressure.
inline WavePort joined(const WavePort& port, double source_pa, double path_paspm3) {
  const double sum = port.impedance_paspm3 + path_paspm3;
  return {(port.wave_pa * path_paspm3 + source_pa * port.impedance_paspm3) / sum,
          port.impedance_paspm3 * path_paspm3 / sum};
}

/// Relief to tank and make-up check from tank at one port, and where its oil boils.
struct PortProtection {
  double relief_pa = 0.0;
  double relief_override_paspm3 = 0.0;
  double makeup_paspm3 = 0.0;
  double boiling_pa = 0.0;
};

/// Total flow into the port, m^3/s: that of the elements joined to it, as `flow_into(port)` gives
/// it, less the relief's, plus the make-up's. Exact: both valves are laminar beyond their opening
/// pressure, and at most one of them is open. A port that would still fall below the boiling
/// pressure has that pressure, whatever flows. `flow_into` is called last with the port as it is.
template <class FlowInto>
double protected_flow(const WavePort& port, const PortProtection& protection,
                      const FlowInto& flow_into) {
  const double flow = flow_into(port);
  const double pressure = port.pressure_pa(flow);
  if (pressure >= 0.0 && pressure <= protection.relief_pa) {
    return flow;
  }
  const double source = pressure < 0.0 ? 0.0 : protection.relief_pa;
  const double path = pressure < 0.0 ? protection.makeup_paspm3 : protection.relief_override_paspm3;
  WavePort open = joined(port, source, path);
  double joint_flow = flow_into(open);
  if (open.pressure_pa(joint_flow) < protection.boiling_pa) {
    open = {protection.boiling_pa, 0.0};
    joint_flow = flow_into(open);
  }
  return joint_flow + (source - open.pressure_pa(joint_flow)) / path;
}

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
