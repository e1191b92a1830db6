// SPDX-License-Identifier: Apache-2.0
// record_cycles SCRIPTS TRACES: plays each script (script.hpp; a line each, # for a remark) and
// writes what its controller saw of the bus, one trace after the other. Prints a line for each
// trace: how many cycles, and the script.

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/timing/counts/play.hpp"

namespace {

using namespace graben::timing;

void append(std::FILE* file, const Played& played) {
  bool written = write(file, played.start);
  for (const TraceCycle& cycle : played.cycles) {
    written = written && write(file, cycle);
  }
  if (!written) {
    throw std::runtime_error("the traces can't be written");
  }
}

void record(const std::string& scripts, const std::string& traces) {
  std::ifstream stream(scripts);
  std::FILE* const file = std::fopen(traces.c_str(), "wb");
  if (!stream || file == nullptr) {
    throw std::runtime_error("can't open " + scripts + " and " + traces);
  }
  std::string line;
  while (std::getline(stream, line)) {
    if (!line.empty() && line[0] != '#') {
      const Played played = play(parse_script(line));
      append(file, played);
      fmt::print("{} {}\n", played.cycles.size(), line);
    }
  }
  if (std::fclose(file) != 0) {
    throw std::runtime_error("the traces can't be written");
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    fmt::print(stderr, "record_cycles SCRIPTS TRACES\n");
    return 2;
  }
  try {
    record(words[1], words[2]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "record_cycles: {}\n", error.what());
    return 1;
  }
}
