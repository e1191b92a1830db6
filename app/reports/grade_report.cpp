#include "app/reports/grade_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/reports/json_file.hpp"
#include "app/reports/machine_json.hpp"
#include "app/reports/report_file.hpp"
#include "app/reports/report_parts.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

constexpr double kLitresPerMinute = 6e4;  ///< In a m^3/s.

/// What of the run no frame has: Mononen and Mattila's figures 5, 7, 8 and 9 beside what is on the
/// bus.
json truth(const machines::SimulatedDozer& machine, const std::vector<runs::GradeSample>& samples) {
  Truth<runs::GradeSample> lines(samples);
  lines.add("error", "", "true", "mm", 2,
            [](const runs::GradeSample& s) { return s.error_true_m * 1e3; });
  lines.add("speeds", "", "true", "mm/s", 1,
            [](const runs::GradeSample& s) { return s.speed_true_mps * 1e3; });
  const double desired_mmps = machine.profile.travel.speed_desired_mps * 1e3;
  lines.add("speeds", "", "desired", "mm/s", 1,
            [=](const runs::GradeSample&) { return desired_mmps; });
  lines.add("flow", "", "required, true motion", "L/min", 2,
            [](const runs::GradeSample& s) { return s.flow_required_m3ps * kLitresPerMinute; });
  lines.add("flow", "", "available, true", "L/min", 2,
            [](const runs::GradeSample& s) { return s.flow_available_m3ps * kLitresPerMinute; });
  lines.add("velocities", "", "blade, true", "mm/s", 2,
            [](const runs::GradeSample& s) { return s.blade_true_mps * 1e3; });
  const char* heights = "Edge, design and body";
  lines.add("heights", heights, "edge", "m", 4,
            [](const runs::GradeSample& s) { return s.edge_m.y(); });
  lines.add("heights", heights, "design under it", "m", 4,
            [](const runs::GradeSample& s) { return s.design_m; });
  lines.add("heights", heights, "body", "m", 4,
            [](const runs::GradeSample& s) { return s.body.height_m; });
  lines.add("place", "Edge along the grade", "x", "m", 3,
            [](const runs::GradeSample& s) { return s.edge_m.x(); });
  lines.add("cycle_time", "Cycle time", "on this computer", "us", 2,
            [](const runs::GradeSample& s) { return s.cycle_us; });
  return lines.json();
}

json way(const std::vector<runs::GradeSample>& samples) {
  return Truth<runs::GradeSample>(samples).way(
      [](const runs::GradeSample& s) { return s.edge_m.x(); },
      [](const runs::GradeSample&) { return 0.0; },
      [](const runs::GradeSample& s) { return s.edge_m.y(); });
}

json key_figures(const runs::GradeSummary& summary) {
  const auto mm = [](double metres) { return fmt::format("{:.1f}", metres * 1e3); };
  return {
      key_figure("Max error, true edge", mm(summary.max_error_true_m), "mm", "over the grade"),
      key_figure("RMSE, true edge", mm(summary.rmse_error_true_m), "mm", "over the grade"),
      key_figure("Time for the grade", fmt::format("{:.2f}", summary.time_s), "s",
                 "edge, from 0 to its end"),
      key_figure("Mean speed", fmt::format("{:.2f}", summary.mean_speed_mps), "m/s",
                 "over the grade"),
      key_figure("Flow required, max", fmt::format("{:.0f}", summary.flow_share_max * 100.0), "%",
                 "of the available, true motion"),
      key_figure("Flow above the limit", fmt::format("{}", summary.flow_occasions), "times",
                 "by more than 2 %"),
      key_figure("Deceleration, wanted", fmt::format("{:.2f}", summary.deceleration_wanted_mps2),
                 "m/s²", "largest"),
      key_figure("Deceleration, true", fmt::format("{:.2f}", summary.deceleration_true_mps2),
                 "m/s²", "largest over 0.1 s"),
      key_figure("Turns of the wanted speed", fmt::format("{}", summary.sign_changes), "",
                 "of 0.02 m/s and more"),
      key_figure("Times real time", fmt::format("{:.0f}", summary.real_time_factor), "",
                 "plant and controller"),
  };
}

}  // namespace

