// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/reports/page_setup.hpp"
#include "app/reports/report_file.hpp"
#include "app/reports/report_parts.hpp"
#include "app/reports/run_reports.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

constexpr double kLitresPerMinute = 6e4;  ///< In a m^3/s.

/// Curves that no frame has: Mononen and Mattila's figures 5, 7, 8 and 9 beside what is on the
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

}  // namespace

void write_grade_report(const ReportTarget& target, const std::filesystem::path& log_file,
                        const machines::SimulatedDozer& machine, const runs::GradeResult& result,
                        const runs::GradeSummary& summary, const std::string& subtitle) {
  const RunText text = run_text("Grading run", subtitle, runs::headed_figures(summary));
  json run = run_json(text, truth(machine, result.samples));
  run["way"] = way(result.samples);
  add_log(run, log_file);
  write_report(target.file, target.page,
               report_setup(log_file, machine_json(machine), std::move(run)));
}

}  // namespace graben::reports
