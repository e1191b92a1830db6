// SPDX-License-Identifier: Apache-2.0
#include "firmware/mcv/descent.hpp"

#include <algorithm>

#include "firmware/mcv/tuning.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben {
namespace {

/// Turns from one of an axis' two constraints to the other. [-; size: at the cap the caller's check
/// decides]
constexpr int kTurns = 8;
/// Halvings of an interval at most. [-; size: they leave 2^-30 of it]
constexpr int kHalvings = 30;

/// lambda at r; 0 where only standstill belongs to it.
double lambda_at(const FlowBalance& line, double ratio) {
  return 1.0 / inverse_lambda(line, stretch_right_of(line, ratio), ratio).value;
}

/// The requirement behind a limit of an axis.
Requirement requirement_of(const CircuitAxis& axis, const Limit& limit) {
  return limit.kind == LimitKind::kBackFlow ? no_back_flow(axis) : spool_travel(axis);
}

/// r of a stagnant line while its relief valve is closed, a little to the left of where 1 / lambda
/// jumps to infinity.
double stagnant_ratio(const FlowBalance& line) {
  return kStagnantInside * solve_pump_pressure(line, kStandstillLambda).sqrt_pressure /
         kStandstillLambda;
}

/// Past `ratio` of a stagnant line r stays what it is.
LambdaChange stagnant_change(const FlowBalance& line, const Requirement& requirement,
                             double lambda_max, double ratio, LambdaChange change) {
  change.lambda = std::min(lambda_max, lambda_at_fixed_ratio(requirement, ratio));
  if (line.has_relief) {
    change.lambda = std::min(change.lambda, line.sqrt_relief / ratio);
  }
  return change;
}

/// A feasible lambda that was found is one to follow, though a larger one may be; and where all
/// down to less than a first cycle's fails, it stands.
Halved ended_early(const McvPoint& fails, double infeasible, Halved found) {
  found.bounded = found.bounded && (found.point.lambda > 0.0 || infeasible < kFirstLambda);
  found.limit = fails.limit;
  return found;
}

}  // namespace

Start fed_start(const McvCircuit& circuit, double most, const Inset& inset) {
  Start start{most, {}};
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    const double fed = fed_lambda(circuit.line[j]);
    if (fed < start.lambda) {
      start = {inset(fed), {LimitKind::kPumpFlow, static_cast<std::uint8_t>(j)}};
    }
  }
  return start;
}

LambdaChange holds_again(const McvCircuit& circuit, const McvPoint& failing, double least,
                         Limit& limit) {
  const CircuitAxis& axis = circuit.axis[static_cast<unsigned>(failing.hardest_axis)];
  const FlowBalance& line = circuit.line[axis.pump];
  const bool stagnant = is_stagnant(line);
  double ratio = failing.sqrt_pressure[axis.pump] / failing.lambda;
  double end = kInfinity;
  if (stagnant) {
    end = std::max(ratio, stagnant_ratio(line));
  } else if (least > 0.0) {
    end = std::max(ratio, solve_pump_pressure(line, least).sqrt_pressure / least);
  }
  LambdaChange result;
  // The stricter of the two first; where it fails, the other need not be looked at on its own.
  const bool travel_first =
      axis.full_opening_force_n * failing.lambda * failing.lambda > axis.force_offset_n;
  const auto index = static_cast<std::uint8_t>(failing.hardest_axis);
  Limit next{travel_first ? LimitKind::kSpoolTravel : LimitKind::kBackFlow, index};
  limit = next;
  // From one constraint to the other until neither moves r; at the cap the caller's check decides.
  for (int turn = 0; turn < kTurns && result.bounded; ++turn) {
    if (!may_step(line.work)) {
      result.bounded = false;
      return result;
    }
    const Requirement requirement = requirement_of(axis, next);
    const Change change = first_change(requirement, line, Towards::kSlower, ratio, end);
    result.steps += change.steps;
    result.bounded = change.bounded;
    if (!change.found) {
      limit = next;
      result.ratio = stagnant || least <= 0.0 ? 0.0 : end;
      return stagnant ? stagnant_change(line, requirement, failing.lambda, end, result) : result;
    }
    if (change.ratio != ratio) {
      limit = next;
      ratio = change.ratio;
    } else if (turn > 0) {
      break;
    }
    next.kind = next.kind == LimitKind::kBackFlow ? LimitKind::kSpoolTravel : LimitKind::kBackFlow;
  }
  result.lambda = lambda_at(line, ratio);
  result.ratio = ratio;
  return result;
}

LambdaChange fails_first(const McvCircuit& circuit, const Limit& limit, const McvPoint& slow,
                         const McvPoint& fastest) {
  const CircuitAxis& axis = circuit.axis[limit.index];
  const FlowBalance& line = circuit.line[axis.pump];
  const Requirement requirement = requirement_of(axis, limit);
  const double from = slow.sqrt_pressure[axis.pump] / slow.lambda;
  const double end = fastest.sqrt_pressure[axis.pump] / fastest.lambda;
  const Change change =
      first_change(requirement, line, Towards::kFaster, from, std::min(from, end));
  return {change.found ? lambda_at(line, change.ratio) : kInfinity, change.steps, change.bounded};
}

bool is_any_starved(const McvCircuit& circuit) {
  bool starved = false;
  for (unsigned j = 0; j < circuit.pump_count; ++j) {
    starved = starved || is_starved(circuit.line[j]);
  }
  return starved;
}

Halved halved(const McvCircuit& circuit, const McvPoint& low, const McvPoint& high, double width) {
  Halved result;
  allow_kept(circuit.work);
  result.point = low;
  McvPoint fails = high;
  McvPoint near = high;
  double infeasible = high.lambda;
  for (int n = 0; n < kHalvings && infeasible - result.point.lambda > width; ++n) {
    if (!may_step(circuit.work)) {
      return ended_early(fails, infeasible, result);
    }
    const double middle = 0.5 * (result.point.lambda + infeasible);
    ++result.evaluations;
    if (still_fails(circuit, fails, middle, near)) {
      infeasible = middle;
      continue;
    }
    const McvPoint at = evaluate(circuit, middle, &near);
    if (!at.converged && circuit.work->left <= 0) {
      return ended_early(fails, infeasible, result);
    }
    near = at;
    result.bounded = result.bounded && near.converged;
    (near.feasible ? result.point : fails) = near;
    infeasible = near.feasible ? infeasible : middle;
  }
  if (infeasible < fails.lambda) {
    // All of it, for the constraint that comes first.
    const McvPoint at = evaluate(circuit, infeasible, &near);
    ++result.evaluations;
    if (!at.converged && circuit.work->left <= 0) {
      return ended_early(fails, infeasible, result);
    }
    fails = at;
    result.bounded = result.bounded && fails.converged;
  }
  result.limit = fails.limit;
  return result;
}

}  // namespace graben
