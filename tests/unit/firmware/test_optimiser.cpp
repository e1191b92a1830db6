// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <limits>

#include "firmware/mcv/optimiser.hpp"
#include "tests/fuzz/endless_work.hpp"
#include "tests/fuzz/plain_circuit.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/split.hpp"
#include "tests/unit/rounds.hpp"

using test::kim;
using test::split_input;

constexpr std::array kPolicies{McvPolicy::kAlgorithm1, McvPolicy::kConnected, McvPolicy::kGlobal};
constexpr double kGapCap_pa = 2.5e6;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double lambda_of(const McvInput& input, McvPolicy policy, const LambdaRange& range = {}) {
  const McvSolution solution = solve_mcv(kim(), input, policy, range);
  assert_int_equal(solution.status, SolveStatus::kOk);
  return solution.point.lambda;
}

bool feasible(const McvInput& input, double lambda) {
  const McvMachine machine = kim();
  return evaluate(make_circuit(machine, input, test::endless_work()), lambda).feasible;
}

/// Over the gap, at its lower end, and Algorithm 1 wherever its halving led it.
TEST(policies_differ_where_the_set_splits) {
  const McvInput input = split_input(kGapCap_pa);
  const double global = lambda_of(input, McvPolicy::kGlobal);
  const double connected = lambda_of(input, McvPolicy::kConnected);
  assert_near(global, 1.0, 0.0);
  assert_true(connected > 0.05 && connected < 0.4);
  for (int n = 1; n < 200; ++n) {
    assert_true(feasible(input, connected * n / 200.0));
  }
  assert_false(feasible(input, connected + 1e-6));
}

TEST(policies_agree_where_it_does_not) {
  for (const double cap_pa : {0.6e6, 4e6}) {
    const McvInput input = split_input(cap_pa);
    const double global = lambda_of(input, McvPolicy::kGlobal);
    assert_near(lambda_of(input, McvPolicy::kConnected), global, 1e-8);
    assert_near(lambda_of(input, McvPolicy::kAlgorithm1), global, 1e-7);
  }
}

/// Bounded from above, global is the largest feasible lambda under the bound: inside the gap the
/// end of the interval below it.
TEST(a_bound_is_kept) {
  const McvInput input = split_input(kGapCap_pa);
  const double connected = lambda_of(input, McvPolicy::kConnected);
  assert_near(lambda_of(input, McvPolicy::kGlobal, {0.9, 0.0}), 0.9, 0.0);
  assert_near(lambda_of(input, McvPolicy::kGlobal, {connected + 0.02, 0.0}), connected, 1e-8);
  for (const McvPolicy policy : kPolicies) {
    assert_near(lambda_of(input, policy, {0.5 * connected, 0.0}), 0.5 * connected, 0.0);
  }
}

/// With a reserve lambda is what the same loads, heavier by it, would allow; the figures are those
/// of the loads as they are.
TEST(a_reserve_stays_in_hand) {
  constexpr double kReserve_n = 4000.0;
  const McvInput input = split_input(4e6);
  for (const McvPolicy policy : kPolicies) {
    const McvSolution free = solve_mcv(kim(), input, policy);
    const McvSolution spared = solve_mcv(kim(), input, policy, {1.0, kReserve_n});
    assert_true(spared.point.lambda < free.point.lambda);
    assert_near(free.margins.force_n[kBucket], 0.0, 1.0);
    assert_near(spared.margins.force_n[kBucket], kReserve_n, 1.0);
    assert_int_equal(spared.limit.kind, LimitKind::kBackFlow);
    assert_int_equal(spared.limit.index, kBucket);
  }
}

TEST(bad_ranges_are_refused) {
  const McvInput input = split_input(kGapCap_pa);
  for (const LambdaRange& range : {LambdaRange{0.0, 0.0},
                                   {-1.0, 0.0},
                                   {1.1, 0.0},
                                   {kNan, 0.0},
                                   {1.0, -1.0},
                                   {1.0, kNan},
                                   {1.0, kInfinity}}) {
    for (const McvPolicy policy : kPolicies) {
      const McvSolution solution = solve_mcv(kim(), input, policy, range);
      assert_int_equal(solution.defect.defect, McvDefect::kLambdaRange);
      assert_string_equal(test::unsafe(kim(), input, range, solution).c_str(), "");
    }
  }
}

