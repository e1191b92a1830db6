#include "app/cli/autodig_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/cli/commands.hpp"
#include "app/cli/guarded.hpp"
#include "app/cli/scenario_options.hpp"
#include "app/cli/validators.hpp"
#include "app/machines/plan_text.hpp"
#include "app/machines/task_text.hpp"
#include "app/reports/autodig_report.hpp"
#include "app/runs/autodig_run.hpp"
#include "app/runs/fault_text.hpp"
#include "app/runs/progress_bar.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

/// The task as its file has it, but for the pace of its first line where that is told.
machines::TaskFile planned(const TaskRunOptions& options, const ExcavatorProfile& profile) {
  machines::TaskFile task = machines::load_task(machines::find_task(options.task), profile);
  if (!options.duration_s) {
    return task;
  }
  auto* const end = task.request.step.begin() + task.request.step_count;
  auto* const line = std::find_if(task.request.step.begin(), end,
                                  [](const StepRequest& step) { return step.straight; });
  if (line == end) {
    throw std::runtime_error("--duration: the task has no straight step");
  }
  line->duration_s = *options.duration_s;
  line->speed_mps = 0.0;
  task.result = plan_program(profile, task.request);
  if (task.result.refusal != ProgramRefusal::kNone) {
    throw std::runtime_error(machines::program_refusal_words(profile, task.request, task.result));
  }
  return task;
}

DriveVector start_of(const TaskRunOptions& options, const ExcavatorProfile& profile,
                     const TaskProgram& program) {
  if (options.start.empty()) {
    return program.start;
  }
  const TeethPose teeth = {{options.start[0], options.start[1], options.start[2]},
                           options.start[3]};
  const DriveResult drives = SwingKinematics(profile.geometry).drive_from_teeth(teeth);
  if (drives.blind.kind != BlindKind::kNone) {
    throw std::runtime_error(
        fmt::format("--start: {}", machines::blind_words(profile.geometry, drives.blind)));
  }
  return drives.value;
}

machines::SimulatedExcavator machine_of(const TaskRunOptions& options) {
  ScenarioOptions scenario;
  scenario.errors = options.errors;
  scenario.scenario.seed = options.seed;
  machines::SimulatedExcavator machine = arranged(
      machines::load_simulated_excavator(machines::find_profile(options.profile)), scenario);
  if (options.swash) {
    std::fill_n(machine.profile.dig_swash_ratio.begin(), machine.profile.pump_count,
                *options.swash);
    machine.plant.swash_ratio = machine.profile.dig_swash_ratio;
  }
  return machine;
}

void throw_unless_done(const runs::AutodigResult& result) {
  if (result.end == runs::AutodigEnd::kFault) {
    throw std::runtime_error(fmt::format("the controller stopped with a fault: {} (fault {})",
                                         runs::fault_words(result.fault),
                                         static_cast<int>(result.fault)));
  }
  if (result.end == runs::AutodigEnd::kNotFinished) {
    const runs::AutodigSample& last = result.samples.back();
    throw std::runtime_error(fmt::format(
        "the task was not finished in time: step {} ({}) at {:.0f} %, held by {}",
        last.progress.step, machines::step_name(last.progress.kind), 100.0 * last.progress.share,
        runs::limit_words(last.limit, runs::excavator_actuators())));
  }
}

}  // namespace

void run_task(const TaskRunOptions& options) {
  const machines::SimulatedExcavator machine = machine_of(options);
  const machines::TaskFile task = planned(options, machine.profile);
  const TaskProgram& program = task.result.program;
  runs::AutodigOptions run;
  run.start = start_of(options, machine.profile, program);
  run.speed_override_ratio = options.speed;
  run.rounds = program.repeats ? options.rounds : 1;
  const fs::path out(options.out);
  fs::create_directories(out);
  run.log_file = out / (options.name + ".log");
  runs::AutodigResult result;
  {
    runs::ProgressBar bar(options.name);
    result = runs::run_autodig(machine, program, run, [&](double share, const std::string& where) {
      bar.show(share, where);
    });
  }
  const runs::AutodigSummary summary = runs::summarise(program, result);
  const fs::path report = out / (options.name + ".html");
  reports::write_autodig_report(
      report, run.log_file, machine, task, result, summary,
      fmt::format("{} | task {} | errors {} | speed {:.0f} %", machine.name, options.task,
                  options.errors, options.speed * 100.0));
  if (!options.summary.empty()) {
    reports::write_autodig_summary(options.summary, summary);
  }
  fmt::print("{}log     {}\nreport  {}\n", reports::autodig_table(summary), run.log_file.string(),
             report.string());
  throw_unless_done(result);
}

void add_autodig(CLI::App& app, int& status) {
  auto options = std::make_shared<TaskRunOptions>();
  CLI::App* command = app.add_subcommand(
      "autodig",
      "Run a task of straight lines, with swing, on the simulated machine, over a CAN bus in "
      "memory. The task is planned first; one that can't be had ends with status 1 and says where");
  command->add_option("--profile", options->profile, "Machine profile: file or shipped name")
      ->capture_default_str();
  command->add_option("--task", options->task, "Task file, or the name of one of ours")
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for autodig.log and autodig.html")
      ->capture_default_str();
  command->add_option("--summary", options->summary, "Write the figures as JSON to this file");
  command
      ->add_option("--errors", options->errors,
                   "What the controller does not know: none, stroke-bias, sensors, parameters, all")
      ->check(CLI::IsMember({"none", "stroke-bias", "sensors", "parameters", "all"}))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of --errors, a whole number from 0")
      ->check(whole_number())
      ->capture_default_str();
  command
      ->add_option("--start", options->start,
                   "Teeth x,y,z in m and attitude in rad that the machine stands at; where the "
                   "task begins unless told")
      ->delimiter(',')
      ->expected(4);
  command->add_option("--speed", options->speed, "Operator's speed override, 0.05 .. 1")
      ->check(number_between(0.05, 1.0))
      ->capture_default_str();
  command->add_option("--swash", options->swash, "Swash of the pumps, 0.05 .. 1, not the profile's")
      ->check(number_between(0.05, 1.0));
  command
      ->add_option("--duration", options->duration_s,
                   "Of the first straight step, s; longer where a drive's limit asks for it")
      ->check(number_between(0.1, 3600.0));
  command->add_option("--rounds", options->rounds, "Of a task that repeats, 1 .. 1000")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback(
      [options, &status] { status = guarded("autodig", [&] { run_task(*options); }); });
}

}  // namespace graben::cli