void write_grade_report(const std::filesystem::path& file, const std::filesystem::path& log_file,
                        const machines::SimulatedDozer& machine, const runs::GradeResult& result,
                        const runs::GradeSummary& summary, const std::string& subtitle) {
  const RunWords words = {"Grading run", subtitle, key_figures(summary), summary.limit_share};
  json run = run_json(words, truth(machine, result.samples));
  run["way"] = way(result.samples);
  add_log(run, log_file);
  write_report(file, report_setup(log_file, machine_json(machine), std::move(run)));
}

void write_grade_summary(const std::filesystem::path& file, const runs::GradeSummary& summary) {
  nlohmann::ordered_json figures;
  figures["max_error_true_m"] = summary.max_error_true_m;
  figures["rmse_error_true_m"] = summary.rmse_error_true_m;
  figures["max_error_measured_m"] = summary.max_error_measured_m;
  figures["rmse_error_measured_m"] = summary.rmse_error_measured_m;
  figures["time_s"] = summary.time_s;
  figures["mean_speed_mps"] = summary.mean_speed_mps;
  figures["flow_share_max"] = summary.flow_share_max;
  figures["flow_share_reported_max"] = summary.flow_share_reported_max;
  figures["flow_above_share"] = summary.flow_above_share;
  figures["flow_occasions"] = summary.flow_occasions;
  figures["deceleration_wanted_mps2"] = summary.deceleration_wanted_mps2;
  figures["deceleration_true_mps2"] = summary.deceleration_true_mps2;
  figures["sign_changes"] = summary.sign_changes;
  figures["corners"] = summary.corners;
  figures["duration_s"] = summary.duration_s;
  figures["real_time_factor"] = summary.real_time_factor;
  figures["cycles"] = summary.cycles;
  figures["cycle_median_us"] = summary.cycle_median_us;
  figures["cycle_max_us"] = summary.cycle_max_us;
  for (const auto& [name, share] : summary.limit_share) {
    figures["limit_share"][name] = share;
  }
  write_json(file, figures);
}

std::string grade_table(const runs::GradeSummary& summary) {
  return fmt::format(
      "                                true    measured\n"
      "edge over the grade, max  {:>10.1f}  {:>10.1f} mm\n"
      "edge over the grade, RMSE {:>10.1f}  {:>10.1f} mm\n"
      "time for the grade        {:>10.2f} s\n"
      "mean speed                {:>10.3f} m/s\n"
      "required flow, max        {:>10.1f}  {:>10.1f} % of the available\n"
      "time with more than 102 % {:>10.1f} %\n"
      "occasions of that         {:>10}\n"
      "largest deceleration      {:>10.2f} m/s2 (wanted {:.2f})\n"
      "turns of the wanted speed {:>10} (the design has {} corners)\n"
      "controller's cycle, median{:>10.1f} us\n"
      "controller's cycle, max   {:>10.1f} us\n"
      "times faster than real    {:>10.0f}\n"
      "share of time per limit of the speed\n{}",
      summary.max_error_true_m * 1e3, summary.max_error_measured_m * 1e3,
      summary.rmse_error_true_m * 1e3, summary.rmse_error_measured_m * 1e3, summary.time_s,
      summary.mean_speed_mps, summary.flow_share_max * 100.0,
      summary.flow_share_reported_max * 100.0, summary.flow_above_share * 100.0,
      summary.flow_occasions, summary.deceleration_true_mps2, summary.deceleration_wanted_mps2,
      summary.sign_changes, summary.corners, summary.cycle_median_us, summary.cycle_max_us,
      summary.real_time_factor, shares_table(summary.limit_share));
}

}  // namespace graben::reports
