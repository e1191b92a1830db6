#include "app/cli/plan_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/cli/json_file.hpp"
#include "app/cli/report/report.hpp"
#include "app/cli/report_parts.hpp"
#include "app/machines/axis_names.hpp"
#include "app/machines/plan_words.hpp"

namespace graben::cli {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

json series(const std::vector<PlanSample>& samples) {
  json data;
  data["time_s"] = list(samples, &PlanSample::time_s);
  data["way_m"] = list(samples, &PlanSample::way_m);
  data["speed_mps"] = list(samples, &PlanSample::speed_mps);
  data["teeth_m"] = lists(samples, &PlanSample::teeth_m);
  data["attitude_rad"] = list(samples, &PlanSample::attitude_rad);
  data["displacement"] = lists(samples, &PlanSample::displacement);
  data["velocity"] = lists(samples, &PlanSample::velocity);
  data["acceleration"] = lists(samples, &PlanSample::acceleration);
  return data;
}

json key_figures(const ExcavatorProfile& profile, const PlanResult& result,
                 const std::vector<PlanSample>& samples) {
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
  const auto flow = greatest_flow_m3ps(samples);
  for (unsigned j = 0; j < static_cast<unsigned>(profile.pump_count); ++j) {
    figures.push_back({{"label", fmt::format("Flow of Pump {}, max", j + 1)},
                       {"value", fmt::format("{:.0f}", 6e4 * flow[j])},
                       {"unit", "L/min"},
                       {"note", fmt::format("of {:.0f}; cylinders alone",
                                            6e4 * full_flow_m3ps(profile.pump[j]))}});
  }
  return figures;
}

ordered_json pose(const TeethPose& teeth) {
  const Eigen::Vector3d& at = teeth.position_m;
  return {{"position_m", {at.x(), at.y(), at.z()}}, {"attitude_rad", teeth.attitude_rad}};
}

}  // namespace

void write_plan_report(const std::filesystem::path& file, const ExcavatorProfile& profile,
                       const PlanResult& result, const std::vector<PlanSample>& samples,
                       const std::string& subtitle) {
  json report;
  report["kind"] = "plan";
  report["title"] = "Graben: planned line";
  report["subtitle"] = subtitle;
  report["summary"] = key_figures(profile, result, samples);
  report["series"] = series(samples);
  write_report(file, report);
}

void write_plan_json(const std::filesystem::path& file, const ExcavatorProfile& profile,
                     const PlanResult& result, const std::vector<PlanSample>& samples) {
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
  const auto flow = greatest_flow_m3ps(samples);
  figures["pump_flow_m3ps"] = std::vector<double>(flow.begin(), flow.begin() + profile.pump_count);
  write_json(file, figures);
}

}  // namespace graben::cli
