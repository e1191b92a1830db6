// SPDX-License-Identifier: Apache-2.0
/// What a scenario changes in plant and controller, and what it leaves alone.

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/simulated/soil_kinds.hpp"
#include "firmware/mcv/mcv_machine.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using machines::arranged;
using machines::Errors;
using machines::Scenario;
using machines::SimulatedExcavator;

const SimulatedExcavator& nominal() {
  static const SimulatedExcavator machine =
      machines::load_simulated_excavator(machines::find_profile("excavator_22t"));
  return machine;
}

/// Every parameter that a draw may change, in a fixed order.
std::vector<double> parameters(const ExcavatorProfile& profile) {
  std::vector<double> values;
  for (unsigned i = 0; i < static_cast<unsigned>(profile.drive_count); ++i) {
    const SpoolProfile& spool = profile.valve.spool[i];
    values.insert(values.end(), {spool.extend_in_m2, spool.extend_out_m2, spool.retract_in_m2,
                                 spool.retract_out_m2, spool.bypass_open, spool.bypass_closed,
                                 spool.c_drain, spool.c_check});
  }
  for (const PumpProfile& pump : profile.pump) {
    values.insert(values.end(), {pump.leak_linear, pump.leak_quadratic, pump.bypass_series[0],
                                 pump.bypass_series[1]});
  }
  return values;
}

/// Bounds in the same order.
std::vector<double> bounds() {
  const machines::Uncertainty& u = nominal().experiment.uncertainty;
  std::vector<double> values;
  for (int i = 0; i < kAxisCount; ++i) {
    values.insert(values.end(), {u.spool_opening, u.spool_opening, u.spool_opening, u.spool_opening,
                                 u.bypass, u.bypass, u.regeneration, u.regeneration});
  }
  for (int j = 0; j < kPumpCount; ++j) {
    values.insert(values.end(), {u.leak, u.leak, u.regeneration, u.regeneration});
  }
  return values;
}

Scenario with_errors(Errors errors, std::uint64_t seed) {
  Scenario scenario;
  scenario.errors = errors;
  scenario.seed = seed;
  return scenario;
}

/// 2000 draws fill each parameter's range and never leave it; drain stays under check.
TEST(draws_fill_their_ranges) {
  const std::vector<double> exact = parameters(nominal().profile);
  const std::vector<double> bound = bounds();
  std::vector<double> least(exact.size(), 1.0);
  std::vector<double> most(exact.size(), -1.0);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const SimulatedExcavator drawn = arranged(nominal(), with_errors(Errors::kKim, seed));
    const std::vector<double> values = parameters(drawn.profile);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double off = values[i] / exact[i] - 1.0;
      least[i] = std::min(least[i], off);
      most[i] = std::max(most[i], off);
    }
    for (const SpoolProfile& spool : drawn.profile.valve.spool) {
      assert_true(spool.c_drain <= 0.95 * spool.c_check);
    }
    assert_int_equal(check_machine(mcv_machine(drawn.profile)).defect, McvDefect::kNone);
  }
  for (std::size_t i = 0; i < exact.size(); ++i) {
    // A drain is cut where its check came out small.
    assert_true(least[i] >= -bound[i] - 1e-12 || (i < 24 && i % 8 == 6));
    assert_true(most[i] <= bound[i] + 1e-12);
    assert_true(least[i] < -0.98 * bound[i] && most[i] > 0.9 * bound[i]);
  }
}

/// The plant is what it was; only the controller's figures move, and only with parameter errors.
TEST(only_the_controller_errs) {
  const std::vector<double> exact = parameters(nominal().profile);
  for (const Errors errors : {Errors::kNone, Errors::kStrokeBias, Errors::kSensors}) {
    assert_true(parameters(arranged(nominal(), with_errors(errors, 3)).profile) == exact);
  }
  const SimulatedExcavator drawn = arranged(nominal(), with_errors(Errors::kKim, 3));
  assert_true(parameters(drawn.profile) != exact);
  assert_true(parameters(drawn.plant.machine) == exact);
  assert_true(drawn.hash == nominal().hash);
}

/// The same seed draws the same, whatever else is switched on; another seed another.
TEST(what_is_switched_on_beside_it_changes_no_draw) {
  Scenario busy = with_errors(Errors::kKim, 9);
  busy.soil = true;
  busy.obstacle = true;
  busy.dead_time_s = 0.15;
  busy.stiff_oil = true;
  const auto of = [](const Scenario& scenario) {
    return parameters(arranged(nominal(), scenario).profile);
  };
  assert_true(of(busy) == of(with_errors(Errors::kKim, 9)));
  assert_true(of(busy) == of(with_errors(Errors::kParameters, 9)));
  assert_true(of(busy) != of(with_errors(Errors::kKim, 10)));
}

/// The swing's section is drawn where there is one, after the others; where there is none it takes
/// no draw from what comes after it.
TEST(swing_is_drawn_where_it_is_driven) {
  const SimulatedExcavator driven =
      machines::load_simulated_excavator(machines::find_profile("excavator_12t"));
  SimulatedExcavator held = driven;
  held.profile.drive_count = kAxisCount;
  const Scenario scenario = with_errors(Errors::kKim, 4);
  const ExcavatorProfile of_driven = arranged(driven, scenario).profile;
  const ExcavatorProfile of_held = arranged(held, scenario).profile;
  const SpoolProfile& exact = driven.profile.valve.spool[kSwing];
  assert_true(of_driven.valve.spool[kSwing].extend_in_m2 != exact.extend_in_m2);
  assert_near(of_driven.valve.spool[kSwing].bypass_closed, exact.bypass_closed,
              driven.experiment.uncertainty.bypass * exact.bypass_closed);
  assert_near(of_held.valve.spool[kSwing].extend_in_m2, exact.extend_in_m2, 0.0);
  assert_near(of_held.valve.spool[kBucket].bypass_open, of_driven.valve.spool[kBucket].bypass_open,
              0.0);
  assert_true(of_held.pump[0].leak_linear != of_driven.pump[0].leak_linear);
}