/// (43): with the pump's pressure at standstill taken from the machine's own figures, what is
/// lacking is the load and the offset less that force.
TEST(standstill_says_who_lacks_what) {
  McvInput input = split_input(kGapCap_pa);
  input.velocity_mps = {0.1, 0.0, 0.05};
  input.cap_pressure_pa = {60e6, 4e6, 30e6};
  const McvMachine machine = kim();
  for (const McvPolicy policy : kPolicies) {
    const McvSolution solution = solve_mcv(machine, input, policy);
    assert_int_equal(solution.status, SolveStatus::kInfeasible);
    assert_false(solution.standstill.can_start);
    assert_int_equal(solution.standstill.actuator, kBoom);
    const McvActuator& boom = machine.actuator[kBoom];
    const double load_n = boom.area_cap_m2 * 60e6 - boom.area_rod_m2 * 1e6;
    const PumpPressure line = solve_pump_pressure(
        make_circuit(machine, input, test::endless_work()).line[static_cast<unsigned>(boom.pump)],
        0.0);
    const double drive_n = boom.area_cap_m2 * line.sqrt_pressure * line.sqrt_pressure;
    assert_near(solution.standstill.short_n, load_n + boom.force_offset_n - drive_n, 1e-3);
    assert_true(solution.standstill.short_n > 1e4);
  }
  // Whoever lacks most is named, not whoever comes first.
  input.cap_pressure_pa = {30e6, 4e6, 200e6};
  assert_int_equal(solve_mcv(machine, input, McvPolicy::kGlobal).standstill.actuator, kBucket);
}

/// What the limit lacks at lambda = 1 is what evaluating there shows.
TEST(shortfall_is_the_margin_at_full_speed) {
  const McvInput input = split_input(4e6);
  const McvMachine machine = kim();
  const McvSolution solution = solve_mcv(machine, input, McvPolicy::kGlobal);
  assert_int_equal(solution.limit.kind, LimitKind::kBackFlow);
  const CircuitAxis axis = make_circuit(machine, input, test::endless_work()).axis[kBucket];
  const PumpPressure line =
      solve_pump_pressure(make_circuit(machine, input, test::endless_work()).line[axis.pump], 1.0);
  const double lacking_n = axis.force_offset_n - drive_force(axis, 1.0, line.sqrt_pressure).force_n;
  assert_near(solution.shortfall, lacking_n, 1e-6);
  assert_true(solution.shortfall > 0.0);
  assert_near(solve_mcv(machine, split_input(0.6e6), McvPolicy::kGlobal).shortfall, 0.0, 0.0);
}

/// Remark 3: a check valve in the in-flow line takes A_in (lambda Q_in / c)^2 of the force; at the
/// limit of travel what is left is what full opening needs.
TEST(in_flow_check_valve_takes_its_force, McvInput input) {
  input.velocity_mps = {0.0, 0.0, 0.3};
  input.cap_pressure_pa = {0.0, 0.0, 6e6};
  input.pump_flow_m3ps = {4e-3, 4e-3};
  McvMachine machine = kim();
  McvActuator& bucket = machine.actuator[kBucket];
  const double without = solve_mcv(machine, input, McvPolicy::kGlobal).point.lambda;
  bucket.c_inflow_check = 6e-7;
  for (const McvPolicy policy : kPolicies) {
    const McvSolution solution = solve_mcv(machine, input, policy);
    const double lambda = solution.point.lambda;
    assert_true(lambda > 0.0 && lambda < without);
    assert_int_equal(solution.limit.kind, LimitKind::kSpoolTravel);
    const double speed = lambda * 0.3;
    const double pressure_lost = std::pow(bucket.area_cap_m2 * speed / bucket.c_inflow_check, 2.0);
    const double spool_needs = std::pow(speed / bucket.extend.y_last(), 2.0);
    assert_near(solution.point.drive_force_n[kBucket],
                spool_needs + bucket.area_cap_m2 * pressure_lost, 1.0);
  }
}

