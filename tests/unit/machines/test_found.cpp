// SPDX-License-Identifier: Apache-2.0
/// A machine as it is found: what is drawn and told of it, and that its controller is not told.

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using machines::arranged;
using machines::Errors;
using machines::Found;
using machines::Scenario;
using machines::SimulatedExcavator;

constexpr std::uint64_t kSeeds = 200;

SimulatedExcavator shipped(const char* name) {
  return machines::load_simulated_excavator(machines::find_profile(name));
}

const SimulatedExcavator& nominal() {
  static const SimulatedExcavator machine = shipped("excavator_12t");
  return machine;
}

Scenario with_errors(Errors errors, std::uint64_t seed) {
  Scenario scenario;
  scenario.errors = errors;
  scenario.seed = seed;
  return scenario;
}

plant::ExcavatorPlantProfile plant_of(Errors errors, std::uint64_t seed) {
  return arranged(nominal(), with_errors(errors, seed)).plant;
}

/// A figure of the plant's and where it may be.
struct Figure {
  std::string name;
  double value;
  double least;
  double most;
};

/// Every figure that a machine is found by. `dead_time` is what the spools have without.
std::vector<Figure> figures(const plant::ExcavatorPlantProfile& plant,
                            const std::array<plant::SideDelay, kDriveCount>& dead_time = {}) {
  const plant::ExcavatorPlantProfile& exact = nominal().plant;
  std::vector<Figure> all;
  const auto add = [&all](const std::string& name, double value, double least, double most) {
    all.push_back({name, value, least, most});
  };
  const auto add_share = [&add](const std::string& name, double value, double from, double share) {
    add(name, value, (1.0 - share) * from, (1.0 + share) * from);
  };
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    const std::string of = " of drive " + std::to_string(i);
    const plant::SpoolDynamics& spool = plant.spool[i];
    add("extend deadband" + of, spool.extend.deadband_ratio, 0.17, 0.23);
    add("retract deadband" + of, spool.retract.deadband_ratio, 0.17, 0.23);
    const double exponent = nominal().profile.valve.opening_exponent;
    add("exponent" + of, spool.extend.opening_exponent, exponent - 0.2, exponent + 0.2);
    add("time constant" + of, spool.time_constant_s, 0.015, 0.040);
    add("dead time" + of, plant.dead_time[i].extend_s - dead_time[i].extend_s, 0.0, 0.030);
  }
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const std::string of = " of axis " + std::to_string(i);
    add_share("Coulomb" + of, plant.friction[i].coulomb_n, exact.friction[i].coulomb_n, 0.5);
    add_share("viscous" + of, plant.friction[i].viscous_nspm, exact.friction[i].viscous_nspm, 0.5);
    add_share("mass" + of, plant.link[i].mass_kg, exact.link[i].mass_kg, 0.15);
  }
  add_share("platform's Coulomb", plant.platform.coulomb_nm, exact.platform.coulomb_nm, 0.5);
  add_share("platform's viscous", plant.platform.viscous_nmsprad, exact.platform.viscous_nmsprad,
            0.5);
  for (std::size_t p = 0; p < kPumpCount; ++p) {
    add_share("flow of pump " + std::to_string(p), plant.pump_flow_ratio[p], 1.0, 0.1);
  }
  add("oil", plant.bulk_modulus_pa, 0.7e9, 1.6e9);
  add("sag", plant.engine.share, 0.0, 0.10);
  return all;
}

std::vector<double> values(const std::vector<Figure>& figures) {
  std::vector<double> all;
  for (const Figure& figure : figures) {
    all.push_back(figure.value);
  }
  return all;
}

std::vector<double> values(const plant::ExcavatorPlantProfile& plant) {
  return values(figures(plant));
}

