// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Options that several commands have, most of them for what a run is to try, and checks of their
/// values.

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/design/design_source.hpp"
#include "app/machines/dozer_file.hpp"
#include "app/machines/simulated/simulation_file.hpp"
#include "app/machines/unknown_drives.hpp"
#include "app/runs/scenarios.hpp"

namespace graben::cli {

// Of `dig`, `campaign dig` and `plant`.

/// Adds --soil, --obstacle, --air, --stiff-oil, --dead-time, --errors, --law, --swash,
/// --fixed-lambda.
void add_scenario_options(CLI::App& command, runs::DigScenario& scenario);

/// Adds --found, of `dig`, `campaign dig`, `autodig` and `campaign autodig`.
void add_found_option(CLI::App& command, machines::Found& found);

/// Adds --simulated and --hidden, of every command that simulates an excavator.
void add_simulated_options(CLI::App& command, machines::SimulatedChoice& choice);

/// Adds --sensors, of the same.
void add_sensor_option(CLI::App& command, bool& imus, bool& seconds);
/// Adds --imu-mounting, of `dig`, `campaign dig`, `plant` and `measure-up`.
void add_mounting_option(CLI::App& command, double& mounting_rad);
/// Adds --swash, of `dig`, `campaign dig`, `plant`, `autodig` and `campaign autodig`.
void add_swash_option(CLI::App& command, std::optional<double>& swash_ratio);

// Of `autodig` and `campaign autodig`.

/// Adds --task, --errors, --soil, --found, --start, --speed, --swash, --duration, --rounds.
void add_task_options(CLI::App& command, runs::TaskScenario& scenario);

// Of `grade`, `campaign grade` and `plant`, for a dozer.

/// Adds --speed-mode, --speed.
void add_speed_options(CLI::App& command, runs::GradeScenario& scenario);
/// Adds --engine-rpm.
void add_engine_option(CLI::App& command, runs::GradeScenario& scenario);
/// Adds --soil, --pass-depth.
void add_ground_options(CLI::App& command, runs::GradeScenario& scenario);
/// Adds --dead-time, --pose-latency.
void add_lateness_options(CLI::App& command, runs::GradeScenario& scenario);
/// Adds --errors.
void add_error_option(CLI::App& command, runs::GradeScenario& scenario);

// Of `grade`, `campaign grade` and `scope`.

/// Adds --design, --surface, --track, --datum.
void add_design_options(CLI::App& command, design::DesignSource& source);
/// The machine with the design that these options name, and that along the track; the machine as it
/// is, and none, where they name none.
struct Designed {
  machines::SimulatedDozer machine;
  machines::DesignLine line;
};
[[nodiscard]] Designed designed(const machines::SimulatedDozer& machine,
                                const design::DesignSource& source);

// Of `dig`, `campaign dig`, `plant` and `scope`.

/// Adds --soil with a name that may be left out: kim, or one of machines::kSoilNames.
CLI::Option& add_soil_option(CLI::App& command, const std::function<void(const std::string&)>& take,
                             const std::string& help);

// Of commands that run anything.

/// Adds --profile, whose default is the value that it has.
void add_profile_option(CLI::App& command, std::string& profile);
/// Adds --summary for a JSON file.
void add_summary_option(CLI::App& command, std::string& summary);
/// Adds --fault, of `dig`, `autodig`, `grade` and `plant`; `more` ends its help.
void add_fault_option(CLI::App& command, std::vector<std::string>& faults,
                      const std::string& more = "");
/// Adds --seconds, of `autodig` and `grade`, after which a run is given up.
void add_seconds_option(CLI::App& command, std::optional<double>& most_s, const std::string& usual);
/// Adds --speed, the operator's override.
void add_override_option(CLI::App& command, double& speed_override_ratio);

/// Adds --unknown-drives, of every command that has a task done; `how` stays empty unless told.
void add_unknown_drives_option(CLI::App& command, std::string& how);

/// machines::demand_known() for a task that is to be tried as `how` says. What it says is printed
/// and returned.
std::string demand_known(machines::ExcavatorMachine& machine, const machines::NeededDrives& needed,
                         const std::string& how);
std::string demand_known(machines::DozerMachine& machine, const std::string& how);

/// Names of all errors that an excavator's controller can have.
[[nodiscard]] CLI::Validator error_name();
[[nodiscard]] CLI::Validator soil_name();
/// The digging path's soil unless another one is named: a field of force.
inline constexpr const char* kKimSoil = "kim";

/// Adds --figure, one or more of `names` with commas between.
void add_figure_option(CLI::App& command, std::vector<std::string>& figures,
                       const std::vector<std::string>& names);

// Checks of options that CLI11's own let too much through.

/// CLI::Range lets "nan" pass.
[[nodiscard]] CLI::Validator number_between(double least, double most);
/// An unsigned option takes "-1" for its largest value.
[[nodiscard]] CLI::Validator whole_number();
[[nodiscard]] CLI::Validator whole_number_between(int least, int most);
/// One of these words; says which is near to a wrong one.
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

/// Throws std::runtime_error for an angle of more than a full turn, which is one in degrees.
void assert_radians(const std::string& what, double angle_rad);

}  // namespace graben::cli
