// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/optimiser.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/mcv/regulated.hpp"
#include "firmware/mcv/tuning.hpp"

namespace graben {
namespace {

/// With steps kept back for what comes after the choice.
PolicyResult choose_regulated(const Asked& asked, int kept) {
  Work& work = *asked.circuit.work;
  work.left -= kept;
  const PolicyResult chosen = choose_algorithm1(asked);
  work.left += kept;
  return chosen;
}

PolicyResult choose(const Asked& asked, McvPolicy policy) {
  if (policy == McvPolicy::kFixed) {
    return choose_fixed(asked.rising(), asked.most);
  }
  // What the searches over r stand on, a pressure that r alone gives, regulated pumps do not have.
  if (asked.circuit.regulated) {
    return choose_regulated(asked, kRegulatedToldSteps);
  }
  if (policy == McvPolicy::kAlgorithm1) {
    return choose_algorithm1(asked);
  }
  return policy == McvPolicy::kConnected ? choose_connected(asked) : choose_global(asked);
}

/// What the reserve adds to the load of each axis.
PerActuator<double> reserves_n(const McvCircuit& circuit, double reserve_n) {
  PerActuator<double> extra_n{};
  PerPump<double> standstill{};
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    standstill[j] = most_pressure(circuit.line[j], 0.0).sqrt_pressure;
  }
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    const double left_n =
        drive_force(axis, 0.0, standstill[axis.pump]).force_n - axis.force_offset_n;
    if (axis.moves && left_n > 0.0) {
      extra_n[i] = std::min(reserve_n, kMostReserveShare * left_n);
    }
  }
  return extra_n;
}

PerActuator<double> loads_n(const McvCircuit& circuit, const PerActuator<double>& extra_n,
                            double share) {
  PerActuator<double> loads{};
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    loads[i] = circuit.axis[i].load_force_n + share * extra_n[i];
  }
  return loads;
}

/// The choice for loads that are heavier by the reserve, and the circuit as it is at that lambda.
PolicyResult choose_with_reserve(McvCircuit& circuit, McvPolicy policy, const LambdaRange& range) {
  const PerActuator<double> plain_n = loads_n(circuit, {}, 0.0);
  if (!(range.reserve_n > 0.0) || policy == McvPolicy::kFixed) {
    return choose({circuit, plain_n, plain_n, range.most, 0.0}, policy);
  }
  const PerActuator<double> extra_n = reserves_n(circuit, range.reserve_n);
  const Asked asked{circuit, loads_n(circuit, extra_n, 1.0),
                    loads_n(circuit, extra_n, range.hold_share), range.most, range.hold};
  PolicyResult chosen = choose(asked, policy);
  asked.with_loads(plain_n);
  if (chosen.point.lambda > 0.0 && circuit.regulated) {
    // A lighter load is a lower line, at which another drive may fail: down to where none does.
    const PolicyResult plain =
        choose_regulated({circuit, plain_n, plain_n, chosen.point.lambda}, kBypassSteps);
    chosen.limit = plain.point.lambda < chosen.point.lambda ? plain.limit : chosen.limit;
    chosen.iterations += plain.iterations;
    chosen.bounded = chosen.bounded && plain.bounded;
    chosen.point = plain.point;
  } else if (chosen.point.lambda > 0.0) {
    reload(circuit, chosen.point);
    // Less load is never less feasible, but for rounding where the reserve is next to nothing.
    chosen.bounded = chosen.bounded && chosen.point.feasible;
  }
  return chosen;
}

/// What earlier solves of the cycle have left, shared between searching and halving as it is in
/// one.
Work work_after(int taken, const SolveSteps& steps) {
  const int left = std::clamp(steps.all() - taken, steps.least, steps.all());
  const int kept = left * steps.halving / steps.all();
  return {left - kept, kept};
}

