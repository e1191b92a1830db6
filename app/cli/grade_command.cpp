// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/cli/output_file.hpp"
#include "app/machines/design_file.hpp"
#include "app/reports/figure/paper_figures.hpp"
#include "app/reports/run_reports.hpp"
#include "app/runs/fastest_speed.hpp"
#include "app/runs/grade_run.hpp"
#include "app/runs/held_lately.hpp"
#include "app/runs/plant_faults.hpp"
#include "app/runs/run_log.hpp"
#include "app/runs/speed_table.hpp"
#include "app/scope/page/scope_page.hpp"

namespace graben::cli {
namespace {

struct GradeCommand {
  runs::GradeScenario scenario;
  std::string profile = "dozer_9t";
  std::string out = "out";
  std::string log;
  std::string summary;
  std::optional<std::uint64_t> seed;
  std::optional<double> within_m;
  design::DesignSource design;
  int compared = 0;  ///< Of the sample designs.
  std::vector<std::string> figures;
  std::vector<std::string> faults;
  std::optional<double> most_s;
  std::string unknown_drives;  ///< See demand_known().
};

std::string end_text(const runs::GradeResult& result) {
  return result.end == runs::GradeEnd::kFault
             ? fmt::format("the controller stopped with a fault: {} (fault {}){}",
                           runs::fault_words(result.fault), static_cast<int>(result.fault),
                           runs::held_lately(result.fault, result.samples, runs::dozer_actuators()))
             : fmt::format(
                   "the grade was not finished in time; --seconds gives it more than these {:.0f} "
                   "s",
                   result.samples.empty() ? 0.0 : result.samples.back().time_s);
}

/// And its design along the track, where a file of its own has it.
Designed machine_of(const GradeCommand& options) {
  if (options.scenario.errors == "all" && !options.seed) {
    throw std::runtime_error("--errors all draws the errors: it needs --seed");
  }
  Designed result = designed(
      machines::load_simulated_dozer(machines::find_profile(options.profile)), options.design);
  result.machine = runs::arranged(result.machine, options.scenario, options.seed.value_or(0));
  return result;
}

std::string subtitle_of(const GradeCommand& options, const machines::SimulatedDozer& machine) {
  const std::string seed = options.seed ? fmt::format(" | seed {}", *options.seed) : "";
  const std::string design =
      options.design.file.empty() ? "" : " | " + options.design.file.filename().string();
  return fmt::format("{}{} | {}{}{}", machine.name, design,
                     runs::scenario_text(machine, options.scenario), seed,
                     runs::told_faults_subtitle(options.faults));
}

/// A figure that is of a constant speed brings it, unless another one is of a bounded speed.
GradeCommand with_speed_of_figures(GradeCommand options) {
  const bool all_constant =
      !options.figures.empty() &&
      std::all_of(options.figures.begin(), options.figures.end(), reports::is_of_constant_speed);
  if (all_constant) {
    options.scenario.speed_mode = "constant";
  }
  return options;
}

void grade(const GradeCommand& told) {
  const GradeCommand options = with_speed_of_figures(told);
  const runs::GradeScenario& scenario = options.scenario;
  auto [machine, line] = machine_of(options);
  const std::filesystem::path out(options.out);
  runs::GradeOptions run;
  run.faults = options.faults;
  run.most_s = options.most_s;
  const std::string slow = demand_known(machine, options.unknown_drives);
  const std::filesystem::path report = out / "grade.html";
  run.log_file = options.log.empty() ? out / "grade.log" : std::filesystem::path(options.log);
  const std::filesystem::path design = out / "design.txt";
  const std::string source = options.design.file.string();
  const bool is_constant = scenario.speed_mode == "constant";
  reports::assert_mononen_figures(options.figures, is_constant);
  std::vector<std::string> written = {report.string(), run.log_file.string(), options.summary,
                                      design.string()};
  for (const std::string& name : options.figures) {
    written.push_back((out / (name + ".svg")).string());
  }
  assert_apart(source.empty() ? std::vector<std::string>{} : std::vector<std::string>{source},
               written);
  std::filesystem::create_directories(out);
  make_folder_of(run.log_file);
  make_folder_of(options.summary);
  if (!line.corners.empty()) {
    const std::string note = machines::wall_note(line, machine.profile.grade.rounding_m);
    fmt::print("{}{}{}", note.empty() ? "" : "note: ", note, note.empty() ? "" : "\n");
    machines::write_design(design, line);
  }

  runs::GradeResult result;
  {
    ProgressBar bar("grade");
    result = runs::run_grade(machine, run, bar.progress_until_stopped());
  }
  runs::GradeSummary summary = runs::summarise(machine, result);
  summary.limit_share = runs::logged_limit_shares(run.log_file);
  const runs::RunFigures figures = runs::headed_figures(summary);
  reports::write_grade_report({report, scope::scope_page()}, run.log_file, machine, result, summary,
                              subtitle_of(options, machine) + (slow.empty() ? "" : " | " + slow));
  if (!options.summary.empty()) {
    reports::write_summary(options.summary, figures);
  }
  fmt::print("{}log     {}\nreport  {}\n", runs::figures_text(figures), run.log_file.string(),
             report.string());
  if (!line.corners.empty()) {
    fmt::print("design  {}\n", design.string());
  }
  for (const std::string& name : options.figures) {
    const std::filesystem::path file = out / (name + ".svg");
    write_whole(file, reports::svg_text(
                          reports::mononen_figure(name, is_constant, machine, result, summary)));
    fmt::print("figure  {}\n", file.string());
  }
  fmt::print("{}",
             runs::told_faults_text(options.faults, result.faults_left,
                                    result.samples.empty() ? 0.0 : result.samples.back().time_s,
                                    result.fault != Fault::kNone));
  if (result.end != runs::GradeEnd::kDone) {
    throw std::runtime_error(end_text(result));
  }
  const std::string missed = runs::out_of_tolerance(summary, machine.profile.grade.tolerance_m);
  if (is_constant && !missed.empty()) {
    fmt::print(
        "{}; status 0 all the same: --speed-mode constant leaves out the controller's bound "
        "of speed, to show what that costs\n",
        missed);
  } else if (!missed.empty()) {
    throw std::runtime_error(missed);
  }
}

/// Where speeds are looked for, none can be taken off.
void demand_every_drive(machines::SimulatedDozer& machine) {
  static_cast<void>(demand_known(machine, std::string()));
}

/// Fastest speed without the controller's bound.
void search(const GradeCommand& options) {
  if (options.scenario.speed_mode != "constant") {
    throw std::runtime_error("--within looks for a constant speed: it needs --speed-mode constant");
  }
  machines::SimulatedDozer machine = machine_of(options).machine;
  demand_every_drive(machine);
  make_folder_of(options.summary);
  runs::FastestSpeed result;
  {
    ProgressBar bar("grade");
    result =
        runs::find_fastest(machine, *options.within_m,
                           [&](double share, const std::string& where) { bar.show(share, where); });
  }
  fmt::print("{}", runs::fastest_table(result, *options.within_m));
  if (!result.found) {
    throw std::runtime_error(
        fmt::format("no constant speed from {} m/s on keeps the grade within {} m",
                    runs::kSlowestTrial_mps, *options.within_m));
  }
  if (!options.summary.empty()) {
    reports::write_summary(options.summary, runs::figures_of(result.found->summary));
  }
}

/// Bounded against constant speed, design by design.
void compare(const GradeCommand& options) {
  if (!options.design.file.empty() || options.within_m) {
    throw std::runtime_error(
        "--compare-speeds has its own designs and bounds: it does not go with "
        "--design or --within");
  }
  if (options.scenario.errors == "all" && !options.seed) {
    throw std::runtime_error("--errors all draws the errors: it needs --seed");
  }
  machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile(options.profile));
  demand_every_drive(machine);
  std::vector<runs::SpeedRow> rows;
  {
    ProgressBar bar("grade");
    rows = runs::compare_speeds(machine, options.scenario, options.seed.value_or(0),
                                static_cast<std::size_t>(options.compared), bar.progress());
  }
  fmt::print("{}", runs::speed_table(rows, options.scenario, machine.profile.grade.tolerance_m));
}

}  // namespace

