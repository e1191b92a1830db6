// SPDX-License-Identifier: Apache-2.0
#include "app/runs/speed_table.hpp"

#include <fmt/format.h>

#include "app/machines/profile_file.hpp"
#include "app/runs/sample_designs.hpp"

namespace graben::runs {
namespace {

/// The part of a whole that is under way.
Progress part_of(const Progress& progress, double begin, double end, const std::string& what) {
  return [=](double share, const std::string& where) {
    progress(begin + (end - begin) * share, fmt::format("{}, {}", what, where));
  };
}

SpeedRow row_of(const machines::SimulatedDozer& nominal, const SampleDesign& design,
                const GradeScenario& scenario, std::uint64_t seed, const Progress& progress) {
  SpeedRow row;
  row.design = design.name;
  try {
    const machines::SimulatedDozer machine =
        machines::with_design(nominal, design.corners, design.rounding_m, design.name);
    GradeScenario tried = scenario;
    tried.speed_mode = "bounded";
    const machines::SimulatedDozer bounded = arranged(machine, tried, seed);
    const GradeResult result = run_grade(bounded, {}, progress);
    row.end = result.end;
    row.bounded = summarise(bounded, result);
    tried.speed_mode = "constant";
    ConstantSpeeds constant(arranged(machine, tried, seed));
    row.tolerance = constant.fastest(machine.profile.grade.tolerance_m, progress);
    row.same_error = constant.fastest(row.bounded.max_error_true_m, progress);
  } catch (const machines::ProfileError& error) {
    row.refused = error.errors().front();
  }
  return row;
}

std::string against(const SpeedRow& row, const std::optional<SpeedTrial>& constant) {
  return constant
             ? fmt::format("{:>7.2f}{:>8.2f}{:>8.2f}", constant->speed_mps,
                           constant->summary.time_s, row.bounded.time_s / constant->summary.time_s)
             : fmt::format("{:>7}{:>8}{:>8}", "none", "-", "-");
}

}  // namespace

std::vector<SpeedRow> compare_speeds(const machines::SimulatedDozer& machine,
                                     const GradeScenario& scenario, std::uint64_t seed,
                                     std::size_t most, const Progress& progress) {
  std::vector<SampleDesign> designs = sample_designs();
  designs.resize(std::min(most, designs.size()));
  std::vector<SpeedRow> rows;
  for (const SampleDesign& design : designs) {
    const auto whole = static_cast<double>(designs.size());
    const auto done = static_cast<double>(rows.size());
    rows.push_back(row_of(machine, design, scenario, seed,
                          part_of(progress, done / whole, (done + 1.0) / whole, design.name)));
  }
  return rows;
}

std::string speed_table(const std::vector<SpeedRow>& rows, const GradeScenario& scenario,
                        double tolerance_m) {
  std::string text = fmt::format(
      "{:<28}  speed bounded by the controller  constant, same error   constant, {:.0f} mm\n"
      "{:<28}{:>10}{:>10}{:>8}{:>7}{:>7}{:>8}{:>8}{:>7}{:>8}{:>8}\n",
      "", tolerance_m * 1e3, "design", "error, mm", "time, s", "turns", "dec", "m/s", "s", "share",
      "m/s", "s", "share");
  for (const SpeedRow& row : rows) {
    if (!row.refused.empty()) {
      text += fmt::format("{:<28}  refused: {}\n", row.design, row.refused);
    } else if (row.end != GradeEnd::kDone) {
      text += fmt::format("{:<28}  did not come to the end\n", row.design);
    } else {
      text += fmt::format("{:<28}{:>10.1f}{:>10.2f}{:>8}{:>7.2f}{}{}\n", row.design,
                          row.bounded.max_error_true_m * 1e3, row.bounded.time_s,
                          row.bounded.sign_changes, row.bounded.deceleration_true_mps2,
                          against(row, row.same_error), against(row, row.tolerance));
    }
  }
  return text +
         fmt::format(
             "error: largest of the true edge off the design; dec: largest deceleration of the "
             "machine, m/s2; share: bounded time over constant time\n"
             "the plant has: wheels on springs that push only, tipping and falling; compressible "
             "oil, the spool's lag and dead band, friction; slip of the tracks; lag of the "
             "transmission{}\n"
             "it does not have: {}a roll, a heading or a place across; blade tilt; ground that "
             "gives way under the tracks; {}sensors that drop out\n",
             scenario.errors == "all" ? "; drawn masses, frictions, efficiencies and sensor errors"
                                      : "",
             scenario.soil.empty() ? "a force of the ground on the blade; " : "",
             scenario.errors == "all" ? "" : "errors of sensors or of the profile; ");
}

}  // namespace graben::runs
