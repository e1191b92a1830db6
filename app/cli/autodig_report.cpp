#include "app/cli/autodig_report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/cli/json_file.hpp"
#include "app/cli/report/report.hpp"
#include "app/cli/report_parts.hpp"
#include "app/machines/task_words.hpp"

namespace graben::cli {
namespace {

using nlohmann::json;

json list_of(const Eigen::Vector3d& at) { return {at.x(), at.y(), at.z()}; }

/// The first `count` of what may be there.
template <std::size_t kCount>
json rows(const std::vector<AutodigSample>& samples,
          std::array<double, kCount> AutodigSample::*member, int count) {
  json all = lists(samples, member);
  all.erase(all.begin() + count, all.end());
  return all;
}

json series(const ExcavatorProfile& profile, const AutodigResult& result) {
  const std::vector<AutodigSample>& samples = result.samples;
  json data;
  data["time_s"] = list(samples, &AutodigSample::time_s);
  data["teeth_m"] = lists(samples, &AutodigSample::teeth_m);
  data["planned_m"] = lists(samples, &AutodigSample::planned_m);
  data["attitude_rad"] = list(samples, &AutodigSample::attitude_rad);
  data["planned_attitude_rad"] = list(samples, &AutodigSample::planned_attitude_rad);
  data["error_true_m"] = list(samples, &AutodigSample::error_true_m);
  data["error_measured_m"] = list(samples, &AutodigSample::error_measured_m);
  data["progress"] = list(samples, &AutodigSample::progress_share);
  data["lambda"] = list(samples, &AutodigSample::lambda);
  data["planned"] = lists(samples, &AutodigSample::planned);
  data["real"] = lists(samples, &AutodigSample::real);
  data["velocity_wanted"] = lists(samples, &AutodigSample::velocity_wanted);
  data["velocity_real"] = lists(samples, &AutodigSample::velocity_real);
  data["spool_command"] = lists(samples, &AutodigSample::spool_command);
  data["spool_real"] = lists(samples, &AutodigSample::spool_real);
  data["pump_expected_pa"] = rows(samples, &AutodigSample::pump_expected_pa, profile.pump_count);
  data["pump_real_pa"] = rows(samples, &AutodigSample::pump_real_pa, profile.pump_count);
  data["cycle_time_us"] = list(samples, &AutodigSample::cycle_us);
  add_limits(data, samples, excavator_actuators());
  return data;
}

/// Where a step begins and ends, as it is planned.
json step_of(const ExcavatorProfile& profile, const TaskProgram& program,
             const StepFigures& figures) {
  const SwingKinematics kinematics(profile.geometry);
  const TaskStep& step = program.step[static_cast<unsigned>(figures.step)];
  const auto at = [&](double share) {
    if (step.straight) {
      return step.line.line.at(share).position_m;
    }
    const DriveVector drives = step.drives.from + share * step.drives.change;
    return kinematics.teeth_from_joints(kinematics.joints_from_drive(drives).value).position_m;
  };
  return {{"name", machines::step_name(figures.kind)},
          {"kind", step.straight ? "line" : "drives"},
          {"from_s", figures.from_s},
          {"until_s", figures.until_s},
          {"from_m", list_of(at(0.0))},
          {"to_m", list_of(at(1.0))}};
}

/// "z >= -0.500 m", or all that is not 0 of a plane that leans.
std::string plane_text(const Fence& fence) {
  constexpr std::array<char, 3> kAxes = {'x', 'y', 'z'};
  const Eigen::Vector3d& normal = fence.normal;
  std::string sum;
  for (unsigned i = 0; i < kAxes.size(); ++i) {
    const double share = normal[i];
    if (std::abs(share) == 1.0) {
      return fmt::format("{} {} {:.3f} m", kAxes.at(i),
                         share > 0.0 ? "<=" : ">=", fence.offset_m / share);
    }
    if (share != 0.0) {
      sum += fmt::format("{}{:.3f} {}", sum.empty() ? "" : " + ", share, kAxes.at(i));
    }
  }
  return fmt::format("{} <= {:.3f} m", sum, fence.offset_m);
}

std::string fence_text(const Fence& fence, int index) {
  const char* guards = fence.guard == FenceGuard::kTeeth ? "teeth" : "teeth, bucket pin, arm pin";
  return fmt::format("fence[{}]: {} for {}", index, plane_text(fence), guards);
}

json fences(const TaskProgram& program) {
  json all = json::array();
  for (int i = 0; i < program.fences.count; ++i) {
    all.push_back({{"words", fence_text(program.fences.fence[static_cast<unsigned>(i)], i)}});
  }
  return all;
}

std::string mm(double metres) { return fmt::format("{:.1f}", metres * 1e3); }

json key_figures(const AutodigSummary& summary) {
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

void write_autodig_report(const std::filesystem::path& file,
                          const machines::ExcavatorMachine& machine, const TaskProgram& program,
                          const AutodigResult& result, const AutodigSummary& summary,
                          const std::string& subtitle) {
  json report;
  report["kind"] = "autodig";
  report["title"] = "Graben: a task's run";
  report["subtitle"] = subtitle;
  report["summary"] = key_figures(summary);
  report["limits_share"] = shares_list(summary.limit_share);
  report["steps"] = json::array();
  for (const StepFigures& step : summary.steps) {
    report["steps"].push_back(step_of(machine.profile, program, step));
  }
  report["fences"] = fences(program);
  report["design"] = nullptr;
  report["series"] = series(machine.profile, result);
  write_report(file, report);
}

void write_autodig_summary(const std::filesystem::path& file, const AutodigSummary& summary) {
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
  for (const StepFigures& step : summary.steps) {
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

std::string autodig_table(const AutodigSummary& summary) {
  std::string table = "step        from s  until s  planned s  from line, max mm  from end mm\n";
  for (const StepFigures& step : summary.steps) {
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

}  // namespace graben::cli