/// A pump that exactly feeds its line at full speed holds no pressure there: the search starts at
/// r = 0, where the driving length is 0 and still grows.
TEST(a_pump_that_exactly_feeds_its_line) {
  McvMachine machine = kim();
  McvInput input;
  input.velocity_mps = {0.0, 0.0, 0.1};
  input.cap_pressure_pa = {0.0, 0.0, 1e6};
  input.rod_pressure_pa = {0.0, 0.0, 0.5e6};
  input.pump_flow_m3ps = {1e-3, 0.1 * machine.actuator[kBucket].area_cap_m2};
  const double local = solve_mcv(machine, input, McvPolicy::kAlgorithm1).point.lambda;
  assert_true(local > 0.1 && local < 1.0);
  assert_near(solve_mcv(machine, input, McvPolicy::kGlobal).point.lambda, local, 1e-7);
  assert_near(solve_mcv(machine, input, McvPolicy::kConnected).point.lambda, local, 1e-7);
}

/// Without pump flow 1 / lambda is so steep in r that rounding moves the end by a tenth, and where
/// a pump only just feeds its line no Newton step gets short: both have been left unfinished.
TEST(rounding_leaves_nothing_unfinished) {
  for (const std::uint64_t seed : {43575u, 9441u}) {
    const test::RandomCase problem = test::random_case(seed);
    for (const McvPolicy policy : kPolicies) {
      const McvSolution solution = solve_mcv(problem.machine, problem.input, policy);
      assert_int_equal(solution.status, SolveStatus::kOk);
      assert_true(solution.point.lambda > 0.04);
    }
  }
}

/// Every corner of the inputs, sound and not, by every policy.
TEST(corners_are_safe) {
  const McvMachine machine = kim();
  const std::array velocities{0.0, -0.0, 5e-324, 1e-9, 0.3, -0.3, 1e3, -1e300, kNan, kInfinity};
  const std::array pressures{0.0, -0.0, 5e-324, 1e7, 1e300, -1.0, kNan, kInfinity};
  const std::array flows{0.0, 5e-324, 2e-3, 1e300, -1e-9, kNan};
  long refused = 0;
  long moving = 0;
  const auto check = [&](const McvInput& input) {
    for (const McvPolicy policy : kPolicies) {
      const McvSolution solution = solve_mcv(machine, input, policy);
      const std::string wrong = test::unsafe(machine, input, {}, solution);
      if (!wrong.empty()) {
        fail_msg("%s", wrong.c_str());
      }
      refused += solution.status == SolveStatus::kBadInput ? 1 : 0;
      moving += solution.point.lambda > 0.0 ? 1 : 0;
    }
  };
  McvInput input;
  for (const double boom : velocities) {
    for (const double bucket : velocities) {
      for (const double cap_pa : pressures) {
        for (const double rod_pa : pressures) {
          for (const double flow : flows) {
            input.velocity_mps = {boom, 0.0, bucket};
            input.cap_pressure_pa = {cap_pa, 0.0, rod_pa};
            input.rod_pressure_pa = {rod_pa, 0.0, 0.0};
            input.pump_flow_m3ps = {flow, 1e-3};
            check(input);
          }
        }
      }
    }
  }
  print_message("%ld refused, %ld moving\n", refused, moving);
  assert_true(refused > 50000 && moving > 2000);
}

/// Kim's machine with pumps under negative flow control.
McvMachine negative_flow() {
  McvMachine machine = kim();
  for (McvPump& pump : machine.pump) {
    pump.has_relief = true;
    pump.relief_pa = 3e7;
    pump.tank_orifice = 1e-6;
    pump.series_resistance = 1e12;
    pump.regulator.kind = PumpKind::kNegativeFlow;
    pump.regulator.full_swash_pa = 0.8e6;
    pump.regulator.least_swash_pa = 3e6;
  }
  return machine;
}

/// The opening of the way that a drive goes counts, the other does not.
TEST(each_side_closes_its_bypass_at_its_own_opening) {
  const auto solved = [](bool extends, const BypassClosing& closes_at) {
    McvMachine machine = negative_flow();
    for (McvActuator& actuator : machine.actuator) {
      actuator.bypass_closes_at = closes_at;
    }
    McvInput input;
    input.velocity_mps = {0.0, extends ? 0.05 : -0.05, 0.0};
    input.pump_flow_m3ps = {1.5e-3, 1.5e-3};
    const McvSolution solution = solve_mcv(machine, input, McvPolicy::kGlobal);
    return solution.point.pump_pressure_pa[0];
  };
  const double extended_pa = solved(true, {0.3, 0.3});
  assert_near(solved(true, {0.3, 0.9}), extended_pa, 0.0);
  assert_true(std::abs(solved(true, {0.9, 0.3}) - extended_pa) > 1e3);
  const double retracted_pa = solved(false, {0.3, 0.3});
  assert_near(solved(false, {0.9, 0.3}), retracted_pa, 0.0);
  assert_true(std::abs(solved(false, {0.3, 0.9}) - retracted_pa) > 1e3);
}

