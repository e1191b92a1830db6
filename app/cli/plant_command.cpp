// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/machines/task_file.hpp"
#include "app/reports/plant_json.hpp"
#include "app/reports/report_file.hpp"
#include "app/runs/plant_runs.hpp"

namespace graben::cli {
namespace {

struct PlantCommand {
  runs::DigScenario scenario;
  machines::SimulatedChoice simulated;
  runs::GradeScenario grade;
  runs::PlantRunOptions run;
  std::string profile = "excavator_22t";
  std::string player = "none";
  std::optional<std::string> task;  ///< Of the player `program`, like its number.
  std::optional<int> task_number;
  std::string summary;
  std::string unknown_drives;  ///< See demand_known().
};

[[noreturn]] void refuse(const std::string& option, const char* kind) {
  throw std::runtime_error(fmt::format("{}: the profile is not one of {}", option, kind));
}

/// Nothing of the scenario is told but --errors.
bool has_errors_alone(const runs::DigScenario& scenario) {
  runs::DigScenario plain;
  plain.errors = scenario.errors;
  return runs::scenario_text(scenario) == runs::scenario_text(plain);
}

/// The player by its name, whose task must be the machine's.
runs::Player player_of(const std::string& name, machines::MachineKind kind) {
  if ((name == "dig" || name == "program") && kind != machines::MachineKind::kExcavator) {
    refuse("--operator " + name, "an excavator");
  }
  if (name == "grade" && kind != machines::MachineKind::kDozer) {
    refuse("--operator grade", "a dozer");
  }
  return name == "none"      ? runs::Player::kNobody
         : name == "shifts"  ? runs::Player::kShifts
         : name == "changes" ? runs::Player::kChanges
                             : runs::Player::kTask;
}

/// A task that the operator will ask for. How fast it is done is the controller's, which is another
/// process; the figures have standard output.
template <class Machine, class... Needed>
void demand(Machine& machine, const PlantCommand& options, const Needed&... needed) {
  const std::string slow =
      machines::demand_known(machine, needed...,
                             options.unknown_drives.empty() ? machines::UnknownTask::kRefused
                                                            : machines::UnknownTask::kSlow);
  if (!slow.empty()) {
    fmt::print(stderr, "{}, by a graben-ecu with --unknown-drives slow\n", slow);
  }
}

nlohmann::ordered_json run_program(const PlantCommand& options,
                                   machines::SimulatedExcavator machine,
                                   runs::PlantRunOptions run) {
  if (!machine.profile.has_swing()) {
    refuse("--operator program", "an excavator with a swing drive");
  }
  runs::TaskScenario tried;
  tried.errors = options.scenario.errors;
  tried.soil = options.scenario.scenario.ground;
  tried.seed = options.scenario.scenario.seed;
  runs::DigScenario others = options.scenario;
  others.scenario.ground.clear();
  if (!has_errors_alone(others)) {
    throw std::runtime_error(
        fmt::format("{}: not with --operator program", runs::scenario_text(others)));
  }
  const machines::TaskFile task =
      machines::load_task(machines::find_task(options.task.value_or("flatten")), machine.profile);
  machines::demand_steps(task, "--operator program");
  demand(machine, options, machines::needed_drives(machine.profile, task.result.program));
  run.task_number = static_cast<std::uint8_t>(options.task_number.value_or(0));
  return reports::plant_json(
      runs::run_task_plant(runs::arranged(machine, tried), task.result.program, run));
}

nlohmann::ordered_json run_excavator(const PlantCommand& options,
                                     const std::filesystem::path& profile,
                                     const runs::PlantRunOptions& run) {
  if (options.grade.engine_rpm) {
    refuse("--engine-rpm", "a dozer");
  }
  if (options.player == "program") {
    return run_program(options, machines::load_simulated_excavator(profile, options.simulated),
                       run);
  }
  machines::SimulatedExcavator machine = runs::arranged(
      machines::load_simulated_excavator(profile, options.simulated), options.scenario);
  if (run.player != runs::Player::kNobody) {
    demand(machine, options, machines::kCylinders);
  }
  const Eigen::Vector3d strokes_m = runs::usual_run(machine, options.scenario).start_strokes_m;
  return reports::plant_json(runs::run_plant(machine, run, runs::start_at(strokes_m)));
}

nlohmann::ordered_json run_dozer(const PlantCommand& options, const std::filesystem::path& profile,
                                 const runs::PlantRunOptions& run) {
  const std::string& errors = options.scenario.errors;
  const bool is_known = errors == "none" || errors == "all";
  if (!is_known || !has_errors_alone(options.scenario)) {
    refuse(runs::scenario_text(options.scenario), "an excavator");
  }
  if (!options.simulated.is_own()) {
    refuse("--simulated, --hidden", "an excavator");
  }
  runs::GradeScenario grade = options.grade;
  grade.errors = errors;
  machines::SimulatedDozer machine = runs::arranged(machines::load_simulated_dozer(profile), grade,
                                                    options.scenario.scenario.seed);
  if (run.player != runs::Player::kNobody) {
    demand(machine, options);
  }
  return reports::plant_json(runs::run_plant(machine, run));
}

void plant_on_bus(const PlantCommand& options) {
  if (options.player != "program" && (options.task || options.task_number)) {
    throw std::runtime_error("--task, --task-number: only with --operator program");
  }
  const std::filesystem::path profile = machines::find_profile(options.profile);
  const machines::MachineKind kind = machines::profile_kind(profile);
  runs::PlantRunOptions run = options.run;
  run.player = player_of(options.player, kind);
  if (!run.lets_go_s.empty() && run.player != runs::Player::kTask) {
    throw std::runtime_error("--lets-go: only with --operator dig, grade or program");
  }
  std::sort(run.lets_go_s.begin(), run.lets_go_s.end());
  const nlohmann::ordered_json figures = kind == machines::MachineKind::kDozer
                                             ? run_dozer(options, profile, run)
                                             : run_excavator(options, profile, run);
  if (options.summary.empty()) {
    fmt::print("{}\n", figures.dump(2));
  } else {
    reports::write_json(options.summary, figures);
  }
}

}  // namespace

void add_plant(CLI::App& app, int& status) {
  auto options = std::make_shared<PlantCommand>();
  CLI::App* command = add_command(app, "plant");
  command->add_option("--can", options->run.interface, "CAN interface, such as vcan0")->required();
  add_profile_option(*command, options->profile);
  command->add_option("--speed", options->run.speed, "Simulated over real time, 0.1 .. 10")
      ->check(number_between(0.1, 10.0))
      ->capture_default_str();
  command
      ->add_option("--seconds", options->run.seconds,
                   "End after this simulated time, 2 .. 1e6; without it at SIGINT or SIGTERM")
      ->check(number_between(2.0, 1e6));
  command
      ->add_option("--operator", options->player,
                   "Who gives enable and task: none (another node does), dig or grade, as the "
                   "machine can, shifts (does that for 5 s, lets go for 1 s, and so on), "
                   "changes (asks for no task every 2 s, for 50 ms), or program (a task of "
                   "the controller's)")
      ->check(one_of({"none", "dig", "grade", "shifts", "changes", "program"}))
      ->capture_default_str();
  command->add_option("--task", options->task,
                      "Task file or shipped name that --operator program asks for, as the "
                      "controller has it; where it begins the machine starts; flatten unless told");
  command
      ->add_option("--task-number", options->task_number,
                   "The controller's number of it, 0 .. 3; 0 unless told")
      ->check(whole_number_between(0, kTaskMost - 1));
  command
      ->add_option("--enable-after", options->run.enable_after_s,
                   "When that operator enables, 0 .. 3600 s")
      ->check(number_between(0.0, 3600.0))
      ->capture_default_str();
  command
      ->add_option(
          "--lets-go", options->run.lets_go_s,
          "When an operator at dig, grade or program lets go for a second, 0 .. 1e6 s; more "
          "often by naming it again")
      ->check(number_between(0.0, 1e6));
  add_fault_option(*command, options->run.faults);
  add_summary_option(*command, options->summary);
  add_unknown_drives_option(*command, options->unknown_drives);
  add_simulated_options(*command, options->simulated);
  add_scenario_options(*command, options->scenario);
  add_engine_option(*command, options->grade);
  command->add_option("--seed", options->scenario.scenario.seed, "Of --errors and --soil")
      ->check(whole_number())
      ->capture_default_str();
  add_examples(*command,
               {"plant --can vcan0", "plant --can vcan0 --profile dozer_9t --operator grade"});
  command->callback(
      [options, &status] { status = guarded("plant", [&] { plant_on_bus(*options); }); });
}

}  // namespace graben::cli
