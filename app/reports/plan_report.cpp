// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/machines/axis_names.hpp"
#include "app/machines/task_text.hpp"
#include "app/reports/page_setup.hpp"
#include "app/reports/report_file.hpp"
#include "app/reports/report_parts.hpp"
#include "app/reports/run_reports.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Zhang's figures 5 to 10: displacement, velocity and acceleration of each drive, the last two
/// with the limit that the plan keeps in that direction.
json truth(const std::vector<runs::PlanSample>& samples, const DriveLimits& limits) {
  Truth<runs::PlanSample> lines(samples);
  lines.add("way", "Teeth along the line", "way", "m", 4,
            [](const runs::PlanSample& s) { return s.way_m; });
  lines.add("teeth_speed", "Speed of the teeth", "along the line", "mm/s", 2,
            [](const runs::PlanSample& s) { return s.speed_mps * kThousandths; });
  const auto add = [&](const char* plot, const char* title, const char* per, unsigned drive,
                       std::array<double, kDriveCount> runs::PlanSample::*member) {
    // The swing's unit is another: a plot of its own.
    const bool is_swing = drive == kSwing;
    lines.add(fmt::format("{}{}", plot, is_swing ? "_swing" : ""),
              fmt::format("{} of the {}", title, is_swing ? "swing" : "cylinders"),
              machines::kDriveNames[drive], fmt::format("{}{}", drive_unit(drive), per), 3,
              [=](const runs::PlanSample& s) { return (s.*member)[drive] * drive_per_si(drive); });
  };
  const auto add_limit = [&](const char* plot, const char* per, unsigned drive,
                             const std::function<double(const runs::PlanSample&)>& of) {
    lines.add(fmt::format("{}{}", plot, drive == kSwing ? "_swing" : ""), "",
              fmt::format("{}, limit", machines::kDriveNames[drive]),
              fmt::format("{}{}", drive_unit(drive), per), 3,
              [=](const runs::PlanSample& s) { return of(s) * drive_per_si(drive); });
  };
  for (unsigned i = 0; i < kDriveCount; ++i) {
    add("displacement", "Displacement", "", i, &runs::PlanSample::displacement);
  }
  for (unsigned i = 0; i < kDriveCount; ++i) {
    add("velocity", "Velocity", "/s", i, &runs::PlanSample::velocity);
    add_limit("velocity", "/s", i, [i, &limits](const runs::PlanSample& s) {
      return s.velocity[i] < 0.0 ? -limits.speed_in[i] : limits.speed_out[i];
    });
  }
  for (unsigned i = 0; i < kDriveCount; ++i) {
    add("acceleration", "Acceleration", "/s²", i, &runs::PlanSample::acceleration);
    add_limit("acceleration", "/s²", i, [i, &limits](const runs::PlanSample& s) {
      return s.acceleration[i] < 0.0 ? -limits.acceleration[i] : limits.acceleration[i];
    });
  }
  return lines.json();
}

json drives(const std::vector<runs::PlanSample>& samples) {
  constexpr int kMicrometres = 6;
  json all = json::array();
  for (const runs::PlanSample& sample : samples) {
    json row = json::array();
    for (const double value : sample.displacement) {
      row.push_back(plotted(value, kMicrometres));
    }
    all.push_back(std::move(row));
  }
  return all;
}

void add_flows(const ExcavatorProfile& profile, const std::vector<runs::PlanSample>& samples,
               json& figures) {
  const auto flow = runs::greatest_flow_m3ps(samples);
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    figures.push_back({{"label", fmt::format("Flow of Pump {}, max", j + 1)},
                       {"value", fmt::format("{:.0f}", 6e4 * flow[j])},
                       {"unit", "L/min"},
                       {"note", fmt::format("of {:.0f}; cylinders alone",
                                            6e4 * runs::full_flow_m3ps(profile.pump[j]))}});
  }
}

json key_figures(const ExcavatorProfile& profile, const PlanResult& result,
                 const std::vector<runs::PlanSample>& samples) {
  const LinePlan& plan = result.plan;
  json figures = {
      key_figure("Line", fmt::format("{:.3f}", plan.line.change.position_m.norm()), "m", ""),
      key_figure("Duration", fmt::format("{:.2f}", plan.ramp.duration_s), "s", ""),
      key_figure("Speeding up", fmt::format("{:.2f}", plan.ramp.ramp_s), "s",
                 "and as long slowing down"),
      key_figure("Speed, max", fmt::format("{:.3f}", plan.way_m * plan.ramp.peak_rate_ps()), "m/s",
                 "of the teeth"),
      key_figure("Slowed by", machines::plan_limit_words(result), "", "what sets the duration"),
  };
  for (unsigned i = 0; i < kDriveCount; ++i) {
    figures.push_back({{"label", fmt::format("Most of the {}'s speed", machines::kDriveNames[i])},
                       {"value", fmt::format("{:.0f}", 100.0 * result.peaks.speed_ratio[i])},
                       {"unit", "%"},
                       {"note", "of its limit"}});
  }
  add_flows(profile, samples, figures);
  return figures;
}

