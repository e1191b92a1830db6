// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Many draws of a run on all cores, and their distribution.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/runs/campaign_file.hpp"
#include "app/runs/scenarios.hpp"

namespace graben::runs {

struct CampaignOptions {
  std::uint64_t draws = 0;
  std::uint64_t seed = 1;     ///< Of the first draw; each next has the next.
  std::string shard = "1/1";  ///< i/n: every n-th draw from the i-th on.
  std::string summary;        ///< CSV, a row for each draw.
  unsigned jobs = 0;          ///< Threads; 0 for all cores.
};

/// Distribution of what the file has now, and why the campaign is not done; empty: it is.
struct CampaignOutcome {
  std::string table;
  std::string error;
  int signal = 0;  ///< That ended it early, as SIGINT; 0: none.
};

/// Digging and grading campaigns. Each draws what the file lacks; SIGINT and SIGTERM let the runs
/// that have begun come to their end, and the same options then go on with the rest. Throws
/// std::runtime_error for what is wrong with the options, the profile or the file.
[[nodiscard]] CampaignOutcome campaign_dig(const CampaignOptions& options,
                                           const machines::SimulatedExcavator& nominal,
                                           const DigScenario& scenario, double speed_override_ratio,
                                           const Progress& progress);
[[nodiscard]] CampaignOutcome campaign_grade(const CampaignOptions& options,
                                             const machines::SimulatedDozer& nominal,
                                             const GradeScenario& scenario,
                                             const Progress& progress);

/// Random designs, one a seed, in a scenario: refused with its place before the start, or made
/// within what the task allows.
[[nodiscard]] CampaignOutcome campaign_designs(const CampaignOptions& options,
                                               const machines::SimulatedDozer& nominal,
                                               const GradeScenario& scenario,
                                               const Progress& progress);

/// Hidden machines of `nominal`: commissioned, identified, and put to the dig, see
/// identify_run.hpp.
[[nodiscard]] CampaignOutcome campaign_identify(const CampaignOptions& options,
                                                const machines::SimulatedExcavator& nominal,
                                                bool as_designed, double speed_override_ratio,
                                                const Progress& progress);

/// The same of hidden dozers, put to the grade, see dozer_identify_run.hpp.
[[nodiscard]] CampaignOutcome campaign_identify_dozer(const CampaignOptions& options,
                                                      const machines::SimulatedDozer& nominal,
                                                      const Progress& progress);

/// Random tasks before random fences, see fence_campaign.hpp.
[[nodiscard]] CampaignOutcome campaign_fences(const CampaignOptions& options,
                                              const machines::SimulatedExcavator& nominal,
                                              const std::string& errors, const Progress& progress);

/// A task, once for each draw. Its seed is the campaign's.
[[nodiscard]] CampaignOutcome campaign_autodig(const CampaignOptions& options,
                                               const machines::SimulatedExcavator& nominal,
                                               const TaskScenario& scenario,
                                               const Progress& progress);

/// Rows that a campaign's file of any kind has; 0 where there is no file. Throws std::runtime_error
/// where it cannot be read.
[[nodiscard]] std::size_t campaign_rows(const std::string& file);

/// How many draws the options' shard has, done or not. Throws std::runtime_error where it is none.
[[nodiscard]] std::size_t shard_size(const CampaignOptions& options);

/// Shards of one campaign of any kind into one file; returns the table. Throws std::runtime_error
/// where they do not belong together.
[[nodiscard]] std::string merge_campaigns(const std::vector<std::string>& files,
                                          const std::string& summary);

/// The run of a seed. Called from several threads at once.
using CampaignDraw = std::function<CampaignRow(std::uint64_t seed)>;

/// A campaign of any kind. `tried` says what is tried, and must begin with the kind's name.
[[nodiscard]] CampaignOutcome run_campaign(const CampaignOptions& options, const CampaignKind& kind,
                                           const std::string& tried, const CampaignDraw& draw,
                                           const Progress& progress);

}  // namespace graben::runs
