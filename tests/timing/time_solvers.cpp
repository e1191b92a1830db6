// SPDX-License-Identifier: Apache-2.0
/// Times each solver on each reference case: time_solvers CASES [Google Benchmark's options]
///
/// A benchmark for each pair, named solver/line of the case, so that one can be looked at alone
/// (--benchmark_filter=global/17). Beside its time each tells what the solver returned, and by how
/// much the plain circuit of tests/fuzz likes that. bench.py runs this and makes the table.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tests/fuzz/plain_circuit.hpp"
#include "tests/timing/cases.hpp"
#include "tests/timing/solver.hpp"

namespace {

using namespace graben;
using namespace graben::timing;

/// Half the width of the look around what was returned.
constexpr double kAround = 1e-6;

/// One solver on one case. It lives as long as the program: repetitions use it again.
struct Pair {
  const TimedCase* timed = nullptr;
  std::unique_ptr<LambdaSolver> solver;
  benchmark::UserCounters found;
};

benchmark::UserCounters judge(const TimedCase& timed, double lambda) {
  const auto margin = [&timed](double at) {
    return test::plain_point(timed.machine, timed.input, std::clamp(at, 0.0, 1.0)).margin;
  };
  return {{"lambda", lambda},
          {"margin", margin(lambda)},
          {"margin_below", margin(lambda - kAround)},
          {"margin_above", margin(lambda + kAround)}};
}

void time_pair(benchmark::State& state, const Pair* pair) {
  const TimedCase& timed = *pair->timed;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(pair->solver->solve(timed.machine, timed.input));
  }
  state.counters = pair->found;
}

int run(const std::string& path) {
  const std::vector<TimedCase> cases = read_cases(path, 1);
  std::vector<std::unique_ptr<Pair>> pairs;
  for (const NamedSolver& solver : solvers()) {
    for (const TimedCase& timed : cases) {
      pairs.push_back(
          std::make_unique<Pair>(Pair{&timed, solver.make(timed.machine, timed.input), {}}));
      Pair* pair = pairs.back().get();
      pair->found = judge(timed, pair->solver->solve(timed.machine, timed.input));
      const std::string name = solver.name + "/" + std::to_string(timed.line);
      benchmark::RegisterBenchmark(name.c_str(), time_pair, pair);
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::AddCustomContext("compiler", "GCC " __VERSION__);
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fputs("time_solvers CASES [--benchmark_...]\n", stderr);
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "time_solvers: %s\n", error.what());
    return 1;
  }
}