/// 200 seeds fill each range, never leave it, and no two figures go together.
TEST(each_figure_is_drawn_by_itself_within_its_range) {
  std::vector<std::vector<double>> share;  // Of its range, by figure and seed.
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<Figure> found =
        figures(plant_of(Errors::kAll, seed), plant_of(Errors::kKim, seed).dead_time);
    share.resize(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      const Figure& figure = found[k];
      share[k].push_back((figure.value - figure.least) / (figure.most - figure.least));
      if (!(share[k].back() >= -1e-9 && share[k].back() <= 1.0 + 1e-9)) {
        fail_msg("%s is %.17g", figure.name.c_str(), figure.value);
      }
    }
  }
  for (std::size_t k = 0; k < share.size(); ++k) {
    const auto [least, most] = std::minmax_element(share[k].begin(), share[k].end());
    assert_true(*least < 0.05 && *most > 0.95);
    for (std::size_t other = 0; other < k; ++other) {
      double moment = 0.0;
      for (std::size_t seed = 0; seed < kSeeds; ++seed) {
        moment += (share[k][seed] - 0.5) * (share[other][seed] - 0.5) / kSeeds;
      }
      assert_near(12.0 * moment, 0.0, 0.35);
    }
  }
}

/// Inertia goes with its mass; the mass centre stays.
TEST(a_link_is_heavier_as_a_whole) {
  const plant::ExcavatorPlantProfile plant = plant_of(Errors::kAll, 3);
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const plant::LinkBody& exact = nominal().plant.link[i];
    assert_near(plant.link[i].inertia_kgm2 / exact.inertia_kgm2,
                plant.link[i].mass_kg / exact.mass_kg, 1e-12);
    assert_true(plant.link[i].mass_centre_m == exact.mass_centre_m);
  }
}

/// What is in the bucket is no error of the bucket.
TEST(the_load_is_what_it_is) {
  Scenario scenario = with_errors(Errors::kAll, 3);
  const double empty_kg = arranged(nominal(), scenario).plant.link[kBucket].mass_kg;
  scenario.air = true;
  assert_near(arranged(nominal(), scenario).plant.link[kBucket].mass_kg,
              empty_kg + nominal().experiment.air.payload_kg, 1e-9);
}

/// Kim's errors are what they were before a machine could be found otherwise: figures of that time.
TEST(kims_errors_are_the_former_ones) {
  static const SimulatedExcavator machine = shipped("excavator_22t");
  Scenario scenario = with_errors(Errors::kKim, 3);
  scenario.dead_time_s = 0.15;
  const SimulatedExcavator drawn = arranged(machine, scenario);
  assert_true(drawn.plant.sensor_errors);
  assert_near(drawn.profile.valve.spool[kBoom].extend_in_m2, 0.0001459758647787628, 0.0);
  assert_near(drawn.profile.valve.spool[kBucket].c_drain, 1.1484807488485694e-06, 0.0);
  assert_near(drawn.profile.pump[1].leak_linear, 4.3800246840989835e-12, 0.0);
  assert_near(drawn.plant.dead_time[kArm].extend_s, 0.11002017947171526, 0.0);
}

TEST(only_all_finds_a_machine) {
  for (const Errors errors :
       {Errors::kNone, Errors::kStrokeBias, Errors::kSensors, Errors::kParameters, Errors::kKim}) {
    assert_true(values(plant_of(errors, 3)) == values(nominal().plant));
  }
  const std::vector<double> exact = values(nominal().plant);
  const std::vector<double> found = values(plant_of(Errors::kAll, 3));
  for (std::size_t k = 0; k < exact.size(); ++k) {
    assert_true(found[k] != exact[k]);
  }
}

/// Every number that Kim's draws change, and two of what they leave.
std::vector<double> controller(const ExcavatorProfile& profile) {
  std::vector<double> all;
  for (const SpoolProfile& spool : profile.valve.spool) {
    all.insert(all.end(),
               {spool.extend_in_m2, spool.extend_out_m2, spool.retract_in_m2, spool.retract_out_m2,
                spool.bypass_open, spool.bypass_closed, spool.c_drain, spool.c_check});
  }
  for (const PumpProfile& pump : profile.pump) {
    all.insert(all.end(), {pump.displacement_m3prev, pump.rated_speed_radps, pump.leak_linear,
                           pump.leak_quadratic, pump.bypass_series[0], pump.bypass_series[1]});
  }
  all.insert(all.end(), {profile.valve.opening_exponent, profile.valve.spool_to_duty.y_first(),
                         profile.control.dead_time_s, profile.control.response_s});
  return all;
}

