// SPDX-License-Identifier: Apache-2.0
#include "app/runs/scenarios.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "app/machines/task_text.hpp"
#include "app/plant/random.hpp"
#include "app/runs/found_text.hpp"
#include "firmware/excavator/motion/program/task_run.hpp"
#include "firmware/numeric/constants.hpp"

namespace graben::runs {
namespace {

/// Off the path; what is compared with then goes on.
constexpr double kNeverSlow_m = 1e3;
/// What is dug in layers ends when its design is met.
constexpr int kRoundsOfLayers = 60;
constexpr double kRadpsPerRpm = kTwoPi / 60.0;

machines::Errors errors_of(const std::string& name) {
  const auto* found = std::find(kErrorNames.begin(), kErrorNames.end(), name);
  if (found == kErrorNames.end()) {
    throw std::runtime_error(fmt::format("--errors: '{}' is unknown", name));
  }
  return static_cast<machines::Errors>(found - kErrorNames.begin());
}

void set_law(const std::string& name, ExcavatorProfile& profile) {
  if (name.empty()) {
    return;
  }
  const auto* found = std::find(machines::kLawNames.begin(), machines::kLawNames.end(), name);
  if (found == machines::kLawNames.end()) {
    throw std::runtime_error(fmt::format("--law: '{}' is unknown", name));
  }
  profile.control.law = static_cast<ControlLaw>(found - machines::kLawNames.begin());
  if (profile.control.law == ControlLaw::kOil && !profile.oil.known()) {
    throw std::runtime_error("--law oil: the profile has no section [oil]");
  }
}

/// Constant, of every pump, from the machine's first moment on.
void set_swash(std::optional<double> swash_ratio, machines::SimulatedExcavator& machine) {
  if (!swash_ratio) {
    return;
  }
  ExcavatorProfile& profile = machine.profile;
  if (profile.pump[0].regulator.sets_swash()) {
    throw std::runtime_error("--swash: the pumps of this machine set their swash themselves");
  }
  std::fill_n(profile.dig_swash_ratio.begin(), profile.pump_count, *swash_ratio);
  profile.demand_swash = {};
  machine.plant.swash_ratio = profile.dig_swash_ratio;
}

std::string errors_text(const std::string& errors, const machines::Found& found) {
  const std::string told = found_text(found);
  return told.empty() ? fmt::format("errors {}", errors)
                      : fmt::format("errors {}, found {}", errors, told);
}

}  // namespace

machines::SimulatedExcavator arranged(const machines::SimulatedExcavator& machine,
                                      const DigScenario& scenario) {
  machines::Scenario tried = scenario.scenario;
  tried.errors = errors_of(scenario.errors);
  tried.ground_at_line = true;
  machines::SimulatedExcavator result = machines::arranged(machine, tried);
  set_law(scenario.law, result.profile);
  set_swash(scenario.swash_ratio, result);
  if (scenario.fixed_lambda) {
    result.profile.control.lambda_policy = McvPolicy::kFixed;
    // Nor does anything else slow it, or stop it off its path. A boom that sinks against its open
    // spool, since another drive takes the flow, is what lambda is for.
    result.profile.bus.spool_feedback = false;
    result.profile.safety.tube_m = kNeverSlow_m;
    result.profile.control.slow_error_m = kNeverSlow_m;
  }
  return result;
}

std::string scenario_text(const DigScenario& scenario) {
  std::vector<std::string> parts;
  const auto add = [&parts](bool is_on, const char* part) {
    if (is_on) {
      parts.emplace_back(part);
    }
  };
  add(scenario.scenario.soil, "soil");
  add(!scenario.scenario.ground.empty(), scenario.scenario.ground.c_str());
  add(scenario.scenario.air, "air");
  add(scenario.scenario.obstacle, "obstacle");
  add(scenario.scenario.stiff_oil, "stiff oil");
  add(scenario.fixed_lambda, "lambda fixed at 1");
  add(scenario.scenario.imus, "IMUs");
  add(scenario.scenario.seconds, "second sensors");
  if (scenario.scenario.imu_mounting_rad > 0.0) {
    parts.push_back(
        fmt::format("IMUs turned by up to {:.6g} rad", scenario.scenario.imu_mounting_rad));
  }
  if (!scenario.scenario.without.empty()) {
    parts.push_back(fmt::format("without {}", fmt::join(scenario.scenario.without, ",")));
  }
  if (!scenario.scenario.bus.empty()) {
    parts.push_back("bus " + std::filesystem::path(scenario.scenario.bus).stem().string());
  }
  if (scenario.scenario.dead_time_s) {
    parts.push_back(fmt::format("dead time {} s", *scenario.scenario.dead_time_s));
  }
  if (!scenario.law.empty()) {
    parts.push_back("law " + scenario.law);
  }
  if (scenario.swash_ratio) {
    parts.push_back(fmt::format("swash {}", *scenario.swash_ratio));
  }
  parts.push_back(errors_text(scenario.errors, scenario.scenario.found));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string machine_text(const machines::SimulatedExcavator& machine) {
  return machine.simulated.empty() ? machine.name
                                   : fmt::format("{} as {}", machine.name, machine.simulated);
}

DigOptions usual_run(const machines::SimulatedExcavator& machine, const DigScenario& scenario) {
  DigOptions run;
  if (scenario.scenario.air) {
    const machines::AirManoeuvre& air = machine.experiment.air;
    run.start_strokes_m = machines::strokes_at(machine.profile, air.start);
    run.loops = air.loops;
    return run;
  }
  run.start_strokes_m = machines::dig_start(machine.profile);
  return run;
}

Eigen::Vector3d random_strokes(const ExcavatorGeometry& geometry, std::uint64_t seed) {
  plant::Random random(seed, plant::Draw::kStart);
  Eigen::Vector3d strokes_m;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    strokes_m[i] = random.uniform() * geometry.cylinder[i].stroke_m;
  }
  return strokes_m;
}

machines::SimulatedDozer arranged(const machines::SimulatedDozer& machine,
                                  const GradeScenario& scenario, std::uint64_t seed) {
  machines::DozerScenario tried;
  tried.policy = scenario.speed_mode == "constant" ? SpeedPolicy::kConstant : SpeedPolicy::kBounded;
  tried.speed_mps = scenario.speed_mps;
  if (scenario.engine_rpm) {
    tried.engine_radps = *scenario.engine_rpm * kRadpsPerRpm;
  }
  tried.soil = scenario.soil;
  tried.pass_depth_m = scenario.pass_depth_m;
  tried.dead_time_s = scenario.dead_time_s;
  tried.pose_latency_s = scenario.pose_latency_s;
  tried.errors = scenario.errors == "all";
  tried.seed = seed;
  machines::SimulatedDozer result = machines::arranged(machine, tried);
  if (tried.policy == SpeedPolicy::kConstant) {
    // To be measured, not to be stopped.
    result.profile.safety.tube_m = kNeverSlow_m;
  }
  return result;
}

std::string scenario_text(const machines::SimulatedDozer& nominal, const GradeScenario& scenario) {
  const double rpm = scenario.engine_rpm.value_or(nominal.profile.hst.engine_radps / kRadpsPerRpm);
  std::string text = fmt::format(
      "{}, wanted {} m/s, {:.0f} rpm, errors {}", scenario.speed_mode,
      scenario.speed_mps.value_or(nominal.profile.travel.speed_desired_mps), rpm, scenario.errors);
  if (!scenario.soil.empty()) {
    text += ", " + scenario.soil;
  }
  if (scenario.pass_depth_m) {
    text += fmt::format(", passes of {} m", *scenario.pass_depth_m);
  }
  if (scenario.dead_time_s) {
    text += fmt::format(", dead time {} s", *scenario.dead_time_s);
  }
  if (scenario.pose_latency_s) {
    text += fmt::format(", pose latency {} s", *scenario.pose_latency_s);
  }
  return text;
}

machines::SimulatedExcavator arranged(const machines::SimulatedExcavator& machine,
                                      const TaskScenario& scenario) {
  machines::Scenario tried;
  tried.errors = errors_of(scenario.errors);
  tried.found = scenario.found;
  tried.imus = scenario.imus;
  tried.seconds = scenario.seconds;
  tried.ground = scenario.soil;
  tried.seed = scenario.seed;
  machines::SimulatedExcavator result = machines::arranged(machine, tried);
  set_swash(scenario.swash_ratio, result);
  return result;
}

std::string machine_text(const TaskScenario& scenario) {
  std::string text = errors_text(scenario.errors, scenario.found);
  if (scenario.imus) {
    text = "IMUs, " + text;
  }
  if (scenario.seconds) {
    text = "second sensors, " + text;
  }
  return scenario.soil.empty() ? text : fmt::format("{}, {}", scenario.soil, text);
}

namespace {

/// What would be told in vain is refused.
void refuse_idle_options(const TaskScenario& scenario, const TaskProgram& program) {
  const bool layers = program.layers.step >= 0;
  if (scenario.rounds && (layers || program.rounds.is_bounded() || !program.repeats)) {
    throw std::runtime_error(
        fmt::format("--rounds: the task {}; allowed: of one that repeats without end",
                    layers                        ? "is an area, which ends when it is dug"
                    : program.rounds.is_bounded() ? "says itself how often"
                                                  : "does not repeat"));
  }
  if (scenario.duration_s && layers) {
    throw std::runtime_error("--duration: the task is an area, whose cuts take what they need");
  }
  const auto* const end = program.step.begin() + program.step_count;
  const bool waits = std::any_of(program.step.begin(), end,
                                 [](const TaskStep& step) { return step.kind == StepKind::kWait; });
  if (scenario.word_after_s && !waits) {
    throw std::runtime_error("--word-after: the task has no wait");
  }
}

}  // namespace

machines::TaskFile planned_task(const TaskScenario& scenario, const ExcavatorProfile& profile) {
  machines::TaskFile task = machines::load_task(machines::find_task(scenario.task), profile);
  machines::demand_steps(task, "autodig");
  refuse_idle_options(scenario, task.result.program);
  if (!scenario.duration_s) {
    return task;
  }
  auto* const end = task.request.step.begin() + task.request.step_count;
  auto* const line = std::find_if(task.request.step.begin(), end,
                                  [](const StepRequest& step) { return step.straight; });
  if (line == end) {
    throw std::runtime_error("--duration: the task has no straight step");
  }
  line->duration_s = *scenario.duration_s;
  line->speed_mps = 0.0;
  task.result = plan_program(profile, task.request);
  if (task.result.refusal != ProgramRefusal::kNone) {
    throw std::runtime_error(machines::program_refusal_words(profile, task.request, task.result));
  }
  return task;
}

AutodigOptions usual_run(const TaskScenario& scenario, const ExcavatorProfile& profile,
                         const TaskProgram& program) {
  AutodigOptions run;
  run.start = program.start;
  run.speed_override_ratio = scenario.speed_override_ratio;
  run.rounds = scenario.rounds.value_or(1);
  if (program.layers.step >= 0) {
    run.rounds = kRoundsOfLayers;
  }
  if (program.rounds.is_bounded()) {
    run.rounds = program.rounds.count * (1 + kAgainMost);
  }
  run.word_after_s = scenario.word_after_s.value_or(run.word_after_s);
  if (scenario.start.empty()) {
    return run;
  }
  const TeethPose teeth = {{scenario.start[0], scenario.start[1], scenario.start[2]},
                           scenario.start[3]};
  const DriveResult drives = SwingKinematics(profile.geometry).drive_from_teeth(teeth);
  if (drives.blind.kind != BlindKind::kNone) {
    throw std::runtime_error(
        fmt::format("--start: {}", machines::blind_words(profile.geometry, drives.blind)));
  }
  run.start = drives.value;
  return run;
}

}  // namespace graben::runs
