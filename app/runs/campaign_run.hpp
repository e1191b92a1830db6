#pragma once
/// Many draws of a run on all cores, and their distribution.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/runs/campaign_file.hpp"

namespace graben::runs {

struct CampaignOptions {
  std::uint64_t draws = 0;
  std::uint64_t seed = 1;     ///< Of the first draw; each next has the next.
  std::string shard = "1/1";  ///< i/n: every n-th draw from the i-th on.
  std::string summary;        ///< CSV, a row for each draw.
  unsigned jobs = 0;          ///< Threads; 0 for all cores.
};

/// The run of a seed. Called from several threads at once.
using CampaignDraw = std::function<CampaignRow(std::uint64_t seed)>;

/// Draws what the file lacks and prints the table. SIGINT and SIGTERM let the runs that have begun
/// come to their end. `tried` says what is tried, and must begin with the kind's name. Throws
/// std::runtime_error for what is wrong with the options or the file, after an interruption, and if
/// any draw did not come to its end.
void run_campaign(const CampaignOptions& options, const CampaignKind& kind,
                  const std::string& tried, const CampaignDraw& draw);

/// Shards of one campaign into one file, and the table. Throws std::runtime_error where they do
/// not belong together.
void merge_campaigns(const std::vector<std::string>& files, const std::string& summary,
                     const CampaignKind& kind);

}  // namespace graben::runs
