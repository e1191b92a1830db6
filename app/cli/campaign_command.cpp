// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/array_commands.hpp"
#include "app/cli/command_table.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/console.hpp"
#include "app/cli/crest_ground.hpp"
#include "app/cli/help.hpp"
#include "app/cli/options.hpp"
#include "app/machines/profile_file.hpp"
#include "app/runs/assist_run.hpp"
#include "app/runs/campaign_run.hpp"
#include "app/runs/ground_campaign.hpp"

namespace graben::cli {
namespace {

/// Of what has a task done.
struct TaskCampaign {
  runs::CampaignOptions campaign;
  ArrayOptions array;
  std::string unknown_drives;  ///< See demand_known().
};

struct DigCampaign : TaskCampaign {
  runs::DigScenario scenario;
  machines::SimulatedChoice simulated;
  std::string profile = "excavator_22t";
  double speed_override_ratio = 1.0;
};

struct GradeCampaign : TaskCampaign {
  runs::GradeScenario scenario;
  design::DesignSource design;
  std::string profile = "dozer_9t";
};

struct IdentifyCampaign {
  runs::CampaignOptions campaign;
  ArrayOptions array;
  std::string profile = "excavator_22t";
  bool as_designed = false;
  double speed_override_ratio = 1.0;
};

struct FenceCampaign : TaskCampaign {
  machines::SimulatedChoice simulated;
  std::string profile = "excavator_12t";
  std::string errors = "all";
};

struct AssistCampaign : TaskCampaign {
  machines::SimulatedChoice simulated;
  std::string profile = "excavator_22t";
  std::string errors = "all";
  machines::Found found;
  bool imus = false;
  bool unmarked = false;
  bool surfaces = false;
};

struct AutodigCampaign : TaskCampaign {
  runs::TaskScenario scenario;
  machines::SimulatedChoice simulated;
  std::string profile = "excavator_12t";
};

void add_campaign_options(CLI::App& command, runs::CampaignOptions& options) {
  command.add_option("--draws", options.draws, "How many, 1 .. 1000000")
      ->check(whole_number_between(1, 1000000))
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Of the first draw; each next has the next")
      ->check(whole_number())
      ->capture_default_str();
  command.add_option("--shard", options.shard, "i/n: every n-th draw from the i-th on")
      ->capture_default_str();
  command.add_option("--summary", options.summary, "CSV, a row for each draw")->required();
  command.add_option("--jobs", options.jobs, "Threads, 1 .. 256; all cores unless told")
      ->check(whole_number_between(1, 256));
}

void add_task_campaign(CLI::App& command, TaskCampaign& options) {
  add_campaign_options(command, options.campaign);
  add_unknown_drives_option(command, options.unknown_drives);
}

/// Runs one with a progress bar and prints what came of it; `signal`: what ended it early.
template <class Run>
void print_outcome(Run run, int& signal) {
  runs::CampaignOutcome outcome;
  {
    ProgressBar bar("campaign");
    outcome = run(bar.progress());
  }
  fmt::print("{}", outcome.table);
  signal = outcome.signal;
  if (!outcome.error.empty()) {
    throw std::runtime_error(outcome.error);
  }
}

/// As a shell says that Ctrl-C ended a program.
constexpr int kInterrupted = 128 + SIGINT;

/// Here, or on Slurm if it was so typed.
template <class Options, class Campaign>
void on_callback(CLI::App& command, const std::shared_ptr<Options>& options, int& status,
                 Campaign campaign) {
  add_array_options(command, options->array);
  command.callback([&command, options, &status, campaign] {
    int signal = 0;
    status = guarded(("campaign " + command.get_name()).c_str(), [&] {
      if (options->array.shards == 0) {
        print_outcome(
            [&](const runs::Progress& progress) {
              return campaign(*options, options->campaign, progress);
            },
            signal);
        return;
      }
      submit_campaign(
          command, options->campaign, options->array, [&](const runs::CampaignOptions& other) {
            static_cast<void>(campaign(*options, other, [](double, const std::string&) {}));
          });
    });
    status = status != 0 && signal == SIGINT ? kInterrupted : status;
  });
}

template <class Campaign>
machines::SimulatedExcavator known_excavator(const Campaign& options,
                                             const machines::NeededDrives& needed) {
  machines::SimulatedExcavator machine = machines::load_simulated_excavator(
      machines::find_profile(options.profile), options.simulated);
  demand_known(machine, needed, options.unknown_drives);
  return machine;
}

machines::SimulatedDozer known_dozer(const GradeCampaign& options) {
  machines::SimulatedDozer machine =
      machines::load_simulated_dozer(machines::find_profile(options.profile));
  demand_known(machine, options.unknown_drives);
  return machine;
}

runs::CampaignOutcome campaign_dig(const DigCampaign& options,
                                   const runs::CampaignOptions& campaign,
                                   const runs::Progress& progress) {
  const auto nominal = known_excavator(options, machines::kCylinders);
  return runs::campaign_dig(campaign, nominal, options.scenario, options.speed_override_ratio,
                            progress);
}

runs::CampaignOutcome campaign_grade(const GradeCampaign& options,
                                     const runs::CampaignOptions& campaign,
                                     const runs::Progress& progress) {
  const Designed nominal = designed(known_dozer(options), options.design);
  return runs::campaign_grade(campaign, nominal.machine, options.scenario, progress);
}

runs::CampaignOutcome campaign_designs(const GradeCampaign& options,
                                       const runs::CampaignOptions& campaign,
                                       const runs::Progress& progress) {
  return runs::campaign_designs(campaign, known_dozer(options), options.scenario, progress);
}

runs::CampaignOutcome campaign_identify(const IdentifyCampaign& options,
                                        const runs::CampaignOptions& campaign,
                                        const runs::Progress& progress) {
  const auto file = machines::find_profile(options.profile);
  if (machines::profile_kind(file) == machines::MachineKind::kDozer) {
    if (options.as_designed || options.speed_override_ratio != 1.0) {
      throw std::runtime_error(
          "--as-designed and --speed are of excavators: a dozer is hidden, and "
          "grades at its own speed");
    }
    return runs::campaign_identify_dozer(campaign, machines::load_simulated_dozer(file), progress);
  }
  const machines::SimulatedExcavator nominal = machines::load_simulated_excavator(file);
  return runs::campaign_identify(campaign, nominal, options.as_designed,
                                 options.speed_override_ratio, progress);
}

runs::CampaignOutcome campaign_fences(const FenceCampaign& options,
                                      const runs::CampaignOptions& campaign,
                                      const runs::Progress& progress) {
  const auto nominal = known_excavator(options, machines::kEveryDrive);
  return runs::campaign_fences(campaign, nominal, options.errors, progress);
}

runs::CampaignOutcome campaign_autodig(const AutodigCampaign& options,
                                       const runs::CampaignOptions& campaign,
                                       const runs::Progress& progress) {
  machines::SimulatedExcavator nominal = machines::load_simulated_excavator(
      machines::find_profile(options.profile), options.simulated);
  const TaskProgram program = runs::planned_task(options.scenario, nominal.profile).result.program;
  demand_known(nominal, machines::needed_drives(nominal.profile, program), options.unknown_drives);
  return runs::campaign_autodig(campaign, nominal, options.scenario, progress);
}

void add_campaign_dig(CLI::App& campaign, int& status) {
  auto options = std::make_shared<DigCampaign>();
  CLI::App* command = campaign.add_subcommand(
      "dig", "Many draws of what the controller does not know; goes on where it was interrupted");
  add_profile_option(*command, options->profile);
  options->campaign.draws = 200;
  add_task_campaign(*command, *options);
  add_override_option(*command, options->speed_override_ratio);
  options->scenario.errors = "all";
  add_simulated_options(*command, options->simulated);
  add_scenario_options(*command, options->scenario);
  add_found_option(*command, options->scenario.scenario.found);
  add_examples(*command, {"campaign dig --draws 40 --errors kim --summary out/draws.csv",
                          "campaign dig --shard 2/8 --summary out/shard2.csv",
                          "campaign dig --draws 10000 --slurm 40 --summary out/draws.csv"});
  on_callback(*command, options, status, campaign_dig);
}

void add_campaign_grade(CLI::App& campaign, int& status) {
  auto options = std::make_shared<GradeCampaign>();
  CLI::App* command = campaign.add_subcommand(
      "grade",
      "Many draws of a dozer that its controller does not quite know; goes on as dig does");
  add_profile_option(*command, options->profile);
  options->campaign.draws = 100;
  add_task_campaign(*command, *options);
  add_design_options(*command, options->design);
  options->scenario.errors = "all";
  add_speed_options(*command, options->scenario);
  add_engine_option(*command, options->scenario);
  add_ground_options(*command, options->scenario);
  add_lateness_options(*command, options->scenario);
  add_error_option(*command, options->scenario);
  add_examples(*command, {"campaign grade --draws 40 --summary out/grades.csv"});
  on_callback(*command, options, status, campaign_grade);
}

void add_campaign_designs(CLI::App& campaign, int& status) {
  auto options = std::make_shared<GradeCampaign>();
  CLI::App* command = campaign.add_subcommand(
      "designs",
      "Random designs of a dozer, one a seed: refused before the start with the place, or made "
      "within grade.tolerance; goes on as dig does");
  add_profile_option(*command, options->profile);
  options->campaign.draws = 160;
  add_task_campaign(*command, *options);
  add_speed_options(*command, options->scenario);
  add_engine_option(*command, options->scenario);
  add_ground_options(*command, options->scenario);
  add_lateness_options(*command, options->scenario);
  add_error_option(*command, options->scenario);
  add_examples(*command, {"campaign designs --draws 20 --summary out/designs.csv"});
  on_callback(*command, options, status, campaign_designs);
}

void add_campaign_ground(CLI::App& campaign, int& status) {
  auto options = std::make_shared<GradeCampaign>();
  CLI::App* command = campaign.add_subcommand(
      "ground",
      fmt::format("A dozer on ground that resists: {} cells of 4 soils, 10 designs and 3 engine "
                  "speeds; cell after cell, then the next draw of each; goes on as dig does",
                  runs::ground_cells()));
  add_profile_option(*command, options->profile);
  options->campaign.draws = 40 * runs::ground_cells();
  add_task_campaign(*command, *options);
  add_examples(*command, {"campaign ground --draws 120 --summary out/ground.csv"});
  on_callback(*command, options, status,
              [](const GradeCampaign& of, const runs::CampaignOptions& chosen,
                 const runs::Progress& progress) {
                return runs::campaign_ground(chosen, known_dozer(of), progress);
              });
}

void add_campaign_identify(CLI::App& campaign, int& status) {
  auto options = std::make_shared<IdentifyCampaign>();
  CLI::App* command = campaign.add_subcommand(
      "identify",
      "Machines that no file describes, one a seed: commissioned over their bus, identified, then "
      "digging with the profile as shipped, as identified and as their truth; half as fast where a "
      "dead time passes 100 ms. Of a dozer's profile hidden dozers, which grade");
  add_profile_option(*command, options->profile);
  options->campaign.draws = 200;
  add_campaign_options(*command, options->campaign);
  command->add_flag(
      "--as-designed", options->as_designed,
      "The profile's own simulated machine with Kim's errors, instead of hidden ones");
  add_override_option(*command, options->speed_override_ratio);
  add_examples(*command, {"campaign identify --draws 4 --summary out/hidden.csv"});
  on_callback(*command, options, status, campaign_identify);
}

void add_campaign_fences(CLI::App& campaign, int& status) {
  auto options = std::make_shared<FenceCampaign>();
  CLI::App* command = campaign.add_subcommand(
      "fences",
      "Random tasks past random walls, floors, ceilings, boxes and cylinders, from random starts: "
      "how far any true point of the machine was beyond one");
  add_profile_option(*command, options->profile);
  options->campaign.draws = 1000;
  add_task_campaign(*command, *options);
  command
      ->add_option("--errors", options->errors,
                   "What the controller does not know, as in campaign dig")
      ->check(error_name())
      ->capture_default_str();
  add_simulated_options(*command, options->simulated);
  add_examples(*command, {"campaign fences --draws 100 --summary out/fences.csv"});
  on_callback(*command, options, status, campaign_fences);
}

void add_campaign_assist(CLI::App& campaign, int& status) {
  const runs::AssistTrial usual;
  auto options = std::make_shared<AssistCampaign>();
  CLI::App* command = campaign.add_subcommand(
      "assist",
      fmt::format(
          "An operator's arm lever draws the edge along a design: {} cells of {} designs and "
          "{} records of levers; cell after cell, then the next draw of each; goes on as dig "
          "does",
          usual.cells(), usual.designs(), runs::kLeverRecords.size()));
  add_profile_option(*command, options->profile);
  options->campaign.draws = 40 * usual.cells();
  add_task_campaign(*command, *options);
  command
      ->add_option("--errors", options->errors,
                   "What the controller does not know, as in campaign dig")
      ->check(error_name())
      ->capture_default_str();
  add_found_option(*command, options->found);
  command
      ->add_option_function<std::string>(
          "--sensors", [options](const std::string& name) { options->imus = name == "imu"; },
          "What measures the joints, as in campaign dig: the profile's sensors, or IMUs on the "
          "links")
      ->check(one_of({"profile", "imu"}))
      ->default_str("profile");
  command->add_flag("--unmarked", options->unmarked,
                    "The edge was not touched to a mark at the start");
  command->add_flag("--surfaces", options->surfaces,
                    "Designs of heights on a grid: flat, a slope, a V ditch, and the shipped "
                    "crest.xml; else the two that are planes");
  add_simulated_options(*command, options->simulated);
  add_examples(*command, {"campaign assist --draws 24 --summary out/assist.csv",
                          "campaign assist --surfaces --draws 24 --summary out/surfaces.csv"});
  on_callback(*command, options, status,
              [](const AssistCampaign& of, const runs::CampaignOptions& chosen,
                 const runs::Progress& progress) {
                const auto machine = known_excavator(of, machines::kCylinders);
                runs::AssistTrial trial{of.errors, !of.unmarked, {}, of.found, of.imus};
                if (of.surfaces) {
                  trial.grounds = runs::assist_grounds(machine.profile);
                  trial.grounds.push_back(crest_ground(machine.profile));
                }
                return runs::campaign_assist(chosen, machine, trial, progress);
              });
}

void add_campaign_autodig(CLI::App& campaign, int& status) {
  auto options = std::make_shared<AutodigCampaign>();
  CLI::App* command = campaign.add_subcommand(
      "autodig", "Many draws of a task, also in soil; goes on where it was interrupted");
  add_profile_option(*command, options->profile);
  options->campaign.draws = 40;
  add_task_campaign(*command, *options);
  options->scenario.errors = "all";
  add_simulated_options(*command, options->simulated);
  add_task_options(*command, options->scenario);
  add_examples(*command, {"campaign autodig --task trench --draws 20 --summary out/trench.csv"});
  on_callback(*command, options, status, campaign_autodig);
}

}  // namespace

void add_campaign(CLI::App& app, int& status) {
  CLI::App* campaign = add_command(app, "campaign");
  campaign->require_subcommand(1);
  add_examples(*campaign, {"campaign dig --draws 40 --summary out/draws.csv"});
  add_campaign_dig(*campaign, status);
  add_campaign_grade(*campaign, status);
  add_campaign_designs(*campaign, status);
  add_campaign_ground(*campaign, status);
  add_campaign_identify(*campaign, status);
  add_campaign_autodig(*campaign, status);
  add_campaign_fences(*campaign, status);
  add_campaign_assist(*campaign, status);
  add_campaign_merge(*campaign, status);
  add_campaign_progress(*campaign, status);
  add_campaign_collect(*campaign, status);
}

}  // namespace graben::cli
