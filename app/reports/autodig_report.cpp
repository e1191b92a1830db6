#include "app/reports/autodig_report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/machines/axis_names.hpp"
#include "app/machines/task_text.hpp"
#include "app/reports/json_file.hpp"
#include "app/reports/machine_json.hpp"
#include "app/reports/report_file.hpp"
#include "app/reports/report_parts.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

/// What of the run no frame has: plan and truth, as Zhang's figures 5 to 10 have them.
json truth(const ExcavatorProfile& profile, const std::vector<runs::AutodigSample>& samples) {
  Truth<runs::AutodigSample> lines(samples);
  lines.add("error", "", "true", "mm", 2,
            [](const runs::AutodigSample& s) { return s.error_true_m * kThousandths; });
  for (unsigned i = 0; i < kDriveCount; ++i) {
    const char* name = machines::kDriveNames[i];
    const std::string title = fmt::format("{}, planned and true", name);
    lines.add(fmt::format("drive_{}", i), title, "planned", drive_unit(i), 2,
              [i](const runs::AutodigSample& s) { return s.planned[i] * kThousandths; });
    lines.add(fmt::format("drive_{}", i), title, "true", drive_unit(i), 2,
              [i](const runs::AutodigSample& s) { return s.real[i] * kThousandths; });
    lines.add(i == kSwing ? "swing" : "velocities", "", fmt::format("{}, true", name),
              i == kSwing ? "mrad/s" : "mm/s", 2,
              [i](const runs::AutodigSample& s) { return s.velocity_real[i] * kThousandths; });
  }
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    lines.add("pumps", "", fmt::format("Pump {}, true", j + 1), "MPa", 3,
              [j](const runs::AutodigSample& s) { return s.pump_real_pa[j] * 1e-6; });
  }
  lines.add("fence", "Distance to the nearest fence", "least of all points", "mm", 1,
            [](const runs::AutodigSample& s) { return s.fence_left_m * kThousandths; });
  lines.add("cycle_time", "Cycle time", "on this computer", "us", 2,
            [](const runs::AutodigSample& s) { return s.cycle_us; });
  return lines.json();
}

json way(const std::vector<runs::AutodigSample>& samples) {
  return Truth<runs::AutodigSample>(samples).way(
      [](const runs::AutodigSample& s) { return s.teeth_m[0]; },
      [](const runs::AutodigSample& s) { return s.teeth_m[1]; },
      [](const runs::AutodigSample& s) { return s.teeth_m[2]; });
}

std::string mm(double metres) { return fmt::format("{:.1f}", metres * 1e3); }

json key_figures(const runs::AutodigSummary& summary) {
  json figures = {
      key_figure("Max distance from the lines, true", mm(summary.max_error_true_m), "mm",
                 "of the teeth"),
      key_figure("RMSE, true", mm(summary.rmse_error_true_m), "mm", "over all lines"),
      key_figure("Max distance, measured", mm(summary.max_error_measured_m), "mm",
                 "as the controller saw it"),
      key_figure("Farthest from a line's end", mm(summary.end_error_true_m), "mm",
                 "when the step was left"),
      key_figure("Time of the steps", fmt::format("{:.2f}", summary.task_s), "s",
                 "with what limits and settling add"),
      key_figure("Planned", fmt::format("{:.2f}", summary.planned_s), "s", "the same steps"),
      key_figure("Least λ", fmt::format("{:.3f}", summary.lambda_min), "", ""),
      key_figure("Mean λ", fmt::format("{:.3f}", summary.lambda_mean), "", ""),
      key_figure("Times real time", fmt::format("{:.0f}", summary.real_time_factor), "",
                 "plant and controller"),
  };
  if (std::isfinite(summary.fence_left_m)) {
    figures.push_back(key_figure("Least distance to a fence", mm(summary.fence_left_m), "mm",
                                 "below 0: beyond it"));
  }
  return figures;
}

}  // namespace

