// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Other programs that a command starts, such as sbatch or ffmpeg.

#include <string>
#include <vector>

namespace graben::cli {

struct ProgramOutcome {
  int status = 0;   ///< What it exited with; 128 and the signal's number where one ended it.
  std::string out;  ///< What it wrote to standard output and to standard error.
  std::string err;
};

/// Path of a program on PATH; empty: there is none.
[[nodiscard]] std::string program_path(const std::string& name);

/// Throws std::runtime_error where the program is not there, with Debian's package that has it.
void assert_program(const std::string& name, const std::string& package);

/// Runs `words`, the first of them the program, without input, until it ends. Throws
/// std::runtime_error where it cannot be started.
[[nodiscard]] ProgramOutcome run_program(const std::vector<std::string>& words);

/// A word as a POSIX shell reads it back.
[[nodiscard]] std::string shell_word(const std::string& word);

}  // namespace graben::cli
