#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/grade_options.hpp"
#include "app/cli/guarded.hpp"
#include "app/cli/scenario_options.hpp"
#include "app/cli/validators.hpp"
#include "app/machines/task_file.hpp"
#include "app/reports/json_file.hpp"
#include "app/runs/grade_plant_run.hpp"
#include "app/runs/plant_run.hpp"
#include "app/runs/task_plant_run.hpp"

namespace graben::cli {
namespace {

struct PlantCommand {
  ScenarioOptions scenario;
  GradeScenario grade;
  runs::PlantRunOptions run;
  std::string profile = "excavator_22t";
  std::string player = "none";
  std::optional<std::string> task;  ///< Of the player `program`, like its number.
  std::optional<int> task_number;
  std::string summary;
};

/// What came of a command; with `of` before the names, if it is not the cylinders'.
void add_command(nlohmann::ordered_json& figures, const std::string& of,
                 const plant::CommandCounters& command) {
  figures[of + "commands_accepted"] = command.accepted;
  figures[of + "commands_rejected"] = command.rejected + command.wrong_format;
  figures[of + "command_timeouts"] = command.timeouts;
}

/// What all runs have at their end.
void add_bus(nlohmann::ordered_json& figures, const runs::PlantBusFigures& bus) {
  figures["late_cycles"] = bus.late_cycles;
  figures["frames_dropped"] = bus.frames_dropped;
}

nlohmann::ordered_json summary_of(const runs::PlantRunResult& result) {
  nlohmann::ordered_json figures = {
      {"simulated_s", result.bus.simulated_s},  {"enabled_s", result.enabled_s},
      {"on_path_s", result.on_path_s},          {"loops", result.loops},
      {"max_error_true_m", result.max_error_m}, {"rmse_error_true_m", result.rmse_error_m}};
  add_command(figures, "", result.spool);
  add_bus(figures, result.bus);
  figures["peak_chamber_pressure_pa"] = result.peak_chamber_pressure_pa;
  return figures;
}

nlohmann::ordered_json summary_of(const runs::GradePlantResult& result) {
  nlohmann::ordered_json figures = {
      {"simulated_s", result.bus.simulated_s},  {"enabled_s", result.enabled_s},
      {"over_grade_s", result.over_grade_s},    {"edge_x_m", result.edge_x_m},
      {"max_error_true_m", result.max_error_m}, {"rmse_error_true_m", result.rmse_error_m}};
  add_command(figures, "", result.spool);
  add_bus(figures, result.bus);
  return figures;
}

nlohmann::ordered_json summary_of(const runs::TaskPlantResult& result) {
  nlohmann::ordered_json figures = {{"simulated_s", result.bus.simulated_s},
                                    {"enabled_s", result.enabled_s},
                                    {"in_steps_s", result.in_steps_s},
                                    {"on_lines_s", result.on_lines_s},
                                    {"finished", result.finished},
                                    {"max_error_true_m", result.max_error_m},
                                    {"rmse_error_true_m", result.rmse_error_m}};
  add_command(figures, "", result.spool);
  add_command(figures, "swing_", result.swing);
  add_bus(figures, result.bus);
  figures["peak_chamber_pressure_pa"] = result.peak_chamber_pressure_pa;
  return figures;
}

[[noreturn]] void refuse(const std::string& option, const char* kind) {
  throw std::runtime_error(fmt::format("{}: the profile is not one of {}", option, kind));
}

/// Whether nothing is told of what is tried but --errors.
bool has_errors_alone(const ScenarioOptions& options) {
  ScenarioOptions plain;
  plain.errors = options.errors;
  return scenario_words(options) == scenario_words(plain);
}

/// The player by its name, whose task must be the machine's.
runs::Player player_of(const std::string& name, machines::MachineKind kind) {
  if ((name == "dig" || name == "program") && kind != machines::MachineKind::kExcavator) {
    refuse("--operator " + name, "an excavator");
  }
  if (name == "grade" && kind != machines::MachineKind::kDozer) {
    refuse("--operator grade", "a dozer");
  }
  return name == "none"     ? runs::Player::kNobody
         : name == "shifts" ? runs::Player::kShifts
                            : runs::Player::kTask;
}

nlohmann::ordered_json run_program(const PlantCommand& options,
                                   const machines::SimulatedExcavator& machine,
                                   runs::PlantRunOptions run) {
  if (!machine.profile.has_swing()) {
    refuse("--operator program", "an excavator with a swing drive");
  }
  if (!has_errors_alone(options.scenario)) {
    throw std::runtime_error(
        fmt::format("{}: not with --operator program", scenario_words(options.scenario)));
  }
  const machines::TaskFile task =
      machines::load_task(machines::find_task(options.task.value_or("flatten")), machine.profile);
  run.task_number = static_cast<std::uint8_t>(options.task_number.value_or(0));
  return summary_of(
      runs::run_task_plant(arranged(machine, options.scenario), task.result.program, run));
}

nlohmann::ordered_json run_excavator(const PlantCommand& options,
                                     const std::filesystem::path& profile,
                                     const runs::PlantRunOptions& run) {
  if (options.grade.engine_rpm) {
    refuse("--engine-rpm", "a dozer");
  }
  if (options.player == "program") {
    return run_program(options, machines::load_simulated_excavator(profile), run);
  }
  const machines::SimulatedExcavator machine =
      arranged(machines::load_simulated_excavator(profile), options.scenario);
  const Eigen::Vector3d strokes_m = usual_run(machine, options.scenario).start_strokes_m;
  return summary_of(runs::run_plant(
      machine, run, plant::ExcavatorPlant::AxisArray{strokes_m[0], strokes_m[1], strokes_m[2]}));
}

nlohmann::ordered_json run_dozer(const PlantCommand& options, const std::filesystem::path& profile,
                                 const runs::PlantRunOptions& run) {
  const std::string& errors = options.scenario.errors;
  const bool is_known = errors == "none" || errors == "all";
  if (!is_known || !has_errors_alone(options.scenario)) {
    refuse(scenario_words(options.scenario), "an excavator");
  }
  GradeScenario grade = options.grade;
  grade.errors = errors;
  return summary_of(runs::run_plant(
      arranged(machines::load_simulated_dozer(profile), grade, options.scenario.scenario.seed),
      run));
}

void plant_on_bus(const PlantCommand& options) {
  if (options.player != "program" && (options.task || options.task_number)) {
    throw std::runtime_error("--task, --task-number: only with --operator program");
  }
  const std::filesystem::path profile = machines::find_profile(options.profile);
  const machines::MachineKind kind = machines::profile_kind(profile);
  runs::PlantRunOptions run = options.run;
  run.player = player_of(options.player, kind);
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
  CLI::App* command = app.add_subcommand(
      "plant", "The simulated machine in real time on a CAN interface, valve side and all");
  command->add_option("--can", options->run.interface, "CAN interface, such as vcan0")->required();
  command->add_option("--profile", options->profile, "Machine profile: file or shipped name")
      ->capture_default_str();
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
                   "machine can, shifts (does that for 5 s, lets go for 1 s, and so on), or "
                   "program (a task of the controller's)")
      ->check(CLI::IsMember({"none", "dig", "grade", "shifts", "program"}))
      ->capture_default_str();
  command->add_option("--task", options->task,
                      "Task file or shipped name that --operator program asks for, as the "
                      "controller has it; where it begins the machine starts; flatten unless told");
  command
      ->add_option("--task-number", options->task_number,
                   "The controller's number of it, 0 .. 3; 0 unless told")
      ->check(CLI::Range(0, kTaskMost - 1));
  command
      ->add_option("--enable-after", options->run.enable_after_s,
                   "When that operator enables, 0 .. 3600 s")
      ->check(number_between(0.0, 3600.0))
      ->capture_default_str();
  command->add_option("--summary", options->summary, "Write the figures as JSON to this file");
  options->scenario.errors = "none";
  add_scenario_options(*command, options->scenario);
  add_engine_option(*command, options->grade);
  command->add_option("--seed", options->scenario.scenario.seed, "Of --errors and --soil")
      ->check(whole_number())
      ->capture_default_str();
  command->callback(
      [options, &status] { status = guarded("plant", [&] { plant_on_bus(*options); }); });
}

}  // namespace graben::cli
