// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Scenarios of runs, as their user says them: the machine that the simulation then has, its start,
/// and the scenario as text.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/machines/axis_names.hpp"
#include "app/machines/simulated/simulated_dozer.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/task_file.hpp"
#include "app/runs/autodig_run.hpp"
#include "app/runs/dig_run.hpp"

namespace graben::runs {

/// Errors that an excavator's controller does not know of, in the order of machines::Errors.
inline constexpr std::array<const char*, 6> kErrorNames = {"none",       "stroke-bias", "sensors",
                                                           "parameters", "kim",         "all"};

struct DigScenario {
  machines::Scenario scenario;  ///< Its errors come from the name below.
  bool fixed_lambda = false;    ///< Lambda stays 1, and nothing else slows the machine.
  std::string errors = "none";  ///< Of kErrorNames.
  std::string law;              ///< Of machines::kLawNames, instead of the profile's; empty: that.
  std::optional<double> swash_ratio;  ///< Constant, of full, instead of what the profile says.
};

/// The machine of this scenario. Throws std::runtime_error for a law that its profile has not the
/// figures for, and for errors that have no such name.
[[nodiscard]] machines::SimulatedExcavator arranged(const machines::SimulatedExcavator& machine,
                                                    const DigScenario& scenario);
/// "soil, dead time 0.15 s, errors kim, found oil 0.7 GPa, exponent 1.4"; soil that is cut by its
/// name. The same text, the same scenario.
[[nodiscard]] std::string scenario_text(const DigScenario& scenario);

/// Start of the bucket and length of its way unless told: machines::dig_start(), once round; in
/// the air as the profile has it. Throws std::runtime_error where that is out of reach.
[[nodiscard]] DigOptions usual_run(const machines::SimulatedExcavator& machine,
                                   const DigScenario& scenario);
/// Any strokes within the cylinders, drawn from the seed.
[[nodiscard]] Eigen::Vector3d random_strokes(const ExcavatorGeometry& geometry, std::uint64_t seed);

/// "excavator_22t", or "excavator_22t as excavator_22t_found hidden 7" where another machine stands
/// in the place of the profile's own.
[[nodiscard]] std::string machine_text(const machines::SimulatedExcavator& machine);

struct GradeScenario {
  std::string speed_mode = "bounded";  ///< Or "constant": the wanted speed, whatever it takes.
  std::optional<double> speed_mps;
  std::optional<double> engine_rpm;
  std::string errors = "none";  ///< Or "all".
  std::string soil;  ///< Of machines::kSoilNames: the ground resists; empty: it does not.
  std::optional<double> pass_depth_m;    ///< Of the first pass.
  std::optional<double> dead_time_s;     ///< Of the blade's valve; both know it.
  std::optional<double> pose_latency_s;  ///< Of the pose sensor; both know it.
};

/// The machine of this scenario. Throws std::runtime_error where its engine can't run so.
[[nodiscard]] machines::SimulatedDozer arranged(const machines::SimulatedDozer& machine,
                                                const GradeScenario& scenario, std::uint64_t seed);
/// "bounded, wanted 1.6 m/s, 1500 rpm, errors all"; the same text, the same scenario.
[[nodiscard]] std::string scenario_text(const machines::SimulatedDozer& nominal,
                                        const GradeScenario& scenario);

struct TaskScenario {
  std::string task = "flatten";  ///< File or shipped name.
  std::string errors = "none";   ///< Of kErrorNames.
  std::string soil;              ///< Of machines::kSoilNames; empty: no ground in the way.
  machines::Found found;         ///< What the machine is told to be.
  bool imus = false;             ///< As machines::Scenario has it.
  bool seconds = false;          ///< The same.
  std::uint64_t seed = 1;
  std::vector<double> start;  ///< Teeth x, y, z in m and attitude in rad; where the task begins.
  double speed_override_ratio = 1.0;
  std::optional<double> swash_ratio;   ///< Of the pumps, instead of the profile's.
  std::optional<double> duration_s;    ///< Of the first straight step.
  std::optional<int> rounds;           ///< Of a task that repeats; once unless told.
  std::optional<double> word_after_s;  ///< Of the operator at a wait; AutodigOptions' unless told.
};

/// The machine of this scenario.
[[nodiscard]] machines::SimulatedExcavator arranged(const machines::SimulatedExcavator& machine,
                                                    const TaskScenario& scenario);
/// "errors kim, found oil 0.7 GPa": what the machine is, not what it is to do.
[[nodiscard]] std::string machine_text(const TaskScenario& scenario);
/// The task as its file has it, but for the pace of its first line where that is told. Throws
/// std::runtime_error where it can't be planned on this machine, or has no use for what is told.
[[nodiscard]] machines::TaskFile planned_task(const TaskScenario& scenario,
                                              const ExcavatorProfile& profile);
/// Start, speed and rounds. Throws std::runtime_error where the start is out of reach.
[[nodiscard]] AutodigOptions usual_run(const TaskScenario& scenario,
                                       const ExcavatorProfile& profile, const TaskProgram& program);

}  // namespace graben::runs
