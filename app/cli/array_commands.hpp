// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Campaigns on Slurm and in shards, as commands: `campaign ... --slurm`, `campaign merge`,
/// `campaign progress`, `campaign collect`.

#include <functional>

#include "app/cli/array_job.hpp"
#include "app/runs/campaign_run.hpp"

namespace CLI {
class App;
}

namespace graben::cli {

/// Adds --slurm and --sbatch.
void add_array_options(CLI::App& command, ArrayOptions& options);

/// Submits `command`, as it was typed, in shards. `run` is the campaign: it is tried without a draw
/// first, so that what is wrong with it is said now and once. Throws std::runtime_error for that,
/// for a summary that is there or is another campaign's, and where Slurm refuses.
void submit_campaign(const CLI::App& command, const runs::CampaignOptions& campaign,
                     const ArrayOptions& options,
                     const std::function<void(const runs::CampaignOptions&)>& run);

void add_campaign_progress(CLI::App& campaign, int& status);
void add_campaign_collect(CLI::App& campaign, int& status);
void add_campaign_merge(CLI::App& campaign, int& status);

}  // namespace graben::cli
