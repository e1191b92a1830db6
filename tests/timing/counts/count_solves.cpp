// SPDX-License-Identifier: Apache-2.0
/// count_solves CASES [BURN]: lambda of each case as a controller's cycle asks for it, with the
/// policy that machines are shipped with; each a counted section, with BURN of about so many
/// instructions more. Prints a line for each: the status as SolveStatus counts, and lambda.

#include <cstdio>
#include <cstdlib>

#include "tests/timing/counts/section.hpp"
#include "tests/timing/counts/solve_case.hpp"

namespace {

using namespace graben;
using namespace graben::timing;

constexpr double kPeriod_s = 0.01;

/// Not on the stack: they are large, and bare metal has little.
SolveCase one;
McvSolution solution;

}  // namespace

int main(int count, char** words) {
  if (count < 2) {
    std::fputs("count_solves CASES [BURN]\n", stderr);
    return 2;
  }
  std::FILE* const file = std::fopen(words[1], "rb");
  if (file == nullptr) {
    std::fprintf(stderr, "count_solves: can't read %s\n", words[1]);
    return 1;
  }
  const auto wasted =
      count > 2 ? static_cast<std::uint32_t>(std::strtoul(words[2], nullptr, 10)) : 0U;
  while (read(file, one)) {
    graben_count_begin();
    solution = steady_lambda(one.machine, one.input, McvPolicy::kGlobal, one.rise, one.last_lambda,
                             kPeriod_s);
    burn(wasted);
    graben_count_end();
    std::printf("%d %.9f\n", static_cast<int>(solution.status), solution.point.lambda);
  }
  const bool whole = std::feof(file) != 0;
  std::fclose(file);
  return whole ? 0 : 1;
}
