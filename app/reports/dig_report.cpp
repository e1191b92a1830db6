#include "app/reports/dig_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/machines/axis_names.hpp"
#include "app/reports/json_file.hpp"
#include "app/reports/machine_json.hpp"
#include "app/reports/report_file.hpp"
#include "app/reports/report_parts.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

/// What of the run no frame has: Kim's figures 10 to 15 beside what is on the bus.
json truth(const machines::SimulatedExcavator& machine,
           const std::vector<runs::DigSample>& samples) {
  Truth<runs::DigSample> lines(samples);
  lines.add("error", "", "true", "mm", 2,
            [](const runs::DigSample& s) { return s.error_true_m * 1e3; });
  for (unsigned i = 0; i < kAxisCount; ++i) {
    lines.add("velocities", "", fmt::format("{}, true", machines::kDriveNames[i]), "mm/s", 2,
              [i](const runs::DigSample& s) { return s.velocity_real_mps[i] * 1e3; });
  }
  for (unsigned j = 0; j < static_cast<unsigned>(machine.profile.pump_count); ++j) {
    lines.add("pumps", "", fmt::format("Pump {}, true", j + 1), "MPa", 3,
              [j](const runs::DigSample& s) { return s.pump_real_pa[j] * 1e-6; });
  }
  const char* forces = "Force on the tip";
  lines.add("force", forces, "forward", "kN", 2,
            [](const runs::DigSample& s) { return s.tip_force_n.x() * 1e-3; });
  lines.add("force", forces, "up", "kN", 2,
            [](const runs::DigSample& s) { return s.tip_force_n.y() * 1e-3; });
  if (machine.plant.obstacle) {
    lines.add("obstacle", "Obstacle", "holds the tip", "", 0, [](const runs::DigSample& s) {
      return s.obstruction == runs::Obstruction::kHolding ? 1.0 : 0.0;
    });
  }
  lines.add("regeneration", "Regeneration", "a check valve is open", "", 0,
            [](const runs::DigSample& s) { return s.regenerating ? 1.0 : 0.0; });
  lines.add("cycle_time", "Cycle time", "on this computer", "us", 2,
            [](const runs::DigSample& s) { return s.cycle_us; });
  return lines.json();
}

json way(const machines::SimulatedExcavator& machine, const std::vector<runs::DigSample>& samples) {
  const Eigen::Vector2d foot_m = machine.profile.geometry.boom_foot_m;
  return Truth<runs::DigSample>(samples).way(
      [&](const runs::DigSample& s) { return s.tip_true_m.x() + foot_m.x(); },
      [](const runs::DigSample&) { return 0.0; },
      [&](const runs::DigSample& s) { return s.tip_true_m.y() + foot_m.y(); });
}

json key_figures(const runs::DigSummary& summary) {
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

void write_dig_report(const std::filesystem::path& file, const std::filesystem::path& log_file,
                      const machines::SimulatedExcavator& machine, const runs::DigResult& result,
                      const runs::DigSummary& summary, const std::string& subtitle) {
  const RunWords words = {"Digging run", subtitle, key_figures(summary), summary.limit_share};
  json run = run_json(words, truth(machine, result.samples));
  run["way"] = way(machine, result.samples);
  add_log(run, log_file);
  write_report(file, report_setup(log_file, machine_json(machine, {}), std::move(run)));
}

void write_dig_summary(const std::filesystem::path& file, const runs::DigSummary& summary) {
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

std::string dig_table(const runs::DigSummary& summary) {
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

}  // namespace graben::reports
