// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/machines/task_text.hpp"
#include "app/reports/run_reports.hpp"
#include "app/runs/autodig_run.hpp"
#include "app/runs/code_text.hpp"
#include "app/runs/held_lately.hpp"
#include "app/runs/plant_faults.hpp"
#include "app/runs/run_log.hpp"
#include "app/scope/page/scope_page.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

/// Less under a design is not worth a word.
constexpr double kOverCut_m = 1e-3;
/// Of the area, that is as it should be.
constexpr double kBuilt = 0.95;

/// As limit_words(), but with the fence's name: a log has only its number.
std::string limit_name(const machines::TaskFile& task, const Limit& limit) {
  const bool fence =
      limit.kind == LimitKind::kFence && limit.index < task.result.program.fences.count;
  return fence ? machines::fence_name(task.request, limit.index)
               : runs::limit_words(limit, runs::excavator_actuators());
}

void name_fences(const machines::TaskFile& task, runs::LimitShares& shares) {
  for (int i = 0; i < task.result.program.fences.count; ++i) {
    const Limit limit{LimitKind::kFence, static_cast<std::uint8_t>(i)};
    const std::string number = runs::limit_words(limit, runs::excavator_actuators());
    for (auto& [words, share] : shares) {
      words = words == number ? limit_name(task, limit) : words;
    }
  }
}

void throw_unless_done(const machines::TaskFile& task, const runs::AutodigResult& result) {
  if (result.end == runs::AutodigEnd::kFault) {
    throw std::runtime_error(
        fmt::format("the controller stopped with a fault: {} (fault {}){}",
                    runs::fault_words(result.fault), static_cast<int>(result.fault),
                    runs::held_lately(result.fault, result.samples, runs::excavator_actuators())));
  }
  if (result.end == runs::AutodigEnd::kNotFinished) {
    const runs::AutodigSample& last = result.samples.back();
    throw std::runtime_error(
        fmt::format("the task was not finished in time: step {} ({}) at {:.0f} %, held by {}; "
                    "--seconds gives it more than these {:.0f} s",
                    last.progress.step, machines::step_name(last.progress.kind),
                    100.0 * last.progress.share, limit_name(task, last.limit), last.time_s));
  }
}

}  // namespace

void run_task(const TaskCommand& options) {
  if (!options.scenario.start.empty()) {
    assert_radians("--start: attitude", options.scenario.start.back());
  }
  machines::SimulatedExcavator machine =
      runs::arranged(machines::load_simulated_excavator(machines::find_profile(options.profile),
                                                        options.simulated),
                     options.scenario);
  const machines::TaskFile task = runs::planned_task(options.scenario, machine.profile);
  runs::AutodigOptions run =
      runs::usual_run(options.scenario, machine.profile, task.result.program);
  const std::string slow =
      demand_known(machine, machines::needed_drives(machine.profile, task.result.program),
                   options.unknown_drives);
  run.store = options.store;
  run.faults = options.faults;
  run.most_s = options.most_s;
  const fs::path out(options.out);
  const fs::path report = out / (options.name + ".html");
  run.log_file = out / (options.name + ".log");
  assert_apart({}, {run.log_file.string(), report.string(), options.summary});
  fs::create_directories(out);
  make_folder_of(options.summary);
  runs::AutodigResult result;
  {
    ProgressBar bar(options.name);
    result = runs::run_autodig(machine, task.result.program, run, bar.progress_until_stopped());
  }
  runs::AutodigSummary summary = runs::summarise(task.result.program, result);
  summary.limit_share = runs::logged_limit_shares(run.log_file);
  name_fences(task, summary.limit_share);
  summary.raised_max_m = machines::most_raised_m(task.request, task.result);
  reports::write_autodig_report(
      {report, scope::scope_page()}, run.log_file, machine, task, result, summary,
      fmt::format("{} | task {} | {} | speed {:.0f} %{}{}", runs::machine_text(machine),
                  options.scenario.task, runs::machine_text(options.scenario),
                  run.speed_override_ratio * 100.0, slow.empty() ? "" : " | " + slow,
                  runs::told_faults_subtitle(options.faults)));
  if (!options.summary.empty()) {
    reports::write_autodig_summary(options.summary, summary);
  }
  fmt::print("{}{}{}log     {}\nreport  {}\n", runs::steps_text(summary),
             machines::raised_text(task.request, task.result),
             runs::figures_text(runs::headed_figures(summary)), run.log_file.string(),
             report.string());
  if (summary.over_cut_max_m > kOverCut_m) {
    fmt::print("the edge was up to {:.0f} mm under the design\n", 1e3 * summary.over_cut_max_m);
  }
  if (task.result.program.layers.step >= 0 && options.scenario.soil.empty()) {
    fmt::print("no ground was there to be dug: --soil lays some\n");
  }
  if (result.end == runs::AutodigEnd::kDone && summary.built.within_ratio < kBuilt) {
    fmt::print(
        "ground was left: {:.0f} % of the area is within 30 mm of the design, {:.2f} m3 stand "
        "higher\n",
        1e2 * summary.built.within_ratio, summary.built.left_m3);
  }
  fmt::print("{}",
             runs::told_faults_text(options.faults, result.faults_left,
                                    result.samples.empty() ? 0.0 : result.samples.back().time_s,
                                    result.fault != Fault::kNone));
  throw_unless_done(task, result);
}

void add_autodig(CLI::App& app, int& status) {
  auto options = std::make_shared<TaskCommand>();
  CLI::App* command = add_command(app, "autodig");
  add_profile_option(*command, options->profile);
  command->add_option("--out", options->out, "Folder for autodig.log and autodig.html")
      ->capture_default_str();
  add_summary_option(*command, options->summary);
  command->add_option("--store", options->store,
                      "Folder for the controller's as-built record, as graben-ecu keeps it: what "
                      "is there is gone on with");
  add_simulated_options(*command, options->simulated);
  add_task_options(*command, options->scenario);
  add_unknown_drives_option(*command, options->unknown_drives);
  add_fault_option(*command, options->faults);
  add_seconds_option(*command, options->most_s,
                     "a minute and ten times what is planned, in layers what is planned for them");
  command->add_option("--seed", options->scenario.seed, "Of --errors, a whole number from 0")
      ->check(whole_number())
      ->capture_default_str();
  add_examples(*command, {"autodig --task trench --soil loam --errors all",
                          "autodig --task flatten --out out/flat --summary out/flat.json"});
  command->callback(
      [options, &status] { status = guarded("autodig", [&] { run_task(*options); }); });
}

}  // namespace graben::cli