TEST(each_switch_does_its_part) {
  const SimulatedExcavator plain = arranged(nominal(), {});
  assert_false(plain.plant.soil.has_value() || plain.plant.obstacle.has_value());
  assert_false(plain.plant.sensor_errors);
  Scenario scenario = with_errors(Errors::kKim, 5);
  scenario.soil = true;
  scenario.obstacle = true;
  scenario.stiff_oil = true;
  scenario.dead_time_s = 0.15;
  const SimulatedExcavator all = arranged(nominal(), scenario);
  assert_true(all.plant.soil.has_value() && all.plant.obstacle.has_value());
  assert_true(all.plant.sensor_errors && all.plant.seed == 5);
  assert_near(all.plant.bulk_modulus_pa, 1e10, 0.0);
  assert_near(all.profile.control.dead_time_s, 0.15, 0.0);
  for (const plant::SideDelay& axis : all.plant.dead_time) {
    assert_true(axis.extend_s != 0.15 && axis.extend_s >= 0.105 && axis.extend_s <= 0.195);
    assert_near(axis.retract_s, axis.extend_s, 0.0);
  }
  scenario.errors = Errors::kSensors;
  for (const plant::SideDelay& axis : arranged(nominal(), scenario).plant.dead_time) {
    assert_near(axis.extend_s, 0.15, 0.0);
    assert_near(axis.retract_s, 0.15, 0.0);
  }
  scenario.errors = Errors::kStrokeBias;
  const plant::SensorErrors biased = arranged(nominal(), scenario).plant.sensors;
  assert_near(biased.pressure_noise_ratio + biased.pressure_bias_ratio, 0.0, 0.0);
  assert_near(biased.stroke_bias_m, 2e-3, 0.0);
  Scenario up;
  up.air = true;
  const SimulatedExcavator air = arranged(nominal(), up);
  assert_near(air.profile.dig_path.y_max_m, nominal().experiment.air.path.y_max_m, 0.0);
  assert_near(air.profile.dig_speed_mps, nominal().experiment.air.speed_mps, 0.0);
}

/// Two point masses and a body: the same kinetic and potential quantities as by hand.
TEST(a_payload_adds_to_the_bucket) {
  Scenario up;
  up.air = true;
  const plant::LinkBody empty = nominal().plant.link[kBucket];
  const plant::LinkBody loaded = arranged(nominal(), up).plant.link[kBucket];
  const machines::AirManoeuvre& air = nominal().experiment.air;
  assert_near(loaded.mass_kg, empty.mass_kg + air.payload_kg, 1e-9);
  const Eigen::Vector2d moment =
      empty.mass_kg * empty.mass_centre_m + air.payload_kg * air.payload_centre_m;
  assert_near((loaded.mass_kg * loaded.mass_centre_m - moment).norm(), 0.0, 1e-9);
  // About the pin both ways.
  const double about_pin = empty.inertia_kgm2 + empty.mass_kg * empty.mass_centre_m.squaredNorm() +
                           air.payload_kg * air.payload_centre_m.squaredNorm();
  assert_near(loaded.inertia_kgm2 + loaded.mass_kg * loaded.mass_centre_m.squaredNorm(), about_pin,
              1e-6);
}

/// Ground to dig in: its kind as it is, or drawn about it where nothing is known for sure.
TEST(soil_is_laid_and_drawn) {
  assert_false(arranged(nominal(), {}).plant.digging.has_value());
  Scenario scenario;
  scenario.ground = "loam";
  const plant::SoilKind kind = *machines::soil_kind("loam");
  const auto dug = [&](Errors errors, std::uint64_t seed) {
    scenario.errors = errors;
    scenario.seed = seed;
    return *arranged(nominal(), scenario).plant.digging;
  };
  const plant::DiggingProfile plain = dug(Errors::kKim, 1);
  assert_near(plain.soil.cohesion_pa, kind.cohesion_pa, 0.0);
  assert_near(plain.soil.friction_rad, kind.friction_rad, 1e-12);
  assert_near(plain.bucket.width_m, nominal().plant.bucket.width_m, 0.0);
  assert_near(plain.pin_m, nominal().profile.geometry.bucket_length_m, 0.0);
  double least = 2.0;
  double most = 0.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const plant::SoilKind drawn = dug(Errors::kAll, seed).soil;
    const double factor = drawn.cohesion_pa / kind.cohesion_pa;
    least = std::min(least, factor);
    most = std::max(most, factor);
    const double friction = std::tan(drawn.friction_rad) / std::tan(kind.friction_rad);
    assert_true(friction > 0.6 && friction < 1.4);
    assert_true(drawn.wall_friction_rad <= drawn.friction_rad);
  }
  assert_true(least > 0.6 && least < 0.65 && most > 1.35 && most < 1.4);
  assert_near(plain.level_m, 0.0, 0.0);
  scenario.ground_at_line = true;
  assert_near(dug(Errors::kNone, 1).level_m, 1.75 - 1.0, 1e-12);
  scenario.ground = "mud";
  test::expect_refusal([&] { return arranged(nominal(), scenario); }, "sand, loam, clay, stones");
}
