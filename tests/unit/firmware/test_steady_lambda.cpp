// SPDX-License-Identifier: Apache-2.0
#include <random>

#include "firmware/mcv/optimiser.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/split.hpp"
#include "tests/unit/rounds.hpp"

constexpr double kPeriod_s = 0.01;
constexpr LambdaRise kRise{4.0, 8000.0, 0.0};
/// About what 2 % of the pressures that hold the boom are.
constexpr double kNoise_pa = 0.2e6;
constexpr unsigned kDrives = test::rounds(10, 3);

/// What lambda did while pressures were driven across the split.
struct Passage {
  int falls = 0;   ///< By more than a tenth in one cycle.
  int rises = 0;   ///< The same upwards.
  int climbs = 0;  ///< From below 0.3 to above 0.9, however slowly.
  double steepest_rise = 0.0;
};

/// The bucket's load goes from light to heavy and back in 40 s, noise on every pressure.
template <class Solve>
Passage drive(unsigned seed, Solve solve) {
  const McvMachine machine = test::kim();
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kNoise_pa);
  Passage passage;
  double last = 0.0;
  bool low = false;
  for (int cycle = 0; cycle < 4000; ++cycle) {
    const double share = 1.0 - std::abs(cycle / 2000.0 - 1.0);
    McvInput input = test::split_input(0.6e6 + 4e6 * share);
    for (unsigned i = 0; i < 3; ++i) {
      input.cap_pressure_pa[i] = std::max(0.0, input.cap_pressure_pa[i] + noise(random));
      input.rod_pressure_pa[i] = std::max(0.0, input.rod_pressure_pa[i] + noise(random));
    }
    const McvSolution solution = solve(machine, input, last);
    assert_int_equal(solution.status, SolveStatus::kOk);
    const double lambda = solution.point.lambda;
    if (cycle > 100) {  // After the start from rest.
      passage.falls += lambda < last - 0.1 ? 1 : 0;
      passage.rises += lambda > last + 0.1 ? 1 : 0;
      passage.steepest_rise = std::max(passage.steepest_rise, lambda - last);
    }
    passage.climbs += low && lambda > 0.9 ? 1 : 0;
    low = lambda < 0.3 || (low && lambda <= 0.9);
    last = lambda;
  }
  return passage;
}

Passage drive_steady(unsigned seed, McvPolicy policy, const LambdaRise& rise) {
  return drive(seed, [&](const McvMachine& machine, const McvInput& input, double last) {
    return steady_lambda(machine, input, policy, rise, last, kPeriod_s);
  });
}

/// One fall on the way up, one climb on the way down, nothing back and forth.
TEST(a_split_is_crossed_once_each_way) {
  for (unsigned seed = 0; seed < kDrives; ++seed) {
    const Passage passage = drive_steady(seed, McvPolicy::kGlobal, kRise);
    assert_int_equal(passage.falls, 1);
    assert_int_equal(passage.rises, 0);
    assert_int_equal(passage.climbs, 2);  // The start from rest, and the way back.
    assert_true(passage.steepest_rise <= kRise.rate_ps * kPeriod_s + 1e-12);
  }
}

/// The rate alone bounds how often lambda can fall, not that it falls again: what the reserve is
/// for.
TEST(without_the_reserve_noise_makes_it_fall_again) {
  int falls = 0;
  for (unsigned seed = 0; seed < kDrives; ++seed) {
    falls += drive_steady(seed, McvPolicy::kGlobal, {kRise.rate_ps, 0.0, 0.0}).falls;
  }
  print_message("%d falls in %u drives\n", falls, kDrives);
  assert_true(falls > static_cast<int>(kDrives));
}

/// The same drive makes every policy chatter that knows nothing of the last cycle: the test above
/// could fail.
TEST(alone_every_policy_chatters) {
  for (const McvPolicy policy :
       {McvPolicy::kAlgorithm1, McvPolicy::kConnected, McvPolicy::kGlobal}) {
    const Passage passage =
        drive(0, [&](const McvMachine& machine, const McvInput& input, double /*last*/) {
          return solve_mcv(machine, input, policy);
        });
    print_message("alone, policy %d: %d falls, %d jumps up\n", static_cast<int>(policy),
                  passage.falls, passage.rises);
    assert_true(passage.falls > 5 && passage.rises > 5);
  }
}

/// Light loads: lambda goes up by the rate, cycle by cycle, and nothing but the rate is the reason.
TEST(from_rest_it_rises_at_its_rate) {
  const McvMachine machine = test::kim();
  const McvInput input = test::split_input(0.6e6);
  double last = 0.0;
  for (int n = 1; n <= 30; ++n) {
    const McvSolution solution =
        steady_lambda(machine, input, McvPolicy::kGlobal, kRise, last, kPeriod_s);
    last = solution.point.lambda;
    assert_near(last, std::min(1.0, 0.04 * n), 1e-12);
    assert_int_equal(solution.limit.kind, LimitKind::kNone);
  }
}

