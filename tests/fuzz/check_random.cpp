// SPDX-License-Identifier: Apache-2.0
/// The policies on random valves against a plain circuit and a plain scan:
///   check_random [CASES [FIRST_SEED]]
/// For each case: what is returned must be feasible by the plain circuit, with the same pressures
/// and spools that do what they should; `global` may not be below any feasible point of a scan;
/// `connected` must have nothing infeasible under it that the scan sees, and something above it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "firmware/mcv/optimiser.hpp"
#include "tests/fuzz/plain_circuit.hpp"

namespace {

using namespace graben;
using test::plain_point;
using test::PlainPoint;
using test::RandomCase;

constexpr int kScanPoints = 400;
constexpr double kLambdaTolerance = 1e-6;
/// What rounding may make of a margin, as a share of the numbers it is the difference of.
constexpr double kMarginRounding = 1e-10;

struct Counts {
  long cases = 0;
  long wrong = 0;
  long held = 0;        ///< lambda between 0 and 1.
  long stopped = 0;     ///< lambda 0.
  long split = 0;       ///< global over connected.
  long local = 0;       ///< global over algorithm1.
  long unfinished = 0;  ///< A bounded search that did not end.
  int most_iterations = 0;
};

bool near(double actual, double wanted, double least_scale) {
  return std::abs(actual - wanted) <= 1e-6 * std::max(std::abs(wanted), least_scale);
}

/// Empty if the solution is what the plain circuit says it is.
std::string check_point(const RandomCase& problem, const McvSolution& solution) {
  if (solution.status == SolveStatus::kBadInput || solution.status == SolveStatus::kNotConverged) {
    return fmt::format("status {}", static_cast<int>(solution.status));
  }
  const double lambda = solution.point.lambda;
  if (!(lambda >= 0.0 && lambda <= 1.0)) {
    return "lambda out of range";
  }
  PlainPoint plain =
      lambda > 0.0 ? plain_point(problem.machine, problem.input, lambda) : PlainPoint{};
  if (!(plain.margin >= -kMarginRounding)) {
    return fmt::format("infeasible at {}: margin {}", lambda, plain.margin);
  }
  if (plain.margin < 0.0) {
    // By rounding alone; it has stopped there and says nothing of the rest.
    plain = plain_point(problem.machine, problem.input, lambda * (1.0 - kMarginRounding));
  }
  for (unsigned j = 0; lambda > 0.0 && j < kMaxPumps; ++j) {
    if (!near(solution.point.pump_pressure_pa[j], plain.pump_pressure_pa[j], 1e3)) {
      return fmt::format("pump {}: {} Pa for {}", j, solution.point.pump_pressure_pa[j],
                         plain.pump_pressure_pa[j]);
    }
  }
  for (unsigned i = 0; i < static_cast<unsigned>(problem.machine.actuator_count); ++i) {
    const double spool = solution.point.spool_m[i];
    const double velocity = problem.input.velocity_mps[i];
    if (lambda == 0.0 || velocity == 0.0) {
      if (spool != 0.0) {
        return fmt::format("spool {} is open at rest", i);
      }
      continue;
    }
    const McvActuator& actuator = problem.machine.actuator[i];
    const MonotoneTable& table = velocity > 0.0 ? actuator.extend : actuator.retract;
    if (!(spool * velocity > 0.0 && std::abs(spool) <= table.x_last())) {
      return fmt::format("spool {} at {}", i, spool);
    }
    // c_L goes with 1 / sqrt(force left over): where hardly any is left, rounding decides.
    const double slack = 1e-6 + kMarginRounding / std::max(plain.margin, kMarginRounding);
    const double opened = test::plain_coefficient(table, std::abs(spool));
    if (!(std::abs(opened - plain.coefficient[i]) <= slack * table.y_last())) {
      return fmt::format("spool {}: c_L {} for {}, margin {}", i, opened, plain.coefficient[i],
                         plain.margin);
    }
  }
  return "";
}

/// Highest point of the scan over `above` that the plain circuit finds feasible, or 0.
double scan_over(const RandomCase& problem, double above) {
  for (int n = kScanPoints; n > 0; --n) {
    const double lambda = static_cast<double>(n) / kScanPoints;
    if (lambda <= above) {
      break;
    }
    if (plain_point(problem.machine, problem.input, lambda).margin >= kMarginRounding) {
      return lambda;
    }
  }
  return 0.0;
}

std::string check_connected(const RandomCase& problem, double lambda) {
  for (int n = 1; n <= kScanPoints; ++n) {
    const double scanned = static_cast<double>(n) / kScanPoints;
    if (scanned > lambda - kLambdaTolerance) {
      break;
    }
    if (plain_point(problem.machine, problem.input, scanned).margin < -kMarginRounding) {
      return fmt::format("connected {} spans infeasible {}", lambda, scanned);
    }
  }
  // It must end where something fails, not short of it.
  const double above = lambda + kLambdaTolerance;
  if (above < 1.0 && lambda > kStandstillLambda &&
      plain_point(problem.machine, problem.input, above).margin > kMarginRounding) {
    // A gap narrower than the tolerance is still a gap.
    for (double step = 1e-9; step < kLambdaTolerance; step *= 2.0) {
      if (plain_point(problem.machine, problem.input, lambda + step).margin < kMarginRounding) {
        return "";
      }
    }
    return fmt::format("connected {} ends before anything fails", lambda);
  }
  return "";
}

void check_case(std::uint64_t seed, Counts& counts) {
  const RandomCase problem = test::random_case(seed);
  const McvSolution global = solve_mcv(problem.machine, problem.input, McvPolicy::kGlobal);
  const McvSolution connected = solve_mcv(problem.machine, problem.input, McvPolicy::kConnected);
  const McvSolution local = solve_mcv(problem.machine, problem.input, McvPolicy::kAlgorithm1);
  std::string found = check_point(problem, global);
  if (found.empty()) {
    found = check_point(problem, connected);
  }
  const double best = std::max(connected.point.lambda, local.point.lambda);
  if (found.empty() && global.point.lambda < best - kLambdaTolerance) {
    found = fmt::format("global {} is below another policy's {}", global.point.lambda, best);
  }
  const double scanned = scan_over(problem, global.point.lambda + kLambdaTolerance);
  if (found.empty() && scanned > 0.0) {
    found = fmt::format("global {} is below the scan's {}", global.point.lambda, scanned);
  }
  if (found.empty()) {
    found = check_connected(problem, connected.point.lambda);
  }
  ++counts.cases;
  counts.held += global.point.lambda > 0.0 && global.point.lambda < 1.0 ? 1 : 0;
  counts.stopped += global.point.lambda == 0.0 ? 1 : 0;
  counts.split += global.point.lambda > connected.point.lambda + kLambdaTolerance ? 1 : 0;
  counts.local += global.point.lambda > local.point.lambda + kLambdaTolerance ? 1 : 0;
  counts.unfinished +=
      global.status == SolveStatus::kNotConverged || connected.status == SolveStatus::kNotConverged
          ? 1
          : 0;
  counts.most_iterations =
      std::max({counts.most_iterations, global.iterations, connected.iterations});
  if (!found.empty()) {
    ++counts.wrong;
    fmt::print("seed {}: {}\n", seed, found);
  }
}

long argument(int argc, char** argv, int index, long otherwise) {
  return argc > index ? std::strtol(argv[index], nullptr, 10) : otherwise;
}

}  // namespace

int main(int argc, char** argv) {
  const long cases = argument(argc, argv, 1, 10000);
  const long first = argument(argc, argv, 2, 0);
  Counts counts;
  for (long n = 0; n < cases; ++n) {
    check_case(static_cast<std::uint64_t>(first + n), counts);
  }
  fmt::print(
      "{} cases: {} held by a limit, {} at lambda 0, {} with a gap under the global one, {} where "
      "algorithm1 stays below it, at most {} iterations, {} unfinished, {} wrong\n",
      counts.cases, counts.held, counts.stopped, counts.split, counts.local, counts.most_iterations,
      counts.unfinished, counts.wrong);
  // Cases that nothing holds, and none with a gap, would compare little.
  const bool telling = counts.held > cases / 4 && counts.split > cases / 1000;
  return counts.wrong == 0 && telling ? EXIT_SUCCESS : EXIT_FAILURE;
}
