// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "app/machines/simulated/hidden.hpp"
#include "app/machines/simulated/hidden_dozer.hpp"
#include "app/runs/assist_run.hpp"
#include "app/runs/autodig_run.hpp"
#include "app/runs/campaign_run.hpp"
#include "app/runs/dig_run.hpp"
#include "app/runs/dozer_identify_run.hpp"
#include "app/runs/fence_campaign.hpp"
#include "app/runs/grade_run.hpp"
#include "app/runs/ground_campaign.hpp"
#include "app/runs/identify_run.hpp"
#include "app/runs/sample_designs.hpp"

namespace graben::runs {
namespace {

void show_nothing(double /*share*/, const std::string& /*where*/) {}

const CampaignKind& dig_kind() {
  // In the order of DigEnd.
  static const CampaignKind kind = {
      "dig", {"done", "path-not-reached", "loop-not-closed", "fault"}, columns_of(dig_figures())};
  return kind;
}

const CampaignKind& grade_kind() {
  // In the order of GradeEnd.
  static const CampaignKind kind = {
      "grade", {"done", "not-finished", "fault"}, columns_of(grade_figures())};
  return kind;
}

/// How a random design ends.
enum class DesignEnd : std::size_t { kDone, kRefused, kTooFarOff, kNotFinished, kFault };

const CampaignKind& designs_kind() {
  static const CampaignKind kind = {"designs",
                                    {"done", "refused", "too-far-off", "not-finished", "fault"},
                                    columns_of(grade_figures()),
                                    2};
  return kind;
}

CampaignRow row_of(DesignEnd end, const GradeSummary& summary) {
  return campaign_row(static_cast<std::size_t>(end), figures_of(summary));
}

/// A design that came out too far off keeps its figures: they are what the campaign is about.
CampaignRow row_of(const machines::SimulatedDozer& machine, const GradeResult& result) {
  const GradeSummary summary = summarise(machine, result);
  if (result.end != GradeEnd::kDone) {
    return row_of(result.end == GradeEnd::kFault ? DesignEnd::kFault : DesignEnd::kNotFinished,
                  summary);
  }
  CampaignRow row = row_of(DesignEnd::kDone, summary);
  if (summary.max_error_true_m > machine.profile.grade.tolerance_m) {
    row.end = static_cast<std::size_t>(DesignEnd::kTooFarOff);
  }
  return row;
}

const CampaignKind& identify_kind() {
  // In the order of IdentifyEnd.
  static const CampaignKind kind = {
      "identify",
      {"done", "commissioning-stopped", "not-identified", "identified-stopped"},
      columns_of(identify_figures())};
  return kind;
}

const CampaignKind& dozer_identify_kind() {
  // In the order of DozerIdentifyEnd.
  static const CampaignKind kind = {
      "identify-dozer",
      {"done", "commissioning-stopped", "not-identified", "identified-stopped"},
      columns_of(dozer_identify_figures())};
  return kind;
}

const CampaignKind& fence_kind() {
  // In the order of FenceEnd.
  static const CampaignKind kind = {
      "fences", {"done", "no-way", "not-finished", "fault"}, columns_of(fence_figures()), 2};
  return kind;
}

const CampaignKind& autodig_kind() {
  // In the order of AutodigEnd.
  static const CampaignKind kind = {
      "autodig", {"done", "not-finished", "fault"}, columns_of(autodig_figures())};
  return kind;
}

const CampaignKind& kind_of(const std::string& file) {
  const std::string name = campaign_name(file);
  for (const CampaignKind* kind :
       {&dig_kind(), &grade_kind(), &designs_kind(), &identify_kind(), &dozer_identify_kind(),
        &autodig_kind(), &fence_kind(), &ground_kind(), &assist_kind()}) {
    if (name == kind->name) {
      return *kind;
    }
  }
  throw std::runtime_error(
      fmt::format("{}: holds a campaign of '{}', which this program does not have", file, name));
}

}  // namespace

CampaignOutcome campaign_dig(const CampaignOptions& options,
                             const machines::SimulatedExcavator& nominal,
                             const DigScenario& scenario, double speed_override_ratio,
                             const Progress& progress) {
  const auto draw = [&](std::uint64_t seed) {
    DigScenario drawn = scenario;
    drawn.scenario.seed = seed;
    const machines::SimulatedExcavator machine = arranged(nominal, drawn);
    DigOptions run = usual_run(machine, drawn);
    run.speed_override_ratio = speed_override_ratio;
    const DigResult result = run_dig(machine, run, show_nothing);
    return campaign_row(static_cast<std::size_t>(result.end), figures_of(summarise(result)));
  };
  return run_campaign(options, dig_kind(),
                      fmt::format("dig {} {:08x}{}, speed {}, {}", nominal.name, nominal.hash,
                                  nominal.simulated.empty() ? "" : " as " + nominal.simulated,
                                  speed_override_ratio, scenario_text(scenario)),
                      draw, progress);
}

CampaignOutcome campaign_grade(const CampaignOptions& options,
                               const machines::SimulatedDozer& nominal,
                               const GradeScenario& scenario, const Progress& progress) {
  const auto draw = [&](std::uint64_t seed) {
    const machines::SimulatedDozer machine = arranged(nominal, scenario, seed);
    const GradeResult result = run_grade(machine, {}, show_nothing);
    return campaign_row(static_cast<std::size_t>(result.end),
                        figures_of(summarise(machine, result)));
  };
  return run_campaign(options, grade_kind(),
                      fmt::format("grade {} {:08x}, {}", nominal.name, nominal.hash,
                                  scenario_text(nominal, scenario)),
                      draw, progress);
}

CampaignOutcome campaign_designs(const CampaignOptions& options,
                                 const machines::SimulatedDozer& nominal,
                                 const GradeScenario& scenario, const Progress& progress) {
  const auto draw = [&](std::uint64_t seed) {
    const SampleDesign design = random_design(seed);
    try {
      const machines::SimulatedDozer machine =
          arranged(machines::with_design(nominal, design.corners, design.rounding_m, design.name),
                   scenario, seed);
      return row_of(machine, run_grade(machine, {}, show_nothing));
    } catch (const machines::ProfileError&) {
      return row_of(DesignEnd::kRefused, {});
    }
  };
  return run_campaign(options, designs_kind(),
                      fmt::format("designs {} {:08x}, {}", nominal.name, nominal.hash,
                                  scenario_text(nominal, scenario)),
                      draw, progress);
}

CampaignOutcome campaign_identify(const CampaignOptions& options,
                                  const machines::SimulatedExcavator& nominal, bool as_designed,
                                  double speed_override_ratio, const Progress& progress) {
  const auto draw = [&](std::uint64_t seed) {
    const machines::SimulatedExcavator machine =
        as_designed ? nominal_with_errors(nominal, seed) : hidden_with_noise(nominal, seed);
    const IdentifyResult result =
        run_identification(machine, {!as_designed, speed_override_ratio, {}}, show_nothing);
    return campaign_row(static_cast<std::size_t>(result.end),
                        figures_of(identify_figures(), result.summary, ""));
  };
  return run_campaign(
      options, identify_kind(),
      fmt::format("identify {} {:08x}, speed {}", nominal.name, nominal.hash, speed_override_ratio),
      draw, progress);
}

CampaignOutcome campaign_identify_dozer(const CampaignOptions& options,
                                        const machines::SimulatedDozer& nominal,
                                        const Progress& progress) {
  const auto draw = [&](std::uint64_t seed) {
    const DozerIdentifyResult result =
        run_dozer_identification(machines::hidden_dozer(nominal, seed), show_nothing);
    return campaign_row(static_cast<std::size_t>(result.end),
                        figures_of(dozer_identify_figures(), result.summary, ""));
  };
  return run_campaign(options, dozer_identify_kind(),
                      fmt::format("identify-dozer {} {:08x}", nominal.name, nominal.hash), draw,
                      progress);
}

CampaignOutcome campaign_fences(const CampaignOptions& options,
                                const machines::SimulatedExcavator& nominal,
                                const std::string& errors, const Progress& progress) {
  const auto draw = [&](std::uint64_t seed) {
    TaskScenario scenario;
    scenario.errors = errors;
    scenario.seed = seed;
    const FenceResult result = run_fenced_task(arranged(nominal, scenario), seed);
    // Whatever the end: nothing may be beyond a fence on the way to a stop either.
    CampaignRow row;
    row.end = static_cast<std::size_t>(result.end);
    for (const Figure<FenceSummary>& figure : fence_figures()) {
      row.figure.push_back(figure.of(result.summary));
    }
    return row;
  };
  return run_campaign(
      options, fence_kind(),
      fmt::format("fences {} {:08x}{}, errors {}", nominal.name, nominal.hash,
                  nominal.simulated.empty() ? "" : " as " + nominal.simulated, errors),
      draw, progress);
}

CampaignOutcome campaign_autodig(const CampaignOptions& options,
                                 const machines::SimulatedExcavator& nominal,
                                 const TaskScenario& scenario, const Progress& progress) {
  // A task that this machine can't do is refused before the first draw.
  const machines::TaskFile file = planned_task(scenario, nominal.profile);
  const auto draw = [&](std::uint64_t seed) {
    TaskScenario drawn = scenario;
    drawn.seed = seed;
    const machines::SimulatedExcavator machine = arranged(nominal, drawn);
    // Its program looks into its surface.
    const machines::TaskFile task = planned_task(drawn, machine.profile);
    const TaskProgram& program = task.result.program;
    const AutodigResult result =
        run_autodig(machine, program, usual_run(drawn, machine.profile, program), show_nothing);
    return campaign_row(static_cast<std::size_t>(result.end),
                        figures_of(summarise(program, result)));
  };
  return run_campaign(options, autodig_kind(),
                      fmt::format("autodig {} {:08x}, task {} {:08x}, rounds {}, speed {}, {}",
                                  machine_text(nominal), nominal.hash, file.name, file.hash,
                                  scenario.rounds.value_or(1), scenario.speed_override_ratio,
                                  machine_text(scenario)),
                      draw, progress);
}

std::size_t campaign_rows(const std::string& file) {
  return std::filesystem::exists(file) ? read_campaign(file, kind_of(file)).rows.size() : 0;
}

std::string merge_campaigns(const std::vector<std::string>& files, const std::string& summary) {
  const CampaignKind& kind = kind_of(files.front());
  CampaignData all;
  for (const std::string& file : files) {
    const CampaignData part = read_campaign(file, kind);
    if (!all.tried.empty() && part.tried != all.tried) {
      throw std::runtime_error(
          fmt::format("{}: holds another campaign ('{}', not '{}')", file, part.tried, all.tried));
    }
    all.tried = part.tried;
    for (const auto& [seed, row] : part.rows) {
      if (!all.rows.emplace(seed, row).second) {
        throw std::runtime_error(fmt::format("{}: seed {} is in two files", file, seed));
      }
    }
  }
  write_campaign(summary, kind, all);
  return campaign_table(kind, all);
}

}  // namespace graben::runs
