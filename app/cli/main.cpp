// SPDX-License-Identifier: Apache-2.0
/// graben: the engineer's tool. Simulates machines and their controller, plans, reports, and shows
/// what is on a bus.

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
  CLI::App app(
      "Graben: follows a path as fast as the hydraulics allow, without ever changing the path's "
      "direction",
      "graben");
  graben::cli::set_help(app);
  app.set_version_flag("--version", GRABEN_VERSION, "Say the version");
  app.require_subcommand(1);
  int status = 0;
  graben::cli::add_check(app, status);
  graben::cli::add_dig(app, status);
  graben::cli::add_grade(app, status);
  graben::cli::add_campaign(app, status);
  graben::cli::add_solve(app, status);
  graben::cli::add_pose(app, status);
  graben::cli::add_strokes(app, status);
  graben::cli::add_autodig(app, status);
  graben::cli::add_plan(app, status);
  graben::cli::add_plant(app, status);
  graben::cli::add_operate(app, status);
  graben::cli::add_commission(app, status);
  graben::cli::add_identify(app, status);
  graben::cli::add_measure_up(app, status);
  graben::cli::add_scope(app, status);
  graben::cli::add_compare(app, status);
  graben::cli::add_export(app, status);
  graben::cli::add_film(app, status);
  graben::cli::add_new_machine(app, status);
  graben::cli::add_examples(app, {"dig --out out", "check excavator_22t", "scope --sim dig",
                                  "new-machine --out mine.toml", "dig --help"});
  graben::cli::add_shipped(app);
  // For the package's man pages and completion; in no help, as nobody types it.
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
