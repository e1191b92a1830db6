#include "app/cli/grade_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/cli/validators.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::cli {
namespace {

constexpr double kRadpsPerRpm = kTwoPi / 60.0;

}  // namespace

void add_speed_options(CLI::App& command, GradeScenario& scenario) {
  command
      .add_option("--speed-mode", scenario.speed_mode,
                  "bounded by what the blade's flow allows, or, for comparison, constant: the "
                  "wanted speed, whatever the blade needs")
      ->check(CLI::IsMember({"bounded", "constant"}))
      ->capture_default_str();
  command
      .add_option("--speed", scenario.speed_mps,
                  "Wanted travel speed, m/s, 0.05 .. 3; the profile's unless told")
      ->check(number_between(0.05, 3.0));
}

void add_engine_option(CLI::App& command, GradeScenario& scenario) {
  command
      .add_option("--engine-rpm", scenario.engine_rpm,
                  "Of a dozer's engine, 900 .. 2200; the profile's unless told")
      ->check(number_between(900.0, 2200.0));
}

void add_error_option(CLI::App& command, GradeScenario& scenario) {
  command
      .add_option("--errors", scenario.errors,
                  "What the controller does not know, drawn from the seed: all (mass, ground, "
                  "efficiencies, sensors' bias and noise) or none")
      ->check(CLI::IsMember({"none", "all"}))
      ->capture_default_str();
}

machines::SimulatedDozer arranged(const machines::SimulatedDozer& machine,
                                  const GradeScenario& scenario, std::uint64_t seed) {
  machines::DozerScenario wanted;
  wanted.policy =
      scenario.speed_mode == "constant" ? SpeedPolicy::kConstant : SpeedPolicy::kBounded;
  wanted.speed_mps = scenario.speed_mps;
  if (scenario.engine_rpm) {
    wanted.engine_radps = *scenario.engine_rpm * kRadpsPerRpm;
  }
  wanted.errors = scenario.errors == "all";
  wanted.seed = seed;
  return machines::arranged(machine, wanted);
}

std::string scenario_words(const machines::SimulatedDozer& nominal, const GradeScenario& scenario) {
  const double rpm = scenario.engine_rpm.value_or(nominal.profile.hst.engine_radps / kRadpsPerRpm);
  return fmt::format("{}, wanted {} m/s, {:.0f} rpm, errors {}", scenario.speed_mode,
                     scenario.speed_mps.value_or(nominal.profile.travel.speed_desired_mps), rpm,
                     scenario.errors);
}

}  // namespace graben::cli
