#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/commands.hpp"
#include "app/cli/grade_options.hpp"
#include "app/cli/guarded.hpp"
#include "app/cli/scenario_options.hpp"
#include "app/cli/validators.hpp"
#include "app/runs/campaign_run.hpp"
#include "app/runs/dig_campaign.hpp"
#include "app/runs/grade_campaign.hpp"

namespace graben::cli {
namespace {

struct DigCampaignOptions {
  runs::CampaignOptions campaign;
  ScenarioOptions scenario;
  std::string profile = "excavator_22t";
  double speed = 1.0;
};

struct GradeCampaignOptions {
  runs::CampaignOptions campaign;
  GradeScenario scenario;
  std::string profile = "dozer_9t";
};

struct MergeOptions {
  std::vector<std::string> from;
  std::string summary;
};

void add_campaign_options(CLI::App& command, runs::CampaignOptions& options) {
  command.add_option("--draws", options.draws, "How many, 1 .. 1000000")
      ->check(whole_number() & CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Of the first draw; each next has the next")
      ->check(whole_number())
      ->capture_default_str();
  command.add_option("--shard", options.shard, "i/n: every n-th draw from the i-th on")
      ->capture_default_str();
  command.add_option("--summary", options.summary, "CSV, a row for each draw")->required();
  command.add_option("--jobs", options.jobs, "Threads, 1 .. 256; all cores unless told")
      ->check(whole_number() & CLI::Range(1, 256));
}

runs::CampaignRow dig_draw(const DigCampaignOptions& options,
                           const machines::SimulatedExcavator& nominal, std::uint64_t seed) {
  ScenarioOptions scenario = options.scenario;
  scenario.scenario.seed = seed;
  const machines::SimulatedExcavator machine = arranged(nominal, scenario);
  runs::DigOptions dig = usual_run(machine, scenario);
  dig.speed_override_ratio = options.speed;
  return runs::dig_campaign_row(runs::run_dig(machine, dig, [](double, const std::string&) {}));
}

void campaign_dig(const DigCampaignOptions& options) {
  const machines::SimulatedExcavator nominal =
      machines::load_simulated_excavator(machines::find_profile(options.profile));
  runs::run_campaign(options.campaign, runs::dig_campaign(),
                     fmt::format("dig {} {:08x}, speed {}, {}", nominal.name, nominal.hash,
                                 options.speed, scenario_words(options.scenario)),
                     [&](std::uint64_t seed) { return dig_draw(options, nominal, seed); });
}

runs::CampaignRow grade_draw(const GradeCampaignOptions& options,
                             const machines::SimulatedDozer& nominal, std::uint64_t seed) {
  const machines::SimulatedDozer machine = arranged(nominal, options.scenario, seed);
  return runs::grade_campaign_row(machine,
                                  runs::run_grade(machine, {}, [](double, const std::string&) {}));
}

void campaign_grade(const GradeCampaignOptions& options) {
  const machines::SimulatedDozer nominal =
      machines::load_simulated_dozer(machines::find_profile(options.profile));
  runs::run_campaign(options.campaign, runs::grade_campaign(),
                     fmt::format("grade {} {:08x}, {}", nominal.name, nominal.hash,
                                 scenario_words(nominal, options.scenario)),
                     [&](std::uint64_t seed) { return grade_draw(options, nominal, seed); });
}

void merge(const MergeOptions& options) {
  const std::string name = runs::campaign_name(options.from.front());
  for (const runs::CampaignKind* kind : {&runs::dig_campaign(), &runs::grade_campaign()}) {
    if (name == kind->name) {
      runs::merge_campaigns(options.from, options.summary, *kind);
      return;
    }
  }
  throw std::runtime_error(fmt::format("{}: holds a campaign of '{}', which this program has not",
                                       options.from.front(), name));
}

void add_campaign_dig(CLI::App& campaign, int& status) {
  auto options = std::make_shared<DigCampaignOptions>();
  CLI::App* command = campaign.add_subcommand(
      "dig", "Many draws of what the controller does not know; goes on where it was interrupted");
  command->add_option("--profile", options->profile, "Machine profile: file or shipped name")
      ->capture_default_str();
  options->campaign.draws = 200;
  add_campaign_options(*command, options->campaign);
  command->add_option("--speed", options->speed, "Operator's speed override, 0.05 .. 1")
      ->check(number_between(0.05, 1.0))
      ->capture_default_str();
  options->scenario.errors = "all";
  add_scenario_options(*command, options->scenario);
  command->callback(
      [options, &status] { status = guarded("campaign dig", [&] { campaign_dig(*options); }); });
}

void add_campaign_grade(CLI::App& campaign, int& status) {
  auto options = std::make_shared<GradeCampaignOptions>();
  CLI::App* command = campaign.add_subcommand(
      "grade",
      "Many draws of a dozer that its controller does not quite know; goes on as dig does");
  command->add_option("--profile", options->profile, "Machine profile: file or shipped name")
      ->capture_default_str();
  options->campaign.draws = 100;
  add_campaign_options(*command, options->campaign);
  options->scenario.errors = "all";
  add_speed_options(*command, options->scenario);
  add_engine_option(*command, options->scenario);
  add_error_option(*command, options->scenario);
  command->callback([options, &status] {
    status = guarded("campaign grade", [&] { campaign_grade(*options); });
  });
}

void add_campaign_merge(CLI::App& campaign, int& status) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command = campaign.add_subcommand("merge", "Shards of one campaign into one file");
  command->add_option("files", options->from, "CSV files of the shards")->required();
  command->add_option("--summary", options->summary, "CSV to write")->required();
  command->callback(
      [options, &status] { status = guarded("campaign merge", [&] { merge(*options); }); });
}

}  // namespace

void add_campaign(CLI::App& app, int& status) {
  CLI::App* campaign = app.add_subcommand("campaign", "Many runs and their distribution");
  campaign->require_subcommand(1);
  add_campaign_dig(*campaign, status);
  add_campaign_grade(*campaign, status);
  add_campaign_merge(*campaign, status);
}

}  // namespace graben::cli
