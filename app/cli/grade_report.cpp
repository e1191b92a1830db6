#include "app/cli/grade_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/cli/json_file.hpp"
#include "app/cli/report/report.hpp"
#include "app/cli/report_parts.hpp"

namespace graben::cli {
namespace {

using nlohmann::json;

/// One number of each sample.
template <class Of>
json of_samples(const std::vector<GradeSample>& samples, Of of) {
  json values = json::array();
  for (const GradeSample& sample : samples) {
    values.push_back(of(sample));
  }
  return values;
}

json series(const machines::DozerMachine& machine, const GradeResult& result) {
  const std::vector<GradeSample>& samples = result.samples;
  json data;
  data["time_s"] = list(samples, &GradeSample::time_s);
  data["edge_x_m"] = of_samples(samples, [](const GradeSample& s) { return s.edge_m.x(); });
  data["edge_z_m"] = of_samples(samples, [](const GradeSample& s) { return s.edge_m.y(); });
  data["body_x_m"] = of_samples(samples, [](const GradeSample& s) { return s.body.position_m; });
  data["body_z_m"] = of_samples(samples, [](const GradeSample& s) { return s.body.height_m; });
  data["pitch_rad"] = of_samples(samples, [](const GradeSample& s) { return s.body.pitch_rad; });
  data["design_m"] = list(samples, &GradeSample::design_m);
  data["error_true_m"] = list(samples, &GradeSample::error_true_m);
  data["error_measured_m"] = list(samples, &GradeSample::error_measured_m);
  data["speed_wanted_mps"] = list(samples, &GradeSample::speed_wanted_mps);
  data["speed_true_mps"] = list(samples, &GradeSample::speed_true_mps);
  data["speed_limit_mps"] = list(samples, &GradeSample::speed_limit_mps);
  data["speed_desired_mps"] = machine.profile.travel.speed_desired_mps;
  data["flow_required_m3ps"] = list(samples, &GradeSample::flow_required_m3ps);
  data["flow_reported_m3ps"] = list(samples, &GradeSample::flow_reported_m3ps);
  data["flow_available_m3ps"] = list(samples, &GradeSample::flow_available_m3ps);
  data["lambda"] = list(samples, &GradeSample::lambda);
  data["blade_wanted_mps"] = list(samples, &GradeSample::blade_wanted_mps);
  data["blade_true_mps"] = list(samples, &GradeSample::blade_true_mps);
  data["spool_command"] = list(samples, &GradeSample::spool_command);
  data["spool_real"] = list(samples, &GradeSample::spool_real);
  data["track_mps"] = lists(samples, &GradeSample::track_mps);
  data["pump_command"] = lists(samples, &GradeSample::pump_command);
  data["pump_real"] = lists(samples, &GradeSample::pump_real);
  data["motor_command"] = lists(samples, &GradeSample::motor_command);
  data["motor_real"] = lists(samples, &GradeSample::motor_real);
  data["cycle_time_us"] = list(samples, &GradeSample::cycle_us);
  add_limits(data, samples, dozer_actuators());
  return data;
}

json key_figures(const GradeSummary& summary) {
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

json terrain(const GradeResult& result) {
  json points = json::array();
  for (const Eigen::Vector2d& point : result.terrain_m) {
    points.push_back({point.x(), point.y()});
  }
  return points;
}

}  // namespace

void write_grade_report(const std::filesystem::path& file, const machines::DozerMachine& machine,
                        const GradeResult& result, const GradeSummary& summary,
                        const std::string& subtitle) {
  json report;
  report["kind"] = "grade";
  report["speed_mode"] =
      machine.profile.travel.policy == SpeedPolicy::kConstant ? "constant" : "bounded";
  report["title"] = "Graben: grading run";
  report["subtitle"] = subtitle;
  report["summary"] = key_figures(summary);
  report["limits_share"] = shares_list(summary.limit_share);
  report["terrain"] = terrain(result);
  report["series"] = series(machine, result);
  write_report(file, report);
}

void write_grade_summary(const std::filesystem::path& file, const GradeSummary& summary) {
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

std::string grade_table(const GradeSummary& summary) {
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

}  // namespace graben::cli
