#pragma once
/// The subcommands of `graben`. Each adds itself to the CLI11 application and sets `status` to its
/// exit status when it has run: 0 done, 1 the input or the result is at fault, 2 wrong usage.

namespace CLI {
class App;
}

namespace graben::cli {

void add_dig(CLI::App& app, int& status);
void add_grade(CLI::App& app, int& status);
void add_campaign(CLI::App& app, int& status);
void add_solve(CLI::App& app, int& status);
void add_pose(CLI::App& app, int& status);
void add_strokes(CLI::App& app, int& status);
void add_autodig(CLI::App& app, int& status);
void add_plan(CLI::App& app, int& status);
void add_plant(CLI::App& app, int& status);
void add_scope(CLI::App& app, int& status);

}  // namespace graben::cli
