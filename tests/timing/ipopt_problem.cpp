// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/ipopt_problem.hpp"

#include <algorithm>

namespace graben::timing {
namespace {

using Ipopt::Index;
using Ipopt::Number;

/// Ipopt's value for "no bound".
constexpr Number kUnbounded = 2e19;

/// Two entries of the Jacobian, by lambda and by u.
Number* put(const Slope& slope, Number* values) {
  *values++ = slope.by_lambda;
  *values++ = slope.by_u;
  return values;
}

}  // namespace

bool IpoptProblem::get_nlp_info(Index& n, Index& m, Index& nonzeros_jacobian,
                                Index& nonzeros_hessian, IndexStyleEnum& style) {
  const auto lines = static_cast<Index>(problem_->line_count());
  const auto axes = static_cast<Index>(problem_->axis_count());
  n = 1 + lines;
  m = lines + 2 * axes;
  nonzeros_jacobian = 2 * m;
  nonzeros_hessian = 1 + 2 * lines;
  style = TNLP::C_STYLE;
  return true;
}

bool IpoptProblem::get_bounds_info(Index n, Number* x_low, Number* x_high, Index m, Number* g_low,
                                   Number* g_high) {
  const auto lines = static_cast<Index>(problem_->line_count());
  std::fill_n(x_low, n, 0.0);
  std::fill_n(x_high, n, 1.0);
  x_high[0] = problem_->highest_lambda();
  std::fill_n(g_low, m, 0.0);
  std::fill_n(g_high, lines, 0.0);
  std::fill_n(g_high + lines, m - lines, kUnbounded);
  return true;
}

bool IpoptProblem::get_starting_point(Index n, bool want_x, Number* x, bool /*want_z*/,
                                      Number* /*z_low*/, Number* /*z_high*/, Index /*m*/,
                                      bool /*want_multipliers*/, Number* /*multipliers*/) {
  if (want_x) {
    x[0] = start_lambda_;
    for (Index j = 1; j < n; ++j) {
      x[j] = problem_->solved_u(static_cast<unsigned>(j - 1), x[0]);
    }
  }
  return true;
}

bool IpoptProblem::eval_f(Index /*n*/, const Number* x, bool /*new_x*/, Number& value) {
  value = -x[0];
  return true;
}

bool IpoptProblem::eval_grad_f(Index n, const Number* /*x*/, bool /*new_x*/, Number* gradient) {
  std::fill_n(gradient, n, 0.0);
  gradient[0] = -1.0;
  return true;
}

bool IpoptProblem::eval_g(Index /*n*/, const Number* x, bool /*new_x*/, Index /*m*/, Number* g) {
  for (unsigned j = 0; j < problem_->line_count(); ++j) {
    *g++ = problem_->balance(j, x[0], x[1 + j]).value;
  }
  for (unsigned i = 0; i < problem_->axis_count(); ++i) {
    const AxisMargins at = problem_->margins(i, x[0], x[1 + problem_->line_of(i)]);
    *g++ = at.force.value;
    *g++ = at.travel.value;
  }
  return true;
}

bool IpoptProblem::eval_jac_g(Index /*n*/, const Number* x, bool /*new_x*/, Index m,
                              Index /*nonzeros*/, Index* rows, Index* columns, Number* values) {
  const unsigned lines = problem_->line_count();
  if (values == nullptr) {
    for (unsigned row = 0; row < static_cast<unsigned>(m); ++row) {
      const unsigned line = row < lines ? row : problem_->line_of((row - lines) / 2);
      rows[2 * row] = rows[2 * row + 1] = static_cast<Index>(row);
      columns[2 * row] = 0;
      columns[2 * row + 1] = static_cast<Index>(1 + line);
    }
    return true;
  }
  for (unsigned j = 0; j < lines; ++j) {
    values = put(problem_->balance(j, x[0], x[1 + j]), values);
  }
  for (unsigned i = 0; i < problem_->axis_count(); ++i) {
    const AxisMargins at = problem_->margins(i, x[0], x[1 + problem_->line_of(i)]);
    values = put(at.travel, put(at.force, values));
  }
  return true;
}

/// Lower triangle: (lambda, lambda), then (u_j, lambda) and (u_j, u_j) of each line.
bool IpoptProblem::eval_h(Index /*n*/, const Number* x, bool /*new_x*/, Number /*factor*/,
                          Index /*m*/, const Number* multipliers, bool /*new_multipliers*/,
                          Index nonzeros, Index* rows, Index* columns, Number* values) {
  const unsigned lines = problem_->line_count();
  if (values == nullptr) {
    rows[0] = columns[0] = 0;
    for (unsigned j = 0; j < lines; ++j) {
      rows[1 + 2 * j] = rows[2 + 2 * j] = static_cast<Index>(1 + j);
      columns[1 + 2 * j] = 0;
      columns[2 + 2 * j] = static_cast<Index>(1 + j);
    }
    return true;
  }
  std::fill_n(values, nonzeros, 0.0);
  const auto add = [values](const Curvature& curvature, unsigned line, double weight) {
    values[0] += weight * curvature.by_lambda_lambda;
    values[1 + 2 * line] += weight * curvature.by_lambda_u;
    values[2 + 2 * line] += weight * curvature.by_u_u;
  };
  for (unsigned j = 0; j < lines; ++j) {
    add(problem_->balance_curvature(j, x[0], x[1 + j]), j, multipliers[j]);
  }
  for (unsigned i = 0; i < problem_->axis_count(); ++i) {
    const unsigned line = problem_->line_of(i);
    const Number* weights = multipliers + lines + 2 * i;
    add(problem_->margins_curvature(i, x[0], x[1 + line], weights[0], weights[1]), line, 1.0);
  }
  return true;
}

void IpoptProblem::finalize_solution(Ipopt::SolverReturn /*status*/, Index /*n*/, const Number* x,
                                     const Number* /*z_low*/, const Number* /*z_high*/, Index /*m*/,
                                     const Number* /*g*/, const Number* /*multipliers*/,
                                     Number /*value*/, const Ipopt::IpoptData* /*data*/,
                                     Ipopt::IpoptCalculatedQuantities* /*quantities*/) {
  lambda_ = x[0];
}

}  // namespace graben::timing
