// SPDX-License-Identifier: Apache-2.0
// Orifices, reliefs, make-up and the return gallery against closed forms.

#include "app/plant/hydraulics.hpp"

#include "app/plant/valve_section.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::plant;

constexpr double kK = 4e-6;          // m^3/(s sqrt(Pa))
constexpr double kStiffPort = 1e10;  // Pa s/m^3
const PortProtection kProtection{38e6, 5e8, 1e7, -0.1e6};

TEST(coefficient_of_an_area) {
  // C_d A sqrt(2 / rho) for 5 mm^2: 1.48634e-7, by hand.
  assert_near(orifice_coefficient(5e-6, 0.62, 870.0), 1.48634e-7, 1e-12);
}

TEST(flow_between_ideal_sources) {
  const WavePort high{9e6, 0.0};
  const WavePort low{5e6, 0.0};
  assert_near(orifice_flow(kK, high, low), kK * 2000.0, 1e-12);
  assert_near(orifice_flow(kK, low, high), -kK * 2000.0, 1e-12);
  assert_near(orifice_flow(kK, high, high), 0.0, 0.0);
  assert_near(orifice_flow(0.0, high, low), 0.0, 0.0);
}

TEST(flow_between_ports_meets_the_law) {
  for (const double difference : {-2e7, -1e3, -1.0, 1e-3, 1.0, 1e5, 3e7}) {
    const WavePort from{1e7 + difference, 3e8};
    const WavePort to{1e7, 7e8};
    const double q = orifice_flow(kK, from, to);
    const double drop =
        (from.wave_pa - to.wave_pa) - (from.impedance_paspm3 + to.impedance_paspm3) * q;
    assert_near(q * std::fabs(q), kK * kK * drop, 1e-6 * std::fabs(q * q) + 1e-24);
  }
}

TEST(slope_at_zero_is_finite) {
  const WavePort from{1e-6, 3e8};
  const WavePort to{0.0, 7e8};
  assert_near(orifice_flow(kK, from, to) / 1e-6, 1e-9, 1e-15);
}

TEST(orifices_in_a_row) {
  assert_near(series_coefficient(3e-6, 4e-6), 2.4e-6, 1e-18);
  assert_near(series_coefficient(3e-6, 0.0), 0.0, 0.0);
}

TEST(unprotected_between_the_limits) {
  const WavePort port{20e6, 1e9};
  const double q = protected_flow(port, kProtection, [](const WavePort&) { return 1e-3; });
  assert_near(q, 1e-3, 0.0);
}

TEST(relief_opens_above_its_pressure) {
  // A pump of constant flow into a closed port: all of it leaves through the relief.
  const double pumped = 2e-3;
  const WavePort port{kProtection.relief_pa + 0.8e6, kStiffPort};
  const double q = protected_flow(port, kProtection, [&](const WavePort&) { return pumped; });
  const double pressure = port.wave_pa + port.impedance_paspm3 * q;
  const double relieved = (pressure - kProtection.relief_pa) / kProtection.relief_override_paspm3;
  assert_true(relieved > 0.0);
  assert_near(q, pumped - relieved, 1e-12);
}

TEST(make_up_holds_the_port_near_ambient) {
  const double drawn = 6e-3;
  const WavePort port{0.1e6, kStiffPort};
  const double q = protected_flow(port, kProtection, [&](const WavePort&) { return -drawn; });
  const double pressure = port.wave_pa + port.impedance_paspm3 * q;
  assert_near(pressure, -drawn * kProtection.makeup_paspm3, 1e3);
}

// Deep below boiling, as a void leaves it: tank feeds the void with what 0.1 MPa push through the
// check, and an orifice sees the boiling pressure.
TEST(a_port_that_boils_pulls_no_harder) {
  const WavePort port{-5e6, 1e8};
  double drawn = 0.0;
  const double q = protected_flow(port, kProtection, [&](const WavePort& p) {
    return drawn = orifice_flow(kK, {1e6, 0.0}, p);
  });
  assert_near(drawn, kK * std::sqrt(1.1e6), 1e-12);
  assert_near(q, drawn + 0.1e6 / kProtection.makeup_paspm3, 1e-12);
}

// Nearly full: what flows in fills it and then raises its pressure, in the same step.
TEST(filling_up_does_not_overshoot) {
  const WavePort port{-0.2e6, kStiffPort};
  const double q = protected_flow(port, kProtection, [&](const WavePort& p) {
    return orifice_flow(kK, {20e6, 0.0}, p);
  });
  assert_near(q, kK * std::sqrt(20e6 - port.pressure_pa(q)), 1e-9);
  assert_true(port.pressure_pa(q) > 0.0);
  assert_true(port.pressure_pa(q) < 20e6);
}

// (18) by hand, with c_r > c_d and the chamber's out-flow given.
double gallery_root_by_18(double q_out, double p_in, double c_d, double c_r) {
  if (p_in >= q_out * q_out / (c_d * c_d)) {
    return q_out / c_d;
  }
  const double span = c_r * c_r - c_d * c_d;
  return (c_r * std::sqrt(q_out * q_out + span * p_in) - c_d * q_out) / span;
}

TEST(gallery_with_check_shut) {
  const ReturnFlow flow = solve_gallery(5e-6, 7e-7, 1.1e-6, {4e6, 0.0}, {6e6, 0.0});
  const double k = 5e-6 * 7e-7 / std::sqrt(5e-6 * 5e-6 + 7e-7 * 7e-7);
  assert_near(flow.out_m3ps, k * 2000.0, 1e-12);
  assert_near(flow.regenerated_m3ps, 0.0, 0.0);
  assert_near(flow.gallery_pa, std::pow(k * 2000.0 / 7e-7, 2), 1.0);
}

TEST(gallery_with_check_open_is_equation_18) {
  for (const double line_pa : {0.0, 0.2e6, 1e6, 5e6}) {
    const ReturnFlow flow = solve_gallery(5e-6, 7e-7, 1.1e-6, {9e6, 0.0}, {line_pa, 0.0});
    assert_true(flow.regenerated_m3ps > 0.0);
    const double root = gallery_root_by_18(flow.out_m3ps, line_pa, 7e-7, 1.1e-6);
    assert_near(std::sqrt(flow.gallery_pa), root, 1e-3);
    assert_near(flow.out_m3ps, 5e-6 * std::sqrt(9e6 - flow.gallery_pa), 1e-12);
    assert_near(flow.regenerated_m3ps, 1.1e-6 * std::sqrt(flow.gallery_pa - line_pa), 1e-12);
  }
}

TEST(gallery_balances_with_compliant_ports) {
  const WavePort chamber{12e6, 2e8};
  const WavePort line{1e6, 4e8};
  const ReturnFlow flow = solve_gallery(3e-6, 1.2e-6, 2e-6, chamber, line);
  assert_true(flow.regenerated_m3ps > 0.0);
  assert_near(flow.out_m3ps, flow.regenerated_m3ps + 1.2e-6 * std::sqrt(flow.gallery_pa), 1e-12);
}

TEST(gallery_draws_from_tank_below_ambient) {
  const ReturnFlow flow = solve_gallery(3e-6, 1.2e-6, 2e-6, {-1e4, 0.0}, {-2e4, 0.0});
  assert_true(flow.out_m3ps < 0.0);
  assert_near(flow.gallery_pa, -std::pow(flow.out_m3ps / 1.2e-6, 2), 1e-6);
  assert_near(flow.regenerated_m3ps, 0.0, 0.0);
}
