#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/autodig_command.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/guarded.hpp"
#include "app/cli/scenario_options.hpp"
#include "app/cli/validators.hpp"
#include "app/plant/random.hpp"
#include "app/reports/dig_report.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/fault_text.hpp"
#include "app/runs/progress_bar.hpp"

namespace graben::cli {
namespace {

struct DigCommand {
  ScenarioOptions scenario;
  std::optional<std::string> profile;
  std::optional<std::string> task;
  std::string out = "out";
  std::string summary;
  std::vector<double> start_strokes_m;
  std::vector<double> start_pose;
  bool random_start = false;
  std::uint64_t seed = 1;
  double speed = 1.0;
  std::optional<double> loops;
};

Eigen::Vector3d random_strokes(const ExcavatorGeometry& geometry, std::uint64_t seed) {
  plant::Random random(seed, plant::Draw::kStart);
  Eigen::Vector3d strokes_m;
  for (unsigned i = 0; i < kAxisCount; ++i) {
    strokes_m[i] = random.uniform() * geometry.cylinder[i].stroke_m;
  }
  return strokes_m;
}

/// Where the options say it, if they do.
std::optional<Eigen::Vector3d> start_strokes(const DigCommand& options,
                                             const ExcavatorProfile& profile) {
  if (options.random_start) {
    return random_strokes(profile.geometry, options.seed);
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
  ScenarioOptions scenario = options.scenario;
  scenario.scenario.seed = options.seed;
  const machines::SimulatedExcavator machine =
      arranged(machines::load_simulated_excavator(
                   machines::find_profile(options.profile.value_or("excavator_22t"))),
               scenario);
  runs::DigOptions run_options = usual_run(machine, scenario);
  run_options.start_strokes_m =
      start_strokes(options, machine.profile).value_or(run_options.start_strokes_m);
  run_options.speed_override_ratio = options.speed;
  run_options.loops = options.loops.value_or(run_options.loops);
  const std::filesystem::path out(options.out);
  std::filesystem::create_directories(out);
  run_options.log_file = out / "dig.log";

  runs::DigResult result;
  {
    runs::ProgressBar bar("dig");
    result = runs::run_dig(machine, run_options,
                           [&](double share, const std::string& where) { bar.show(share, where); });
  }
  const runs::DigSummary summary = runs::summarise(result);
  const std::filesystem::path report = out / "dig.html";
  reports::write_dig_report(
      report, run_options.log_file, machine, result, summary,
      fmt::format("{} | {} | start strokes {:.3f}, {:.3f}, {:.3f} m | speed {:.0f} %", machine.name,
                  scenario_words(scenario), run_options.start_strokes_m[0],
                  run_options.start_strokes_m[1], run_options.start_strokes_m[2],
                  options.speed * 100.0));
  if (!options.summary.empty()) {
    reports::write_dig_summary(options.summary, summary);
  }
  fmt::print("{}log     {}\nreport  {}\n", reports::dig_table(summary),
             run_options.log_file.string(), report.string());
  if (result.end != runs::DigEnd::kDone) {
    throw std::runtime_error(result.end == runs::DigEnd::kFault
                                 ? fmt::format("{}: {} (fault {})", end_text(result.end),
                                               runs::fault_words(result.fault),
                                               static_cast<int>(result.fault))
                                 : end_text(result.end));
  }
}

/// What can be told of a task's run too, in the words of `autodig`.
TaskRunOptions task_run(const DigCommand& options) {
  TaskRunOptions run;
  run.profile = options.profile.value_or(run.profile);
  run.task = options.task.value_or(run.task);
  run.out = options.out;
  run.name = "dig";
  run.summary = options.summary;
  run.errors = options.scenario.errors;
  run.seed = options.seed;
  run.speed = options.speed;
  return run;
}

/// Adds --task, which goes with none of the options that are of Kim's path alone.
void add_task(CLI::App& command, DigCommand& options) {
  CLI::Option* task = command.add_option("--task", options.task,
                                         "Run a task of straight lines instead, as `autodig` does: "
                                         "a file, or the name of one of ours");
  for (const char* of_the_path :
       {"--soil", "--air", "--obstacle", "--stiff-oil", "--dead-time", "--fixed-lambda",
        "--start-strokes", "--start", "--random-start", "--loops"}) {
    task->excludes(command.get_option(of_the_path));
  }
}

}  // namespace

void add_dig(CLI::App& app, int& status) {
  auto options = std::make_shared<DigCommand>();
  CLI::App* command = app.add_subcommand(
      "dig", "Dig round Kim's path on the simulated machine, over a CAN bus in memory");
  command->add_option("--profile", options->profile,
                      "Machine profile: file or shipped name; excavator_22t unless told, with "
                      "--task excavator_12t");
  command->add_option("--out", options->out, "Folder for dig.log and dig.html")
      ->capture_default_str();
  command->add_option("--summary", options->summary, "Write the figures as JSON to this file");
  options->scenario.errors = "none";
  add_scenario_options(*command, options->scenario);
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
  command->add_option("--speed", options->speed, "Operator's speed override, 0.05 .. 1")
      ->check(number_between(0.05, 1.0))
      ->capture_default_str();
  command
      ->add_option("--loops", options->loops, "Times round the path, 0.1 .. 100; once unless told")
      ->check(number_between(0.1, 100.0));
  add_task(*command, *options);
  command->callback([options, &status] {
    status = guarded("dig", [&] {
      if (options->task) {
        run_task(task_run(*options));
      } else {
        dig(*options);
      }
    });
  });
}

}  // namespace graben::cli
