// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What is measured: everything from a machine and one cycle's input to lambda, by one solver.

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "firmware/mcv/optimiser.hpp"

namespace graben::timing {

/// Made for the shape of one case (which actuators move). A controller would keep it from cycle to
/// cycle, so making it is not measured; whatever depends on numbers is done in solve().
class LambdaSolver {
 public:
  LambdaSolver() = default;
  LambdaSolver(const LambdaSolver&) = delete;
  LambdaSolver& operator=(const LambdaSolver&) = delete;
  virtual ~LambdaSolver() = default;

  /// The lambda it returns, uncorrected; 0 where it says itself that it failed.
  [[nodiscard]] virtual double solve(const McvMachine& machine, const McvInput& input) = 0;
};

using MakeSolver = std::unique_ptr<LambdaSolver> (*)(const McvMachine& machine,
                                                     const McvInput& input);

std::unique_ptr<LambdaSolver> make_global(const McvMachine& machine, const McvInput& input);
std::unique_ptr<LambdaSolver> make_connected(const McvMachine& machine, const McvInput& input);
std::unique_ptr<LambdaSolver> make_algorithm1(const McvMachine& machine, const McvInput& input);
std::unique_ptr<LambdaSolver> make_toms748(const McvMachine& machine, const McvInput& input);
std::unique_ptr<LambdaSolver> make_toms748_force(const McvMachine& machine, const McvInput& input);
std::unique_ptr<LambdaSolver> make_cobyla(const McvMachine& machine, const McvInput& input);
std::unique_ptr<LambdaSolver> make_slsqp(const McvMachine& machine, const McvInput& input);
std::unique_ptr<LambdaSolver> make_ipopt(const McvMachine& machine, const McvInput& input);

struct NamedSolver {
  std::string name;
  MakeSolver make;
};
/// In the order of the table; our default first, which the others are compared with.
[[nodiscard]] inline std::vector<NamedSolver> solvers() {
  return {{"global", make_global},
          {"connected", make_connected},
          {"algorithm1", make_algorithm1},
          {"boost_toms748", make_toms748},
          {"boost_toms748_force", make_toms748_force},
          {"nlopt_cobyla", make_cobyla},
          {"nlopt_slsqp", make_slsqp},
          {"ipopt", make_ipopt}};
}

/// Throws std::runtime_error where there is none of that name.
[[nodiscard]] inline NamedSolver solver_named(const std::string& name) {
  for (const NamedSolver& solver : solvers()) {
    if (solver.name == name) {
      return solver;
    }
  }
  throw std::runtime_error("no solver " + name);
}

}  // namespace graben::timing
