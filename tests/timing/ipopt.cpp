// SPDX-License-Identifier: Apache-2.0
/// Ipopt, the usual interior-point method, with exact first and second derivatives. The linear
/// solver is MUMPS, the one that Debian's Ipopt has. About four tenths of the time go into
/// MUMPS 5.5 comparing strings in dmumps_save_restore_structure, on each of its calls; no option of
/// Ipopt's turns that off.

#include <IpIpoptApplication.hpp>
#include <stdexcept>

#include "tests/timing/ipopt_problem.hpp"
#include "tests/timing/local_starts.hpp"
#include "tests/timing/solver.hpp"

namespace graben::timing {
namespace {

void must(bool done) {
  if (!done) {
    throw std::runtime_error("Ipopt refuses an option or does not start");
  }
}

class IpoptSolver final : public LambdaSolver {
 public:
  IpoptSolver(const McvMachine& machine, const McvInput& input) {
    Ipopt::OptionsList& options = *application_->Options();
    must(options.SetIntegerValue("print_level", 0));
    must(options.SetStringValue("sb", "yes"));
    must(options.SetNumericValue("tol", 1e-8));
    // The start is near enough to skip the first barriers: 6.8 iterations instead of 8.6 (mean).
    must(options.SetNumericValue("mu_init", 1e-6));
    must(application_->Initialize("") == Ipopt::Solve_Succeeded);
    const LambdaProblem problem(machine, input);
    if (problem.can_start()) {
      problem_->set(&problem, kLocalStarts[0] * problem.highest_lambda());
      application_->OptimizeTNLP(problem_);
      // From here on what was learnt from the structure is kept; saves a tenth.
      must(options.SetStringValue("warm_start_same_structure", "yes"));
    }
  }

  double solve(const McvMachine& machine, const McvInput& input) override {
    const LambdaProblem problem(machine, input);
    if (!problem.can_start()) {
      return 0.0;
    }
    return first_feasible(problem, [&](double start) {
      problem_->set(&problem, start);
      const Ipopt::ApplicationReturnStatus status = application_->ReOptimizeTNLP(problem_);
      return status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level
                 ? problem_->lambda()
                 : -1.0;
    });
  }

 private:
  Ipopt::SmartPtr<IpoptProblem> problem_ = new IpoptProblem;
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application_ = new Ipopt::IpoptApplication(false);
};

}  // namespace

std::unique_ptr<LambdaSolver> make_ipopt(const McvMachine& machine, const McvInput& input) {
  return std::make_unique<IpoptSolver>(machine, input);
}

}  // namespace graben::timing
