// SPDX-License-Identifier: Apache-2.0
// One cylinder with valve section, pump line and mass against closed forms.

#include <algorithm>
#include <cmath>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/cylinder_circuit.hpp"

using namespace graben::plant;

constexpr double kCapArea = kCircuitCapArea;
constexpr double kRodArea = kCircuitRodArea;

// Steady extension: in-flow and out-flow of an asymmetric cylinder, force balance, pump balance.
TEST(steady_extension_meets_the_orifice_equations) {
  const ExcavatorPlantProfile profile = hopsan_circuit(200);
  CylinderCircuit circuit(profile, 0.1, 20000.0, 60000.0);
  circuit.run(5.0, 0.4);
  const double v = circuit.velocity_mps;
  const double cap = circuit.cap_pa();
  const double rod = circuit.rod_pa();
  const double line = circuit.pump.pressure_pa();
  const double k = 0.62 * std::sqrt(2.0 / 870.0) * 0.4;
  assert_near(v * (1.0 + cap / 1.2e9), 0.1536, 1e-4);  // as incompressible oil would go
  // Flows count at ambient density, what the piston sweeps is denser by p / beta.
  const double cap_flow = kCapArea * v * (1.0 + cap / 1.2e9);
  assert_near(cap_flow, k * 1.70e-4 * std::sqrt(line - cap), 1e-6);
  assert_near(kRodArea * v * (1.0 + rod / 1.2e9), k * 1.05e-4 * std::sqrt(rod), 1e-6);
  assert_near(kCapArea * cap - kRodArea * rod, 60000.0 + 15000.0 * v, 5.0);
  assert_near(circuit.pump.flows().delivered_m3ps, cap_flow + kHopsanBypass * std::sqrt(line),
              1e-6);
  assert_near(circuit.pump.flows().delivered_m3ps, 3.5e-3 - 4e-12 * line, 1e-9);
}

TEST(pump_relief_takes_what_the_bypass_cannot) {
  CylinderCircuit circuit(hopsan_circuit(200), 0.1, 20000.0, 60000.0);
  circuit.run(1.0, 0.0);
  const double line = circuit.pump.pressure_pa();
  const double relieved = circuit.pump.flows().delivered_m3ps - kHopsanBypass * std::sqrt(line);
  assert_near(line, 35e6 + relieved * 0.17e6 / 0.631e-3, 1.0);
  assert_true(relieved > 0.5e-3);
}

TEST(regeneration_feeds_the_pump_line) {
  ExcavatorPlantProfile profile = hopsan_circuit(200);
  SpoolProfile& spool = profile.machine.valve.spool[kArm];
  spool.regeneration = RegenerationSide::kExtend;
  spool.c_drain = 7e-7;
  spool.c_check = 1.1e-6;
  // A load that pulls the rod out.
  CylinderCircuit circuit(profile, 0.1, 20000.0, -60000.0);
  circuit.run(1.5, 0.9);
  const double out = kRodArea * circuit.velocity_mps * (1.0 + circuit.rod_pa() / 1.2e9);
  assert_true(circuit.flows.recycle_in_m3ps > 0.05 * out);
  const double drained = out - circuit.flows.recycle_in_m3ps;
  const double gallery = std::pow(drained / 7e-7, 2);
  const double check = 1.1e-6 * std::sqrt(gallery - circuit.pump.pressure_pa());
  assert_near(circuit.flows.recycle_in_m3ps, check, 2e-5);
  // The same spool does not regenerate the other way.
  circuit.run(1.0, -0.5);
  assert_near(circuit.flows.recycle_in_m3ps, 0.0, 0.0);
}

TEST(load_above_the_pump_flows_back) {
  // No load check in the circuit: opening towards a pump at standby lets the load down at first.
  ExcavatorPlantProfile profile = hopsan_circuit(200);
  profile.machine.valve.spool[kArm].bypass_open = 4.5e-6;
  profile.machine.valve.spool[kArm].bypass_closed = 4.5e-6;
  CylinderCircuit circuit(profile, 0.752, 20000.0, 150000.0);
  circuit.run(0.3, 0.5);
  assert_true(circuit.velocity_mps < -0.01);
  assert_true(circuit.flows.supply_out_m3ps < 0.0);
}

TEST(blocked_chambers_carry_a_load_like_a_spring) {
  ExcavatorPlantProfile profile = hopsan_circuit(200);
  profile.friction[kArm] = {0.0, 4e5};  // settles soon
  CylinderCircuit circuit(profile, 0.752, 20000.0, 60000.0);
  circuit.load_n += 10000.0;
  circuit.run(5.0, 0.0);
  const double stiffness = 1.2e9 * (kCapArea * kCapArea / (1e-3 + kCapArea * 0.752) +
                                    kRodArea * kRodArea / (1e-3 + kRodArea * 0.752));
  assert_near(circuit.position_m - 0.752, -10000.0 / stiffness, 5e-6);
}

