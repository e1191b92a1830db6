// SPDX-License-Identifier: Apache-2.0
// Steps that a solve's searches take from one count.
#include "firmware/mcv/work.hpp"

#include <algorithm>

#include "firmware/excavator/excavator_drives.hpp"
#include "firmware/mcv/optimiser.hpp"
#include "firmware/mcv/policies.hpp"
#include "firmware/mcv/tuning.hpp"
#include "tests/fuzz/endless_work.hpp"
#include "tests/fuzz/plain_circuit.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/fixture.hpp"

TEST(a_step_is_taken_once) {
  assert_false(may_step(nullptr));
  allow_kept(nullptr);
  Work work{1, 2};
  assert_false(work.is_spent());
  assert_true(may_step(&work));
  assert_false(may_step(&work));
  assert_int_equal(work.left, 0);
  assert_false(work.is_spent());
  allow_kept(&work);
  assert_int_equal(work.left, 2);
  assert_true(may_step(&work) && may_step(&work));
  assert_true(work.is_spent());
  allow_kept(&work);
  assert_true(work.is_spent());
}

/// Of whole numbers that a defect could leave, too.
TEST(less_than_none_is_none) {
  Work work{-1, 0};
  assert_false(may_step(&work));
  assert_true(work.is_spent());
  assert_true(Work({0, -1}).is_spent());
  assert_false(Work({0, 1}).is_spent());
  assert_false(Work({1, 0}).is_spent());
}

using Choose = PolicyResult (*)(const Asked&);
constexpr Choose kChoices[] = {choose_global, choose_connected, choose_algorithm1};

Asked plain(McvCircuit& circuit) {
  Asked asked{circuit};
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    asked.rising_n[i] = asked.holding_n[i] = circuit.axis[i].load_force_n;
  }
  return asked;
}

/// However few steps there are: a point that holds, or none, and then it is said.
TEST(whoever_runs_out_of_steps_says_so) {
  int ran_out = 0;
  int ended = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const test::RandomCase problem = test::random_case(seed);
    for (const Choose choose : kChoices) {
      for (const int steps : {0, 1, 2, 5, 11, 23, 47, 95, 191}) {
        Work work{steps, steps / 2};
        McvCircuit circuit = make_circuit(problem.machine, problem.input, &work);
        const PolicyResult found = choose(plain(circuit));
        assert_true(work.left >= 0);
        if (!found.bounded || work.is_spent()) {
          ++ran_out;
          continue;
        }
        ++ended;
        McvCircuit again = make_circuit(problem.machine, problem.input, test::endless_work());
        if (found.point.lambda > 0.0) {
          assert_true(evaluate(again, found.point.lambda).feasible);
        }
      }
    }
  }
  assert_true(ran_out > 1000);
  assert_true(ended > 1000);
}

/// A second solve of a cycle has what the first has left, and kLeastSteps whatever that took.
TEST(a_second_solve_has_what_is_left) {
  constexpr int kAll = kSearchSteps + kHalvingSteps;
  int less = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const test::RandomCase problem = test::random_case(seed);
    const McvSolution alone = solve_mcv(problem.machine, problem.input, McvPolicy::kConnected);
    for (const int taken : {kAll / 2, kAll, 2 * kAll}) {
      LambdaRange range;
      range.taken = taken;
      const McvSolution second =
          solve_mcv(problem.machine, problem.input, McvPolicy::kConnected, range);
      assert_in_range(second.steps, 0, std::max(kAll - taken, kLeastSteps));
      less += second.steps < alone.steps ? 1 : 0;
    }
  }
  assert_true(less > 0);
  LambdaRange wrong;
  wrong.taken = -1;
  const test::RandomCase problem = test::random_case(0);
  assert_int_equal(
      solve_mcv(problem.machine, problem.input, McvPolicy::kGlobal, wrong).defect.defect,
      McvDefect::kLambdaRange);
}

/// A controller's solve never comes to it: not on wild circuits of an excavator's size.
TEST(there_are_enough_steps) {
  int most = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const test::RandomCase problem = test::random_case(seed);
    for (const McvPolicy policy :
         {McvPolicy::kGlobal, McvPolicy::kConnected, McvPolicy::kAlgorithm1}) {
      const McvSolution solution = solve_mcv(problem.machine, problem.input, policy);
      assert_int_not_equal(solution.status, SolveStatus::kNotConverged);
      most = std::max(most, solution.steps);
    }
  }
  assert_in_range(most, kSearchSteps / 2, kSearchSteps + kHalvingSteps);
}

