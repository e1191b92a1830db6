// SPDX-License-Identifier: Apache-2.0
#include "tests/timing/cases.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "app/cli/mcv_json.hpp"

namespace graben::timing {

std::vector<TimedCase> read_cases(const std::string& path, unsigned stride) {
  std::ifstream stream(path);
  if (!stream) {
    throw std::runtime_error("can't read " + path);
  }
  std::vector<TimedCase> cases;
  std::string text;
  for (unsigned line = 1; std::getline(stream, text); ++line) {
    if ((line - 1) % stride != 0) {
      continue;
    }
    try {
      const cli::McvCase read = cli::parse_mcv_case(text);
      cases.push_back({line, read.machine, read.input});
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", path, line, error.what()));
    }
  }
  return cases;
}

}  // namespace graben::timing
