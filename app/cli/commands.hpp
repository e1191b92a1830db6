// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The subcommands of `graben`. Each adds itself to the CLI11 application and sets `status` to its
/// exit status when it has run: 0 done, 1 the input or the result is at fault, 2 wrong usage.

#include <optional>
#include <string>
#include <vector>

#include "app/machines/simulated/simulation_file.hpp"
#include "app/runs/scenarios.hpp"

namespace CLI {
class App;
}

namespace graben::cli {

/// Adds the commands of the program that is linked; made by CMake (graben_program).
void add_commands(CLI::App& app, int& status);

void add_check(CLI::App& app, int& status);
void add_dig(CLI::App& app, int& status);
void add_grade(CLI::App& app, int& status);
void add_campaign(CLI::App& app, int& status);
void add_solve(CLI::App& app, int& status);
void add_pose(CLI::App& app, int& status);
void add_strokes(CLI::App& app, int& status);
void add_autodig(CLI::App& app, int& status);
void add_plan(CLI::App& app, int& status);
void add_plant(CLI::App& app, int& status);
void add_operate(CLI::App& app, int& status);
void add_commission(CLI::App& app, int& status);
void add_identify(CLI::App& app, int& status);
void add_measure_up(CLI::App& app, int& status);
void add_verdict(CLI::App& app, int& status);
void add_drift(CLI::App& app, int& status);
void add_as_built(CLI::App& app, int& status);
void add_surface(CLI::App& app, int& status);
void add_site(CLI::App& app, int& status);
void add_scope(CLI::App& app, int& status);
void add_compare(CLI::App& app, int& status);
void add_export(CLI::App& app, int& status);
void add_film(CLI::App& app, int& status);
void add_faults(CLI::App& app, int& status);
void add_new_machine(CLI::App& app, int& status);

/// A task on the simulated machine, as both `autodig` and `dig --task` run it.
struct TaskCommand {
  runs::TaskScenario scenario;
  std::string profile = "excavator_12t";
  machines::SimulatedChoice simulated;
  std::string out = "out";
  std::string name = "autodig";  ///< Of the files in `out`.
  std::string summary;
  std::string store;  ///< See AutodigOptions.
  std::vector<std::string> faults;
  std::optional<double> most_s;
  std::string unknown_drives;  ///< See demand_known().
};

/// Runs it, writes log, report and summary, prints the figures. Throws std::runtime_error where the
/// run did not come to its end.
void run_task(const TaskCommand& options);

}  // namespace graben::cli
