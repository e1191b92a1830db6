// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/machines/axis_names.hpp"
#include "app/reports/page_setup.hpp"
#include "app/reports/report_file.hpp"
#include "app/reports/report_parts.hpp"
#include "app/reports/run_reports.hpp"

namespace graben::reports {
namespace {

using nlohmann::json;

/// Curves that no frame has: Kim's figures 10 to 15 beside what is on the bus.
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
  if (machine.plant.digging) {
    lines.add("fill", "Loose soil in the bucket", "true", "m3", 3,
              [](const runs::DigSample& s) { return s.fill_m3; });
  }
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

}  // namespace

void write_dig_report(const ReportTarget& target, const std::filesystem::path& log_file,
                      const machines::SimulatedExcavator& machine, const runs::DigResult& result,
                      const runs::DigSummary& summary, const std::string& subtitle) {
  const RunText text = run_text("Digging run", subtitle, runs::figures_of(summary));
  json run = run_json(text, truth(machine, result.samples));
  run["way"] = way(machine, result.samples);
  add_log(run, log_file);
  write_report(target.file, target.page,
               report_setup(log_file, machine_json(machine, {}), std::move(run)));
}

}  // namespace graben::reports
