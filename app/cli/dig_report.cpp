#include "app/cli/dig_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/cli/json_file.hpp"
#include "app/cli/report/report.hpp"
#include "app/cli/report_parts.hpp"
#include "firmware/motion/dig_field.hpp"

namespace graben::cli {
namespace {

using nlohmann::json;

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
constexpr double kMarkEvery_s = 5.0;

json point(const Eigen::Vector2d& at) { return {at.x(), at.y()}; }

/// Path, field, where the tip was, and its attitude every five seconds (Fig. 9).
json geometry(const machines::ExcavatorMachine& machine, const DigResult& result) {
  constexpr int kPathPoints = 240;
  constexpr double kFieldStep_m = 0.35;
  constexpr double kMargin_m = 0.7;
  const ExcavatorKinematics kinematics(machine.profile.geometry);
  const DigField field(machine.profile, kinematics);
  const DigPath& path = machine.profile.dig_path;
  json geometry;
  geometry["path"] = json::array();
  for (int k = 0; k < kPathPoints; ++k) {
    geometry["path"].push_back(
        point(field.path().at_share(static_cast<double>(k) / kPathPoints).position_m));
  }
  geometry["field"] = json::array();
  const auto columns =
      static_cast<int>((path.x_max_m - path.x_min_m + 2.0 * kMargin_m) / kFieldStep_m);
  const auto rows =
      static_cast<int>((path.y_max_m - path.y_min_m + 2.0 * kMargin_m) / kFieldStep_m);
  for (int i = 0; i <= columns; ++i) {
    for (int j = 0; j <= rows; ++j) {
      const TipPose at = {path.x_min_m - kMargin_m + i * kFieldStep_m,
                          path.y_min_m - kMargin_m + j * kFieldStep_m, 0.0};
      const TipVelocity velocity = field.contour(at);
      geometry["field"].push_back(
          {at.x_m, at.y_m, velocity.linear_mps.x(), velocity.linear_mps.y()});
    }
  }
  geometry["tip_true"] = json::array();
  geometry["tip_measured"] = json::array();
  geometry["marks"] = json::array();
  double next_mark_s = 0.0;
  for (const DigSample& sample : result.samples) {
    geometry["tip_true"].push_back(point(sample.tip_true_m));
    geometry["tip_measured"].push_back(point(sample.tip_measured_m));
    if (sample.time_s >= next_mark_s) {
      geometry["marks"].push_back({{"x", sample.tip_true_m.x()},
                                   {"y", sample.tip_true_m.y()},
                                   {"attitude_deg", sample.attitude_true_rad * kDegrees},
                                   {"time_s", sample.time_s}});
      next_mark_s += kMarkEvery_s;
    }
  }
  geometry["ground_y_m"] = nullptr;
  if (machine.plant.soil) {
    geometry["ground_y_m"] = machine.plant.soil->ground_y_m;
  }
  if (machine.plant.obstacle) {
    const plant::ObstacleProfile& obstacle = *machine.plant.obstacle;
    geometry["obstacle"] = {{"point", point(obstacle.point_m)},
                            {"normal", point(obstacle.normal)},
                            {"size_m", obstacle.size_m}};
  }
  if (!result.samples.empty()) {
    geometry["start"] = point(result.samples.front().tip_true_m);
  }
  return geometry;
}

/// x and y of a vector over time.
json components(const DigResult& result, Eigen::Vector2d DigSample::*member) {
  json x = json::array();
  json y = json::array();
  for (const DigSample& sample : result.samples) {
    x.push_back((sample.*member).x());
    y.push_back((sample.*member).y());
  }
  return {std::move(x), std::move(y)};
}

json series(const DigResult& result) {
  const std::vector<DigSample>& samples = result.samples;
  json data;
  data["time_s"] = list(samples, &DigSample::time_s);
  data["lambda"] = list(samples, &DigSample::lambda);
  data["spool_command"] = lists(samples, &DigSample::spool_command);
  data["spool_real"] = lists(samples, &DigSample::spool_real);
  data["velocity_wanted"] = lists(samples, &DigSample::velocity_wanted_mps);
  data["velocity_real"] = lists(samples, &DigSample::velocity_real_mps);
  data["pump_pressure_expected"] = lists(samples, &DigSample::pump_expected_pa);
  data["pump_pressure_real"] = lists(samples, &DigSample::pump_real_pa);
  data["error_true_m"] = list(samples, &DigSample::error_true_m);
  data["error_measured_m"] = list(samples, &DigSample::error_measured_m);
  data["tip_force_n"] = components(result, &DigSample::tip_force_n);
  data["tip_velocity_mps"] = components(result, &DigSample::velocity_true_mps);
  data["obstruction"] = json::array();
  for (const DigSample& sample : samples) {
    data["obstruction"].push_back(static_cast<int>(sample.obstruction));
  }
  data["cycle_time_us"] = list(samples, &DigSample::cycle_us);
  add_limits(data, samples, excavator_actuators());
  return data;
}

json key_figures(const DigSummary& summary) {
  const auto mm = [](double metres) { return fmt::format("{:.1f}", metres * 1e3); };
  return {
      key_figure("Max error, true tip", mm(summary.max_error_true_m), "mm", "on the path"),
      key_figure("RMSE, true tip", mm(summary.rmse_error_true_m), "mm", "on the path"),
      key_figure("Max error, measured tip", mm(summary.max_error_measured_m), "mm", "on the path"),
      key_figure("RMSE, measured tip", mm(summary.rmse_error_measured_m), "mm", "on the path"),
      key_figure("Lambda, least", fmt::format("{:.3f}", summary.lambda_min), "", "on the path"),
      key_figure("Lambda below 1", fmt::format("{:.0f}", summary.lambda_below_1_share * 100.0), "%",
                 "of the time on the path"),
      key_figure("Regeneration open", fmt::format("{:.0f}", summary.regeneration_share * 100.0),
                 "%", "of the time on the path"),
      key_figure("Chamber pressure, max",
                 fmt::format("{:.1f}", summary.peak_chamber_pressure_pa * 1e-6), "MPa",
                 "whole run"),
      key_figure("Lambda, mean", fmt::format("{:.3f}", summary.lambda_mean), "", "on the path"),
      key_figure("Time round the path", fmt::format("{:.1f}", summary.loop_s), "s", "simulated"),
      key_figure("Times real time", fmt::format("{:.0f}", summary.real_time_factor), "",
                 "plant and controller"),
  };
}

}  // namespace

void write_dig_report(const std::filesystem::path& file, const machines::ExcavatorMachine& machine,
                      const DigResult& result, const DigSummary& summary,
                      const std::string& subtitle) {
  json report;
  report["title"] = "Graben: digging run";
  report["subtitle"] = subtitle;
  report["summary"] = key_figures(summary);
  report["limits_share"] = shares_list(summary.limit_share);
  report["geometry"] = geometry(machine, result);
  report["series"] = series(result);
  write_report(file, report);
}

void write_dig_summary(const std::filesystem::path& file, const DigSummary& summary) {
  nlohmann::ordered_json figures;
  figures["max_error_true_m"] = summary.max_error_true_m;
  figures["rmse_error_true_m"] = summary.rmse_error_true_m;
  figures["max_error_measured_m"] = summary.max_error_measured_m;
  figures["rmse_error_measured_m"] = summary.rmse_error_measured_m;
  figures["lambda_min"] = summary.lambda_min;
  figures["lambda_mean"] = summary.lambda_mean;
  figures["lambda_below_1_share"] = summary.lambda_below_1_share;
  figures["regeneration_share"] = summary.regeneration_share;
  figures["peak_chamber_pressure_pa"] = summary.peak_chamber_pressure_pa;
  if (summary.recovery) {
    figures["recovery"] = {{"lambda_held", summary.recovery->lambda_held},
                           {"off_field_max_rad", summary.recovery->off_field_max_rad},
                           {"ringing_max_rad", summary.recovery->ringing_max_rad},
                           {"error_max_m", summary.recovery->error_max_m}};
  }
  figures["duration_s"] = summary.duration_s;
  figures["real_time_factor"] = summary.real_time_factor;
  figures["cycles"] = summary.cycles;
  figures["approach_s"] = summary.approach_s;
  figures["loop_s"] = summary.loop_s;
  figures["cycle_median_us"] = summary.cycle_median_us;
  figures["cycle_max_us"] = summary.cycle_max_us;
  for (const auto& [name, share] : summary.limit_share) {
    figures["limit_share"][name] = share;
  }
  write_json(file, figures);
}

std::string dig_table(const DigSummary& summary) {
  return fmt::format(
      "                                true    measured\n"
      "path error, max           {:>10.1f}  {:>10.1f} mm\n"
      "path error, RMSE          {:>10.1f}  {:>10.1f} mm\n"
      "lambda, min               {:>10.3f}\n"
      "lambda, mean              {:>10.3f}\n"
      "time with lambda below 1  {:>10.1f} %\n"
      "regeneration check open   {:>10.1f} %\n"
      "highest chamber pressure  {:>10.1f} MPa\n"
      "time to reach the path    {:>10.2f} s\n"
      "time round the path       {:>10.2f} s\n"
      "controller's cycle, median{:>10.1f} us\n"
      "controller's cycle, max   {:>10.1f} us\n"
      "times faster than real    {:>10.0f}\n"
      "share of time per limit of lambda\n{}",
      summary.max_error_true_m * 1e3, summary.max_error_measured_m * 1e3,
      summary.rmse_error_true_m * 1e3, summary.rmse_error_measured_m * 1e3, summary.lambda_min,
      summary.lambda_mean, summary.lambda_below_1_share * 100.0, summary.regeneration_share * 100.0,
      summary.peak_chamber_pressure_pa * 1e-6, summary.approach_s, summary.loop_s,
      summary.cycle_median_us, summary.cycle_max_us, summary.real_time_factor,
      shares_table(summary.limit_share));
}

}  // namespace graben::cli