TEST(the_controller_is_told_nothing) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Scenario told = with_errors(Errors::kAll, seed);
    told.found.opening_exponent = 1.0;
    told.found.dead_time_s = 0.1;
    told.found.pump_flow_factor = 0.8;
    const auto of = [](const Scenario& scenario) {
      return controller(arranged(nominal(), scenario).profile);
    };
    const std::vector<double> kims = of(with_errors(Errors::kKim, seed));
    assert_true(of(with_errors(Errors::kAll, seed)) == kims && of(told) == kims);
  }
  // Nor is the plant's copy of the design another one.
  assert_true(controller(plant_of(Errors::kAll, 3).machine) == controller(nominal().profile));
}

/// The same seed draws the same, whatever else is switched on; another seed another.
TEST(what_is_switched_on_beside_it_changes_no_draw) {
  Scenario busy = with_errors(Errors::kAll, 9);
  busy.soil = true;
  busy.obstacle = true;
  busy.dead_time_s = 0.15;
  const Scenario plain = with_errors(Errors::kAll, 9);
  const auto of = [](Scenario scenario) {
    const plant::ExcavatorPlantProfile plant = arranged(nominal(), scenario).plant;
    scenario.errors = Errors::kKim;
    std::vector<double> all = values(figures(plant, arranged(nominal(), scenario).plant.dead_time));
    return all;
  };
  const std::vector<double> once = of(busy);
  const std::vector<double> again = of(plain);
  const std::vector<double> other = of(with_errors(Errors::kAll, 10));
  for (std::size_t k = 0; k < once.size(); ++k) {
    assert_near(once[k], again[k], 1e-15);
    assert_true(std::abs(once[k] - other[k]) > 1e-12);
  }
  assert_true(values(plant_of(Errors::kAll, 9)) == values(plant_of(Errors::kAll, 9)));
}

/// A machine with no swing drive finds the same of the rest.
TEST(a_swing_that_is_held_takes_no_draw_from_the_others) {
  SimulatedExcavator held = nominal();
  held.profile.drive_count = kAxisCount;
  held.plant.machine.drive_count = kAxisCount;
  assert_true(values(arranged(held, with_errors(Errors::kAll, 4)).plant) ==
              values(plant_of(Errors::kAll, 4)));
}

TEST(sides_of_a_spool_differ) {
  const plant::ExcavatorPlantProfile plant = plant_of(Errors::kAll, 5);
  for (const plant::SpoolDynamics& spool : plant.spool) {
    assert_true(std::abs(spool.extend.deadband_ratio - spool.retract.deadband_ratio) > 1e-6);
    assert_near(spool.extend.opening_exponent, spool.retract.opening_exponent, 0.0);
  }
}

TEST(stiff_oil_stays_stiff) {
  Scenario scenario = with_errors(Errors::kAll, 5);
  scenario.stiff_oil = true;
  assert_near(arranged(nominal(), scenario).plant.bulk_modulus_pa, 1e10, 0.0);
  scenario.found.bulk_modulus_gpa = 1.0;
  test::expect_refusal([&] { return arranged(nominal(), scenario); }, "oil");
}

/// Of a range each spool has its own value, another with another seed; nothing else is drawn anew.
TEST(a_range_is_drawn_within) {
  Scenario scenario = with_errors(Errors::kAll, 7);
  scenario.found.spool_time_constant_s = machines::Told(0.05, 0.08);
  scenario.found.closing_time_constant_s = machines::Told(0.01, 0.02);
  scenario.found.bypass_leak_factor = machines::Told(2.0, 3.0);
  const plant::ExcavatorPlantProfile plant = arranged(nominal(), scenario).plant;
  const plant::ExcavatorPlantProfile plain = plant_of(Errors::kAll, 7);
  for (std::size_t i = 0; i < kDriveCount; ++i) {
    const plant::SpoolDynamics& spool = plant.spool[i];
    assert_true(spool.time_constant_s >= 0.05 && spool.time_constant_s < 0.08);
    assert_true(spool.closing_time_constant_s >= 0.01 && spool.closing_time_constant_s < 0.02);
    const double leaks =
        plant.machine.valve.spool[i].bypass_closed / plain.machine.valve.spool[i].bypass_closed;
    assert_true(leaks >= 2.0 && leaks < 3.0);
    assert_near(spool.extend.deadband_ratio, plain.spool[i].extend.deadband_ratio, 0.0);
  }
  assert_true(plant.spool[0].time_constant_s != plant.spool[1].time_constant_s);
  assert_near(plant.bulk_modulus_pa, plain.bulk_modulus_pa, 0.0);
}

