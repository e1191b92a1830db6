/// NLopt's COBYLA over lambda alone: derivative-free, the pressures solved inside by the core. With
/// them as unknowns and equality constraints COBYLA needs hundreds of evaluations.

#include "tests/timing/lambda_problem.hpp"
#include "tests/timing/nlopt_solvers.hpp"
#include "tests/timing/solver.hpp"

namespace graben::timing {
namespace {

constexpr double kFirstStep = 0.25;
/// Of the first step: the last trust region.
constexpr double kLastStep = 2e-8;
constexpr int kMostEvaluations = 500;

double objective(unsigned /*n*/, const double* x, double* /*gradient*/, void* /*data*/) {
  return -x[0];
}

void constraints(unsigned count, double* result, unsigned /*n*/, const double* x,
                 double* /*gradient*/, void* data) {
  const auto* problem = *static_cast<const LambdaProblem* const*>(data);
  problem->solved_margins(x[0], result);
  for (unsigned i = 0; i < count; ++i) {
    result[i] = -result[i];
  }
}

class Cobyla final : public LambdaSolver {
 public:
  Cobyla(const McvMachine& machine, const McvInput& input)
      : optimiser_(nlopt_create(NLOPT_LN_COBYLA, 1)) {
    const LambdaProblem shape(machine, input);
    nlopt_must(nlopt_set_min_objective(optimiser_.get(), objective, nullptr));
    nlopt_must(nlopt_add_inequality_mconstraint(optimiser_.get(), 2 * shape.axis_count(),
                                                constraints, &problem_, nullptr));
    nlopt_must(nlopt_set_lower_bounds1(optimiser_.get(), 0.0));
    nlopt_must(nlopt_set_xtol_rel(optimiser_.get(), kLastStep));
    nlopt_must(nlopt_set_maxeval(optimiser_.get(), kMostEvaluations));
  }

  double solve(const McvMachine& machine, const McvInput& input) override {
    const LambdaProblem problem(machine, input);
    if (!problem.can_start()) {
      return 0.0;
    }
    problem_ = &problem;
    double lambda = problem.highest_lambda();
    double unused = 0.0;
    nlopt_must(nlopt_set_upper_bounds1(optimiser_.get(), lambda));
    nlopt_must(nlopt_set_initial_step1(optimiser_.get(), kFirstStep * lambda));
    return nlopt_optimize(optimiser_.get(), &lambda, &unused) > 0 ? lambda : 0.0;
  }

 private:
  NloptOptimiser optimiser_;
  const LambdaProblem* problem_ = nullptr;
};

}  // namespace

std::unique_ptr<LambdaSolver> make_cobyla(const McvMachine& machine, const McvInput& input) {
  return std::make_unique<Cobyla>(machine, input);
}

}  // namespace graben::timing
