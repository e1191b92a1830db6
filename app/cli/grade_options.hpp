#pragma once
/// The options of `grade`, `campaign grade` and `plant` that say what a dozer is to try.

#include <optional>
#include <string>

#include "app/machines/simulated/dozer_scenario.hpp"

namespace CLI {
class App;
}

namespace graben::cli {

struct GradeScenario {
  std::string speed_mode = "bounded";
  std::optional<double> speed_mps;
  std::optional<double> engine_rpm;
  std::string errors;
};

/// Adds --speed-mode, --speed.
void add_speed_options(CLI::App& command, GradeScenario& scenario);
/// Adds --engine-rpm.
void add_engine_option(CLI::App& command, GradeScenario& scenario);
/// Adds --errors.
void add_error_option(CLI::App& command, GradeScenario& scenario);

/// The machine as the options have it. Throws std::runtime_error where its engine can't run so.
[[nodiscard]] machines::SimulatedDozer arranged(const machines::SimulatedDozer& machine,
                                                const GradeScenario& scenario, std::uint64_t seed);

/// "bounded, wanted 1.6 m/s, 1500 rpm, errors all"; the same words, the same scenario.
[[nodiscard]] std::string scenario_words(const machines::SimulatedDozer& nominal,
                                         const GradeScenario& scenario);

}  // namespace graben::cli