void write_autodig_report(const std::filesystem::path& file, const std::filesystem::path& log_file,
                          const machines::SimulatedExcavator& machine,
                          const machines::TaskFile& task, const runs::AutodigResult& result,
                          const runs::AutodigSummary& summary, const std::string& subtitle) {
  const RunWords words = {"A task's run", subtitle, key_figures(summary), summary.limit_share};
  json run = run_json(words, truth(machine.profile, result.samples));
  run["way"] = way(result.samples);
  add_log(run, log_file);
  write_report(file, report_setup(log_file, machine_json(machine, {task}), std::move(run)));
}

void write_autodig_summary(const std::filesystem::path& file, const runs::AutodigSummary& summary) {
  nlohmann::ordered_json figures;
  figures["max_error_true_m"] = summary.max_error_true_m;
  figures["rmse_error_true_m"] = summary.rmse_error_true_m;
  figures["max_error_measured_m"] = summary.max_error_measured_m;
  figures["rmse_error_measured_m"] = summary.rmse_error_measured_m;
  figures["end_error_true_m"] = summary.end_error_true_m;
  figures["fence_left_m"] = nullptr;
  if (std::isfinite(summary.fence_left_m)) {
    figures["fence_left_m"] = summary.fence_left_m;
  }
  figures["lambda_min"] = summary.lambda_min;
  figures["lambda_mean"] = summary.lambda_mean;
  figures["task_s"] = summary.task_s;
  figures["planned_s"] = summary.planned_s;
  figures["duration_s"] = summary.duration_s;
  figures["real_time_factor"] = summary.real_time_factor;
  figures["cycles"] = summary.cycles;
  figures["cycle_median_us"] = summary.cycle_median_us;
  figures["cycle_max_us"] = summary.cycle_max_us;
  figures["steps"] = json::array();
  for (const runs::StepFigures& step : summary.steps) {
    figures["steps"].push_back({{"step", step.step},
                                {"round", step.round},
                                {"kind", machines::step_name(step.kind)},
                                {"straight", step.straight},
                                {"from_s", step.from_s},
                                {"until_s", step.until_s},
                                {"planned_s", step.planned_s},
                                {"max_error_true_m", step.max_error_true_m},
                                {"max_error_measured_m", step.max_error_measured_m},
                                {"end_error_true_m", step.end_error_true_m}});
  }
  for (const auto& [name, share] : summary.limit_share) {
    figures["limit_share"][name] = share;
  }
  write_json(file, figures);
}

std::string autodig_table(const runs::AutodigSummary& summary) {
  std::string table = "step        from s  until s  planned s  from line, max mm  from end mm\n";
  for (const runs::StepFigures& step : summary.steps) {
    const auto of_line = [&](double metres) {
      return step.straight ? mm(metres) : std::string("-");
    };
    table += fmt::format("{:<10}{:>8.2f} {:>8.2f} {:>10.2f} {:>18} {:>12}\n",
                         machines::step_name(step.kind), step.from_s, step.until_s, step.planned_s,
                         of_line(step.max_error_true_m), of_line(step.end_error_true_m));
  }
  table += fmt::format(
      "                                true    measured\n"
      "teeth from the lines, max {:>10.1f}  {:>10.1f} mm\n"
      "teeth from the lines, RMSE{:>10.1f}  {:>10.1f} mm\n"
      "lambda, least             {:>10.3f}\n"
      "lambda, mean              {:>10.3f}\n"
      "time of the steps         {:>10.2f} s (planned {:.2f})\n",
      summary.max_error_true_m * 1e3, summary.max_error_measured_m * 1e3,
      summary.rmse_error_true_m * 1e3, summary.rmse_error_measured_m * 1e3, summary.lambda_min,
      summary.lambda_mean, summary.task_s, summary.planned_s);
  if (std::isfinite(summary.fence_left_m)) {
    table += fmt::format("least distance to a fence {:>10.1f} mm\n", summary.fence_left_m * 1e3);
  }
  table += fmt::format(
      "controller's cycle, median{:>10.1f} us\n"
      "controller's cycle, max   {:>10.1f} us\n"
      "times faster than real    {:>10.0f}\n"
      "share of time per limit\n{}",
      summary.cycle_median_us, summary.cycle_max_us, summary.real_time_factor,
      shares_table(summary.limit_share));
  return table;
}

}  // namespace graben::reports