McvCheck check(const McvMachine& machine, const McvInput& input, const LambdaRange& range) {
  McvCheck found = check_machine(machine);
  if (found.defect == McvDefect::kNone) {
    found = check_input(machine, input);
  }
  const bool sound = range.most > 0.0 && range.most <= 1.0 && range.reserve_n >= 0.0 &&
                     std::isfinite(range.reserve_n) && range.hold >= 0.0 && range.hold <= 1.0 &&
                     range.hold_share >= 0.0 && range.hold_share <= 1.0 && range.taken >= 0;
  return found.defect == McvDefect::kNone && !sound ? McvCheck{McvDefect::kLambdaRange, 0} : found;
}

double travel_for(const MonotoneTable& table, double coefficient) {
  if (coefficient <= table.y_last()) {
    return table.inverse(coefficient);
  }
  const int last = table.size() - 1;
  const double per_coefficient =
      (table.x(last) - table.x(last - 1)) / (table.y(last) - table.y(last - 1));
  const double over = std::min(coefficient, kShortfallMost * table.y_last()) - table.y_last();
  return std::min(table.x_last() + over * per_coefficient, kShortfallMost * table.x_last());
}

/// P -> 0 stands for a pump that can't feed its line at all.
double sqrt_pressure_or_zero(const FlowBalance& line, double lambda) {
  return most_pressure(line, lambda).sqrt_pressure;
}

double shortfall_at_full(const McvCircuit& circuit, const Limit& limit) {
  if (limit.kind == LimitKind::kNone) {
    return 0.0;
  }
  if (limit.kind == LimitKind::kPumpFlow) {
    return -feed_margin_m3ps(circuit.line[limit.index], 1.0);
  }
  const CircuitAxis& axis = circuit.axis[limit.index];
  const double force_n =
      std::min(axis.most_force_n,
               drive_force(axis, 1.0, sqrt_pressure_or_zero(circuit.line[axis.pump], 1.0)).force_n);
  return limit.kind == LimitKind::kBackFlow
             ? axis.force_offset_n - force_n
             : travel_for(*axis.spool, needed_coefficient(axis, 1.0, force_n)) -
                   axis.spool->x_last();
}

/// Margins of a feasible point.
McvMargins margins_of(const McvCircuit& circuit, const McvPoint& point) {
  McvMargins margins;
  margins.flow_m3ps = point.feed_margin_m3ps;
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (axis.moves) {
      margins.force_n[i] = point.drive_force_n[i] - axis.force_offset_n;
      margins.travel_m[i] = axis.spool->x_last() - std::abs(point.spool_m[i]);
    }
  }
  return margins;
}

/// (43), with the pressures that lambda -> 0 leaves.
void look_at_standstill(const McvCircuit& circuit, McvSolution& solution) {
  PerPump<double> sqrt_pressure{};
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    sqrt_pressure[j] = sqrt_pressure_or_zero(circuit.line[j], 0.0);
    solution.margins.flow_m3ps[j] = circuit.line[j].flow_m3ps;
  }
  for (unsigned i = 0; i < circuit.axis_count; ++i) {
    const CircuitAxis& axis = circuit.axis[i];
    if (!axis.moves) {
      continue;
    }
    const double left_n =
        drive_force(axis, 0.0, sqrt_pressure[axis.pump]).force_n - axis.force_offset_n;
    solution.margins.force_n[i] = left_n;
    solution.margins.travel_m[i] = axis.spool->x_last();
    // (43) asks for more than equality: at equality the first movement already lacks force.
    if (!(left_n > 0.0) &&
        (solution.standstill.can_start || -left_n > solution.standstill.short_n)) {
      solution.standstill = {false, static_cast<std::uint8_t>(i), -left_n};
    }
  }
}

bool finite(const McvSolution& solution) {
  double sum = solution.point.lambda + solution.shortfall + solution.standstill.short_n;
  const auto add = [&sum](const auto& values) {
    for (const double value : values) {
      sum += value;
    }
  };
  add(solution.point.pump_pressure_pa);
  add(solution.point.sqrt_pressure);
  add(solution.point.feed_margin_m3ps);
  add(solution.point.out_pressure_pa);
  add(solution.point.drive_force_n);
  add(solution.point.spool_m);
  add(solution.point.yield_mpsn);
  add(solution.margins.flow_m3ps);
  add(solution.margins.force_n);
  add(solution.margins.travel_m);
  return std::isfinite(sum);
}

