#pragma once
/// What the oil is, and the energy in it.

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

}  // namespace graben::plant
