// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/mcv/evaluation.hpp"
#include "firmware/mcv/requirement.hpp"
#include "tests/fuzz/endless_work.hpp"
#include "tests/fuzz/plain_circuit.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/rounds.hpp"

constexpr int kCases = test::rounds(400, 100);

/// Calls `use(circuit)` for random valves.
template <class Use>
void for_random_circuits(Use use) {
  for (std::uint64_t seed = 0; seed < kCases; ++seed) {
    const test::RandomCase problem = test::random_case(seed);
    use(make_circuit(problem.machine, problem.input, test::endless_work()));
  }
}

/// r at lambda by the flow balance; below 0 where the pump can't feed its line.
double ratio_at(const FlowBalance& line, double lambda) {
  const PumpPressure solved = solve_pump_pressure(line, lambda);
  return solved.fed && solved.converged ? solved.sqrt_pressure / lambda : -1.0;
}

/// What the balance gives over lambda, 1 / lambda over r gives back.
TEST(lambda_to_r_and_back) {
  int compared = 0;
  for_random_circuits([&](const McvCircuit& circuit) {
    for (unsigned j = 0; j < circuit.pump_count; ++j) {
      const FlowBalance& line = circuit.line[j];
      for (int n = 1; n <= 50 && line.ratio_flow_m3ps > 0.0; ++n) {
        const double lambda = n / 50.0;
        const double ratio = ratio_at(line, lambda);
        // Held at the relief valve, or at 0, r says nothing but 1 / lambda too.
        if (ratio > 0.0) {
          const double y = inverse_lambda(line, stretch_left_of(line, ratio), ratio).value;
          assert_near(y * lambda, 1.0, 1e-9);
          ++compared;
        }
      }
    }
  });
  assert_true(compared > 25 * kCases);
}

/// Fact 1 and 2 of pressure_ratio.hpp: y rises with r, and between two openings it bends upwards;
/// its slope is that of the difference quotient.
TEST(inverse_lambda_rises_and_is_convex) {
  int compared = 0;
  for_random_circuits([&](const McvCircuit& circuit) {
    for (unsigned j = 0; j < circuit.pump_count; ++j) {
      const FlowBalance& line = circuit.line[j];
      if (line.ratio_flow_m3ps == 0.0) {
        continue;
      }
      Stretch stretch = stretch_right_of(line, 0.0);
      for (int n = 0; n <= line.regeneration_count; ++n) {
        const double high = std::min(stretch.high, 2.0 * stretch.low + 1e5);
        const auto y = [&](double share) {
          return inverse_lambda(line, stretch, stretch.low + share * (high - stretch.low));
        };
        for (double at = 0.1; at < 0.85; at += 0.1) {
          const double left = y(at - 0.05).value;
          const double middle = y(at).value;
          const double right = y(at + 0.05).value;
          const double rounding = 1e-12 * right;
          assert_true(left <= middle + rounding && middle <= right + rounding);
          assert_true(2.0 * middle <= left + right + rounding);
          const double step = 0.05 * (high - stretch.low);
          assert_true(y(at).slope >= (middle - left - rounding) / step - 1e-9);
          assert_true(y(at).slope <= (right - middle + rounding) / step + 1e-9);
          ++compared;
        }
        if (!(stretch.high < 1e9)) {
          break;
        }
        stretch = stretch_right_of(line, stretch.high);
      }
    }
  });
  assert_true(compared > 12 * kCases);
}

/// The requirement's own words, from the evaluation: whether it holds at lambda.
bool holds(const CircuitAxis& axis, bool travel, double lambda, double ratio) {
  const double force_n = drive_force(axis, lambda, lambda * ratio).force_n;
  return travel ? force_n >= lambda * lambda * axis.full_opening_force_n
                : force_n >= axis.force_offset_n;
}

struct Counted {
  int found = 0;
  int none = 0;
};

/// first_change against looking at 300 points on the way: between start and change nothing may be
/// other than at the start, and past it it is.
void check_first_change(const CircuitAxis& axis, const FlowBalance& line, bool travel,
                        Counted& counted) {
  const Requirement requirement = travel ? spool_travel(axis) : no_back_flow(axis);
  const double fastest = std::min(1.0, fed_lambda(line) * (1.0 - 1e-9));
  const double from_lambda[] = {fastest, kStandstillLambda};
  for (const Towards towards : {Towards::kSlower, Towards::kFaster}) {
    const bool slower = towards == Towards::kSlower;
    const double start = from_lambda[slower ? 0 : 1];
    const double stop = from_lambda[slower ? 1 : 0];
    const double from = ratio_at(line, start);
    const double end = ratio_at(line, stop);
    // kSlower starts where it fails, kFaster where it holds.
    if (from < 0.0 || end < 0.0 || holds(axis, travel, start, from) == slower) {
      continue;
    }
    const Change change = first_change(requirement, line, towards, from, end);
    assert_true(change.bounded);
    ++(change.found ? counted.found : counted.none);
    const double reached =
        change.found
            ? 1.0 / inverse_lambda(line, stretch_right_of(line, change.ratio), change.ratio).value
            : stop;
    for (int n = 1; n < 300; ++n) {
      // Geometric: changes sit at small lambdas as well.
      const double lambda = start * std::pow(reached / start, n / 300.0);
      const double inside = slower ? lambda * (1.0 + 1e-6) : lambda * (1.0 - 1e-6);
      if ((slower && inside < start) || (!slower && inside > start)) {
        assert_int_equal(holds(axis, travel, inside, ratio_at(line, inside)), !slower);
      }
    }
    if (change.found) {
      const double past = slower ? reached * (1.0 - 1e-6) : reached * (1.0 + 1e-6);
      const double ratio = ratio_at(line, past);
      if (ratio >= 0.0 && past <= 1.0) {
        assert_int_equal(holds(axis, travel, past, ratio), slower);
      }
    }
  }
}

TEST(first_change_is_the_first, Counted counted) {
  for_random_circuits([&](const McvCircuit& circuit) {
    for (unsigned i = 0; i < circuit.axis_count; ++i) {
      const CircuitAxis& axis = circuit.axis[i];
      if (axis.moves && !is_starved(circuit.line[axis.pump]) &&
          !is_stagnant(circuit.line[axis.pump])) {
        check_first_change(axis, circuit.line[axis.pump], false, counted);
        check_first_change(axis, circuit.line[axis.pump], true, counted);
      }
    }
  });
  print_message("%d changes, %d ways without\n", counted.found, counted.none);
  assert_true(counted.found > kCases && counted.none > kCases);
}
