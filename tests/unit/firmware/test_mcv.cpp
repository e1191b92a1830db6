// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <random>

#include "firmware/hydraulics/flow.hpp"
#include "firmware/mcv/optimiser.hpp"
#include "firmware/mcv/pump_pressure.hpp"
#include "tests/fuzz/endless_work.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

McvMachine kim() { return mcv_machine(test::excavator().profile); }

/// A load that all three cylinders can move in either direction.
McvInput light_load(double boom_mps, double arm_mps, double bucket_mps) {
  McvInput input;
  input.velocity_mps = {boom_mps, arm_mps, bucket_mps};
  input.cap_pressure_pa = {2.0e6, 2.0e6, 2.0e6};
  input.rod_pressure_pa = {2.0e6, 2.0e6, 2.0e6};
  input.pump_flow_m3ps = {2.3e-3, 2.3e-3};
  return input;
}

/// (17) must hold at what (18) gives: drained plus regenerated is what comes out.
TEST(return_gallery_balances) {
  const double c_drain = 7e-7;
  const double c_check = 1.1e-6;
  for (double q = 0.0; q < 4e-3; q += 1e-4) {
    for (double s = 0.0; s < 6000.0; s += 100.0) {
      const ReturnGallery gallery = return_gallery(q, s, c_drain, c_check);
      const double out_pa = gallery.sqrt_pressure * gallery.sqrt_pressure;
      const double over = out_pa - s * s;
      if (std::abs(over) > 1e-9 * out_pa) {  // At the opening itself either is right.
        assert_int_equal(gallery.regenerating, over > 0.0);
      }
      const double regenerated =
          gallery.regenerating ? c_check * std::sqrt(std::max(0.0, over)) : 0.0;
      assert_near(c_drain * gallery.sqrt_pressure + regenerated, q, 1e-10);
    }
  }
}

/// Without regeneration and leakage the balance is a straight line: s = (flow - demand) / c_by.
TEST(pump_pressure_in_closed_form, FlowBalance balance) {
  balance.work = test::endless_work();
  balance.flow_m3ps = 2e-3;
  balance.in_flow_m3ps = 5e-4;
  balance.least_flow_m3ps = 5e-4;
  balance.bypass = 5e-7;
  const PumpPressure solved = solve_pump_pressure(balance, 1.0);
  assert_true(solved.fed && solved.converged);
  assert_near(solved.sqrt_pressure, 3000.0, 1e-9);
  balance.has_relief = true;
  balance.sqrt_relief = 2000.0;
  const PumpPressure held = solve_pump_pressure(balance, 1.0);
  assert_near(held.sqrt_pressure, 2000.0, 1e-12);
  balance.in_flow_m3ps = 2.1e-3;
  balance.least_flow_m3ps = 2.1e-3;
  assert_false(solve_pump_pressure(balance, 1.0).fed);
}

/// Over wide random circuits: always converged, the root balances, and nothing changes sign there.
TEST(pump_pressure_always_converges) {
  std::mt19937 random(11);
  const auto draw = [&](double least, double most) {
    return std::exp(
        std::uniform_real_distribution<double>(std::log(least), std::log(most))(random));
  };
  int fed = 0;
  int most_steps = 0;
  for (int n = 0; n < 20000; ++n) {
    FlowBalance balance;
    balance.work = test::endless_work();
    balance.flow_m3ps = draw(1e-5, 1e-1);
    balance.leak_linear = n % 3 == 0 ? 0.0 : draw(1e-13, 1e-10);
    balance.leak_quadratic = n % 5 == 0 ? 0.0 : draw(1e-21, 1e-17);
    balance.bypass = draw(1e-8, 1e-5);
    balance.regeneration_count = n % 4;
    for (int i = 0; i < balance.regeneration_count; ++i) {
      RegenerationDemand& demand = balance.regeneration[static_cast<unsigned>(i)];
      demand.q_out_m3ps = draw(1e-6, 1e-1);
      demand.c_drain = draw(1e-7, 1e-5);
      // Down to hardly more than the drain, where (18) as printed cancels.
      demand.c_check = demand.c_drain * (1.0 + draw(1e-13, 9.0));
      demand.opening = demand.q_out_m3ps / demand.c_drain;
      const double q_in = demand.q_out_m3ps * draw(0.3, 0.8);
      balance.in_flow_m3ps += q_in - demand.q_out_m3ps;
      balance.least_flow_m3ps +=
          q_in - demand.q_out_m3ps * demand.c_check / (demand.c_check + demand.c_drain);
    }
    const PumpPressure solved = solve_pump_pressure(balance, 1.0);
    assert_int_equal(solved.fed, feed_margin_m3ps(balance, 1.0) >= 0.0);
    if (solved.fed) {
      ++fed;
      assert_true(solved.converged);
      const double s = solved.sqrt_pressure;
      assert_true(flow_left(balance, 1.0, s * (1.0 - 1e-9)) >= -1e-14);
      assert_true(flow_left(balance, 1.0, s * (1.0 + 1e-9)) <= 1e-14);
      most_steps = std::max(most_steps, solved.iterations);
    }
  }
  assert_true(fed > 10000);
  assert_true(most_steps <= 20);
}

