// SPDX-License-Identifier: Apache-2.0
// lie_cases: a lie of a sensor tried with many seeds, a line each and one of all as JSON.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <exception>

#include "tests/lies/lie_case.hpp"

namespace {

using graben::lies::LieCase;
using graben::lies::LieOutcome;

double middle(std::vector<double> of) {
  std::sort(of.begin(), of.end());
  return of.empty() ? -1.0 : of[of.size() / 2];
}

void print_summary(const std::vector<LieOutcome>& outcomes) {
  std::vector<double> seen_s;
  std::vector<double> off;
  int works = 0;
  for (const LieOutcome& outcome : outcomes) {
    if (!outcome.works) {
      continue;  // What had stopped by itself before says nothing of the lie.
    }
    ++works;
    off.push_back(outcome.off);
    if (outcome.seen_s >= 0.0) {
      seen_s.push_back(outcome.seen_s);
    }
  }
  const double last_s = seen_s.empty() ? -1.0 : *std::max_element(seen_s.begin(), seen_s.end());
  fmt::print(
      "{{\"tried\": {}, \"worked\": {}, \"seen\": {}, \"seen_s\": [{:.2f}, {:.2f}], \"off\": "
      "[{:.3f}, {:.3f}]}}\n",
      outcomes.size(), works, seen_s.size(), middle(seen_s), last_s, middle(off),
      off.empty() ? -1.0 : *std::max_element(off.begin(), off.end()));
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("A lie of a sensor, tried with many seeds in simulated time.");
  LieCase lie;
  std::uint64_t seeds = 20;
  std::uint64_t first = 1;
  bool each = false;
  app.add_option("--machine", lie.machine, "whose: 22t with another bus are retrofit and zx200")
      ->required()
      ->check(CLI::IsMember(graben::lies::machines()));
  app.add_option("--fault", lie.faults, "NAME or NAME=VALUE, as `graben plant --fault` has them");
  app.add_option("--speed", lie.speed_ratio, "the operator's share of full speed")
      ->check(CLI::Range(0.05, 1.0));
  app.add_flag("--soil", lie.soil, "in soil");
  app.add_flag("--second", lie.seconds, "with second sensors on every joint");
  app.add_flag("--from-start", lie.from_start, "from power-on");
  app.add_option("--for", lie.looked_s, "so long it may go on, s")->check(CLI::Range(1.0, 600.0));
  app.add_option("--seeds", seeds, "how many")->check(CLI::Range(1, 100000));
  app.add_option("--first-seed", first, "the first");
  app.add_flag("--each", each, "a line each");
  CLI11_PARSE(app, count, words);
  try {
    std::vector<LieOutcome> outcomes;
    for (std::uint64_t n = 0; n < seeds; ++n) {
      outcomes.push_back(graben::lies::tried(lie, first + n));
      if (each) {
        const LieOutcome& now = outcomes.back();
        fmt::print("{:3} {:6.2f} s {:.3f} {}{}\n", first + n, now.seen_s, now.off, now.fault,
                   now.works ? "" : " (did not work before)");
      }
    }
    print_summary(outcomes);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "lie_cases: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
