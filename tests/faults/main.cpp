// SPDX-License-Identifier: Apache-2.0
// fault_cases [--machine excavator|dozer] [--seeds N] [--row R] [--first-seed S] | --list: every
// row of the faults that a controller survives, of one machine kind or of both, tried with N seeds
// in simulated time; a table for each, and exit 1 with the reasons if any differs from what is
// expected.

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <string>

#include "tests/faults/results.hpp"

namespace {

using namespace graben::faults;

struct Options {
  std::uint64_t seeds = 20;
  std::uint64_t first_seed = 1;
  int row = 0;  ///< 0: all.
  bool excavator = true;
  bool dozer = true;
};

bool read(int count, char** words, Options& options) {
  for (int i = 1; i < count; i += 2) {
    const std::string name = words[i];
    if (i + 1 == count) {
      return false;
    }
    if (name == "--machine") {
      options.excavator = std::strcmp(words[i + 1], "excavator") == 0;
      options.dozer = std::strcmp(words[i + 1], "dozer") == 0;
      if (!options.excavator && !options.dozer) {
        return false;
      }
      continue;
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

template <class Kind>
Outcome tried(const Row<Kind>& row, std::uint64_t seed) {
  Trial<Kind> trial(seed, row.number);
  try {
    row.run(trial);
  } catch (const std::exception& error) {
    trial.check(false, error.what());
  }
  return trial.outcome;
}

template <class Kind>
bool run(const Options& options) {
  std::vector<RowResult> results;
  for (const Row<Kind>& row : all_rows<Kind>()) {
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
  return all_right;
}

/// Every row that any kind has, a line each.
int list_rows() {
  std::map<int, std::string> rows;
  for (const RowText& row : all_rows<Excavator>()) {
    rows.emplace(row.number, row.fault);
  }
  for (const RowText& row : all_rows<Dozer>()) {
    rows.emplace(row.number, row.fault);
  }
  for (const auto& [number, fault] : rows) {
    fmt::print("{} {}\n", number, fault);
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** words) {
  if (count == 2 && std::strcmp(words[1], "--list") == 0) {
    return list_rows();
  }
  Options options;
  if (!read(count, words, options)) {
    fmt::print(stderr,
               "usage: fault_cases [--machine excavator|dozer] [--seeds N] [--row R] "
               "[--first-seed S]\n");
    return EXIT_FAILURE;
  }
  try {
    const bool excavator = !options.excavator || run<Excavator>(options);
    const bool dozer = !options.dozer || run<Dozer>(options);
    return excavator && dozer ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    fmt::print(stderr, "fault_cases: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
