// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A program that runs beside this one, with pipes to and from it.

#include <sys/types.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace graben::cli {

class ChildProcess {
 public:
  /// What the child's descriptor is a pipe for; others but standard error are closed to it.
  enum class Way { kChildReads, kChildWrites };

  /// Standard error goes to `log`, standard input is empty unless told. Throws std::runtime_error
  /// where the program cannot be started.
  ChildProcess(const std::vector<std::string>& words, const std::map<int, Way>& pipes,
               const std::string& log);
  /// Ends it, with SIGKILL if SIGTERM does not.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Throws std::runtime_error where the child no longer reads.
  void write(int descriptor, std::string_view bytes);

  /// What it has written until `end` came, without it; what comes behind is kept for the next call.
  /// Throws std::runtime_error where it has ended before, or after `most_s` without a word.
  std::string read_until(int descriptor, char end, double most_s);

  /// Says that nothing more comes; returns its exit status (128 and the signal's number).
  int finish(int descriptor);

 private:
  void close_pipe(int descriptor);
  int wait();

  std::string name_;
  pid_t process_ = -1;
  std::map<int, int> own_;  ///< Our end, by the child's descriptor.
  std::map<int, std::string> rest_;
};

}  // namespace graben::cli