/// On what there is, and nothing else.
TEST(what_wears_comes_on_top) {
  Scenario scenario = with_errors(Errors::kAll, 7);
  scenario.found.piston_leak_factor = 3.0;
  scenario.found.dead_band_more_ratio = 0.02;
  scenario.found.stroke_zero_more_m = -0.005;
  scenario.found.stroke_age_s = 0.03;
  scenario.found.rocking_deg = 1.5;
  const plant::ExcavatorPlantProfile plant = arranged(nominal(), scenario).plant;
  const plant::ExcavatorPlantProfile plain = plant_of(Errors::kAll, 7);
  assert_near(plain.rocking_rad, 0.0, 0.0);
  assert_near(plant.rocking_rad, 0.0261799, 1e-7);
  assert_near(plant.piston_leak_m3pspa, 3.0 * plain.piston_leak_m3pspa, 1e-20);
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    assert_near(plant.spool[i].retract.deadband_ratio, plain.spool[i].retract.deadband_ratio + 0.02,
                1e-12);
    assert_near(plant.spool[i].extend.deadband_ratio, plain.spool[i].extend.deadband_ratio + 0.02,
                1e-12);
    assert_near(plant.sensors.stroke_zero_m[i], plain.sensors.stroke_zero_m[i] - 0.005, 1e-12);
    assert_near(plant.sensors.stroke_age_s[i], 0.03, 0.0);
    assert_near(plant.spool[i].time_constant_s, plain.spool[i].time_constant_s, 0.0);
  }
}

/// What is told goes before what is drawn, with errors or without, and leaves the rest as it is.
TEST(what_is_told_goes_before_what_is_drawn) {
  struct Told {
    std::optional<machines::Told> Found::*key;
    double value;
    const char* of;  ///< How the names of the figures begin that it says.
    double factor;   ///< From the value to the figure where it is no factor on it.
  };
  const Told every[] = {{&Found::bulk_modulus_gpa, 0.6, "oil", 1e9},
                        {&Found::opening_exponent, 1.1, "exponent", 1.0},
                        {&Found::spool_time_constant_s, 0.06, "time constant", 1.0},
                        {&Found::engine_sag_ratio, 0.2, "sag", 1.0},
                        {&Found::dead_time_s, 0.05, "dead time", 1.0},
                        {&Found::pump_flow_factor, 0.7, "flow", 1.0},
                        {&Found::mass_factor, 1.5, "mass", 0.0},
                        {&Found::deadband_ratio, 0.3, "deadband", 1.0},
                        {&Found::friction_factor, 2.5, "friction", 0.0}};
  const std::vector<Figure> exact = figures(nominal().plant);
  for (const Errors errors : {Errors::kNone, Errors::kAll}) {
    const std::vector<Figure> plain = figures(plant_of(errors, 7));
    for (const Told& told : every) {
      Scenario scenario = with_errors(errors, 7);
      scenario.found.*told.key = told.value;
      const std::vector<Figure> found = figures(arranged(nominal(), scenario).plant);
      int said = 0;
      for (std::size_t k = 0; k < found.size(); ++k) {
        const std::string& name = found[k].name;
        const bool is_friction =
            name.find("Coulomb") != std::string::npos || name.find("viscous") != std::string::npos;
        const std::string of = told.of;
        const bool is_said = of == "friction"   ? is_friction
                             : of == "deadband" ? name.find(of) != std::string::npos
                                                : name.rfind(of, 0) == 0;
        said += is_said ? 1 : 0;
        const double expected = !is_said            ? plain[k].value
                                : told.factor > 0.0 ? told.factor * told.value
                                                    : told.value * exact[k].value;
        if (std::abs(found[k].value - expected) > 1e-12 * std::abs(expected)) {
          fail_msg("%s is %.17g, expected %.17g", name.c_str(), found[k].value, expected);
        }
      }
      assert_true(said > 0);
    }
  }
}
