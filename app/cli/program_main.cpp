// SPDX-License-Identifier: Apache-2.0
/// One of the programs behind `graben`: it has the command line that `graben` was called with, and
/// some of the commands.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <string_view>

#include "app/cli/commands.hpp"
#include "app/cli/help.hpp"

namespace {
constexpr int kWrongUsage = 2;
}

int main(int argc, char** argv) {
  CLI::App app("", "graben");
  graben::cli::set_help(app);
  app.set_version_flag("--version", GRABEN_VERSION, "Say the version");
  app.require_subcommand(1);
  int status = 0;
  graben::cli::add_commands(app, status);
  graben::cli::add_shipped(app);
  if (argc == 2 && std::string_view(argv[1]) == "--describe") {
    fmt::print("{}", graben::cli::description_json(app));
    return 0;
  }
  const std::string slip = graben::cli::command_slip(app, {argv + 1, argv + argc});
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
  // A full disk must not pass for success.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::perror("graben: standard output");
    return 1;
  }
  return status;
}
