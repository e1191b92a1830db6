#pragma once
/// The options of `dig` and `campaign dig` that say what is tried.

#include <string>

#include "app/machines/simulated/scenario.hpp"
#include "app/runs/dig_run.hpp"

namespace CLI {
class App;
}

namespace graben::cli {

struct ScenarioOptions {
  machines::Scenario scenario;
  bool fixed_lambda = false;
  std::string errors;
};

/// Adds --soil, --obstacle, --air, --stiff-oil, --dead-time, --errors, --fixed-lambda.
void add_scenario_options(CLI::App& command, ScenarioOptions& options);

/// The machine as the options have it.
[[nodiscard]] machines::SimulatedExcavator arranged(const machines::SimulatedExcavator& machine,
                                                    const ScenarioOptions& options);

/// "soil, stiff oil, dead time 0.15 s, errors all"; the same words, the same scenario.
[[nodiscard]] std::string scenario_words(const ScenarioOptions& options);

/// Where the bucket starts and how far it goes unless told: machines::dig_start(), once round; in
/// the air as the profile has it. Throws std::runtime_error where that is out of reach.
[[nodiscard]] runs::DigOptions usual_run(const machines::SimulatedExcavator& machine,
                                         const ScenarioOptions& options);

}  // namespace graben::cli
