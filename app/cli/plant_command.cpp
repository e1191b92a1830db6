#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/grade_options.hpp"
#include "app/cli/grade_plant_run.hpp"
#include "app/cli/guarded.hpp"
#include "app/cli/json_file.hpp"
#include "app/cli/plant_run.hpp"
#include "app/cli/scenario_options.hpp"
#include "app/cli/validators.hpp"

namespace graben::cli {
namespace {

struct Options {
  ScenarioOptions scenario;
  GradeScenario grade;
  PlantRunOptions run;
  std::string profile = "excavator_22t";
  std::string player = "none";
  std::string summary;
};

/// What both kinds' runs have at their end.
template <class Result>
void add_bus(nlohmann::ordered_json& figures, const Result& result) {
  figures["commands_accepted"] = result.commands_accepted;
  figures["commands_rejected"] = result.commands_rejected;
  figures["command_timeouts"] = result.command_timeouts;
  figures["late_cycles"] = result.bus.late_cycles;
  figures["frames_dropped"] = result.bus.frames_dropped;
}

nlohmann::ordered_json summary_of(const PlantRunResult& result) {
  nlohmann::ordered_json figures = {
      {"simulated_s", result.bus.simulated_s},  {"enabled_s", result.enabled_s},
      {"on_path_s", result.on_path_s},          {"loops", result.loops},
      {"max_error_true_m", result.max_error_m}, {"rmse_error_true_m", result.rmse_error_m}};
  add_bus(figures, result);
  figures["peak_chamber_pressure_pa"] = result.peak_chamber_pressure_pa;
  return figures;
}

nlohmann::ordered_json summary_of(const GradePlantResult& result) {
  nlohmann::ordered_json figures = {
      {"simulated_s", result.bus.simulated_s},  {"enabled_s", result.enabled_s},
      {"over_grade_s", result.over_grade_s},    {"edge_x_m", result.edge_x_m},
      {"max_error_true_m", result.max_error_m}, {"rmse_error_true_m", result.rmse_error_m}};
  add_bus(figures, result);
  return figures;
}

[[noreturn]] void refuse(const std::string& option, const char* kind) {
  throw std::runtime_error(fmt::format("{}: the profile is not one of {}", option, kind));
}

/// The player by its name, whose task must be the machine's.
Player player_of(const std::string& name, machines::MachineKind kind) {
  if (name == "dig" && kind != machines::MachineKind::kExcavator) {
    refuse("--operator dig", "an excavator");
  }
  if (name == "grade" && kind != machines::MachineKind::kDozer) {
    refuse("--operator grade", "a dozer");
  }
  return name == "none" ? Player::kNobody : name == "shifts" ? Player::kShifts : Player::kTask;
}

nlohmann::ordered_json run_excavator(const Options& options, const std::filesystem::path& profile,
                                     const PlantRunOptions& run) {
  if (options.grade.engine_rpm) {
    refuse("--engine-rpm", "a dozer");
  }
  const machines::ExcavatorMachine machine =
      arranged(machines::load_excavator(profile), options.scenario);
  const Eigen::Vector3d strokes_m = usual_run(machine, options.scenario).start_strokes_m;
  return summary_of(run_plant(
      machine, run, plant::ExcavatorPlant::AxisArray{strokes_m[0], strokes_m[1], strokes_m[2]}));
}

nlohmann::ordered_json run_dozer(const Options& options, const std::filesystem::path& profile,
                                 const PlantRunOptions& run) {
  ScenarioOptions plain;
  plain.errors = options.scenario.errors;
  const bool is_known = plain.errors == "none" || plain.errors == "all";
  if (!is_known || scenario_words(options.scenario) != scenario_words(plain)) {
    refuse(scenario_words(options.scenario), "an excavator");
  }
  GradeScenario grade = options.grade;
  grade.errors = plain.errors;
  return summary_of(run_plant(
      arranged(machines::load_dozer(profile), grade, options.scenario.scenario.seed), run));
}

void plant_on_bus(const Options& options) {
  const std::filesystem::path profile = machines::find_profile(options.profile);
  const machines::MachineKind kind = machines::profile_kind(profile);
  PlantRunOptions run = options.run;
  run.player = player_of(options.player, kind);
  const nlohmann::ordered_json figures = kind == machines::MachineKind::kDozer
                                             ? run_dozer(options, profile, run)
                                             : run_excavator(options, profile, run);
  if (options.summary.empty()) {
    fmt::print("{}\n", figures.dump(2));
  } else {
    write_json(options.summary, figures);
  }
}

}  // namespace

void add_plant(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
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
                   "machine can, or shifts (does that for 5 s, lets go for 1 s, and so on)")
      ->check(CLI::IsMember({"none", "dig", "grade", "shifts"}))
      ->capture_default_str();
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
