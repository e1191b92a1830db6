/// graben: the engineer's tool. Simulates machines and their controller, plans, reports, and shows
/// what is on a bus.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "app/cli/commands.hpp"

namespace {
constexpr int kWrongUsage = 2;
}

int main(int argc, char** argv) {
  CLI::App app(
      "Graben: follows a path as fast as the hydraulics allow, without ever changing the path's "
      "direction");
  app.set_version_flag("--version", GRABEN_VERSION);
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
  graben::cli::add_scope(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongUsage;
  }
  // A full disk must not pass for success.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::perror("graben: standard output");
    return 1;
  }
  return status;
}
