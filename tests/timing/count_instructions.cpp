// SPDX-License-Identifier: Apache-2.0
/// One solve of each SOLVER on each STRIDE-th case, for Callgrind to count its instructions:
///   valgrind --tool=callgrind --collect-atstart=no --combine-dumps=yes
///     count_instructions CASES STRIDE SOLVER...
/// A part of the profile for each, "Client Request: solver/line of the case". bench.py runs this.

#include <valgrind/callgrind.h>

#include <charconv>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "tests/timing/cases.hpp"
#include "tests/timing/solver.hpp"

namespace {

using namespace graben::timing;

void count(const std::vector<TimedCase>& cases, const NamedSolver& named) {
  for (const TimedCase& timed : cases) {
    const auto solver = named.make(timed.machine, timed.input);
    const std::string name = named.name + "/" + std::to_string(timed.line);
    // As for the times, the solver has seen its problem before: memory is there, symbols are bound.
    static_cast<void>(solver->solve(timed.machine, timed.input));
    CALLGRIND_ZERO_STATS;
    CALLGRIND_TOGGLE_COLLECT;
    static_cast<void>(solver->solve(timed.machine, timed.input));
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_DUMP_STATS_AT(name.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  unsigned stride = 0;
  if (argc > 3) {
    std::from_chars(argv[2], argv[2] + std::strlen(argv[2]), stride);
  }
  if (stride == 0) {
    std::fputs("count_instructions CASES STRIDE SOLVER...\n", stderr);
    return 2;
  }
  try {
    const std::vector<TimedCase> cases = read_cases(argv[1], stride);
    for (int i = 3; i < argc; ++i) {
      count(cases, solver_named(argv[i]));
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "count_instructions: %s\n", error.what());
    return 1;
  }
}