/// A bypass that closes over the opening on one side does so on the other.
TEST(half_a_closing_bypass_is_refused) {
  using At = BypassClosing;
  for (const At& closes_at : {At{0.3, 0.0}, At{0.0, 0.3}, At{0.3, 1.1}}) {
    McvMachine machine = negative_flow();
    machine.actuator[0].bypass_closes_at = closes_at;
    const McvSolution refused = solve_mcv(machine, split_input(0.6e6), McvPolicy::kGlobal);
    assert_int_equal(refused.defect.defect, McvDefect::kBypass);
  }
}

/// At a force of nothing a drive of a line under negative flow control gives way without end.
TEST(a_yield_that_is_no_number_is_no_solution) {
  McvMachine machine = negative_flow();
  for (McvActuator& actuator : machine.actuator) {
    actuator.force_offset_n = 0.0;
  }
  const auto fixed = [&](double cap_pa) {
    return solve_mcv(machine, split_input(cap_pa), McvPolicy::kFixed);
  };
  assert_int_equal(fixed(0.6e6).status, SolveStatus::kOk);
  const McvSolution heavy = fixed(29e6);
  assert_string_equal(test::unsafe(machine, split_input(29e6), {}, heavy).c_str(), "");
  assert_int_equal(heavy.status, SolveStatus::kNotConverged);
  assert_near(heavy.point.lambda, 0.0, 0.0);
}

/// A share of a reserve is that much less of it, also where half of what is left over bounds it.
TEST(a_share_of_the_reserve) {
  const McvInput input = split_input(4e6);
  const auto at = [&](double reserve_n, double share) {
    return lambda_of(input, McvPolicy::kGlobal, {1.0, reserve_n, 1.0, share});
  };
  assert_near(at(8000.0, 0.75), at(6000.0, 1.0), 1e-12);
  assert_near(at(8000.0, 0.0), lambda_of(input, McvPolicy::kGlobal), 0.0);
  assert_true(at(1e9, 0.5) > at(1e9, 1.0) + 1e-3);
  for (const double share : {-0.1, 1.1, kNan}) {
    const McvSolution refused =
        solve_mcv(kim(), input, McvPolicy::kGlobal, {1.0, 8000.0, 1.0, share});
    assert_int_equal(refused.status, SolveStatus::kBadInput);
    assert_int_equal(refused.defect.defect, McvDefect::kLambdaRange);
  }
}

/// Up to `hold` the share is enough, over it the whole reserve is asked for: the one solve ends
/// where two would, one for what may be reached and one for what may be held.
TEST(what_is_held_needs_its_share_alone) {
  constexpr double kReserve_n = 8000.0;
  constexpr double kShare = 0.25;
  const McvInput input = split_input(4e6);
  for (const McvPolicy policy : kPolicies) {
    const double risen = lambda_of(input, policy, {1.0, kReserve_n});
    const double held = lambda_of(input, policy, {1.0, kShare * kReserve_n});
    assert_true(risen > 0.01 && risen < held - 0.005);
    const auto at = [&](double most, double hold) {
      return solve_mcv(kim(), input, policy, {most, kReserve_n, hold, kShare});
    };
    const double between = 0.5 * (risen + held);
    assert_near(at(1.0, 0.5 * risen).point.lambda, risen, 1e-7);
    assert_near(at(0.9 * risen, 0.5 * risen).point.lambda, 0.9 * risen, 0.0);
    assert_near(at(1.0, 0.9).point.lambda, held, 1e-7);
    assert_near(at(between, 1.0).point.lambda, between, 0.0);
    // Not a bit of it is lost from cycle to cycle, and what the rise lacks is the reason.
    const McvSolution stays = at(1.0, between);
    assert_near(stays.point.lambda, between, 0.0);
    assert_int_equal(stays.limit.kind, LimitKind::kBackFlow);
    assert_int_equal(stays.limit.index, kBucket);
    assert_true(stays.shortfall > 0.0);
  }
  for (const double hold : {-0.1, 1.1, kNan}) {
    const LambdaRange range{1.0, kReserve_n, hold, kShare};
    const McvSolution refused = solve_mcv(kim(), input, McvPolicy::kGlobal, range);
    assert_int_equal(refused.defect.defect, McvDefect::kLambdaRange);
    assert_string_equal(test::unsafe(kim(), input, range, refused).c_str(), "");
  }
}