/// It climbs to where the reserve is used up, then stays although more is feasible; the reason is
/// what lacks the reserve. When the load grows it falls to what is feasible, reserve or not.
TEST(it_rises_with_the_reserve_and_falls_without) {
  const McvMachine machine = test::kim();
  const McvInput input = test::split_input(4e6);
  const double free = solve_mcv(machine, input, McvPolicy::kGlobal).point.lambda;
  const double spared =
      solve_mcv(machine, input, McvPolicy::kGlobal, {1.0, kRise.reserve_n}).point.lambda;
  const auto after = [&](double last) {
    return steady_lambda(machine, input, McvPolicy::kGlobal, kRise, last, kPeriod_s);
  };
  const McvSolution climbed = after(spared - 0.01);
  assert_near(climbed.point.lambda, spared, 1e-9);
  const double between = 0.5 * (spared + free);
  const McvSolution held = after(between);
  assert_near(held.point.lambda, between, 0.0);
  assert_int_equal(held.limit.kind, LimitKind::kBackFlow);
  assert_int_equal(held.limit.index, kBucket);
  assert_true(held.shortfall > 0.0);
  const McvSolution fallen = after(0.9);
  assert_near(fallen.point.lambda, free, 1e-9);
}

/// With a share for holding it falls to where that share is left, and no further; a little above it
/// stays.
TEST(it_holds_with_its_share_of_the_reserve) {
  const McvMachine machine = test::kim();
  const McvInput input = test::split_input(4e6);
  const LambdaRise rise{4.0, 16000.0, 0.25};
  const double held = solve_mcv(machine, input, McvPolicy::kGlobal, {1.0, 4000.0}).point.lambda;
  const double risen = solve_mcv(machine, input, McvPolicy::kGlobal, {1.0, 16000.0}).point.lambda;
  assert_true(risen < held - 0.01);
  const auto after = [&](double last) {
    return steady_lambda(machine, input, McvPolicy::kGlobal, rise, last, kPeriod_s).point.lambda;
  };
  assert_near(after(0.9), held, 1e-9);
  assert_near(after(0.5 * (held + risen)), 0.5 * (held + risen), 0.0);
  assert_near(after(risen - 0.01), risen, 1e-9);
}

/// The split again, half of the reserve being for holding: what is left still keeps the peace; with
/// nothing left it is gone.
TEST(a_share_for_holding_leaves_it_calm) {
  int falls_without = 0;
  for (unsigned seed = 0; seed < kDrives; ++seed) {
    const Passage passage = drive_steady(seed, McvPolicy::kGlobal, {4.0, 16000.0, 0.5});
    assert_int_equal(passage.falls, 1);
    assert_int_equal(passage.rises, 0);
    falls_without += drive_steady(seed, McvPolicy::kGlobal, {4.0, 8000.0, 1.0}).falls;
  }
  print_message("%d falls in %u drives with all of the reserve for holding\n", falls_without,
                kDrives);
  assert_true(falls_without > static_cast<int>(kDrives));
}

/// A load within the reserve of stall is moved, and a little more load makes it a little slower:
/// the reserve takes at most half of what is left over.
TEST(near_stall_it_slows_down_smoothly) {
  const McvMachine machine = test::kim();
  double before = 1.0;
  for (double cap_pa = 12.0e6; cap_pa < 12.3e6; cap_pa += 0.02e6) {
    McvInput input;
    input.velocity_mps = {0.01, 0.0, 0.0};
    input.cap_pressure_pa = {cap_pa, 0.0, 0.0};
    input.pump_flow_m3ps = {2e-3, 2e-3};
    double last = 0.0;
    for (int n = 0; n < 100; ++n) {
      last = steady_lambda(machine, input, McvPolicy::kGlobal, kRise, last, kPeriod_s).point.lambda;
    }
    const double free = solve_mcv(machine, input, McvPolicy::kGlobal).point.lambda;
    assert_true(last <= before && last > 0.3 * free);
    before = last;
  }
}

/// Another axis close to stall, on the other pump, must not cost the split its reserve.
TEST(an_axis_near_stall_does_not_free_the_others) {
  const McvMachine machine = test::kim();
  McvInput still = test::split_input(2.0e6);
  still.velocity_mps[kArm] = 0.002;
  still.rod_pressure_pa[kArm] = 0.0;
  // Up to 4 kN short of stall, as (43) has it at standstill.
  still.cap_pressure_pa[kArm] = 60e6;
  const double short_n = solve_mcv(machine, still, McvPolicy::kGlobal).standstill.short_n;
  assert_true(short_n > 0.0);
  still.cap_pressure_pa[kArm] -= (short_n + 4000.0) / machine.actuator[kArm].area_cap_m2;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, kNoise_pa);
  double last = 0.0;
  int falls = 0;
  for (int cycle = 0; cycle < 4000; ++cycle) {
    McvInput input = still;
    for (const unsigned i : {0u, 2u}) {
      input.cap_pressure_pa[i] = std::max(0.0, input.cap_pressure_pa[i] + noise(random));
      input.rod_pressure_pa[i] = std::max(0.0, input.rod_pressure_pa[i] + noise(random));
    }
    const double lambda =
        steady_lambda(machine, input, McvPolicy::kGlobal, kRise, last, kPeriod_s).point.lambda;
    falls += lambda < last - 0.1 ? 1 : 0;
    last = lambda;
  }
  assert_true(falls <= 1);
  assert_true(last > 0.05);
}

TEST(bad_rises_are_refused) {
  const double nan = std::nan("");
  const auto refused = [](const LambdaRise& rise, double period_s) {
    const McvSolution solution =
        steady_lambda(test::kim(), test::split_input(4e6), McvPolicy::kGlobal, rise, 0.5, period_s);
    assert_int_equal(solution.status, SolveStatus::kBadInput);
    assert_near(solution.point.lambda, 0.0, 0.0);
  };
  refused(kRise, nan);
  refused({nan, 0.0, 0.0}, kPeriod_s);
  refused({4.0, nan, 0.0}, kPeriod_s);
  refused({4.0, -1.0, 0.0}, kPeriod_s);
}