TEST(piston_leakage_is_laminar) {
  ExcavatorPlantProfile profile = hopsan_circuit(200);
  profile.piston_leak_m3pspa = 1e-12;
  Cylinder cylinder(profile.cylinder(kArm), profile.step_s());
  cylinder.start(0.752, 200e3);
  const double cap = cylinder.cap().pressure_pa();
  const double difference = cap - cylinder.rod().pressure_pa();
  for (int i = 0; i < 100; ++i) {  // 20 ms with the piston held
    cylinder.step(0.0, 0.0, 0.0);
  }
  const double rate = 1.2e9 * 1e-12 * difference / (1e-3 + kCapArea * 0.752);
  assert_near(cylinder.cap().pressure_pa() - cap, -rate * 20e-3, 0.02 * rate * 20e-3);
}

// A load that would need 41 MPa presses in through the cap relief and draws on the rod side.
TEST(port_relief_and_make_up_hold_the_chambers) {
  ExcavatorPlantProfile profile = hopsan_circuit(200);
  profile.port_relief_pa = 38e6;
  profile.makeup_paspm3 = 3e6;
  profile.boiling_pa = -0.1e6;
  CylinderCircuit circuit(profile, 1.2, 20000.0, 60000.0);
  circuit.load_n = 630e3;
  circuit.run(1.0, 0.0);
  const double v = -circuit.velocity_mps;
  assert_true(v > 0.05);
  assert_near(circuit.cap_pa(), 38e6 + profile.relief_override_paspm3 * kCapArea * v, 4e5);
  assert_near(circuit.rod_pa(), -profile.makeup_paspm3 * kRodArea * v, 1e3);
  assert_near(circuit.cylinder.rod().void_m3(), 0.0, 0.0);
}

// Closed valve, no make-up: a pull that the oil cannot follow opens a void, and the piston flies on
// against the rod side alone. It comes back to where it was when the void closes.
TEST(void_closes_where_it_opened) {
  ExcavatorPlantProfile profile = hopsan_circuit(200);
  profile.start_back_pressure_pa = 0.5e6;
  CylinderCircuit circuit(profile, 0.752, 20000.0, 0.0);
  const double content = circuit.cylinder.cap().content_m3();
  double closed_at = 0.0;
  double largest = 0.0;
  bool was_hollow = false;
  for (int i = 0; i < 2500; ++i) {
    circuit.load_n = i < 500 ? -60e3 : 0.0;
    circuit.run(200e-6, 0.0);
    const WaveVolume& cap = circuit.cylinder.cap();
    const bool hollow = cap.void_m3() > 0.0;
    largest = std::max(largest, cap.void_m3());
    assert_near(cap.content_m3(), content, 1e-15);
    assert_true(circuit.cap_pa() >= 0.0);
    if (hollow) {
      assert_near(circuit.cap_pa(), 0.0, 0.0);
      // Space less oil: V - content, all of it known from where the piston is.
      assert_near(cap.void_m3(), 1e-3 + kCapArea * circuit.position_m - content, 1e-10);
    }
    if (was_hollow && !hollow) {
      closed_at = circuit.position_m;
    }
    was_hollow = hollow;
  }
  assert_true(largest > 0.02e-3);
  assert_near(closed_at, (content - 1e-3) / kCapArea, 0.05e-3);
}

// What the pump line and the chambers hold changes by what the pump gives and tank takes, voids or
// not: circuit (b) of the Hopsan reference, whose bore side boils for 0.3 s.
TEST(oil_is_conserved_through_voids) {
  CylinderCircuit circuit(hopsan_circuit(200), 0.752, 20000.0, 0.0);
  const auto held = [&] {
    return circuit.cylinder.cap().content_m3() + circuit.cylinder.rod().content_m3() +
           circuit.pump.line().content_m3();
  };
  const double before = held();
  double pumped = 0.0;
  double drained = 0.0;
  double largest_void = 0.0;
  for (int i = 0; i < 10000; ++i) {
    circuit.run(200e-6, i < 5000 ? 0.4 : -0.4);
    // All that leaves the line but through the valve, and all that leaves the cylinder but by it.
    pumped +=
        circuit.step_s * (circuit.pump.flows().line_in_m3ps - circuit.pump.flows().bypass_m3ps);
    drained += circuit.step_s * (circuit.flows.supply_out_m3ps - circuit.flows.cap_in_m3ps -
                                 circuit.flows.rod_in_m3ps);
    largest_void = std::max(largest_void, circuit.cylinder.cap().void_m3());
  }
  assert_true(largest_void > 0.05e-3);
  assert_true(drained > 2e-3);
  assert_near(held() - before, pumped - drained, 1e-12);
}