void add_grade(CLI::App& app, int& status) {
  auto options = std::make_shared<GradeCommand>();
  CLI::App* command = add_command(app, "grade");
  add_profile_option(*command, options->profile);
  command->add_option("--out", options->out, "Folder for grade.log and grade.html")
      ->capture_default_str();
  command->add_option("--log", options->log, "candump log; grade.log in that folder unless told");
  add_summary_option(*command, options->summary);
  add_design_options(*command, options->design);
  add_speed_options(*command, options->scenario);
  add_engine_option(*command, options->scenario);
  add_ground_options(*command, options->scenario);
  add_lateness_options(*command, options->scenario);
  add_error_option(*command, options->scenario);
  add_fault_option(*command, options->faults);
  add_unknown_drives_option(*command, options->unknown_drives);
  add_seconds_option(*command, options->most_s,
                     "ten times what the wanted speed needs, and 20 s, of each pass");
  command->add_option("--seed", options->seed, "Of --errors, a whole number from 0")
      ->check(whole_number());
  add_figure_option(*command, options->figures, reports::mononen_figure_names());
  command
      ->add_option("--within", options->within_m,
                   "Instead of one run: the fastest constant speed up to the wanted one whose "
                   "true edge stays this near to the grade, m, 0.001 .. 1")
      ->check(number_between(0.001, 1.0));
  command
      ->add_option(
          "--compare-speeds", options->compared,
          "Instead of one run: the first so many of 11 sample designs (the trench with "
          "walls of 1, 1.5, 2, 3 m, sines, steps, V, level), 1 .. 11; each bounded, and at "
          "the fastest constant speed with the same error and within grade.tolerance")
      ->check(whole_number_between(1, 11));
  add_examples(*command, {"grade", "grade --figure mononen7,mononen8",
                          "grade --speed-mode constant --within 0.02",
                          "grade --design trench.xml --track 100,200,127,200 --datum 54.3"});
  command->callback([options, &status] {
    status = guarded("grade", [&] {
      options->compared > 0 ? compare(*options)
                            : (options->within_m ? search(*options) : grade(*options));
    });
  });
}

}  // namespace graben::cli
