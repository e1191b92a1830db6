// SPDX-License-Identifier: Apache-2.0
// record_solves SCRIPTS VECTORS CASES: writes the cases of the optimiser that the scripts name, and
// prints a line for each. `last` is the lambda of the cycle before. A script is a line, # a remark:
//
//   GROUP 22t v=0.1,0.2,-0.3 cap=1e6,2e6,3e6 rod=1e6,1e6,1e6 flow=2e-3,2e-3 last=0.7
//   GROUP vector 17       the 17th line of VECTORS (tests/vectors/mcv.jsonl)
//   GROUP random 4711     a valve of a seed: 1 to 6 spools on 1 to 3 pumps (tests/fuzz)

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/mcv_json.hpp"
#include "tests/fuzz/plain_circuit.hpp"
#include "tests/timing/counts/setups.hpp"
#include "tests/timing/counts/solve_case.hpp"

namespace {

using namespace graben;
using namespace graben::timing;

/// Up to 1 within a cycle, with nothing in reserve.
constexpr LambdaRise kFree = {1000.0, 0.0, 0.0};

std::vector<double> numbers_of(std::string words) {
  std::replace(words.begin(), words.end(), ',', ' ');
  std::istringstream stream(words);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;) {
    numbers.push_back(number);
  }
  return numbers;
}

template <class Array>
void fill(Array& array, const std::vector<double>& numbers) {
  std::copy_n(numbers.begin(), std::min(numbers.size(), array.size()), array.begin());
}

SolveCase valve_case(Setup setup, std::istringstream& words) {
  SolveCase one;
  const ExcavatorProfile& profile = excavator_setup(setup).profile;
  one.machine = mcv_machine(profile);
  one.rise = profile.control.lambda_rise;
  for (std::string word; words >> word;) {
    const std::size_t at = word.find('=');
    const std::string key = word.substr(0, at);
    const std::vector<double> numbers = numbers_of(word.substr(at + 1));
    if (numbers.empty()) {
      throw std::runtime_error("no number in " + word);
    }
    if (key == "v") {
      fill(one.input.velocity_mps, numbers);
    } else if (key == "cap") {
      fill(one.input.cap_pressure_pa, numbers);
    } else if (key == "rod") {
      fill(one.input.rod_pressure_pa, numbers);
    } else if (key == "flow") {
      fill(one.input.pump_flow_m3ps, numbers);
    } else if (key == "last") {
      one.last_lambda = numbers[0];
    } else {
      throw std::runtime_error("'" + word + "' is not known");
    }
  }
  return one;
}

SolveCase vector_case(const std::string& vectors, long line) {
  std::ifstream stream(vectors);
  std::string text;
  for (long n = 0; n < line && std::getline(stream, text); ++n) {
  }
  const cli::McvCase read = cli::parse_mcv_case(text);
  return {read.machine, read.input, kFree, 0.0};
}

SolveCase case_of(const std::string& line, const std::string& vectors) {
  std::istringstream words(line);
  std::string group;
  std::string kind;
  words >> group >> kind;
  if (kind == "22t" || kind == "12t") {
    return valve_case(kind == "22t" ? Setup::kExcavator22t : Setup::kExcavator12t, words);
  }
  long number = 0;
  if (!(words >> number) || (kind != "vector" && kind != "random")) {
    throw std::runtime_error("'" + line + "' is not known");
  }
  if (kind == "vector") {
    return vector_case(vectors, number);
  }
  const test::RandomCase drawn = test::random_case(static_cast<std::uint64_t>(number));
  return {drawn.machine, drawn.input, kFree, 0.0};
}

void record(const std::string& scripts, const std::string& vectors, const std::string& cases) {
  std::ifstream stream(scripts);
  std::FILE* const file = std::fopen(cases.c_str(), "wb");
  if (!stream || file == nullptr) {
    throw std::runtime_error("can't open " + scripts + " and " + cases);
  }
  std::string line;
  while (std::getline(stream, line)) {
    if (line.empty() || line[0] == '#') {
      continue;
    }
    if (!write(file, case_of(line, vectors))) {
      throw std::runtime_error("the cases can't be written");
    }
    fmt::print("1 {}\n", line);
  }
  if (std::fclose(file) != 0) {
    throw std::runtime_error("the cases can't be written");
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 4) {
    fmt::print(stderr, "record_solves SCRIPTS VECTORS CASES\n");
    return 2;
  }
  try {
    record(words[1], words[2], words[3]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "record_solves: {}\n", error.what());
    return 1;
  }
}
