#pragma once
/// A campaign of digging runs.

#include "app/cli/campaign_file.hpp"
#include "app/cli/dig_run.hpp"

namespace graben::cli {

[[nodiscard]] const CampaignKind& dig_campaign();
[[nodiscard]] CampaignRow dig_campaign_row(const DigResult& result);

}  // namespace graben::cli
