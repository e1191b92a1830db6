#pragma once
/// What graben-ecu is told on its command line.

#include <optional>
#include <string>
#include <vector>

namespace graben::ecu {

struct EcuOptions {
  std::vector<std::string> interfaces;  ///< CAN interfaces by name; all are heard, all are sent to.
  std::string profile;
  std::vector<std::string> tasks;  ///< Files or names, in the order of their numbers, from 0.
  std::string stats_file;          ///< Written on the way out; none if empty.
  bool real_time = true;
  int priority = 80;  ///< SCHED_FIFO.
  std::optional<int> cpu;
};

/// Reads the command line. Without a value when the process is to end at once, with `status`: 0
/// after --help or --version, 2 after wrong usage, which has been told.
[[nodiscard]] std::optional<EcuOptions> read_options(int argc, const char* const* argv,
                                                     int& status);

}  // namespace graben::ecu
