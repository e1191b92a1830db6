// SPDX-License-Identifier: Apache-2.0
// The oil volume against closed forms.

#include "app/plant/wave_volume.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using namespace graben::plant;

constexpr double kBulkModulus = 1.2e9;
constexpr double kVolume = 2e-3;
constexpr double kStep = 1e-4;
constexpr Oil kOil{kBulkModulus, 0.0};

TEST(steady_inflow_raises_the_pressure) {
  WaveVolume volume(3, kOil, kStep);
  volume.start(kVolume, 5e6);
  for (int i = 0; i < 1000; ++i) {
    volume.set_flow(0, 4e-4);
    volume.set_flow(2, -1e-4);
    volume.scatter();
  }
  // dp/dt = beta / V * 3e-4 m^3/s over 0.1 s; the filter may shift it by a fraction of a step.
  assert_near(volume.pressure_pa(), 5e6 + kBulkModulus / kVolume * 3e-4 * 0.1, 0.2e5);
}

TEST(start_is_steady) {
  WaveVolume volume(2, kOil, kStep);
  volume.set_flow(0, 1e-3);
  volume.set_flow(1, -1e-3);
  volume.start(kVolume, 7e6);
  for (int i = 0; i < 50; ++i) {
    volume.scatter();
    assert_near(volume.pressure_pa(), 7e6, 1e-6);
  }
}

// sqrt(p) = sqrt(p0) - beta K / (2 V) t; 20 MPa through 5 mm^2, as in the Hopsan reference run,
// which is empty at 0.1003 s.
TEST(discharge_through_an_orifice) {
  const double k = orifice_coefficient(5e-6, 0.62, 870.0);
  WaveVolume volume(1, kOil, kStep);
  volume.start(kVolume, 20e6);
  for (int i = 1; i <= 950; ++i) {
    volume.set_flow(0, -orifice_flow(k, volume.port(0), kTank));
    volume.scatter();
    const double root = std::sqrt(20e6) - kBulkModulus * k / (2.0 * kVolume) * kStep * i;
    assert_near(volume.pressure_pa(), root * root, 4e4);
  }
  assert_near(volume.pressure_pa(), 56e3, 15e3);
}

// Thousands of the orifice's time constants in a step: the ports stay within the start's pressure.
TEST(far_too_long_a_step_stays_stable) {
  WaveVolume volume(2, {1e10, 0.0}, 0.1);
  volume.start(1e-4, 30e6);
  double pressure = 30e6;
  for (int i = 0; i < 200; ++i) {
    const WavePort port = volume.port(0);
    const double out = orifice_flow(5e-6, port, kTank);
    pressure = port.wave_pa - port.impedance_paspm3 * out;
    assert_true(std::fabs(pressure) <= 30e6);
    volume.set_flow(0, -out);
    volume.set_flow(1, 0.0);
    volume.scatter();
  }
  assert_near(pressure, 0.0, 1.0);
}

TEST(closed_ports_agree_after_a_while) {
  WaveVolume volume(2, kOil, kStep);
  volume.start(kVolume, 5e6);
  volume.set_flow(0, 1e-3);
  volume.scatter();
  volume.set_flow(0, 0.0);
  graben::repeat(100, [&] { volume.scatter(); });
  assert_near(volume.port(0).wave_pa, volume.port(1).wave_pa, 1e-3);
}

// A wall gives way by 1 % of the volume: density is linear in pressure, so that
// V (1 + p / beta) stays.
TEST(oil_survives_a_change_of_volume) {
  WaveVolume volume(2, kOil, kStep);
  volume.start(kVolume, 30e6);
  const double content = volume.content_m3();
  for (int i = 0; i < 100; ++i) {
    volume.set_flow(1, -1e-4 * kVolume / kStep);
    volume.scatter();
    volume.grow(1e-4 * kVolume);
  }
  assert_near(volume.content_m3(), content, 1e-15);
  assert_near(volume.volume_m3(), 1.01 * kVolume, 1e-15);
  assert_near(volume.pressure_pa(), kBulkModulus * ((1.0 + 30e6 / kBulkModulus) / 1.01 - 1.0), 1.0);
}

// Below its boiling pressure a volume pulls no harder, and gives back pressure only when it is
// full.
TEST(void_is_refilled_before_pressure_returns) {
  const Oil oil{kBulkModulus, -0.1e6};
  WaveVolume volume(2, oil, kStep);
  volume.start(kVolume, 0.0);
  for (int i = 0; i < 100; ++i) {
    volume.set_flow(0, -1e-4);
    volume.scatter();
  }
  assert_near(volume.pressure_pa(), -0.1e6, 0.0);
  // 1e-4 m^3/s over 10 ms, less what stretched the oil before it boiled.
  const double stretched = 0.1e6 * kVolume / kBulkModulus;
  assert_near(volume.void_m3(), 1e-6 - stretched, 1e-15);
  int steps = 0;
  for (; volume.void_m3() > 0.0; ++steps) {
    volume.set_flow(0, 2e-4);
    volume.scatter();
  }
  assert_near(steps, (1e-6 - stretched) / (2e-4 * kStep), 1.0);
  assert_near(volume.content_m3() - kVolume, -1e-6 + steps * 2e-4 * kStep, 1e-15);
}