/// Where the set splits, what is held under the gap does not jump over it, but by the policy that
/// is free to, and for it only with the whole reserve.
TEST(a_gap_is_met_from_where_lambda_is_held) {
  const McvInput input = split_input(kGapCap_pa);
  const double connected = lambda_of(input, McvPolicy::kConnected);
  const LambdaRange low{1.0, 10.0, 0.5 * connected, 0.5};
  assert_near(lambda_of(input, McvPolicy::kConnected, low), connected, 1e-3);
  assert_near(lambda_of(input, McvPolicy::kGlobal, low), 1.0, 0.0);
  // Held over the gap, in the gap and within it under a lower bound.
  assert_near(lambda_of(input, McvPolicy::kGlobal, {1.0, 1e9, 0.9, 0.0}), 0.9, 0.0);
  assert_near(lambda_of(input, McvPolicy::kGlobal, {1.0, 1e9, connected + 0.02, 0.0}), connected,
              1e-8);
  assert_near(lambda_of(input, McvPolicy::kConnected, {1.0, 1e9, 0.9, 0.0}), connected, 1e-8);
}

/// Where a line has no flow of its own and an axis regenerates, rounding shows in r: what the
/// search finds is then brought to the end of its interval by halving.
TEST(a_starved_line_ends_where_halving_says) {
  constexpr int kCases = test::rounds(20000, 1000);
  int held = 0;
  for (std::uint64_t seed = 0; seed < kCases; ++seed) {
    test::RandomCase problem = test::random_case(seed);
    problem.input.pump_flow_m3ps[0] = 0.0;
    const auto at = [&](McvPolicy policy) {
      return solve_mcv(problem.machine, problem.input, policy).point.lambda;
    };
    const double local = at(McvPolicy::kAlgorithm1);
    assert_true(at(McvPolicy::kGlobal) >= local - 1e-7);
    held += local > 0.0 && local < 1.0 ? 1 : 0;
  }
  assert_true(held > kCases / 100);
}

/// Where all is feasible fixed is what the others find; where it is not, it goes on at full speed
/// with the hindered spool wide open, and says who hinders.
TEST(fixed_asks_nobody) {
  const McvInput light = split_input(0.6e6);
  const McvSolution free = solve_mcv(kim(), light, McvPolicy::kFixed);
  const McvSolution global = solve_mcv(kim(), light, McvPolicy::kGlobal);
  assert_near(free.point.lambda, 1.0, 0.0);
  assert_int_equal(free.limit.kind, LimitKind::kNone);
  for (unsigned i = 0; i < kAxisCount; ++i) {
    assert_near(free.point.spool_m[i], global.point.spool_m[i], 1e-12);
  }
  const McvInput heavy = split_input(4e6);
  assert_true(lambda_of(heavy, McvPolicy::kGlobal) < 0.9);
  const McvSolution forced = solve_mcv(kim(), heavy, McvPolicy::kFixed, {1.0, 8000.0});
  assert_int_equal(forced.status, SolveStatus::kOk);
  assert_near(forced.point.lambda, 1.0, 0.0);
  assert_int_equal(forced.limit.kind, LimitKind::kBackFlow);
  assert_int_equal(forced.limit.index, kBucket);
  const McvMachine machine = kim();
  const double opened_m = std::abs(forced.point.spool_m[kBucket]);
  assert_near(opened_m,
              heavy.velocity_mps[kBucket] > 0.0 ? machine.actuator[kBucket].extend.x_last()
                                                : machine.actuator[kBucket].retract.x_last(),
              1e-12);
}
