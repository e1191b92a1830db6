// SPDX-License-Identifier: Apache-2.0
/// Our own three policies, as the controller calls them: with the checks of machine and input
/// before, and margins, limit and shortfall after, which no peer has to work out.

#include "tests/timing/solver.hpp"

namespace graben::timing {
namespace {

template <McvPolicy policy>
class OwnPolicy final : public LambdaSolver {
 public:
  double solve(const McvMachine& machine, const McvInput& input) override {
    return solve_mcv(machine, input, policy).point.lambda;
  }
};

}  // namespace

std::unique_ptr<LambdaSolver> make_global(const McvMachine& /*machine*/, const McvInput& /*i*/) {
  return std::make_unique<OwnPolicy<McvPolicy::kGlobal>>();
}

std::unique_ptr<LambdaSolver> make_connected(const McvMachine& /*machine*/, const McvInput& /*i*/) {
  return std::make_unique<OwnPolicy<McvPolicy::kConnected>>();
}

std::unique_ptr<LambdaSolver> make_algorithm1(const McvMachine& /*machine*/,
                                              const McvInput& /*i*/) {
  return std::make_unique<OwnPolicy<McvPolicy::kAlgorithm1>>();
}

}  // namespace graben::timing
