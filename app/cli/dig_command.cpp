// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/machines/simulated/soil_kinds.hpp"
#include "app/reports/figure/paper_figures.hpp"
#include "app/reports/run_reports.hpp"
#include "app/runs/code_text.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/held_lately.hpp"
#include "app/runs/plant_faults.hpp"
#include "app/runs/run_log.hpp"
#include "app/scope/page/scope_page.hpp"

namespace graben::cli {
namespace {

struct DigCommand {
  runs::DigScenario scenario;
  machines::SimulatedChoice simulated;
  std::optional<std::string> profile;
  std::optional<std::string> task;
  std::string out = "out";
  std::string summary;
  std::vector<double> start_strokes_m;
  std::vector<double> start_pose;
  bool random_start = false;
  std::uint64_t seed = 1;
  double speed = 1.0;
  std::string unknown_drives;  ///< See demand_known().
  std::optional<double> loops;
  std::vector<std::string> figures;
  std::vector<std::string> faults;
};

/// Start that the options name, if they do.
std::optional<Eigen::Vector3d> start_strokes(const DigCommand& options,
                                             const ExcavatorProfile& profile) {
  if (options.random_start) {
    return runs::random_strokes(profile.geometry, options.seed);
  }
  if (!options.start_strokes_m.empty()) {
    const Eigen::Vector3d strokes_m(options.start_strokes_m[0], options.start_strokes_m[1],
                                    options.start_strokes_m[2]);
    for (unsigned i = 0; i < kAxisCount; ++i) {
      const double most_m = profile.geometry.cylinder[i].stroke_m;
      if (!(strokes_m[i] >= 0.0 && strokes_m[i] <= most_m)) {
        throw std::runtime_error(fmt::format(
            "--start-strokes: entry {} is {} m; allowed: 0 .. {} m", i + 1, strokes_m[i], most_m));
      }
    }
    return strokes_m;
  }
  if (!options.start_pose.empty()) {
    assert_radians("--start: attitude", options.start_pose[2]);
    return machines::strokes_at(
        profile, {options.start_pose[0], options.start_pose[1], options.start_pose[2]});
  }
  return std::nullopt;
}

const char* end_text(runs::DigEnd end) {
  switch (end) {
    case runs::DigEnd::kDone:
      return "done";
    case runs::DigEnd::kPathNotReached:
      return "the path was not reached in time";
    case runs::DigEnd::kLoopNotClosed:
      return "the loop was not closed in time";
    case runs::DigEnd::kFault:
      return "the controller stopped with a fault";
  }
  return "unknown";
}

void dig(const DigCommand& options) {
  runs::DigScenario scenario = options.scenario;
  scenario.scenario.seed = options.seed;
  machines::SimulatedExcavator machine = runs::arranged(
      machines::load_simulated_excavator(
          machines::find_profile(options.profile.value_or("excavator_22t")), options.simulated),
      scenario);
  runs::DigOptions run_options = runs::usual_run(machine, scenario);
  run_options.start_strokes_m =
      start_strokes(options, machine.profile).value_or(run_options.start_strokes_m);
  const std::string slow = demand_known(machine, machines::kCylinders, options.unknown_drives);
  run_options.speed_override_ratio = options.speed;
  run_options.loops = options.loops.value_or(run_options.loops);
  run_options.faults = options.faults;
  const std::filesystem::path out(options.out);
  const std::filesystem::path report = out / "dig.html";
  run_options.log_file = out / "dig.log";
  reports::assert_kim_figures(options.figures, machine, scenario.scenario.obstacle);
  std::vector<std::string> written = {run_options.log_file.string(), report.string(),
                                      options.summary};
  for (const std::string& name : options.figures) {
    written.push_back((out / (name + ".svg")).string());
  }
  assert_apart({}, written);
  std::filesystem::create_directories(out);
  make_folder_of(options.summary);

  runs::DigResult result;
  {
    ProgressBar bar("dig");
    result = runs::run_dig(machine, run_options, bar.progress_until_stopped());
  }
  runs::DigSummary summary = runs::summarise(result);
  summary.limit_share = runs::logged_limit_shares(run_options.log_file);
  const runs::RunFigures figures = runs::figures_of(summary);
  reports::write_dig_report(
      {report, scope::scope_page()}, run_options.log_file, machine, result, summary,
      fmt::format("{} | {} | start strokes {:.3f}, {:.3f}, {:.3f} m | speed {:.0f} %{}{}",
                  runs::machine_text(machine), runs::scenario_text(scenario),
                  run_options.start_strokes_m[0], run_options.start_strokes_m[1],
                  run_options.start_strokes_m[2], options.speed * 100.0,
                  slow.empty() ? "" : " | " + slow, runs::told_faults_subtitle(options.faults)));
  if (!options.summary.empty()) {
    reports::write_summary(options.summary, figures);
  }
  fmt::print("{}log     {}\nreport  {}\n", runs::figures_text(figures),
             run_options.log_file.string(), report.string());
  for (const std::string& name : options.figures) {
    const std::filesystem::path file = out / (name + ".svg");
    write_whole(file, reports::svg_text(reports::kim_figure(name, machine, result, summary)));
    fmt::print("figure  {}\n", file.string());
  }
  fmt::print("{}",
             runs::told_faults_text(options.faults, result.faults_left,
                                    result.samples.empty() ? 0.0 : result.samples.back().time_s,
                                    result.fault != Fault::kNone));
  if (result.end != runs::DigEnd::kDone) {
    throw std::runtime_error(
        result.end == runs::DigEnd::kFault
            ? fmt::format(
                  "{}: {} (fault {}){}{}", end_text(result.end), runs::fault_words(result.fault),
                  static_cast<int>(result.fault),
                  runs::held_lately(result.fault, result.samples, runs::excavator_actuators()),
                  runs::emergency_words(result.emergency))
            : end_text(result.end));
  }
}

/// Options that a task's run has too, as `autodig` names them.
TaskCommand task_command(const DigCommand& options) {
  TaskCommand run;
  run.scenario.task = options.task.value_or(run.scenario.task);
  if (options.scenario.scenario.soil) {
    throw std::runtime_error(fmt::format("--soil {}: not with --task; there are {}", kKimSoil,
                                         fmt::join(machines::kSoilNames, ", ")));
  }
  run.scenario.soil = options.scenario.scenario.ground;
  run.scenario.errors = options.scenario.errors;
  run.scenario.found = options.scenario.scenario.found;
  run.scenario.imus = options.scenario.scenario.imus;
  run.scenario.seconds = options.scenario.scenario.seconds;
  run.scenario.seed = options.seed;
  run.scenario.speed_override_ratio = options.speed;
  run.profile = options.profile.value_or(run.profile);
  run.simulated = options.simulated;
  run.out = options.out;
  run.name = "dig";
  run.summary = options.summary;
  run.unknown_drives = options.unknown_drives;
  run.faults = options.faults;
  return run;
}

/// Adds --task, which goes with none of the options that are of Kim's path alone.
void add_task(CLI::App& command, DigCommand& options) {
  CLI::Option* task = command.add_option("--task", options.task,
                                         "Run a task of straight lines instead, as `autodig` does: "
                                         "a file, or the name of one of ours");
  for (const char* of_the_path :
       {"--air", "--obstacle", "--stiff-oil", "--dead-time", "--fixed-lambda", "--law", "--bus",
        "--start-strokes", "--start", "--random-start", "--loops", "--figure"}) {
    task->excludes(command.get_option(of_the_path));
  }
}

}  // namespace

void add_dig(CLI::App& app, int& status) {
  auto options = std::make_shared<DigCommand>();
  CLI::App* command = add_command(app, "dig");
  command->add_option("--profile", options->profile,
                      "Machine profile: file or shipped name; excavator_22t unless told, with "
                      "--task excavator_12t");
  command->add_option("--out", options->out, "Folder for dig.log and dig.html")
      ->capture_default_str();
  add_summary_option(*command, options->summary);
  add_simulated_options(*command, options->simulated);
  add_scenario_options(*command, options->scenario);
  add_found_option(*command, options->scenario.scenario.found);
  command
      ->add_option("--seed", options->seed,
                   "Of --random-start, --errors and --soil, a whole number from 0")
      ->check(whole_number())
      ->capture_default_str();
  auto* start = command->add_option_group("start", "Where the bucket starts");
  start->add_option("--start-strokes", options->start_strokes_m, "Boom,arm,bucket in m")
      ->delimiter(',')
      ->expected(3);
  start->add_option("--start", options->start_pose, "Tip x,y in m and attitude in rad")
      ->delimiter(',')
      ->expected(3);
  start->add_flag("--random-start", options->random_start,
                  "Any pose of the work space, drawn from the seed");
  start->require_option(0, 1);
  add_override_option(*command, options->speed);
  add_unknown_drives_option(*command, options->unknown_drives);
  add_fault_option(*command, options->faults);
  command
      ->add_option("--loops", options->loops, "Times round the path, 0.1 .. 100; once unless told")
      ->check(number_between(0.1, 100.0));
  add_figure_option(*command, options->figures, reports::kim_figure_names());
  add_task(*command, *options);
  add_examples(*command, {"dig", "dig --soil sand --loops 3 --out out/sand",
                          "dig --soil --errors kim --figure kim9,kim11",
                          "dig --random-start --seed 7 --summary out/seven.json"});
  command->callback([options, &status] {
    status = guarded("dig", [&] {
      if (options->task) {
        run_task(task_command(*options));
      } else {
        dig(*options);
      }
    });
  });
}

}  // namespace graben::cli
