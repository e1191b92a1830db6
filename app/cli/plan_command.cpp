// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
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
#include "app/machines/planned_line.hpp"
#include "app/machines/simulated/simulated_excavator.hpp"
#include "app/machines/task_file.hpp"
#include "app/reports/figure/paper_figures.hpp"
#include "app/reports/run_reports.hpp"
#include "app/runs/plan_run.hpp"
#include "app/scope/page/scope_page.hpp"
#include "firmware/excavator/motion/program/line_plan.hpp"

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

struct PlanCommand {
  std::string profile = "excavator_12t";
  std::string task;
  std::vector<double> from;
  std::vector<double> to;
  std::optional<double> duration_s;
  std::optional<double> speed_mps;
  std::optional<double> acceleration_mps2;
  double step_s = 0.05;
  std::string out = "out";
  bool table = false;
  std::vector<std::string> figures;
};

TeethPose pose(const std::vector<double>& given, const TeethPose& otherwise) {
  return given.empty() ? otherwise : TeethPose{{given[0], given[1], given[2]}, given[3]};
}

/// Line of the simulated machine, for what the command does not tell.
machines::LineTask task_of(const PlanCommand& options, const fs::path& file) {
  const bool is_whole = !options.from.empty() && !options.to.empty() &&
                        (options.duration_s.has_value() || options.speed_mps.has_value());
  return is_whole ? machines::LineTask{} : machines::load_simulated_excavator(file).experiment.line;
}

LineRequest request_of(const PlanCommand& options, const machines::ExcavatorMachine& machine,
                       const machines::LineTask& task) {
  LineRequest request{pose(options.from, task.from), pose(options.to, task.to),
                      options.acceleration_mps2.value_or(machine.profile.line.acceleration_mps2)};
  request.speed_mps = options.speed_mps.value_or(0.0);
  request.duration_s = options.duration_s.value_or(options.speed_mps ? 0.0 : task.duration_s);
  return request;
}

std::string pose_text(const TeethPose& teeth) {
  const Eigen::Vector3d& at = teeth.position_m;
  return fmt::format("{:.3f}, {:.3f}, {:.3f} m, {:.3f} rad", at.x(), at.y(), at.z(),
                     teeth.attitude_rad);
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    throw std::runtime_error(fmt::format("{}: can't be written", file.string()));
  }
}

void tell(const PlanCommand& options, const std::vector<runs::PlanSample>& samples,
          const std::string& summary) {
  const fs::path out(options.out);
  write_text(out / "plan.csv", runs::plan_csv(samples));
  fmt::print("{}{}report  {}\n", options.table ? runs::plan_table(samples) + "\n" : "", summary,
             (out / "plan.html").string());
}

/// Texts in the order of `options.figures`. Throws std::runtime_error for another line than theirs.
std::vector<std::string> drawn_figures(const PlanCommand& options, const std::string& machine,
                                       const std::vector<runs::PlanSample>& samples) {
  std::vector<std::string> texts;
  for (const std::string& name : options.figures) {
    texts.push_back(reports::svg_text(reports::zhang_figure(name, machine, samples)));
  }
  return texts;
}

void write_figures(const PlanCommand& options, const std::vector<std::string>& texts) {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const fs::path file = fs::path(options.out) / (options.figures[i] + ".svg");
    write_whole(file, texts[i]);
    fmt::print("figure  {}\n", file.string());
  }
}

/// As `autodig` reads it, and refuses it.
void plan_task(const PlanCommand& options) {
  const machines::ExcavatorMachine machine =
      machines::load_excavator(machines::find_profile(options.profile));
  const machines::TaskFile task =
      machines::load_task(machines::find_task(options.task), machine.profile);
  machines::demand_steps(task, "plan");
  const SwingKinematics kinematics(machine.profile.geometry);
  const std::vector<runs::PlanSample> samples =
      runs::sample_task(machine.profile, kinematics, task.result.program, options.step_s);
  const fs::path out(options.out);
  fs::create_directories(out);
  reports::write_task_plan_report({out / "plan.html", scope::scope_page()}, machine, task, samples,
                                  fmt::format("{} | task {}", machine.name, task.name));
  reports::write_task_plan_json(out / "plan.json", task, machine.profile);
  tell(options, samples, runs::task_summary(task));
}

