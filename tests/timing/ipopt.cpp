/// Ipopt, the usual interior-point method, with exact first and second derivatives.

#include <IpIpoptApplication.hpp>
#include <stdexcept>

#include "tests/timing/ipopt_problem.hpp"
#include "tests/timing/solver.hpp"

namespace graben::timing {
namespace {

class IpoptSolver final : public LambdaSolver {
 public:
  IpoptSolver(const McvMachine& machine, const McvInput& input) {
    Ipopt::OptionsList& options = *application_->Options();
    options.SetIntegerValue("print_level", 0);
    options.SetStringValue("sb", "yes");
    options.SetNumericValue("tol", 1e-8);
    if (const char* e = getenv("IP_OPTS")) {
      std::istringstream s(e); std::string k, v;
      while (s >> k >> v) { if (!options.SetStringValue(k, v)) { options.SetNumericValue(k, std::stod(v)) || options.SetIntegerValue(k, std::stoi(v)); } }
    }
    if (application_->Initialize("") != Ipopt::Solve_Succeeded) {
      throw std::runtime_error("Ipopt does not start");
    }
    const LambdaProblem problem(machine, input);
    if (problem.can_start()) {
      problem_->set(&problem);
      application_->OptimizeTNLP(problem_);
    }
  }

  double solve(const McvMachine& machine, const McvInput& input) override {
    const LambdaProblem problem(machine, input);
    if (!problem.can_start()) {
      return 0.0;
    }
    problem_->set(&problem);
    const auto status = getenv("NOREOPT")? application_->OptimizeTNLP(problem_) : application_->ReOptimizeTNLP(problem_);
    return status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level
               ? problem_->lambda()
               : 0.0;
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