TEST(a_small_circuit_has_fewer_steps) {
  const McvMachine valve = mcv_machine(test::excavator().profile);
  const SolveSteps small = solve_steps(valve, McvPolicy::kGlobal);
  const SolveSteps large = solve_steps(valve, McvPolicy::kConnected);
  assert_int_equal(small.all(), kSmallSearchSteps + kSmallHalvingSteps);
  assert_int_equal(small.least, kSmallLeastSteps);
  assert_int_equal(large.all(), kSearchSteps + kHalvingSteps);
  assert_int_equal(large.least, kLeastSteps);
  const auto all_of = [](const McvMachine& machine) {
    return solve_steps(machine, McvPolicy::kGlobal).all();
  };
  assert_int_equal(all_of(mcv_machine(test::excavator_12t().profile)), small.all());
  McvMachine other = valve;
  other.actuator_count = kSmallActuators + 1;
  assert_int_equal(all_of(other), large.all());
  other = valve;
  other.pump_count = kSmallPumps + 1;
  assert_int_equal(all_of(other), large.all());
  other = valve;
  other.pump[1].regulator.kind = PumpKind::kNegativeFlow;
  assert_int_equal(all_of(other), large.all());
}

/// Shipped valves, with loads that no machine has: the steps are enough for a first solve. Of a
/// second one that has next to none they may end before a search does, and then it is said.
TEST(a_small_circuit_has_enough_steps) {
  int ended = 0;
  int ran_out = 0;
  for (const auto* profile : {&test::excavator().profile, &test::excavator_12t().profile}) {
    const McvMachine valve = mcv_machine(*profile);
    const SolveSteps steps = solve_steps(valve, McvPolicy::kGlobal);
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
      const McvInput input = test::random_case(seed).input;
      LambdaRange range;
      const McvSolution first = solve_mcv(valve, input, McvPolicy::kGlobal, range);
      assert_int_not_equal(first.status, SolveStatus::kNotConverged);
      assert_in_range(first.steps, 0, steps.all());
      range.taken = steps.all();
      const McvSolution second = solve_mcv(valve, input, McvPolicy::kGlobal, range);
      assert_in_range(second.steps, 0, steps.least);
      assert_true(second.point.lambda <= first.point.lambda + 1e-9);
      assert_true(second.status != SolveStatus::kNotConverged || second.point.lambda == 0.0);
      ended += second.status == first.status ? 1 : 0;
      ran_out += second.status == SolveStatus::kNotConverged ? 1 : 0;
    }
  }
  assert_true(ended > 5000);
  assert_true(ran_out > 0);
}

/// Shipped valves whose pumps set their own swash, with loads that no machine has, some of which
/// pull, so that checks of regeneration open: both solves of a cycle come to an end.
TEST(regulated_pumps_have_enough_steps) {
  int slowed = 0;
  for (const char* name :
       {"excavator_22t_ls", "excavator_12t_ls", "excavator_22t_nfc", "excavator_12t_nfc"}) {
    const machines::SimulatedExcavator machine =
        machines::load_simulated_excavator(machines::find_profile(name));
    const McvMachine valve = mcv_machine(machine.profile);
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
      const McvInput input = test::random_case(seed).input;
      LambdaRange range{1.0, 20e3, seed % 2 == 0 ? 0.0 : 0.9, 0.5};
      const McvSolution first = solve_mcv(valve, input, McvPolicy::kGlobal, range);
      assert_int_not_equal(first.status, SolveStatus::kNotConverged);
      range.reserve_n = 0.0;
      range.hold = 0.0;
      range.taken = first.steps;
      const McvSolution second = solve_mcv(valve, input, McvPolicy::kGlobal, range);
      assert_int_not_equal(second.status, SolveStatus::kNotConverged);
      slowed += first.point.lambda > 0.0 && first.point.lambda < 1.0 ? 1 : 0;
    }
  }
  assert_true(slowed > 1000);
}
