#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/commands.hpp"
#include "app/cli/guarded.hpp"
#include "app/cli/json_file.hpp"
#include "app/cli/plant_run.hpp"
#include "app/cli/scenario_options.hpp"
#include "app/cli/validators.hpp"

namespace graben::cli {
namespace {

struct Options {
  ScenarioOptions scenario;
  PlantRunOptions run;
  std::string profile = "excavator_22t";
  std::string summary;
};

nlohmann::ordered_json summary_of(const PlantRunResult& result) {
  return {{"simulated_s", result.simulated_s},
          {"enabled_s", result.enabled_s},
          {"on_path_s", result.on_path_s},
          {"loops", result.loops},
          {"max_error_true_m", result.max_error_m},
          {"rmse_error_true_m", result.rmse_error_m},
          {"commands_accepted", result.commands_accepted},
          {"commands_rejected", result.commands_rejected},
          {"command_timeouts", result.command_timeouts},
          {"late_cycles", result.late_cycles},
          {"frames_dropped", result.frames_dropped},
          {"peak_chamber_pressure_pa", result.peak_chamber_pressure_pa}};
}

void plant_on_bus(const Options& options) {
  const machines::ExcavatorMachine machine =
      arranged(machines::load_excavator(machines::find_profile(options.profile)), options.scenario);
  PlantRunOptions run = options.run;
  run.start_strokes_m = usual_run(machine, options.scenario).start_strokes_m;
  const nlohmann::ordered_json figures = summary_of(run_plant(machine, run));
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
      ->add_option("--operator", options->run.player,
                   "Who gives enable and task: none (another node does), dig, or shifts (digs for "
                   "5 s, lets go for 1 s, and so on)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Player>{
          {"none", Player::kNobody}, {"dig", Player::kDig}, {"shifts", Player::kShifts}}))
      ->default_str("none");
  command
      ->add_option("--enable-after", options->run.enable_after_s,
                   "When that operator enables, 0 .. 3600 s")
      ->check(number_between(0.0, 3600.0))
      ->capture_default_str();
  command->add_option("--summary", options->summary, "Write the figures as JSON to this file");
  options->scenario.errors = "none";
  add_scenario_options(*command, options->scenario);
  command->add_option("--seed", options->scenario.scenario.seed, "Of --errors and --soil")
      ->check(whole_number())
      ->capture_default_str();
  command->callback(
      [options, &status] { status = guarded("plant", [&] { plant_on_bus(*options); }); });
}

}  // namespace graben::cli
