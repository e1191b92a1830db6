#include "app/cli/scenario_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "app/cli/validators.hpp"

namespace graben::cli {
namespace {

constexpr double kNeverSlow_m = 1e3;

/// In the order of machines::Errors.
const std::array<const char*, 5> kErrors = {"none", "stroke-bias", "sensors", "parameters", "all"};

machines::Errors errors_of(const std::string& name) {
  const auto* found = std::find(kErrors.begin(), kErrors.end(), name);
  return static_cast<machines::Errors>(found - kErrors.begin());
}

}  // namespace

void add_scenario_options(CLI::App& command, ScenarioOptions& options) {
  machines::Scenario& scenario = options.scenario;
  auto* in_the_way = command.add_option_group("in the way", "What the bucket meets");
  in_the_way->add_flag("--soil", scenario.soil, "Soil below the profile's ground line");
  CLI::Option* air = in_the_way->add_flag(
      "--air", scenario.air, "The profile's manoeuvre in the air, with a loaded bucket, instead");
  in_the_way->require_option(0, 1);
  command
      .add_flag("--obstacle", scenario.obstacle,
                "A rock on the digging path that holds for a while and then comes loose")
      ->excludes(air);
  command.add_flag("--stiff-oil", scenario.stiff_oil, "Oil as stiff as the paper's");
  command
      .add_option("--dead-time", scenario.dead_time_s,
                  "Of every spool, s, 0 .. 0.5; the profile's unless told")
      ->check(number_between(0.0, 0.5));
  command
      .add_option("--errors", options.errors,
                  "What the controller does not know, drawn from the seed: sensors' bias and "
                  "noise, parameters")
      ->check(CLI::IsMember(std::vector<std::string>(kErrors.begin(), kErrors.end())))
      ->capture_default_str();
  command.add_flag("--fixed-lambda", options.fixed_lambda,
                   "For comparison: lambda stays 1, whatever the machine can do");
}

machines::SimulatedExcavator arranged(const machines::SimulatedExcavator& machine,
                                      const ScenarioOptions& options) {
  machines::Scenario scenario = options.scenario;
  scenario.errors = errors_of(options.errors);
  machines::SimulatedExcavator result = machines::arranged(machine, scenario);
  if (options.fixed_lambda) {
    result.profile.control.lambda_policy = McvPolicy::kFixed;
    // Nor does anything else slow it.
    result.profile.control.slow_error_m = kNeverSlow_m;
  }
  return result;
}

std::string scenario_words(const ScenarioOptions& options) {
  std::vector<std::string> words;
  const auto add = [&words](bool is_on, const char* word) {
    if (is_on) {
      words.emplace_back(word);
    }
  };
  add(options.scenario.soil, "soil");
  add(options.scenario.air, "air");
  add(options.scenario.obstacle, "obstacle");
  add(options.scenario.stiff_oil, "stiff oil");
  add(options.fixed_lambda, "lambda fixed at 1");
  if (options.scenario.dead_time_s) {
    words.push_back(fmt::format("dead time {} s", *options.scenario.dead_time_s));
  }
  words.push_back(fmt::format("errors {}", options.errors));
  return fmt::format("{}", fmt::join(words, ", "));
}

runs::DigOptions usual_run(const machines::SimulatedExcavator& machine,
                           const ScenarioOptions& options) {
  runs::DigOptions run;
  if (options.scenario.air) {
    const machines::AirManoeuvre& air = machine.experiment.air;
    run.start_strokes_m = machines::strokes_at(machine.profile, air.start);
    run.loops = air.loops;
    return run;
  }
  run.start_strokes_m = machines::dig_start(machine.profile);
  return run;
}

}  // namespace graben::cli
