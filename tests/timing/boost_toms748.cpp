/// Boost.Math's TOMS 748, the usual bracketing root finder, on the smallest margin over lambda.

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

#include "tests/timing/lambda_problem.hpp"
#include "tests/timing/solver.hpp"

namespace graben::timing {
namespace {

/// 2^-25 of lambda: as close as Algorithm 1 gets.
constexpr int kBits = 25;
constexpr std::uintmax_t kMostEvaluations = 100;

class Toms748 final : public LambdaSolver {
 public:
  double solve(const McvMachine& machine, const McvInput& input) override {
    const LambdaProblem problem(machine, input);
    const double at_standstill = problem.smallest_margin(0.0);
    if (!(at_standstill > 0.0)) {
      return 0.0;
    }
    const double highest = problem.highest_lambda();
    const double at_highest = problem.smallest_margin(highest);
    if (at_highest >= 0.0) {
      return highest;
    }
    std::uintmax_t evaluations = kMostEvaluations;
    const auto bracket = boost::math::tools::toms748_solve(
        [&problem](double lambda) { return problem.smallest_margin(lambda); }, 0.0, highest,
        at_standstill, at_highest, boost::math::tools::eps_tolerance<double>(kBits), evaluations);
    // The margin falls through zero, so the lower end is the feasible one.
    return bracket.first;
  }
};

}  // namespace

std::unique_ptr<LambdaSolver> make_toms748(const McvMachine& /*machine*/, const McvInput& /*i*/) {
  return std::make_unique<Toms748>();
}

}  // namespace graben::timing