/// A pump that feeds nothing and has no orifice to the tank holds no pressure and no one up.
TEST(an_idle_pump_without_orifices_is_no_limit) {
  McvMachine machine = kim();
  machine.pump_count = 3;
  McvInput input = light_load(0.05, 0.05, 0.05);
  input.pump_flow_m3ps[2] = 1e-3;
  const McvSolution solution = solve_mcv(machine, input, McvPolicy::kAlgorithm1);
  assert_int_equal(solution.status, SolveStatus::kOk);
  assert_near(solution.point.lambda, 1.0, 0.0);
  assert_near(solution.point.pump_pressure_pa[2], 0.0, 0.0);
}

TEST(full_speed_where_nothing_holds) {
  const McvSolution solution =
      solve_mcv(kim(), light_load(0.05, 0.05, 0.05), McvPolicy::kAlgorithm1);
  assert_int_equal(solution.status, SolveStatus::kOk);
  assert_near(solution.point.lambda, 1.0, 0.0);
  assert_int_equal(solution.limit.kind, LimitKind::kNone);
  assert_int_equal(solution.iterations, 0);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    assert_true(solution.point.spool_m[i] > 0.0);
  }
}

/// Asking more of a pump than it has gives the speed that just feeds it, and says so.
TEST(a_starved_pump_scales_all_axes) {
  const McvMachine machine = kim();
  const McvInput input = light_load(0.3, 0.0, 0.3);
  const McvSolution solution = solve_mcv(machine, input, McvPolicy::kAlgorithm1);
  assert_int_equal(solution.status, SolveStatus::kOk);
  assert_true(solution.point.lambda > 0.0 && solution.point.lambda < 1.0);
  assert_int_not_equal(solution.limit.kind, LimitKind::kNone);
  assert_true(
      evaluate(make_circuit(machine, input, test::endless_work()), solution.point.lambda).feasible);
  assert_false(
      evaluate(make_circuit(machine, input, test::endless_work()), solution.point.lambda + 1e-7)
          .feasible);
  assert_near(solution.point.spool_m[kArm], 0.0, 0.0);
}

/// Where a load is what holds lambda, just F_offset is left to drive it.
TEST(back_flow_keeps_its_offset) {
  McvInput input = light_load(0.2, 0.0, 0.05);
  input.cap_pressure_pa[kBoom] = 15e6;
  const McvSolution solution = solve_mcv(kim(), input, McvPolicy::kAlgorithm1);
  assert_int_equal(solution.limit.kind, LimitKind::kBackFlow);
  assert_int_equal(solution.limit.index, kBoom);
  assert_near(solution.point.drive_force_n[kBoom],
              test::excavator().profile.valve.spool[kBoom].force_offset_n, 1.0);
}

void assert_closed(const McvSolution& solution) {
  for (const double spool : solution.point.spool_m) {
    assert_near(spool, 0.0, 0.0);
  }
}

TEST(a_load_too_heavy_is_infeasible) {
  McvInput input = light_load(0.1, 0.1, 0.1);
  input.cap_pressure_pa[kBoom] = 60e6;
  const McvSolution solution = solve_mcv(kim(), input, McvPolicy::kAlgorithm1);
  assert_int_equal(solution.status, SolveStatus::kInfeasible);
  assert_int_equal(solution.limit.kind, LimitKind::kBackFlow);
  assert_int_equal(solution.limit.index, kBoom);
  assert_near(solution.point.lambda, 0.0, 0.0);
  assert_closed(solution);
}

