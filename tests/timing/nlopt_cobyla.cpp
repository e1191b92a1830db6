// SPDX-License-Identifier: Apache-2.0
/// NLopt's COBYLA over lambda alone: derivative-free, the pressures solved inside as Kim does, the
/// smallest margin its one constraint. All margins as constraints of their own take it 19
/// evaluations instead of 14 (mean); pressures as unknowns with equality constraints, hundreds.

#include "tests/timing/local_starts.hpp"
#include "tests/timing/nlopt_solvers.hpp"
#include "tests/timing/solver.hpp"

namespace graben::timing {
namespace {

/// Of highest_lambda(): the first trust region.
constexpr double kFirstStep = 0.25;
/// Of lambda, absolutely: the last one.
constexpr double kLastStep = 1e-7;

struct Reduced {
  const LambdaProblem* problem = nullptr;
  LambdaProblem::Near near;
};

double objective(unsigned /*n*/, const double* x, double* /*gradient*/, void* /*data*/) {
  return -x[0];
}

double constraint(unsigned /*n*/, const double* x, double* /*gradient*/, void* data) {
  auto* reduced = static_cast<Reduced*>(data);
  return -reduced->problem->smallest_margin(x[0], reduced->near);
}

class Cobyla final : public LambdaSolver {
 public:
  Cobyla() : optimiser_(nlopt_create(NLOPT_LN_COBYLA, 1)) {
    nlopt_must(nlopt_set_min_objective(optimiser_.get(), objective, nullptr));
    nlopt_must(nlopt_add_inequality_constraint(optimiser_.get(), constraint, &reduced_,
                                               kNloptMarginTolerance));
    nlopt_must(nlopt_set_lower_bounds1(optimiser_.get(), 0.0));
    nlopt_must(nlopt_set_xtol_abs1(optimiser_.get(), kLastStep));
    nlopt_must(nlopt_set_maxeval(optimiser_.get(), kNloptMostEvaluations));
  }

  double solve(const McvMachine& machine, const McvInput& input) override {
    const LambdaProblem problem(machine, input);
    if (!problem.can_start()) {
      return 0.0;
    }
    reduced_ = {&problem, {}};
    const double highest = problem.highest_lambda();
    nlopt_must(nlopt_set_upper_bounds1(optimiser_.get(), highest));
    nlopt_must(nlopt_set_initial_step1(optimiser_.get(), kFirstStep * highest));
    return first_feasible(problem, [this](double start) {
      double lambda = start;
      double unused = 0.0;
      return nlopt_found(nlopt_optimize(optimiser_.get(), &lambda, &unused)) ? lambda : -1.0;
    });
  }

 private:
  NloptOptimiser optimiser_;
  Reduced reduced_;
};

}  // namespace

std::unique_ptr<LambdaSolver> make_cobyla(const McvMachine& /*machine*/, const McvInput& /*i*/) {
  return std::make_unique<Cobyla>();
}

}  // namespace graben::timing
