#include "tests/timing/cases.hpp"

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
  std::string line;
  for (unsigned number = 0; std::getline(stream, line); ++number) {
    if (number % stride == 0) {
      const cli::McvCase read = cli::parse_mcv_case(line);
      cases.push_back({read.id.get<std::string>(), read.machine, read.input});
    }
  }
  if (cases.empty()) {
    throw std::runtime_error("no cases in " + path);
  }
  return cases;
}

}  // namespace graben::timing
