#include "firmware/mcv/descent.hpp"

namespace graben {

PolicyResult choose_algorithm1(const Asked& asked) {
  PolicyResult result;
  const McvCircuit* circuit = &asked.at(asked.most);
  McvPoint low;
  McvPoint high = evaluate(*circuit, asked.most);
  result.bounded = high.converged;
  if (high.feasible) {
    result.point = high;
    return result;
  }
  if (asked.hold > 0.0 && asked.hold < asked.most) {
    const McvPoint held = evaluate(asked.holding(), asked.hold, &high);
    ++result.iterations;
    result.bounded = result.bounded && held.converged;
    circuit = held.feasible ? &asked.rising() : &asked.holding();
    (held.feasible ? low : high) = held;
  }
  // The last infeasible point lies one last step above the last feasible one (Theorem 4), so
  // `limit` is what fails just above, and `point` what the paper's final lines return.
  const Halved found = halved(*circuit, low, high, kAlgorithm1Width * asked.most);
  result.point = found.point;
  result.limit = found.limit;
  result.iterations += found.evaluations;
  result.bounded = result.bounded && found.bounded;
  return result;
}

}  // namespace graben