/// lambda 0 with nothing but how it came to it. In place and not inlined: a second solution would
/// stand in the caller's frame, under the deepest chain of calls.
[[gnu::noinline]] void give_up(int iterations, int steps, McvSolution& solution) {
  solution = McvSolution{};
  solution.steps = steps;
  solution.status = SolveStatus::kNotConverged;
  solution.iterations = iterations;
}

}  // namespace

SolveSteps solve_steps(const McvMachine& machine, McvPolicy policy) {
  bool small = policy == McvPolicy::kGlobal && machine.actuator_count <= kSmallActuators &&
               machine.pump_count <= kSmallPumps;
  for (unsigned j = 0; j < static_cast<unsigned>(machine.pump_count); ++j) {
    small = small && !machine.pump[j].regulator.sets_swash();
  }
  return small ? SolveSteps{kSmallSearchSteps, kSmallHalvingSteps, kSmallLeastSteps}
               : SolveSteps{kSearchSteps, kHalvingSteps, kLeastSteps};
}

McvSolution solve_mcv(const McvMachine& machine, const McvInput& input, McvPolicy policy,
                      const LambdaRange& range) {
  McvSolution solution;
  solution.defect = check(machine, input, range);
  if (solution.defect.defect != McvDefect::kNone) {
    return solution;
  }
  Work work = work_after(range.taken, solve_steps(machine, policy));
  const int given = work.left + work.kept;
  McvCircuit circuit = make_circuit(machine, input, &work);
  const PolicyResult chosen = choose_with_reserve(circuit, policy, range);
  allow_kept(&work);  // For what is told of the choice.
  if (!chosen.bounded) {
    give_up(chosen.iterations, given - work.left, solution);
    return solution;
  }
  solution.status = SolveStatus::kOk;
  solution.point = chosen.point;
  solution.limit = chosen.limit;
  solution.shortfall = shortfall_at_full(circuit, chosen.limit);
  solution.iterations = chosen.iterations;
  if (solution.point.lambda > 0.0) {
    open_spools(circuit, solution.point);
    solution.margins = margins_of(circuit, solution.point);
  } else {
    look_at_standstill(circuit, solution);
    solution.status = solution.standstill.can_start ? SolveStatus::kOk : SolveStatus::kInfeasible;
  }
  solution.steps = given - work.left - work.kept;
  // Numbers that no machine has, though each is in its range, can still end outside of all ranges.
  if (work.is_spent() || !finite(solution)) {
    give_up(chosen.iterations, solution.steps, solution);
  }
  return solution;
}

McvInput mcv_input(Span<const double> velocity_mps, Span<const LoadState> load,
                   Span<const double> pump_flow_m3ps) {
  McvInput input;
  for (int i = 0; i < load.count(); ++i) {
    const auto k = static_cast<unsigned>(i);
    input.velocity_mps[k] = velocity_mps[i];
    input.cap_pressure_pa[k] = load[i].cap_pa;
    input.rod_pressure_pa[k] = load[i].rod_pa;
  }
  for (int j = 0; j < pump_flow_m3ps.count(); ++j) {
    input.pump_flow_m3ps[static_cast<unsigned>(j)] = pump_flow_m3ps[j];
  }
  return input;
}

McvSolution steady_lambda(const McvMachine& machine, const McvInput& input, McvPolicy policy,
                          const LambdaRise& rise, double last_lambda, double period_s) {
  const double bound = std::clamp(last_lambda + rise.rate_ps * period_s, kFirstLambda, 1.0);
  const double hold = last_lambda > 0.0 ? std::clamp(last_lambda, kFirstLambda, 1.0) : 0.0;
  return solve_mcv(machine, input, policy,
                   {std::max(bound, hold), rise.reserve_n, hold, rise.hold_share});
}

}  // namespace graben
