#include "firmware/mcv/descent.hpp"

namespace graben {

Start fed_start(const McvCircuit& circuit, double lambda_max, const Inset& inset) {
  Start start{lambda_max, {}};
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    const double fed = fed_lambda(circuit.line[j]);
    if (fed < start.lambda) {
      start = {inset(fed), {LimitKind::kPumpFlow, static_cast<std::uint8_t>(j)}};
    }
  }
  return start;
}

double lambda_at(const FlowBalance& line, double ratio) {
  const double y = inverse_lambda(line, stretch_right_of(line, ratio), ratio).value;
  return y > 0.0 ? 1.0 / y : 0.0;
}

Requirement requirement_of(const McvCircuit& circuit, const Limit& limit) {
  const CircuitAxis& axis = circuit.axis[limit.index];
  return limit.kind == LimitKind::kBackFlow ? no_back_flow(axis) : spool_travel(axis);
}

}  // namespace graben