/// The way and the drives' displacements on it.
void add_samples(const std::vector<runs::PlanSample>& samples, json& run) {
  run["pose"]["drives"] = drives(samples);
  run["way"] =
      Truth<runs::PlanSample>(samples).way([](const runs::PlanSample& s) { return s.teeth_m[0]; },
                                           [](const runs::PlanSample& s) { return s.teeth_m[1]; },
                                           [](const runs::PlanSample& s) { return s.teeth_m[2]; });
}

ordered_json pose(const TeethPose& teeth) {
  const Eigen::Vector3d& at = teeth.position_m;
  return {{"position_m", {at.x(), at.y(), at.z()}}, {"attitude_rad", teeth.attitude_rad}};
}

/// The line as the only task of its machine: the page draws that, and no path that it has besides.
json planned_line(const machines::ExcavatorMachine& machine, const LinePlan& plan) {
  machines::TaskFile task;
  task.name = "planned line";
  task.result.program.step[0].line = plan;
  task.result.program.step_count = 1;
  json told = task_json(task, machine.profile);
  told["steps"][0]["kind"] = task.name;
  return told;
}

}  // namespace

void write_plan_report(const ReportTarget& target, const machines::ExcavatorMachine& machine,
                       const PlanResult& result, const std::vector<runs::PlanSample>& samples,
                       const std::string& subtitle) {
  json run = run_json({"Planned line", subtitle, key_figures(machine.profile, result, samples), {}},
                      truth(samples, drive_limits(machine.profile)));
  add_samples(samples, run);
  json shown = machine_json(machine, {});
  shown["tasks"] = json::array({planned_line(machine, result.plan)});
  json setup = report_setup(target.file, std::move(shown), std::move(run));
  setup["source"]["mode"] = "plan";
  write_report(target.file, target.page, setup);
}

void write_task_plan_report(const ReportTarget& target, const machines::ExcavatorMachine& machine,
                            const machines::TaskFile& task,
                            const std::vector<runs::PlanSample>& samples,
                            const std::string& subtitle) {
  json figures = {key_figure("Steps", fmt::format("{}", task.result.program.step_count), "", ""),
                  key_figure("Duration", fmt::format("{:.2f}", samples.back().time_s), "s",
                             "of all steps, as planned"),
                  key_figure("Raised by the design, max",
                             fmt::format("{:.0f}", kThousandths * machines::most_raised_m(
                                                                      task.request, task.result)),
                             "mm", "of the ends of its digs")};
  add_flows(machine.profile, samples, figures);
  json run = run_json({"Planned task", subtitle, std::move(figures), {}},
                      truth(samples, drive_limits(machine.profile)));
  add_samples(samples, run);
  json setup = report_setup(target.file, machine_json(machine, {task}), std::move(run));
  setup["source"]["mode"] = "plan";
  write_report(target.file, target.page, setup);
}

void write_plan_json(const std::filesystem::path& file, const ExcavatorProfile& profile,
                     const PlanResult& result, const std::vector<runs::PlanSample>& samples) {
  const LinePlan& plan = result.plan;
  ordered_json figures;
  figures["from"] = pose(plan.line.from);
  figures["to"] = pose(plan.line.at(1.0));
  figures["length_m"] = plan.line.change.position_m.norm();
  figures["duration_s"] = plan.ramp.duration_s;
  figures["ramp_s"] = plan.ramp.ramp_s;
  figures["speed_mps"] = plan.way_m * plan.ramp.peak_rate_ps();
  figures["acceleration_mps2"] = plan.way_m * plan.ramp.peak_rate_change_ps2();
  figures["slowed_by"] = machines::plan_limit_words(result);
  figures["slowed_ratio"] = result.slowed_ratio;
  for (unsigned i = 0; i < kDriveCount; ++i) {
    figures["drives"][machines::kDriveNames[i]] = {
        {"unit", i == kSwing ? "rad" : "m"},
        {"from", samples.front().displacement[i]},
        {"to", samples.back().displacement[i]},
        {"speed", result.peaks.speed[i]},
        {"speed_ratio", result.peaks.speed_ratio[i]},
        {"acceleration", result.peaks.acceleration[i]},
        {"acceleration_ratio", result.peaks.acceleration_ratio[i]}};
  }
  const auto flow = runs::greatest_flow_m3ps(samples);
  figures["pump_flow_m3ps"] = std::vector<double>(flow.begin(), flow.begin() + profile.pump_count);
  write_json(file, figures);
}

void write_task_plan_json(const std::filesystem::path& file, const machines::TaskFile& task,
                          const ExcavatorProfile& profile) {
  write_json(file, task_json(task, profile));
}

}  // namespace graben::reports
