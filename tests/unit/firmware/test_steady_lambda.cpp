#include <random>

#include "firmware/mcv/steady_lambda.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/firmware/split.hpp"

namespace {

using namespace graben;

constexpr double kPeriod_s = 0.01;
constexpr LambdaRise kRise{4.0, 4000.0};
constexpr double kNoise_pa = 0.1e6;

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
void a_split_is_crossed_once_each_way(void**) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Passage passage = drive_steady(seed, McvPolicy::kGlobal, kRise);
    print_message("steady: %d falls, %d jumps up, %d climbs\n", passage.falls, passage.rises,
                  passage.climbs);
    assert_int_equal(passage.falls, 1);
    assert_int_equal(passage.rises, 0);
    assert_int_equal(passage.climbs, 2);  // The start from rest, and the way back.
    assert_true(passage.steepest_rise <= kRise.rate_ps * kPeriod_s + 1e-12);
  }
}

/// The same drive makes every policy chatter that knows nothing of the last cycle: the test above
/// could fail.
void alone_every_policy_chatters(void**) {
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

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_split_is_crossed_once_each_way),
      cmocka_unit_test(alone_every_policy_chatters),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
