// fault_cases [--seeds N] [--row R] [--first-seed S]: every row of the faults that the controller
// survives, tried with N seeds in simulated time; one table, and exit 1 with the reasons if any
// differs from what is expected.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <string>

#include "tests/faults/results.hpp"

namespace {

using namespace graben::faults;

struct Options {
  std::uint64_t seeds = 20;
  std::uint64_t first_seed = 1;
  int row = 0;  ///< 0: all.
};

bool read(int count, char** words, Options& options) {
  for (int i = 1; i < count; i += 2) {
    const std::string name = words[i];
    if (i + 1 == count) {
      return false;
    }
    char* end = nullptr;
    const std::uint64_t value = std::strtoull(words[i + 1], &end, 10);
    if (*end != '\0' || end == words[i + 1]) {
      return false;
    }
    if (name == "--seeds") {
      options.seeds = value;
    } else if (name == "--first-seed") {
      options.first_seed = value;
    } else if (name == "--row") {
      options.row = static_cast<int>(value);
    } else {
      return false;
    }
  }
  return true;
}

Rows all_rows() {
  Rows rows;
  for (const Rows& some : {silence_rows(), message_rows(), format_rows(), bus_rows(),
                           machine_rows(), process_rows()}) {
    rows.insert(rows.end(), some.begin(), some.end());
  }
  std::sort(rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return a.number < b.number; });
  return rows;
}

Outcome tried(const Row& row, std::uint64_t seed) {
  Trial trial(seed, row.number);
  try {
    row.run(trial);
  } catch (const std::exception& error) {
    trial.check(false, error.what());
  }
  return trial.outcome;
}

int run(const Options& options) {
  std::vector<RowResult> results;
  for (const Row& row : all_rows()) {
    if (options.row != 0 && options.row != row.number) {
      continue;
    }
    RowResult result(row);
    for (std::uint64_t n = 0; n < options.seeds && row.run != nullptr; ++n) {
      result.add(options.first_seed + n, tried(row, options.first_seed + n));
    }
    results.push_back(result);
  }
  print_table(results);
  bool all_right = !results.empty();
  for (const RowResult& result : results) {
    for (const std::string& failure : result.failures()) {
      fmt::print("FAILED {}\n", failure);
      all_right = false;
    }
  }
  return all_right ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int count, char** words) {
  Options options;
  if (!read(count, words, options)) {
    fmt::print(stderr, "usage: fault_cases [--seeds N] [--row R] [--first-seed S]\n");
    return EXIT_FAILURE;
  }
  try {
    return run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "fault_cases: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
