// SPDX-License-Identifier: Apache-2.0
/// Boost.Math's TOMS 748, the usual bracketing root finder, on the smallest margin over lambda,
/// the pressures solved inside as Kim does. Bracket: standstill, which must be feasible, and the
/// fastest that the pumps can feed; where that is feasible, it is the answer.
///
/// Twice, for which root it lands on where there are several is chance: margins as lengths are the
/// faster way, margins as forces end at the largest lambda in all of the reference cases.

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

#include "tests/timing/lambda_problem.hpp"
#include "tests/timing/solver.hpp"

namespace graben::timing {
namespace {

/// 2^-25 of lambda: as close as Algorithm 1 gets.
constexpr int kBits = 26;
constexpr std::uintmax_t kMostEvaluations = 100;

template <MarginForm form>
class Toms748 final : public LambdaSolver {
 public:
  double solve(const McvMachine& machine, const McvInput& input) override {
    const LambdaProblem problem(machine, input);
    LambdaProblem::Near near;
    const double at_standstill = problem.smallest_margin(0.0, near, form);
    if (!(at_standstill > 0.0)) {
      return 0.0;
    }
    const double highest = problem.highest_lambda();
    const double at_highest = problem.smallest_margin(highest, near, form);
    if (at_highest >= 0.0) {
      return highest;
    }
    std::uintmax_t evaluations = kMostEvaluations;
    const auto bracket = boost::math::tools::toms748_solve(
        [&](double lambda) { return problem.smallest_margin(lambda, near, form); }, 0.0, highest,
        at_standstill, at_highest, boost::math::tools::eps_tolerance<double>(kBits), evaluations);
    // The margin falls through zero, so the lower end is the feasible one.
    return bracket.first;
  }
};

}  // namespace

std::unique_ptr<LambdaSolver> make_toms748(const McvMachine& /*machine*/, const McvInput& /*i*/) {
  return std::make_unique<Toms748<MarginForm::kLength>>();
}

std::unique_ptr<LambdaSolver> make_toms748_force(const McvMachine& /*machine*/,
                                                 const McvInput& /*i*/) {
  return std::make_unique<Toms748<MarginForm::kForce>>();
}

}  // namespace graben::timing
