#pragma once
/// Turns what a command throws into a message and an exit status.

#include <fmt/format.h>

#include <exception>

namespace graben::cli {

/// 0 if `work` returned, 1 with its message on standard error if it threw.
template <class Work>
int guarded(const char* command, Work work) {
  try {
    work();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "graben {}: {}\n", command, error.what());
    return 1;
  }
}

}  // namespace graben::cli
