// One cylinder with valve section, pump line and mass, against two independent sources: samples of
// a Hopsan 2.24.0 run of the same circuit (transmission-line elements at 5e-6 s), and closed forms.

#include <array>

#include "app/plant/cylinder.hpp"
#include "app/plant/pump_line.hpp"
#include "app/plant/valve_section.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machine_22t.hpp"

namespace {

using namespace graben;
using namespace graben::plant;

constexpr double kBypass = 4.6e-7;
constexpr double kCapArea = 0.015393804;  // bore 140 mm
constexpr double kRodArea = 0.007539822;  // rod 100 mm

// The circuit of the Hopsan run: linear openings, no deadband, constant bypass, no leakage.
PlantProfile hopsan_circuit(TimeUs step_us) {
  PlantProfile profile = machine_22t();
  profile.step_us = step_us;
  SpoolProfile& spool = profile.machine.valve.spool[kArm];
  spool.extend_in_m2 = 1.70e-4;
  spool.extend_out_m2 = 1.05e-4;
  spool.regeneration = RegenerationSide::kNone;
  spool.bypass_open = kBypass;
  spool.bypass_closed = kBypass;
  profile.machine.valve.opening_exponent = 1.0;
  profile.machine.valve.discharge = 0.62;
  profile.machine.valve.density_kgpm3 = 870.0;
  profile.deadband_ratio = 0.0;
  profile.spool_time_constant_s = 0.02;
  profile.spool_damping = 1.0;
  profile.bulk_modulus_pa = 1.2e9;
  profile.dead_volume_m3[kArm] = 1e-3;
  profile.line_volume_m3[0] = 3e-3;
  profile.friction[kArm] = {0.0, 15000.0};
  profile.piston_leak_m3pspa = 0.0;
  profile.swash_ratio[0] = 1.0;
  PumpProfile& pump = profile.machine.pump[0];
  pump.displacement_m3prev = 3.5e-3 * 2.0 * 3.141592653589793;
  pump.rated_speed_radps = 1.0;
  pump.leak_linear = 4e-12;
  pump.leak_quadratic = 0.0;
  pump.bypass_series = {1.0, 1.0};
  pump.relief_pa = 35e6;
  profile.relief_override_paspm3 = 0.17e6 / 0.631e-3;
  profile.machine.geometry.cylinder[kArm].bore_m = 0.140;
  profile.machine.geometry.cylinder[kArm].rod_m = 0.100;
  profile.machine.geometry.cylinder[kArm].stroke_m = 1.504;
  profile.start_back_pressure_pa = 4.083333e6;
  return profile;
}

struct Circuit {
  Circuit(const PlantProfile& profile, double start_m, double mass, double load)
      : step_s(1e-6 * static_cast<double>(profile.step_us)),
        cylinder(profile, kArm),
        pump(profile, 0, 1),
        section(profile, kArm),
        mass_kg(mass),
        load_n(load),
        position_m(start_m) {
    pump.set_bypass(1.0 / std::pow(section.bypass_coefficient(), 2));
    pump.start();
    cylinder.start(position_m, load_n);
  }

  void run(double duration_s, double spool_command) {
    section.set_command(spool_command);
    for (int i = 0; i < static_cast<int>(std::lround(duration_s / step_s)); ++i) {
      step();
    }
  }

  void step() {
    cylinder.set_motion(position_m, velocity_mps);
    flows = section.solve(
        {cylinder.cap_port(), cylinder.rod_port(), pump.supply_port(0), pump.recycle_port(0)});
    pump.set_section_flows(0, flows.supply_out_m3ps, flows.recycle_in_m3ps);
    pump.set_bypass(1.0 / std::pow(section.bypass_coefficient(), 2));
    pump.step();
    const PistonLoad load = cylinder.load();
    const double mean = (mass_kg * velocity_mps + 0.5 * step_s * (load.force_n - load_n)) /
                        (mass_kg + 0.5 * step_s * load.damping_nspm);
    velocity_mps = 2.0 * mean - velocity_mps;
    position_m += step_s * mean;
    cylinder.step(flows.cap_in_m3ps, flows.rod_in_m3ps, mean);
    section.step(step_s);
  }

