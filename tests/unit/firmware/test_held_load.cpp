// SPDX-License-Identifier: Apache-2.0
// Lines that give way to their load: what boom and arm are opened for, and what the observer knows.

#include "firmware/excavator/estimation/oil/held_load.hpp"

#include <array>
#include <cmath>

#include "firmware/drives/learnt/learnt_valve.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

const ExcavatorProfile& machine() { return test::excavator().profile; }

OilState settled(double load_n) {
  OilState oil;
  oil.weight = 1.0;
  oil.load_n = {-load_n, 0.0};
  return oil;
}

/// Opened for the load that is left at rest and for the path's push, not for what the boom's own
/// swinging adds; a line that does not give way changes nothing.
TEST(a_giving_line_is_opened_for_load_and_push) {
  const Eigen::Matrix2d inertia_kg = Eigen::Vector2d(1e5, 2e4).asDiagonal();
  HeldLoad held;
  OilState oil = settled(200e3);
  oil.force_n = {260e3, 0.0};
  next_held_load(oil, Eigen::Vector2d::Zero(), inertia_kg, 1, held);
  assert_false(held.leads);
  held.yield_mpsn = {5e-7, 0.0};
  double due_mps = 0.0;
  for (int n = 0; n < 100; ++n) {
    due_mps += 0.01 * 0.3;
    next_held_load(oil, {due_mps, 0.0}, inertia_kg, 1, held);
  }
  assert_true(held.leads);
  assert_near(held.force_n[0], 200e3 + 1e5 * 0.3, 100.0);

  const ExcavatorBank bank = excavator_bank(machine());
  const DriveRow& boom = bank.row[0];
  McvInput input;
  input.cap_pressure_pa = {12e6, 3e6, 4e6};
  input.rod_pressure_pa = {1e6, 2e6, 5e6};
  const auto force_n = [&boom](const McvInput& of) {
    return boom.extend_area_m2 * of.cap_pressure_pa[0] -
           boom.retract_area_m2 * of.rod_pressure_pa[0];
  };
  assert_near(force_n(opened_for(held, bank.rows(), input)), held.force_n[0], 1e-3);
  assert_near(opened_for(held, bank.rows(), input).cap_pressure_pa[2], 4e6, 0.0);
  held.force_n[0] = -300e3;
  assert_near(force_n(opened_for(held, bank.rows(), input)), -300e3, 1e-3);
  assert_near(opened_for(held, bank.rows(), input).cap_pressure_pa[0], 0.0, 0.0);
  held.leads = false;
  assert_near(opened_for(held, bank.rows(), input).cap_pressure_pa[0], 12e6, 0.0);
}

/// A force beyond the one that the valve is opened for slows the flow that the observer expects.
TEST(the_observer_knows_a_flow_that_gives_way) {
  const OilGains gains{OilDesign{}};
  const KinematicState now = ExcavatorKinematics(machine().geometry).state({0.6, 0.7, 0.5});
  std::array<LoadState, kDriveCount> load{};
  load.fill({8e6, 5e6});
  const OilModes modes =
      oil_modes(machine().oil, machine().geometry, now, {load.data(), 2}, 0.0, 1.0);
  const auto error_mps = [&](double yield_mpsn) {
    OilState state;
    OilSeen seen;
    seen.force_known = true;
    seen.force_n = {100e3, 0.0};
    seen.yield_mpsn = {yield_mpsn, 0.0};
    next_oil(gains, modes, seen, true, true, state);
    double stroke_m = 0.0;
    for (int n = 0; n < 300; ++n) {
      stroke_m -= 0.01 * 5e-7 * 100e3;
      seen.stroke_m = {stroke_m, 0.0};
      next_oil(gains, modes, seen, true, true, state);
    }
    return state.flow_error_mps[0];
  };
  assert_near(error_mps(0.0), -0.05, 0.005);
  assert_true(std::abs(error_mps(5e-7)) < 0.015);
}

/// A drive that stands since its line does not press as hard as its load yet shows no flow that is
/// missing: what else would be taken for that comes on top once it sets off. The other one does.
TEST(what_stands_shows_no_missing_flow) {
  const OilGains gains{OilDesign{}};
  const KinematicState now = ExcavatorKinematics(machine().geometry).state({0.6, 0.7, 0.5});
  std::array<LoadState, kDriveCount> load{};
  load.fill({8e6, 5e6});
  const OilModes modes =
      oil_modes(machine().oil, machine().geometry, now, {load.data(), 2}, 0.0, 1.0);
  const auto after = [&](bool stands) {
    OilState state;
    OilSeen seen;
    seen.force_known = true;
    seen.stands[0] = stands;
    next_oil(gains, modes, seen, true, true, state);
    seen.asked_mps = {0.05, 0.02};
    seen.expected_mps = seen.asked_mps;
    repeat(100, [&] { next_oil(gains, modes, seen, true, true, state); });
    return state;
  };
  assert_true(after(false).flow_error_mps[0] < -0.02);
  const OilState stood = after(true);
  assert_near(stood.flow_error_mps[0], 0.0, 0.0);
  assert_near(stood.speed_mps[0], 0.0, 0.005);
  assert_true(stood.flow_error_mps[1] < -0.005);
}

/// A drive that has come round and stands: its edge is looked for at once, and no faster than its
/// line can show by its pressure what the spool has reached.
TEST(an_edge_is_looked_for_at_once_and_steadily) {
  const ExcavatorBank bank = excavator_bank(machine());
  DriveRow boom = bank.row[0];
  boom.spool.bypass_closes_at = {0.25, 0.25};
  const double first = boom.answer.extend.edge();
  constexpr double kOpening = 0.22;
  LearntValve valve;
  std::array<double, 60> edge{};
  TwoLags spool;
  bool told = false;
  for (int n = 0; n < 160; ++n) {
    const bool back = n < 100;
    const double asked = back ? -kOpening : kOpening;
    const double beyond = back ? 0.0 : opening_beyond(valve.extend, kOpening);
    spool.first_mps += 0.4 * (asked + beyond - spool.first_mps);
    spool.second_mps += 0.4 * (spool.first_mps - spool.second_mps);
    ValidDrive seen;
    seen.stroke_m = 0.5;
    seen.spool_ratio = std::copysign(first + (1.0 - first) * std::abs(spool.second_mps), asked);
    next_learnt(boom, seen, {back ? -0.005 : 0.03, asked}, LearntFrom::kPlainMotion, 0.01, valve);
    told = told || stands_open(valve);
    if (!back) {
      edge[static_cast<unsigned>(n - 100)] = valve.extend.edge;
    }
  }
  assert_true(told);
  assert_true(edge[20] > 0.004 && edge[50] > 0.0345);
  for (unsigned n = 1; n < edge.size(); ++n) {
    assert_true(edge[n] - edge[n - 1] < 0.1 * 0.01 + 1e-9);
  }
  next_learnt(boom, {}, {}, LearntFrom::kNothing, 0.01, valve);
  assert_false(stands_open(valve));
}
