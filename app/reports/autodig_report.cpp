// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
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

/// Curves that no frame has: plan and truth, as Zhang's figures 5 to 10 have them.
json truth(const ExcavatorProfile& profile, const std::vector<runs::AutodigSample>& samples) {
  Truth<runs::AutodigSample> lines(samples);
  lines.add("error", "", "true", "mm", 2,
            [](const runs::AutodigSample& s) { return s.error_true_m * kThousandths; });
  for (unsigned i = 0; i < kDriveCount; ++i) {
    const char* name = machines::kDriveNames[i];
    const std::string title = fmt::format("{}, planned and true", name);
    lines.add(fmt::format("drive_{}", i), title, "planned", drive_unit(i), 2,
              [i](const runs::AutodigSample& s) { return s.planned[i] * drive_per_si(i); });
    lines.add(fmt::format("drive_{}", i), title, "true", drive_unit(i), 2,
              [i](const runs::AutodigSample& s) { return s.real[i] * drive_per_si(i); });
    lines.add(i == kSwing ? "swing" : "velocities", "", fmt::format("{}, true", name),
              fmt::format("{}/s", drive_unit(i)), 2,
              [i](const runs::AutodigSample& s) { return s.velocity_real[i] * drive_per_si(i); });
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

/// `Built` of the page: by the millimetre, and heights by a tenth of one.
json built_json(const runs::AsBuilt& built) {
  json result = {{"cell_m", runs::kBuiltGrid_m}};
  for (const runs::BuiltPlace& place : built.map) {
    result["x_m"].push_back(plotted(place.at_m[0], 3));
    result["y_m"].push_back(plotted(place.at_m[1], 3));
    result["off_mm"].push_back(plotted(place.off_m * kThousandths, 1));
    result["firm_mm"].push_back(plotted(place.firm_m * kThousandths, 1));
  }
  return result;
}

}  // namespace

void write_autodig_report(const ReportTarget& target, const std::filesystem::path& log_file,
                          const machines::SimulatedExcavator& machine,
                          const machines::TaskFile& task, const runs::AutodigResult& result,
                          const runs::AutodigSummary& summary, const std::string& subtitle) {
  const RunText text = run_text("A task's run", subtitle, runs::headed_figures(summary));
  json run = run_json(text, truth(machine.profile, result.samples));
  run["way"] = way(result.samples);
  if (!result.built.map.empty()) {
    run["built"] = built_json(result.built);
  }
  add_log(run, log_file);
  write_report(target.file, target.page,
               report_setup(log_file, machine_json(machine, {task}), std::move(run)));
}

}  // namespace graben::reports