  double step_s;
  Cylinder cylinder;
  PumpLine pump;
  ValveSection section;
  double mass_kg;
  double load_n;
  double position_m;
  double velocity_mps = 0.0;
  SectionFlows flows;
};

struct Sample {
  double time_s, position_m, velocity_mps, cap_pa, rod_pa, pump_pa;
};

// 60 kN against extension from the start; spool 0 -> 0.4 at 0.1 s, -> 0 at 1.2 s.
constexpr std::array<Sample, 8> kHopsan{{
    {0.2, 0.766932424, 0.30226878, 4857361.85, 3423046.05, 6803789.84},
    {0.3, 0.784348724, 0.0814681915, 4354549.93, 245700.556, 5537097.12},
    {0.4, 0.798626953, 0.19440422, 4697741.91, 1332907.19, 6161764.13},
    {0.6, 0.829619321, 0.165171643, 4636395.47, 979017.317, 6021499.28},
    {0.8, 0.86047323, 0.156588631, 4559386.52, 887555.243, 5927871.12},
    {1.0, 0.89126215, 0.154193944, 4508753.69, 864470.585, 5875529.41},
    {1.2, 0.922017029, 0.153638046, 4483376.37, 859968.406, 5851074.57},
    {1.3, 0.932896267, -0.00214475349, 2717091.63, 5221292.38, 24096333.9},
}};

// Reported pressures are one step old: on a slope of 200 MPa/s that shows.
void compare_with_hopsan(TimeUs step_us, double position_tolerance_m, double tolerance_pa) {
  Circuit circuit(hopsan_circuit(step_us), 0.752, 20000.0, 60000.0);
  circuit.run(0.1, 0.0);
  double time = 0.1;
  for (const Sample& sample : kHopsan) {
    circuit.run(sample.time_s - time, time < 1.15 ? 0.4 : 0.0);
    time = sample.time_s;
    assert_near(circuit.position_m, sample.position_m, position_tolerance_m);
    assert_near(circuit.velocity_mps, sample.velocity_mps, 6e-4);
    assert_near(circuit.cylinder.cap_pressure_pa(), sample.cap_pa, tolerance_pa);
    assert_near(circuit.cylinder.rod_pressure_pa(), sample.rod_pa, tolerance_pa);
    assert_near(circuit.pump.pressure_pa(), sample.pump_pa, 4.0 * tolerance_pa);
  }
}

void hopsan_at_0_1_ms(void**) { compare_with_hopsan(100, 0.02e-3, 2e4); }
void hopsan_at_0_2_ms(void**) { compare_with_hopsan(200, 0.03e-3, 4e4); }

// Steady extension: in-flow and out-flow of an asymmetric cylinder, force balance, pump balance.
void steady_extension_meets_the_orifice_equations(void**) {
  const PlantProfile profile = hopsan_circuit(200);
  Circuit circuit(profile, 0.1, 20000.0, 60000.0);
  circuit.run(5.0, 0.4);
  const double v = circuit.velocity_mps;
  const double cap = circuit.cylinder.cap_pressure_pa();
  const double rod = circuit.cylinder.rod_pressure_pa();
  const double line = circuit.pump.pressure_pa();
  const double k = 0.62 * std::sqrt(2.0 / 870.0) * 0.4;
  assert_near(v, 0.1536, 1e-4);
  assert_near(kCapArea * v, k * 1.70e-4 * std::sqrt(line - cap), 1e-6);
  assert_near(kRodArea * v, k * 1.05e-4 * std::sqrt(rod), 1e-6);
  assert_near(kCapArea * cap - kRodArea * rod, 60000.0 + 15000.0 * v, 5.0);
  assert_near(circuit.pump.flow_m3ps(), kCapArea * v + kBypass * std::sqrt(line), 1e-6);
  assert_near(circuit.pump.flow_m3ps(), 3.5e-3 - 4e-12 * line, 1e-9);
}

void pump_relief_takes_what_the_bypass_cannot(void**) {
  Circuit circuit(hopsan_circuit(200), 0.1, 20000.0, 60000.0);
  circuit.run(1.0, 0.0);
  const double line = circuit.pump.pressure_pa();
  const double relieved = circuit.pump.flow_m3ps() - kBypass * std::sqrt(line);
  assert_near(line, 35e6 + relieved * 0.17e6 / 0.631e-3, 1.0);
  assert_true(relieved > 0.5e-3);
}

void regeneration_feeds_the_pump_line(void**) {
  PlantProfile profile = hopsan_circuit(200);
  SpoolProfile& spool = profile.machine.valve.spool[kArm];
  spool.regeneration = RegenerationSide::kExtend;
  spool.c_drain = 7e-7;
  spool.c_check = 1.1e-6;
  // A load that pulls the rod out.
  Circuit circuit(profile, 0.1, 20000.0, -60000.0);
  circuit.run(1.5, 0.9);
  const double out = kRodArea * circuit.velocity_mps;
  assert_true(circuit.flows.recycle_in_m3ps > 0.05 * out);
  const double drained = out - circuit.flows.recycle_in_m3ps;
  const double gallery = std::pow(drained / 7e-7, 2);
  const double check = 1.1e-6 * std::sqrt(gallery - circuit.pump.pressure_pa());
  assert_near(circuit.flows.recycle_in_m3ps, check, 2e-5);
  // The same spool does not regenerate the other way.
  circuit.run(1.0, -0.5);
  assert_near(circuit.flows.recycle_in_m3ps, 0.0, 0.0);
}

void load_above_the_pump_flows_back(void**) {
  // No load check in the circuit: opening towards a pump at standby lets the load down at first.
  PlantProfile profile = hopsan_circuit(200);
  profile.machine.valve.spool[kArm].bypass_open = 4.5e-6;
  profile.machine.valve.spool[kArm].bypass_closed = 4.5e-6;
  Circuit circuit(profile, 0.752, 20000.0, 150000.0);
  circuit.run(0.3, 0.5);
  assert_true(circuit.velocity_mps < -0.01);
  assert_true(circuit.flows.supply_out_m3ps < 0.0);
}

void blocked_chambers_carry_a_load_like_a_spring(void**) {
  PlantProfile profile = hopsan_circuit(200);
  profile.friction[kArm] = {0.0, 4e5};  // settles soon
  Circuit circuit(profile, 0.752, 20000.0, 60000.0);
  circuit.load_n += 10000.0;
  circuit.run(5.0, 0.0);
  const double stiffness = 1.2e9 * (kCapArea * kCapArea / (1e-3 + kCapArea * 0.752) +
                                    kRodArea * kRodArea / (1e-3 + kRodArea * 0.752));
  assert_near(circuit.position_m - 0.752, -10000.0 / stiffness, 5e-6);
}

void piston_leakage_is_laminar(void**) {
  PlantProfile profile = hopsan_circuit(200);
  profile.piston_leak_m3pspa = 1e-12;
  Cylinder cylinder(profile, kArm);
  cylinder.start(0.752, 200e3);
  const double cap = cylinder.cap_pressure_pa();
  const double difference = cap - cylinder.rod_pressure_pa();
  for (int i = 0; i < 100; ++i) {  // 20 ms with the piston held
    cylinder.step(0.0, 0.0, 0.0);
  }
  const double rate = 1.2e9 * 1e-12 * difference / (1e-3 + kCapArea * 0.752);
  assert_near(cylinder.cap_pressure_pa() - cap, -rate * 20e-3, 0.02 * rate * 20e-3);
}

// A load that would need 41 MPa presses in through the cap relief and draws on the rod side.
void port_relief_and_make_up_hold_the_chambers(void**) {
  const PlantProfile profile = hopsan_circuit(200);
  Circuit circuit(profile, 1.2, 20000.0, 60000.0);
  circuit.load_n = 630e3;
  circuit.run(1.0, 0.0);
  const double v = -circuit.velocity_mps;
  assert_true(v > 0.05);
  assert_near(circuit.cylinder.cap_pressure_pa(),
              38e6 + profile.relief_override_paspm3 * kCapArea * v, 5e4);
  assert_near(circuit.cylinder.rod_pressure_pa(), -profile.makeup_paspm3 * kRodArea * v, 1e3);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(hopsan_at_0_1_ms),
      cmocka_unit_test(hopsan_at_0_2_ms),
      cmocka_unit_test(steady_extension_meets_the_orifice_equations),
      cmocka_unit_test(pump_relief_takes_what_the_bypass_cannot),
      cmocka_unit_test(regeneration_feeds_the_pump_line),
      cmocka_unit_test(load_above_the_pump_flows_back),
      cmocka_unit_test(blocked_chambers_carry_a_load_like_a_spring),
      cmocka_unit_test(piston_leakage_is_laminar),
      cmocka_unit_test(port_relief_and_make_up_hold_the_chambers),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