TEST(at_rest_everything_stays_closed) {
  const McvSolution solution = solve_mcv(kim(), light_load(0.0, 0.0, 0.0), McvPolicy::kAlgorithm1);
  assert_int_equal(solution.status, SolveStatus::kOk);
  assert_closed(solution);
}

void check_safe(const McvSolution& solution, McvDefect defect) {
  assert_int_equal(solution.status, SolveStatus::kBadInput);
  assert_int_equal(solution.defect.defect, defect);
  assert_near(solution.point.lambda, 0.0, 0.0);
  assert_closed(solution);
}

template <class Break>
void refused(McvDefect defect, Break change) {
  McvMachine machine = kim();
  McvInput input = light_load(0.1, 0.1, 0.1);
  change(machine, input);
  check_safe(solve_mcv(machine, input, McvPolicy::kAlgorithm1), defect);
}

TEST(bad_machines_and_inputs_are_safe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused(McvDefect::kVelocity, [&](auto&, auto& in) { in.velocity_mps[1] = nan; });
  refused(McvDefect::kPressure, [&](auto&, auto& in) { in.cap_pressure_pa[2] = nan; });
  refused(McvDefect::kPressure, [&](auto&, auto& in) { in.rod_pressure_pa[0] = 1.0 / 0.0; });
  refused(McvDefect::kPressure, [&](auto&, auto& in) { in.cap_pressure_pa[1] = -1.0; });
  refused(McvDefect::kPressure, [&](auto&, auto& in) { in.rod_pressure_pa[2] = -1e-9; });
  refused(McvDefect::kInflowCheck, [&](auto& m, auto&) { m.actuator[2].c_inflow_check = -1.0; });
  refused(McvDefect::kInflowCheck, [&](auto& m, auto&) { m.actuator[2].c_inflow_check = nan; });
  refused(McvDefect::kRegeneration,
          [](auto& m, auto&) { m.actuator[1].c_check = m.actuator[1].c_drain; });
  refused(McvDefect::kPumpFlow, [&](auto&, auto& in) { in.pump_flow_m3ps[0] = -1e-3; });
  refused(McvDefect::kPumpFlow, [&](auto&, auto& in) { in.pump_flow_m3ps[1] = nan; });
  refused(McvDefect::kBadActuatorCount, [](auto& m, auto&) { m.actuator_count = 7; });
  refused(McvDefect::kBadActuatorCount, [](auto& m, auto&) { m.actuator_count = 0; });
  refused(McvDefect::kBadPumpCount, [](auto& m, auto&) { m.pump_count = 4; });
  refused(McvDefect::kPumpIndex, [](auto& m, auto&) { m.actuator[0].pump = 2; });
  refused(McvDefect::kPumpIndex, [](auto& m, auto&) { m.actuator[0].pump = -1; });
  refused(McvDefect::kArea, [](auto& m, auto&) { m.actuator[1].area_rod_m2 = 0.0; });
  refused(McvDefect::kArea, [](auto& m, auto&) { m.actuator[0].area_cap_m2 = -1e-2; });
  refused(McvDefect::kRegeneration, [](auto& m, auto&) { m.actuator[1].c_drain = 2e-6; });
  refused(McvDefect::kRegeneration, [&](auto& m, auto&) { m.actuator[1].c_check = nan; });
  refused(McvDefect::kBypass, [](auto& m, auto&) { m.actuator[2].bypass_closed = 0.0; });
  refused(McvDefect::kBypass, [](auto& m, auto&) { m.actuator[2].bypass_open = 1e-200; });
  refused(McvDefect::kRegeneration, [](auto& m, auto&) { m.actuator[1].c_check = 1e200; });
  refused(McvDefect::kForceOffset, [](auto& m, auto&) { m.actuator[2].force_offset_n = -1.0; });
  refused(McvDefect::kExtendTable, [](auto& m, auto&) { m.actuator[0].extend = {}; });
  refused(McvDefect::kRetractTable, [](auto& m, auto&) { m.actuator[0].retract = {}; });
  refused(McvDefect::kLeak, [](auto& m, auto&) { m.pump[0].leak_linear = -1.0; });
  refused(McvDefect::kBypassSeries, [&](auto& m, auto&) { m.pump[1].series_resistance = nan; });
  refused(McvDefect::kRelief, [](auto& m, auto&) { m.pump[1].relief_pa = 0.0; });
}