void plan(const PlanCommand& options) {
  if (!options.task.empty()) {
    plan_task(options);
    return;
  }
  for (const auto* pose : {&options.from, &options.to}) {
    if (!pose->empty()) {
      assert_radians(pose == &options.from ? "--from: attitude" : "--to: attitude", pose->back());
    }
  }
  const fs::path file = machines::find_profile(options.profile);
  const machines::ExcavatorMachine machine = machines::load_excavator(file);
  const ExcavatorProfile& profile = machine.profile;
  const SwingKinematics kinematics(profile.geometry);
  const LineRequest request = request_of(options, machine, task_of(options, file));
  const std::string refusal = machines::line_refusal(profile, request);
  if (!refusal.empty()) {
    throw std::runtime_error(refusal);
  }
  const PlanResult result = plan_line(kinematics, drive_limits(profile), request);
  const std::vector<runs::PlanSample> samples =
      runs::sample_plan(profile, kinematics, result.plan, options.step_s);
  // What they refuse is refused before anything is written.
  const std::vector<std::string> figures = drawn_figures(options, machine.name, samples);
  const fs::path out(options.out);
  fs::create_directories(out);
  reports::write_plan_report({out / "plan.html", scope::scope_page()}, machine, result, samples,
                             fmt::format("{} | from {} | to {}", machine.name,
                                         pose_text(request.from), pose_text(request.to)));
  reports::write_plan_json(out / "plan.json", profile, result, samples);
  tell(options, samples, runs::plan_summary(profile, request, result, samples));
  write_figures(options, figures);
}

}  // namespace

void add_plan(CLI::App& app, int& status) {
  auto options = std::make_shared<PlanCommand>();
  CLI::App* command = add_command(app, "plan");
  add_profile_option(*command, options->profile);
  CLI::Option* const task =
      command->add_option("--task", options->task, "A task by file or name, instead of a line");
  command
      ->add_option("--from", options->from,
                   "Teeth x,y,z in m (x, y level, z up, from the swing axis on the ground), "
                   "attitude in rad (from the teeth to the bucket pin)")
      ->delimiter(',')
      ->expected(4)
      ->excludes(task);
  command->add_option("--to", options->to, "The same at the line's end")
      ->delimiter(',')
      ->expected(4)
      ->excludes(task);
  auto* pace = command->add_option_group("pace", "One of the two; the other is found");
  pace->add_option("--duration", options->duration_s, "s, longer where a limit asks for it")
      ->check(number_between(0.1, 600.0))
      ->excludes(task);
  pace->add_option("--speed", options->speed_mps, "Of the teeth, m/s at most")
      ->check(number_between(0.01, 3.0))
      ->excludes(task);
  pace->require_option(0, 1);
  command
      ->add_option("--acceleration", options->acceleration_mps2,
                   "Of the teeth, m/s2 at most; the profile's unless told")
      ->check(number_between(0.001, 100.0))
      ->excludes(task);
  command->add_option("--step", options->step_s, "Of table, CSV and report, s")
      ->check(number_between(0.01, 60.0))
      ->capture_default_str();
  command->add_option("--out", options->out, "Folder for plan.html, plan.json and plan.csv")
      ->capture_default_str();
  command->add_flag("--table", options->table,
                    "Print displacement, velocity and acceleration of each drive over time");
  add_figure_option(*command, options->figures, reports::zhang_figure_names());
  command->get_option("--figure")->excludes(task);
  add_examples(*command, {"plan --from 5,0,0,1.2 --to 6,0,0,1.2 --speed 0.5",
                          "plan --table --out out/line", "plan --figure zhang5,zhang9"});
  command->callback([options, &status] { status = guarded("plan", [&] { plan(*options); }); });
}

}  // namespace graben::cli
