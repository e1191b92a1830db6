// SPDX-License-Identifier: Apache-2.0
/// graben: the engineer's tool. Simulates machines and their controller, plans, reports, and shows
/// what is on a bus. This is its front: it finds the command in the table and becomes its program.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/program.hpp"
#include "app/cli/program_files.hpp"

namespace {

using graben::cli::CommandRow;

constexpr int kWrongUsage = 2;
constexpr int kNoProgram = 1;

/// Row of the command that is called: the first word that is no option.
const CommandRow* called(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word.empty() || word[0] != '-') {
      return graben::cli::command_row(word);
    }
  }
  return nullptr;
}

/// Becomes the command's program. Returns only where it can't.
int become(const CommandRow& row, char** argv) {
  const std::string file = graben::cli::program_file(row.program).string();
  execv(file.c_str(), argv);
  const bool is_missing = errno == ENOENT;
  fmt::print(
      stderr, "graben {}: {}: {}\n", row.name, file,
      is_missing ? fmt::format("not built; `./run {}` builds it", row.name) : std::strerror(errno));
  return kNoProgram;
}

/// All programs' commands, in the table's order.
void describe(const CLI::App& app) {
  std::map<std::string, std::string> said;
  for (const CommandRow& row : graben::cli::kCommands) {
    if (said.count(row.program) == 0) {
      const std::string file = graben::cli::program_file(row.program).string();
      const graben::cli::ProgramOutcome outcome = graben::cli::run_program({file, "--describe"});
      if (outcome.status != 0) {
        throw std::runtime_error(fmt::format("{}: {}", file, outcome.err));
      }
      said[row.program] = outcome.out;
    }
  }
  fmt::print("{}", graben::cli::description_json(app, said));
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (const CommandRow* row = called(words); row != nullptr) {
    return become(*row, argv);
  }
  CLI::App app(
      "Graben: follows a path as fast as the hydraulics allow, slowing all drives together to keep "
      "the path's direction",
      "graben");
  graben::cli::set_help(app);
  app.set_version_flag("--version", GRABEN_VERSION, "Say the version");
  app.require_subcommand(1);
  for (const CommandRow& row : graben::cli::kCommands) {
    graben::cli::add_command(app, row.name);
  }
  graben::cli::add_examples(app, {"dig --out out", "check excavator_22t", "scope --sim dig",
                                  "new-machine --out mine.toml", "dig --help"});
  graben::cli::add_shipped(app);
  // For the package's man pages and completion; in no help, as nobody types it.
  if (words.size() == 1 && words[0] == "--describe") {
    return graben::cli::guarded("--describe", [&] { describe(app); });
  }
  const std::string slip = graben::cli::command_slip(app, words);
  if (!slip.empty()) {
    fmt::print(stderr, "{}", slip);
    return kWrongUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);
    }
    fmt::print(stderr, "{}", graben::cli::usage_text(app, error));
    return kWrongUsage;
  }
  return kWrongUsage;
}
