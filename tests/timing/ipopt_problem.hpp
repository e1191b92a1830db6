// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The optimisation in the form that Ipopt asks for. Unknowns: lambda, then u of each line.
/// Constraints: the balances, then force and travel of each axis.

#include <IpTNLP.hpp>

#include "tests/timing/lambda_problem.hpp"

namespace graben::timing {

class IpoptProblem final : public Ipopt::TNLP {
 public:
  /// What the next run solves and from where; of the same shape from run to run.
  void set(const LambdaProblem* problem, double start_lambda) {
    problem_ = problem;
    start_lambda_ = start_lambda;
  }
  /// The lambda of the last run.
  [[nodiscard]] double lambda() const { return lambda_; }

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& nonzeros_jacobian,
                    Ipopt::Index& nonzeros_hessian, IndexStyleEnum& style) override;
  bool get_bounds_info(Ipopt::Index n, Ipopt::Number* x_low, Ipopt::Number* x_high, Ipopt::Index m,
                       Ipopt::Number* g_low, Ipopt::Number* g_high) override;
  bool get_starting_point(Ipopt::Index n, bool want_x, Ipopt::Number* x, bool want_z,
                          Ipopt::Number* z_low, Ipopt::Number* z_high, Ipopt::Index m,
                          bool want_multipliers, Ipopt::Number* multipliers) override;
  bool eval_f(Ipopt::Index n, const Ipopt::Number* x, bool new_x, Ipopt::Number& value) override;
  bool eval_grad_f(Ipopt::Index n, const Ipopt::Number* x, bool new_x,
                   Ipopt::Number* gradient) override;
  bool eval_g(Ipopt::Index n, const Ipopt::Number* x, bool new_x, Ipopt::Index m,
              Ipopt::Number* g) override;
  bool eval_jac_g(Ipopt::Index n, const Ipopt::Number* x, bool new_x, Ipopt::Index m,
                  Ipopt::Index nonzeros, Ipopt::Index* rows, Ipopt::Index* columns,
                  Ipopt::Number* values) override;
  bool eval_h(Ipopt::Index n, const Ipopt::Number* x, bool new_x, Ipopt::Number factor,
              Ipopt::Index m, const Ipopt::Number* multipliers, bool new_multipliers,
              Ipopt::Index nonzeros, Ipopt::Index* rows, Ipopt::Index* columns,
              Ipopt::Number* values) override;
  void finalize_solution(Ipopt::SolverReturn status, Ipopt::Index n, const Ipopt::Number* x,
                         const Ipopt::Number* z_low, const Ipopt::Number* z_high, Ipopt::Index m,
                         const Ipopt::Number* g, const Ipopt::Number* multipliers,
                         Ipopt::Number value, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities* quantities) override;

 private:
  const LambdaProblem* problem_ = nullptr;
  double start_lambda_ = 0.0;
  double lambda_ = 0.0;
};

}  // namespace graben::timing
